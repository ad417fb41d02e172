// A15: a cuboid of whole cells under uniaxial load: Young's modulus, Poisson ratio, and creep of Kelvin-Voigt bonds without mass.
#include <cmath>
#include <cstddef>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/bond.hpp>
#include <dmp/integrator.hpp>
#include <dmp/lattice_spring.hpp>
#include <dmp/simulation.hpp>

using namespace dmp::lattice_spring;
using dmp::Vector;

namespace {

// k = l = 1, so E = 2.5 and nu = 1/4.
constexpr double modulus = 2.5;
Body<3> cuboid(int cells) { return lattice_block(CubicLattice{.spacing = 1.0}, {cells, cells, cells}, SurfaceBonds::shared); }

/// A normal stress on the two faces across x: on each bead as much as there are cells of the face around it.
struct Traction {
  double stress;  // [Pa], > 0 pulls
  int cells;      // along each edge

  [[nodiscard]] double force(double x, double y, double z) const {
    const auto share = [this](double at) { return at > 0.5 && at < cells - 0.5 ? 1.0 : 0.5; };
    return (x > cells - 0.5 ? 1.0 : x < 0.5 ? -1.0 : 0.0) * stress * share(y) * share(z);
  }
  [[nodiscard]] dmp::Components<3, double> acceleration(const auto& subject) const {
    const auto& [x, y, z] = subject.position.component;
    return {{force(x, y, z) / subject.mass, 0.0, 0.0}};
  }
};
void validate(const Traction&) {}

/// Strain of a cuboid along d: how far its two faces have moved apart.
double strain(const Body<3>& body, const auto& now, int cells, int d) {
  double apart = 0.0, beads = 0.0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double from = body.points.positions[i][d];
    if (from > 0.5 && from < cells - 0.5) continue;
    apart += (from < 0.5 ? -1.0 : 1.0) * (now[i][d] - from);
    beads += 0.5;
  }
  return apart / (beads * cells);
}

/// By the linear problem: loads at x = n, the faces x = 0, y = 0, z = 0 on rollers.
void check_elasticity(int cells) {
  CAPTURE(cells);
  const auto body = cuboid(cells);
  const auto& x = body.points.positions;
  const Traction traction{.stress = 1.0, .cells = cells};
  Supports<3> rollers(x.size());
  std::vector<Vector<3>> loads;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (int d = 0; d < 3; ++d)
      if (x[i][d] < 0.5) rollers.hold(i, d);
    loads.push_back({traction.force(x[i][0], x[i][1], x[i][2]), 0.0, 0.0});
  }
  const SmallStrain<3> springs(body, {.stiffness = 1.0});
  const std::vector<Vector<3>> rest(x.size(), Vector<3>::Zero());
  auto now = equilibrium<3>(springs, rollers, rest, loads, {.tolerance = 1e-13}).displacements;
  double uneven = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    uneven = std::max(uneven, (now[i] - Vector<3>(x[i][0], -0.25 * x[i][1], -0.25 * x[i][2]) / modulus).norm() / cells);
    now[i] += x[i];
  }
  const double along = strain(body, now, cells, 0);
  CHECK(1.0 / along == doctest::Approx(modulus).epsilon(1e-10));
  CHECK(-strain(body, now, cells, 1) / along == doctest::Approx(0.25).epsilon(1e-10));
  CHECK(-strain(body, now, cells, 2) / along == doctest::Approx(0.25).epsilon(1e-10));
  CHECK(uneven <= 1e-10);
}

struct Beads {};
enum class Rule { backward_euler, midpoint };

/// Relative L2 of the strain over 5 relaxation times against (sigma/E)(1 - exp(-t/tau)).
double creep_error(int cells, Rule rule, int steps_per_tau, double tolerance = 1e-5) {
  const auto body = cuboid(cells);
  constexpr double tau = 1.0, last_strain = 1e-5;
  const double dt = tau / steps_per_tau;
  const Traction traction{.stress = modulus * last_strain, .cells = cells};
  auto bonds = body.bonds;
  dmp::geometry::Points<3> points = body.points;
  measure_rest_lengths<3>(bonds, points.positions);
  InertiaFreeStep<3> step(dmp::bond::KelvinVoigt{.stiffness = 1.0, .damping = tau}, rule == Rule::midpoint ? 0.5 * dt : dt, bonds,
                          points.positions);
  double error = 0.0, all = 0.0, along = 0.0, across = 0.0;
  std::vector<Vector<3>> before = points.positions;
  for (int n = 1; n <= 5 * steps_per_tau; ++n) {
    auto start = points;  // a first guess: as in the last step
    for (std::size_t i = 0; i < before.size(); ++i)
      start.positions[i] += (rule == Rule::midpoint ? 0.5 : 1.0) * (points.positions[i] - before[i]);
    before = points.positions;
    auto scene = dmp::simulation::scene<dmp::integrator::Leapfrog>(
        dmp::geometry::Box<3>::unbounded(), dmp::simulation::group<Beads>("beads", dmp::particles::Mobile{}, start, 1.0),
        dmp::simulation::bonds<Beads, Beads>(step.law(), step.bonds()), dmp::simulation::forced_by<Beads>(traction));
    relax(scene, {.force_tolerance = tolerance * traction.stress});
    const auto& found = scene.group<Beads>().positions();
    for (std::size_t i = 0; i < found.size(); ++i)  // half a step and the same again
      points.positions[i] = rule == Rule::midpoint ? Vector<3>(2.0 * found[i] - points.positions[i]) : found[i];
    step.advance(points.positions);
    along = strain(body, points.positions, cells, 0);
    across = strain(body, points.positions, cells, 1);
    const double exact = -last_strain * std::expm1(-n * dt / tau);
    error += dmp::square(along - exact);
    all += dmp::square(exact);
  }
  CHECK(-across / along == doctest::Approx(0.25).epsilon(1e-3));
  return std::sqrt(error / all);
}

}  // namespace

TEST_CASE("A15: a loaded cuboid of 10^3 cells is strained uniformly, with E = 2.5 k/l and nu = 1/4 to 1e-10") { check_elasticity(10); }
TEST_CASE("slow: A15: E and nu of 40^3 cells to 1e-10") { check_elasticity(40); }

TEST_CASE("A15: a Kelvin-Voigt cuboid of 10^3 cells creeps as one bond does, (sigma/E)(1 - exp(-t/tau)) to 1e-3, without mass") {
  CHECK(creep_error(10, Rule::midpoint, 10) <= 1e-3);
  const double order_of_euler = std::log2(creep_error(3, Rule::backward_euler, 20) / creep_error(3, Rule::backward_euler, 40));
  const double order_of_midpoint = std::log2(creep_error(3, Rule::midpoint, 5) / creep_error(3, Rule::midpoint, 10));
  CHECK(order_of_euler == doctest::Approx(1.0).epsilon(0.05));
  CHECK(order_of_midpoint == doctest::Approx(2.0).epsilon(0.05));
}

TEST_CASE("slow: A15: creep of 40^3 cells to 1e-3") { CHECK(creep_error(40, Rule::midpoint, 6, 1e-4) <= 1e-3); }
