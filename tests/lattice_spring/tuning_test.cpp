// kL-tune and ikL-tune of random networks (B6, B7 on a small cube, B11), interiors, and bodies too thin to tune.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>
#include "support/compare.hpp"
#include <doctest/doctest.h>
#include <dmp/lattice_spring.hpp>

using namespace dmp::lattice_spring;
using dmp::Vector;
using dmp::geometry::Ball, dmp::geometry::Cuboid, dmp::geometry::Points;
using test::relative_error;
using test::complaint;

namespace {

const double least = 0.46, reach = 0.885;  // [a0], of sheet 04

struct Cube {
  double edge;
  [[nodiscard]] Cuboid<3> shape() const { return {.lower = {0, 0, 0}, .upper = {edge, edge, edge}}; }
  [[nodiscard]] Body<3> body(std::uint64_t seed = 1) const {
    const auto count = static_cast<std::size_t>(7.1 * edge * edge * edge);
    return network(random_points<3>({.least_distance = least, .most_points = count, .seed = seed}, shape()), reach);
  }
};

bool same_weights(const Body<3>& a, const Body<3>& b) {
  return std::equal(a.bonds.begin(), a.bonds.end(), b.bonds.begin(), [](const auto& p, const auto& q) { return p.weight == q.weight; });
}

}  // namespace

TEST_CASE("interiors: depth below the surface of cuboids and balls, and the volume of what lies deeper") {
  const Cuboid<3> box{.lower = {0, 0, 0}, .upper = {2, 4, 6}};
  CHECK(depth_in(box, Vector<3>(0.7, 2.0, 3.0)) == doctest::Approx(0.7).epsilon(1e-15));
  CHECK(depth_in(box, Vector<3>(1.0, 4.5, 3.0)) == doctest::Approx(-0.5).epsilon(1e-15));
  CHECK(volume_deeper(box, 0.5) == doctest::Approx(1.0 * 3.0 * 5.0).epsilon(1e-15));
  CHECK(volume_deeper(box, 1.0) == 0.0);
  CHECK(volume_deeper(box, 1.5) == 0.0);
  const Ball<2> disc{.centre = {1, 0}, .radius = 3.0};
  CHECK(depth_in(disc, Vector<2>(3.0, 0.0)) == doctest::Approx(1.0).epsilon(1e-15));
  CHECK(volume_deeper(disc, 1.0) == doctest::Approx(4.0 * 3.141592653589793).epsilon(1e-15));
  CHECK(volume_deeper(Ball<3>{.centre = {0, 0, 0}, .radius = 1.0}, 2.0) == 0.0);
  const Interior<Cuboid<3>> inside{box, 0.5};
  CHECK(inside.contains({0.6, 1.0, 1.0}));
  CHECK_FALSE(inside.contains({0.4, 1.0, 1.0}));
}

TEST_CASE("B11: the bonds of a chain come to one k L, that of their mean by w L^2, when the limit of change is not met") {
  const std::vector<double> length{1.0, 1.1, 0.9, 1.05, 0.95, 1.0};
  Points<1> line{.positions = {Vector<1>(0.0)}};
  for (const double l : length) line.positions.push_back(line.positions.back() + Vector<1>(l));
  auto body = network(line, 1.2);
  const auto before = body;
  REQUIRE(body.bonds.size() == 6);
  // Inner beads are those at least 0.5 deep; bonds inside all six but none is left out of the balance.
  const auto report = tune_balance(body, Cuboid<1>{.lower = Vector<1>(-0.3), .upper = Vector<1>(6.3)}, 0.5, {.solver_tolerance = 1e-13});
  CHECK(report.end == TuningEnd::balanced);
  CHECK(report.steps == 1);
  CHECK(report.imbalance < 1e-12);
  CHECK(report.imbalance_before > 0.03);
  double level = 0.0, level_before = 0.0;
  for (std::size_t b = 0; b < 6; ++b) {
    CHECK(relative_error(body.bonds[b].weight * length[b], body.bonds[0].weight * length[0]) < 1e-12);
    level += body.bonds[b].weight * length[b] * length[b];
    level_before += length[b] * length[b];
  }
  CHECK(relative_error(level, level_before) < 1e-14);
}

