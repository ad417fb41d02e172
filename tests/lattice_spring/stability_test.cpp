// What holds a bead: mechanisms, and the highest frequency that bounds the time step (section 6 of sheets 01 and 04).
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/bond.hpp>
#include <dmp/integrator.hpp>
#include <dmp/lattice_spring.hpp>
#include <dmp/simulation.hpp>
#include "support/compare.hpp"
#include "support/stiffness_matrix.hpp"

using namespace dmp::lattice_spring;
using dmp::Vector;
using dmp::geometry::Ball, dmp::geometry::Box, dmp::geometry::Cuboid, dmp::geometry::Points;
using dmp::neighbours::Bond;
using test::largest_eigenvalue;
using test::relative_error;
using test::complaint;

namespace {

struct Beads {};

auto solid(const Body<3>& body, double mass, const auto& law) {
  return dmp::simulation::scene<dmp::integrator::Leapfrog>(
      Box<3>::unbounded(), dmp::simulation::group<Beads>("beads", dmp::particles::Mobile{}, body.points, mass),
      dmp::simulation::bonds<Beads, Beads>(law, body.bonds));
}

}  // namespace

TEST_CASE("sheet 01 section 6: inside the cubic lattice H = 6 k 1, so omega^2 <= 12 k/m") {
  const auto block = lattice_block(CubicLattice{.spacing = 0.1}, {4, 4, 4});
  const auto held = local_stiffness(block, 7.0);
  for (std::size_t i = 0; i < held.size(); ++i)
    if (bonds_per_bead(block)[i] == 18) CHECK((held[i] - 42.0 * Tensor<3>::Identity()).norm() < 1e-11);
  CHECK(highest_rate<3>(held, 2.0) == doctest::Approx(12.0 * 7.0 / 2.0).epsilon(1e-13));
  CHECK(stable_time_step(block, 2.0, 7.0) == doctest::Approx(2.0 / std::sqrt(42.0)).epsilon(1e-13));
  // The sphere of sheet 01 at 1000 kg/m^3: 3.51e7 1/s, and 5.2e-8 s with tau = 5e-9 s.
  const double mass = 1000.0 * std::pow(12.5e-6, 3);
  CHECK(std::sqrt(highest_rate<3>(local_stiffness(block, 200.0), mass)) == doctest::Approx(3.51e7).epsilon(2e-3));
  CHECK(stable_time_step(block, mass, 200.0, 1e-6) == doctest::Approx(5.2e-8).epsilon(0.01).scale(0.0));
}

TEST_CASE(
    "section 6: the bound holds for lattices and networks, by the eigenvalues of the whole stiffness matrix, and is near in lattices") {
  const auto block = lattice_block(CubicLattice{.spacing = 1.0}, {5, 5, 5}, SurfaceBonds::shared);
  const auto points = random_points<3>({.least_distance = 0.46, .most_points = 200}, {.lower = {0, 0, 0}, .upper = {3, 3, 3}});
  for (const auto& body : {block, lattice_block(CubicLattice{.spacing = 1.0}, {5, 5, 5}), network(points, 0.885),
                           network(points, 0.885, StiffnessRule::uniform_tension)}) {
    const double exact = largest_eigenvalue(body), bound = highest_rate<3>(local_stiffness(body, 1.0), 1.0);
    CAPTURE(exact / bound);
    CHECK(exact <= bound);
    CHECK(exact > 0.5 * bound);
  }
  CHECK(largest_eigenvalue(block) > 0.85 * 12.0);
}

TEST_CASE("section 6: two beads, b = 0.2 N s/m on 1e-5 kg each, allow 5e-5 s; springs alone 2/omega; nothing, any step") {
  Body<3> pair;
  pair.points.positions = {{0, 0, 0}, {1, 0, 0}};
  pair.bonds = {{0, 1}};
  CHECK(stable_time_step(pair, 1e-5, 0.0, 0.2) == doctest::Approx(5e-5).epsilon(1e-14));
  CHECK(stable_time_step(pair, 1e-5, 0.2) == doctest::Approx(2.0 / std::sqrt(2.0 * 0.2 / 1e-5)).epsilon(1e-14));
  CHECK(stable_time_step(pair, 1e-5, 0.0) == std::numeric_limits<double>::infinity());
  const double omega = 300.0, tau = 2e-3;  // sqrt(tau^2 + 4/omega^2) - tau
  CHECK(stable_time_step(omega * omega, omega * omega * tau) ==
        doctest::Approx(std::sqrt(tau * tau + 4.0 / (omega * omega)) - tau).epsilon(1e-13));
  // Lists with laws of their own add up.
  auto sum = local_stiffness(pair, 3.0);
  const auto more = local_stiffness(pair, 4.0);
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += more[i];
  CHECK(highest_rate<3>(sum, 0.5) == doctest::Approx(28.0).epsilon(1e-14));
  // A bond under tension T also holds across, by T/L; one under pressure is taken as at rest.
  const std::vector<double> pull{5.0}, push{-5.0};
  const Tensor<3> pulled = local_stiffness<3>(pair.points.positions, pair.bonds, 3.0, pull)[0];
  CHECK((pulled - Tensor<3>(Vector<3>(3.0, 5.0, 5.0).asDiagonal())).norm() < 1e-14);
  CHECK((local_stiffness<3>(pair.points.positions, pair.bonds, 3.0, push)[0] - local_stiffness(pair, 3.0)[0]).norm() == 0.0);
}

