// Where bodies of bonds blow up: for each bond law, on two beads and on a block of lattice, the step that a scene allows, the exact limit
// of the scheme, and the one found by bisection. One CSV line each, steps in 1/omega, omega the highest frequency of the springs;
// bonded_solids.py makes a table of them.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <dmp/dmp.hpp>

#include "support/stiffness_matrix.hpp"

using namespace dmp;
using namespace dmp::simulation;
using lattice_spring::Body;

namespace {

struct Beads {};

// k = m = l = 1 for bonds that are springs at once; the spring of Maxwell's law and both of the standard linear solid together are 1.
constexpr auto explicitly = [](const auto& law, const Body<3>& body) { return bonds<Beads, Beads>(law, body.bonds); };
constexpr auto implicitly = [](const bond::KelvinVoigt& law, const Body<3>& body) { return implicit_bonds<Beads, Beads>(law, body.bonds); };

auto scene_of(const auto& make_bonds, const auto& law, const Body<3>& body) {
  return scene<integrator::Leapfrog>(geometry::Box<3>::unbounded(), group<Beads>("beads", particles::Mobile{}, body.points, 1.0),
                                     make_bonds(law, body));
}

/// Whether a small motion at random grows with this step. The engine is asked, since a scene refuses steps beyond its bound.
bool blows_up(const auto& make_bonds, const auto& law, const Body<3>& body, double dt) {
  constexpr double small = 1e-9, grown = 1e6;
  constexpr std::uint64_t steps = 10000, look_every = 100;
  auto beads = scene_of(make_bonds, law, body);
  std::mt19937 generator;
  std::normal_distribution<double> normal(0.0, small);
  beads.template group<Beads>().template set<field::Velocity>(
      [&](const Vector<3>&) { return Vector<3>(normal(generator), normal(generator), normal(generator)); });
  const auto energy = [&] {
    double sum = 0.0;
    for (const Vector<3>& v : beads.template group<Beads>().template get<field::Velocity>()) sum += v.squaredNorm();
    return sum;
  };
  (void)beads.step_limit();  // checks the scene, and evaluates it
  auto& engine = beads.engine();
  const double start = energy();
  for (std::uint64_t n = 1; n <= steps; ++n) {
    const double time = static_cast<double>(n) * dt;
    const bool worn = engine.begin_step(dt, time);
    engine.prepare_forces(dt, n, worn);
    engine.forces(dt, time);
    engine.end_step(dt);
    if (n % look_every == 0 && !(energy() < grown * start)) return true;
  }
  return false;
}

double bisect(const auto& make_bonds, const auto& law, const Body<3>& body, double guess) {
  double stable = 0.5 * guess, unstable = 2.0 * guess;
  while (unstable - stable > 2e-3 * guess) {
    const double middle = 0.5 * (stable + unstable);
    (blows_up(make_bonds, law, body, middle) ? unstable : stable) = middle;
  }
  return 0.5 * (stable + unstable);
}

/// Where holds(dt) ends.
double largest(const auto& holds) {
  double low = 0.0, high = 1e3;
  for (int n = 0; n < 100; ++n) (holds(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  return low;
}

void print(const std::string& name, const std::string& of, double omega, const auto& make_bonds, const auto& law, const Body<3>& body,
           double exact) {
  auto beads = scene_of(make_bonds, law, body);
  std::printf("%s,%s,%.4f,%.4f,%.4f\n", of.c_str(), name.c_str(), omega * beads.step_limit().stable_time_step, omega * exact,
              omega * bisect(make_bonds, law, body, exact));
  std::fflush(stdout);
}

void print_all(const std::string& of, const Body<3>& body) {
  const double squared = test::largest_eigenvalue(body), omega = std::sqrt(squared);
  print("Harmonic", of, omega, explicitly, bond::Harmonic{.stiffness = 1.0}, body, 2.0 / omega);
  // Ratios tau = c/k in 1/omega, so that damping is light and heavy on both bodies.
  for (const double ratio : {0.1, 10.0}) {
    const double tau = ratio / omega;
    const std::string with = "; tau = " + to_text(ratio) + "/omega";
    const bond::KelvinVoigt damped{.stiffness = 1.0, .damping = tau};
    print("Kelvin-Voigt in `bonds`" + with, of, omega, explicitly, damped, body,
          std::sqrt(tau * tau + 4.0 / squared) - tau);
    print("Kelvin-Voigt in `implicit_bonds`" + with, of, omega, implicitly, damped, body, 2.0 / omega);
    // Eigenvalue -1 of the step: omega_e^2 dt^2 + omega_m^2 dt^2 tanh(h/2)/(h/2) = 4, h = dt/tau.
    const auto stable = [&](double share_of_branch) {
      return [=](double dt) {
        const double half = 0.5 * dt / tau;
        return squared * dt * dt * (1.0 - share_of_branch + share_of_branch * std::tanh(half) / half) < 4.0;
      };
    };
    print("Maxwell" + with, of, omega, explicitly, bond::Maxwell{.stiffness = 1.0, .damping = tau}, body, largest(stable(1.0)));
    print("standard linear solid" + with, of, omega, explicitly,
          bond::StandardLinearSolid{.stiffness = 0.5, .branch_stiffness = 0.5, .branch_damping = 0.5 * tau}, body,
          largest(stable(0.5)));
  }
}

}  // namespace

int main() {
  use_threads(1);
  std::puts("body,law,bound,exact,measured");
  Body<3> pair{.points = {.positions = {{0, 0, 0}, {1, 0, 0}}}, .bonds = {{0, 1}}};
  print_all("two beads", pair);
  print_all("lattice", lattice_spring::lattice_block(lattice_spring::CubicLattice{.spacing = 1.0}, {4, 4, 4}));
}
