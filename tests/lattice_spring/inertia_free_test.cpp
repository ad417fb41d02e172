// A8: viscoelastic steps without inertia, on one bond against closed forms; whole bodies are an example's.
#include <cmath>
#include <string>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/lattice_spring/inertia_free.hpp>

using dmp::Vector;
using dmp::lattice_spring::InertiaFreeStep;
using dmp::neighbours::Bond;
namespace bond = dmp::bond;

namespace {

constexpr double rest = 2.0;
std::vector<Vector<1>> ends(double length) { return {Vector<1>(0.0), Vector<1>(length)}; }
const std::vector<Bond> one{{0, 1, rest}};

/// Extension after `steps` steps under a constant force: each is one spring at rest.
double creep(const auto& law, double force, double dt, int steps) {
  InertiaFreeStep<1> step(law, dt, one, ends(rest));
  double length = rest;
  for (int n = 0; n < steps; ++n) {
    length = step.bonds()[0].rest_length + force / step.law().stiffness;
    step.advance(ends(length));
  }
  return length - rest;
}

}  // namespace

TEST_CASE("A1 without mass: creep of a Kelvin-Voigt bond is (F/k)(1 - exp(-t k/b)), with the first order of backward Euler") {
  const bond::KelvinVoigt law{.stiffness = 0.2, .damping = 0.2};
  const auto error = [&](int steps) { return std::fabs(creep(law, 0.1, 1.0 / steps, steps) - 0.5 * (1.0 - std::exp(-1.0))); };
  CHECK(error(1000) < 1e-4);
  CHECK(std::log2(error(1000) / error(2000)) == doctest::Approx(1.0).epsilon(0.01));
}

TEST_CASE(
    "A8c: creep of a standard linear solid is its closed form, with the first order of a load put on within a step, and relaxation at a "
    "fixed length is exact") {
  const bond::StandardLinearSolid law{.stiffness = 1.7, .branch_stiffness = 1.0, .branch_damping = 4.0};
  const double time_constant = 4.0 * 2.7 / (1.7 * 1.0), exact = 1.0 / 1.7 * (1.0 - 1.0 / 2.7 * std::exp(-3.0 / time_constant));
  const auto error = [&](int steps) { return std::fabs(creep(law, 1.0, 3.0 / steps, steps) - exact); };
  CHECK(error(1000) < 1e-3);
  CHECK(std::log2(error(1000) / error(2000)) == doctest::Approx(1.0).epsilon(0.02));
  const double dt = 0.5;
  InertiaFreeStep<1> step(law, dt, one, ends(rest));
  const double stretched = rest + 0.1;
  const auto force = [&] { return step.law().stiffness * (stretched - step.bonds()[0].rest_length); };
  const double first = force();
  step.advance(ends(stretched));
  const double branch = first - 0.17;  // at the end of the ramp of one step
  CHECK(branch == doctest::Approx(0.1 * -std::expm1(-dt / 4.0) / (dt / 4.0)).epsilon(1e-12));
  for (int n = 1; n < 20; ++n) {
    CHECK(force() - 0.17 == doctest::Approx(branch * std::exp(-n * dt / 4.0)).epsilon(1e-12));
    step.advance(ends(stretched));
  }
}

TEST_CASE("without dashpots a step is the springs themselves") {
  InertiaFreeStep<1> step(bond::KelvinVoigt{.stiffness = 3.0, .damping = 0.0}, 0.1, one, ends(rest));
  step.advance(ends(5.0));
  CHECK(step.law().stiffness == 3.0);
  CHECK(step.bonds()[0].rest_length == rest);
}

TEST_CASE("inertia-free steps refuse bonds without a rest length, and no time") {
  const auto complaint = [](double dt, double rest_length) -> std::string {
    try {
      InertiaFreeStep<1>(bond::KelvinVoigt{.stiffness = 1.0, .damping = 1.0}, dt, {{0, 1, rest_length}}, ends(rest));
    } catch (const dmp::ParameterError& error) {
      return error.what();
    }
    return {};
  };
  CHECK(complaint(0.0, rest) == "lattice_spring::InertiaFreeStep: dt must be finite and > 0 s, got 0");
  CHECK(complaint(1.0, -1.0) ==
        "lattice_spring::InertiaFreeStep: rest_length (measure_rest_lengths first) must be finite and >= 0 m, got -1");
}