TEST_CASE("B6 on a cube of 5 a0: kL-tune keeps points, limits and the interior's bulk modulus, and balances the inner beads") {
  const Cube cube{5.0};
  const auto before = cube.body();
  auto body = before;
  const auto report = tune_balance(body, cube.shape(), reach);
  INFO("S_kL ", report.imbalance_before, " -> ", report.imbalance, " in ", report.steps, " steps, factors ", report.smallest_factor, " to ",
       report.largest_factor);
  CHECK(report.imbalance < 0.02 * report.imbalance_before);
  CHECK(report.imbalance < 1e-3);
  const Interior<Cuboid<3>> inside{cube.shape(), reach};
  const auto inner = [&](const Vector<3>& x) { return inside.contains(x); };
  CHECK(report.imbalance == doctest::Approx(mean_imbalance(body, inner)).epsilon(1e-9));
  CHECK(report.imbalance_before == doctest::Approx(mean_imbalance(before, inner)).epsilon(1e-9));
  CHECK(body.points.positions == before.points.positions);
  CHECK(relative_error(affine_bulk_modulus(body, 1.0, inside, inside.volume()), affine_bulk_modulus(before, 1.0, inside, inside.volume())) <
        1e-13);
  double smallest = 1e300, largest = 0.0, border = 0.0;
  for (std::size_t b = 0; b < body.bonds.size(); ++b) {
    const double factor = body.bonds[b].weight / before.bonds[b].weight;
    smallest = std::min(smallest, factor);
    largest = std::max(largest, factor);
    if (inner(body.points.positions[body.bonds[b].i]) || inner(body.points.positions[body.bonds[b].j])) continue;
    if (border == 0.0) border = factor;
    CHECK(relative_error(factor, border) < 1e-14);  // border bonds: the common factor alone
  }
  CHECK(smallest == report.smallest_factor);
  CHECK(largest == report.largest_factor);
  CHECK(smallest > 0.4999 * border);
  CHECK(largest < 1.5001 * border);
  // Stretched alike and then let go, the interior does not move.
  const SmallStrain<3> strained(body, {.stiffness = 1.0}), untuned(before, {.stiffness = 1.0});
  Supports<3> supports(body.points.positions.size());
  for (std::size_t i = 0; i < supports.beads(); ++i)
    if (!inner(body.points.positions[i])) supports.hold(i);
  const auto moved = [&](const SmallStrain<3>& of) {
    const auto relaxed = equilibrium<3>(of, supports, body.points.positions).displacements;
    double sum = 0.0;
    for (std::size_t i = 0; i < relaxed.size(); ++i) sum += (relaxed[i] - body.points.positions[i]).squaredNorm();
    return std::sqrt(sum);
  };
  CHECK(moved(strained) < 0.05 * moved(untuned));
}

TEST_CASE(
    "B12, counted: solves and alternations do not grow with the network, iterations of a solve more slowly than the beads across it") {
  struct Work {
    double across;  // a0, of the inner beads
    TuningReport balance;
    StressTuningReport stress;
  };
  const auto work = [](double edge) {
    const Cube cube{edge};
    auto body = cube.body(), other = body;
    return Work{edge - 2.0 * reach, tune_balance(body, cube.shape(), reach), tune_stress(other, cube.shape(), reach)};
  };
  const Work small = work(5.0), large = work(8.0);
  const auto each = [](const TuningReport& report) { return static_cast<double>(report.iterations) / static_cast<double>(report.solves); };
  for (const Work& one : {small, large}) {
    CHECK(one.balance.solves == one.balance.steps);
    CHECK(one.balance.solves <= 25);  // 5 to 25, and 90 iterations of each for twice the springs of the large one
    CHECK(each(one.balance) <= 90.0);
    CHECK(one.stress.steps <= 300);
    CHECK(one.stress.solves <= one.stress.steps + 25);
    CHECK(each(one.stress) <= each(one.balance));  // from one alternation to the next little is left to solve for
  }
  CHECK(each(large.balance) <= each(small.balance) * large.across / small.across);
  CHECK(each(large.stress) <= each(small.stress) * large.across / small.across);
}