TEST_CASE("the bound of a body is that of a scene of it: 2/omega, omega^2 = 12 k/m, on the cubic lattice") {
  const auto block = lattice_block(CubicLattice{.spacing = 1.0}, {4, 4, 4});
  auto scene = solid(block, 2.0, dmp::bond::Harmonic{.stiffness = 7.0});
  const double bound = 2.0 / std::sqrt(12.0 * 7.0 / 2.0);
  CHECK(stable_time_step(block, 2.0, 7.0) == doctest::Approx(bound).epsilon(1e-7));
  CHECK(scene.step_limit().stable_time_step == doctest::Approx(bound).epsilon(1e-7));
}

TEST_CASE("mechanisms: beads with fewer than three bonds that do not lie in one plane, and no others") {
  // Bead 0 has three bonds, bead 1 in the plane of four, bead 2 two, bead 3 one, bead 4 none, bead 5 two along one line.
  Body<3> body{.points = {.positions = {{0, 0, 0}, {10, 0, 0}, {20, 0, 0}, {30, 0, 0}, {40, 0, 0}, {50, 0, 0}}}, .bonds = {}};
  const auto tie = [&body](std::uint32_t bead, const Vector<3>& to) {
    body.points.positions.push_back(body.points.positions[bead] + to);
    body.bonds.push_back({bead, static_cast<std::uint32_t>(body.points.positions.size() - 1)});
  };
  tie(0, {1, 0, 0}), tie(0, {0, 1, 0}), tie(0, {1, 1, 1e-3});
  tie(1, {1, 0, 0}), tie(1, {0, 1, 0}), tie(1, {1, 1, 0}), tie(1, {-1, 2, 0});
  tie(2, {1, 0, 0}), tie(2, {0, 1, 0});
  tie(3, {1, 0, 0});
  tie(5, {1, 0, 0}), tie(5, {-2, 0, 0});
  auto loose = mechanisms(body);
  std::erase_if(loose, [](std::uint32_t bead) { return bead > 5; });  // the far ends all are
  CHECK(loose == std::vector<std::uint32_t>{1, 2, 3, 4, 5});
  CHECK(bonds_per_bead(body)[1] == 4);

  CHECK(mechanisms(lattice_block(CubicLattice{.spacing = 1.0}, {2, 2, 2}, SurfaceBonds::shared)).empty());
  CHECK(mechanisms(lattice_block(TriangularLattice{.spacing = 1.0}, {3, 3})).empty());
  auto block = lattice_block(CubicLattice{.spacing = 1.0}, {2, 2, 2});
  for (auto& bond : block.bonds)  // the corner 0 keeps its bonds in the plane z = 0
    if (bond.i == 0 && block.points.positions[bond.j][2] > 0.0) bond.weight = 0.0;
  CHECK(mechanisms(block) == std::vector<std::uint32_t>{0});
  CHECK(bonds_per_bead(block)[0] == 3);
}

TEST_CASE("scenes refuse bodies with a bond of length zero, of a bead with itself, twice, or to a bead that is not there") {
  const dmp::bond::Harmonic law{.stiffness = 1.0};
  const auto with = [&](std::vector<Bond> bonds) {
    const Body<3> body{.points = {.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}}, .bonds = std::move(bonds)};
    return complaint([&] { return solid(body, 1.0, law); });
  };
  CHECK(with({{0, 1}}).empty());
  CHECK(with({{1, 2}}) ==
        "bonds of beads: length must be > 0 m (the two ends coincide; give a rest_length if that is meant), got bond (1, 2)");
  CHECK(with({{1, 1}}) == "bonds of beads: a particle cannot be bonded to itself, got bond (1, 1)");
  CHECK(with({{0, 1}, {1, 0}}) == "bonds of beads: the same two particles must not be bonded twice, got bond (0, 1)");
  CHECK(with({{0, 3}}) == "bonds of beads: both ends must exist (3 and 3 particles), got bond (0, 3)");
}

TEST_CASE("stability: what cannot be bounded is told by name and value") {
  const auto block = lattice_block(CubicLattice{.spacing = 1.0}, {1, 1, 1});
  CHECK(complaint([&] { return stable_time_step(block, 0.0, 1.0); }) ==
        "lattice_spring::highest_rate: mass must be finite and > 0 kg, got 0");
  CHECK(complaint([&] { return stable_time_step(block, 1.0, -1.0); }) ==
        "lattice_spring::stable_time_step: stiffness must be finite and >= 0 N/m, got -1");
  CHECK(complaint([&] { return stable_time_step(block, 1.0, 1.0, -1.0); }) ==
        "lattice_spring::stable_time_step: damping must be finite and >= 0 N s/m, got -1");
  CHECK(complaint([] { return stable_time_step(-4.0); }) ==
        "lattice_spring::stable_time_step: omega_squared must be finite and >= 0 1/s^2, got -4");
  Body<3> broken = block;
  broken.bonds.push_back({0, 99});
  CHECK(complaint([&] { return mechanisms(broken); }) ==
        "lattice_spring::local_stiffness: both ends of a bond must exist (8 beads), got bond (0, 99)");
}
