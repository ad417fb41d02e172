// Layers pushed through each other: sheet 01, section 6.
#include <array>
#include <cmath>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/bond.hpp>
#include <dmp/forcing.hpp>
#include <dmp/integrator.hpp>
#include <dmp/lattice_spring.hpp>
#include <dmp/simulation.hpp>

using namespace dmp::lattice_spring;
using dmp::Vector;

TEST_CASE("no bead is folded in a body that is moved, turned, sheared and squeezed, in 2D and 3D") {
  const auto check = [](const auto& body, const auto& gradient) {
    constexpr int dim = std::remove_cvref_t<decltype(gradient)>::RowsAtCompileTime;
    std::vector<Vector<dim>> now;
    for (const auto& x : body.points.positions) now.push_back(gradient * x + Vector<dim>::Constant(7.0));
    CHECK(folded_beads<dim>(body.bonds, body.points.positions, now).empty());
  };
  const Tensor<3> solid{{0.0, -0.5, 0.3}, {0.9, 0.0, 0.4}, {0.0, 0.1, 0.8}};
  REQUIRE(solid.determinant() > 0.0);
  check(lattice_block(CubicLattice{.spacing = 1.0}, {4, 4, 4}), solid);
  check(lattice_block(TriangularLattice{.spacing = 1.0}, {4, 4}), Tensor<2>{{0.1, -1.0}, {0.7, 0.3}});
}

TEST_CASE("a layer that has been pushed through the next one is folded, and so is the one it passed; a mirrored body is folded all over") {
  const auto body = lattice_block(CubicLattice{.spacing = 1.0}, {4, 4, 4});
  const auto& x = body.points.positions;
  auto now = x;
  for (auto& at : now)
    if (at[2] > 3.5) at[2] -= 1.5;
  const auto folded = folded_beads<3>(body.bonds, x, now);
  std::size_t top = 0;
  for (const auto i : folded) {
    CHECK(x[i][2] > 2.5);
    top += x[i][2] > 3.5 ? 1u : 0u;
  }
  CHECK(top == 25);
  now = x;
  for (auto& at : now) at[0] = -at[0];
  CHECK(folded_beads<3>(body.bonds, x, now).size() == 125);
}

TEST_CASE("beads without bonds in all directions cannot be folded") {
  const std::vector<Vector<2>> x{{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}}, back{{2.0, 0.0}, {1.0, 0.0}, {0.0, 0.0}};
  CHECK(folded_beads<2>(std::vector<dmp::neighbours::Bond>{{0, 1}, {1, 2}}, x, back).empty());
}

namespace {

constexpr double tolerance = 1e-5, beads_times_tolerance = 2103 * tolerance;  // [k l]

struct Beads {};
struct Pressed {
  double force;  // [k l]
  dmp::simulation::StepsReport report;
};

/// A ball of R = 8 l, its layers along two plates, pressed by `approach` [l] in equal steps, each from rest to rest.
Pressed press(double approach, int steps, int most_halvings) {
  constexpr double radius = 8.0 - 1e-6;
  auto body = lattice_body(CubicLattice{.spacing = 1.0}, dmp::geometry::Cuboid<3>{.lower = {-9, -9, -9}, .upper = {9, 9, 9}},
                           dmp::geometry::Ball<3>{.centre = {0, 0, 0}, .radius = radius});
  measure_rest_lengths<3>(body.bonds, body.points.positions);
  const dmp::forcing::Plane<3> below{.normal = {{0.0, 0.0, 1.0}}, .position = -7.0, .strength = 625.0, .motion = {.speed = 0.5}};
  const dmp::forcing::Plane<3> above{.normal = {{0.0, 0.0, -1.0}}, .position = -7.0, .strength = 625.0, .motion = {.speed = 0.5}};
  auto ball = dmp::simulation::scene<dmp::integrator::Leapfrog>(
      dmp::geometry::Box<3>::unbounded(), dmp::simulation::group<Beads>("ball", dmp::particles::Mobile{}, body.points, 1.0),
      dmp::simulation::bonds<Beads, Beads>(dmp::bond::Harmonic{.stiffness = 1.0}, body.bonds),
      dmp::simulation::forced_by<Beads>(below, above));
  const auto report = dmp::simulation::relax_in_steps(
      ball,
      {.until = approach, .largest_step = approach / steps, .most_halvings = most_halvings,
       .relax = {.force_tolerance = tolerance, .without_rotation = true}},
      [&] { return folded_beads<3>(body.bonds, body.points.positions, ball.group<Beads>().positions()).size(); });
  return {.force = dmp::simulation::load_on<Beads>(ball, below, approach).force[2], .report = report};
}

}  // namespace

TEST_CASE("section 6: plates that move by 1.6 l at once fold layers, and bear less; with steps halved they do not, and bear as by 0.4 l") {
  constexpr double approach = 3.2;  // a fifth of the diameter
  const Pressed slow = press(approach, 8, 0), abrupt = press(approach, 2, 0), halved = press(approach, 2, 6);
  CHECK(slow.report.folded == 0);
  CHECK(abrupt.report.folded > 0);
  CHECK(abrupt.report.steps == 2);
  CHECK(abrupt.force < 0.95 * slow.force);
  CHECK(halved.report.folded == 0);
  CHECK(halved.report.halvings > 0);
  CHECK(halved.report.steps == 2 + halved.report.halvings);
  CHECK(halved.report.evaluations < slow.report.evaluations);
  CHECK(std::fabs(halved.force - slow.force) < beads_times_tolerance);
}