TEST_CASE("B7 on a cube of 6 a0: ikL-tune makes the stress of inner beads even besides, within the same limits") {
  const Cube cube{6.0};
  const auto before = cube.body(2);
  auto body = before, balanced = before;
  const auto report = tune_stress(body, cube.shape(), reach);
  const auto plain = tune_balance(balanced, cube.shape(), reach);
  INFO("scatter ", report.stress_scatter_before, " -> ", report.stress_scatter, ", S_kL ", report.imbalance, ", kL-tune ", plain.imbalance);
  CHECK(report.stress_scatter < 0.5 * report.stress_scatter_before);
  CHECK(report.imbalance < 0.02);
  CHECK(report.largest_factor / report.smallest_factor < 3.0001);
  const Interior<Cuboid<3>> inside{cube.shape(), reach};
  CHECK(relative_error(affine_bulk_modulus(body, 1.0, inside, inside.volume()), affine_bulk_modulus(before, 1.0, inside, inside.volume())) <
        1e-13);
  CHECK(body.points.positions == before.points.positions);
}

TEST_CASE("section 6: a body without inner bead is left alone by both; one without room for probes is balanced only") {
  const Cuboid<3> slab{.lower = {0, 0, 0}, .upper = {6, 6, 1.7}};
  auto body = network(random_points<3>({.least_distance = least, .most_points = 400}, slab), reach);
  const auto before = body;
  CHECK(tune_balance(body, slab, reach).end == TuningEnd::nothing_to_do);
  CHECK(tune_stress(body, slab, reach).end == TuningEnd::nothing_to_do);
  CHECK(same_weights(body, before));
  const Cube small{3.0};
  auto little = small.body();
  const auto report = tune_stress(little, small.shape(), reach);
  CHECK(report.end == TuningEnd::stagnated);
  CHECK(report.steps == 0);
  CHECK(report.imbalance < 0.1 * report.imbalance_before);
  // Lattices with whole cells are in balance as they are.
  auto lattice = lattice_block(CubicLattice{.spacing = 0.5}, {8, 8, 8}, SurfaceBonds::shared);
  const auto as_made = lattice;
  const auto nothing = tune_balance(lattice, Cuboid<3>{.lower = {0, 0, 0}, .upper = {4, 4, 4}}, 0.75);
  CHECK(nothing.end == TuningEnd::balanced);
  CHECK(nothing.steps == 0);
  CHECK(same_weights(lattice, as_made));
}

TEST_CASE("tuning: bad settings are told by name and value") {
  const Cube cube{3.0};
  auto body = cube.body();
  CHECK(complaint([&] { return tune_balance(body, cube.shape(), 0.0); }) ==
        "lattice_spring::tune_balance: reach must be finite and > 0 m, got 0");
  CHECK(complaint([&] { return tune_balance(body, cube.shape(), reach, {.largest_change = 1.0}); }) ==
        "lattice_spring::Tuning: largest_change must be > 0 and < 1, got 1");
  CHECK(complaint([&] { return tune_balance(body, cube.shape(), reach, {.most_steps = 0}); }) ==
        "lattice_spring::Tuning: most_steps must be >= 1, got 0");
  CHECK(complaint([&] { return tune_stress(body, cube.shape(), reach, {.step = 2.0}); }) ==
        "lattice_spring::StressTuning: step must be > 0 and < 2, got 2");
  CHECK(complaint([&] { return tune_stress(body, cube.shape(), reach, {.balance = {.largest_change = -1.0}}); }) ==
        "lattice_spring::Tuning: largest_change must be > 0 and < 1, got -1");
}
