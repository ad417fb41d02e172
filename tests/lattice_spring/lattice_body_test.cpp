// Bodies cut out of lattices of springs: exact counts of sheet 01, weights in the surface, division into core and shell.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>
#include <doctest/doctest.h>
#include <Eigen/Geometry>
#include <dmp/lattice_spring.hpp>
#include "support/compare.hpp"

using namespace dmp::lattice_spring;
using dmp::Vector;
using dmp::geometry::Ball, dmp::geometry::Cuboid;

using test::complaint;

namespace {

const double l = 12.5e-6;  // [m], of the sphere of sheet 01

Body<3> sphere(int radius, const Tensor<3>& orientation = Tensor<3>::Identity(), SurfaceBonds surface = SurfaceBonds::full) {
  const double reach = (radius + 1) * l;
  return lattice_body(CubicLattice{.spacing = l, .orientation = orientation},
                      {.lower = {-reach, -reach, -reach}, .upper = {reach, reach, reach}},
                      Ball<3>{.centre = {0, 0, 0}, .radius = (radius - 1e-6) * l}, surface);
}

std::size_t edges(const Body<3>& body) {
  return static_cast<std::size_t>(std::count_if(body.bonds.begin(), body.bonds.end(), [&](const auto& bond) {
    return (body.points.positions[bond.i] - body.points.positions[bond.j]).norm() < 1.2 * l;
  }));
}

Tensor<3> generic() { return Eigen::Quaterniond(-0.467424, -0.047608, 0.829916, -0.300813).normalized().toRotationMatrix(); }  // q1 of A4

/// All bonds between points that lie one of `lengths` apart, by looking at every pair.
template <int Dim>
std::set<std::pair<std::uint32_t, std::uint32_t>> pairs_at(const std::vector<Vector<Dim>>& x, const std::vector<double>& lengths) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t i = 0; i < x.size(); ++i)
    for (std::uint32_t j = i + 1; j < x.size(); ++j)
      for (const double length : lengths)
        if (std::fabs((x[i] - x[j]).norm() - length) < 1e-9) pairs.insert({i, j});
  return pairs;
}
template <int Dim>
std::set<std::pair<std::uint32_t, std::uint32_t>> pairs_of(const Body<Dim>& body) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const auto& bond : body.bonds) pairs.insert({std::min(bond.i, bond.j), std::max(bond.i, bond.j)});
  CHECK(pairs.size() == body.bonds.size());
  return pairs;
}

struct Count {
  int radius;
  std::size_t beads, edges, diagonals;
  double coordination;
};
void check_sphere(const Count& count) {
  CAPTURE(count.radius);
  const auto body = sphere(count.radius);
  CHECK(body.points.positions.size() == count.beads);
  CHECK(edges(body) == count.edges);
  CHECK(body.bonds.size() == count.edges + count.diagonals);
  CHECK(std::round(100.0 * mean_coordination(body)) == std::round(100.0 * count.coordination));
  CHECK(body.points.volume == doctest::Approx(l * l * l).epsilon(1e-14).scale(0.0));
  CHECK(body.volume == doctest::Approx(static_cast<double>(count.beads) * l * l * l).epsilon(1e-14).scale(0.0));
}

}  // namespace

static_assert(SpringLattice<CubicLattice> && SpringLattice<TriangularLattice> && SpringLattice<SquareLattice>);

TEST_CASE("A4, sheet 01 section 3: spheres of cubic lattice have the beads, edge bonds and diagonal bonds of the table") {
  for (const auto& count :
       {Count{8, 2103, 5730, 10956, 15.87}, Count{10, 4139, 11502, 22176, 16.27}, Count{16, 17071, 48834, 95688, 16.93},
        Count{20, 33371, 96378, 189648, 17.14}, Count{24, 57747, 167874, 331236, 17.29}, Count{32, 137059, 401562, 795108, 17.46}})
    check_sphere(count);
}

TEST_CASE("A4: a turned lattice gives the same sphere, turned about its centre; its bead at the centre stays") {
  const auto straight = sphere(8), turned = sphere(8, generic());
  CHECK(turned.points.positions.size() == straight.points.positions.size());
  CHECK(turned.bonds.size() == straight.bonds.size());
  const auto& x = turned.points.positions;
  CHECK(std::any_of(x.begin(), x.end(), [](const auto& at) { return at.norm() == 0.0; }));
  double farthest = 0.0;
  for (const auto& at : x) {  // whole numbers of steps once turned back
    const Vector<3> steps = generic().transpose() * at / l;
    farthest = std::max(farthest, (steps - steps.array().round().matrix()).norm());
  }
  CHECK(farthest < 1e-13);
}

TEST_CASE("A4: every bead that has all its neighbours has 18 bonds, and a bead of the lattice moved to another centre is a bead still") {
  const auto body = sphere(8);
  const auto count = bonds_per_bead(body);
  for (std::size_t i = 0; i < count.size(); ++i) {
    CHECK(count[i] <= 18);
    if (body.points.positions[i].norm() < (8.0 - std::sqrt(2.0) - 1e-5) * l) CHECK(count[i] == 18);
  }
  CHECK(mean_coordination(body, [](const Vector<3>& x) { return x.norm() < 6.5 * l; }) == 18.0);

  const Vector<3> centre{0.3, -0.2, 0.1};
  const auto elsewhere = lattice_body(CubicLattice{.spacing = 0.1, .node = centre}, {.lower = {-1, -2, -1}, .upper = {2, 1, 2}},
                                      Ball<3>{.centre = centre, .radius = 0.8 - 1e-7});
  CHECK(elsewhere.points.positions.size() == 2103);
}

TEST_CASE("lattices of springs: bonds are all pairs at the distances of the lattice, by looking at every pair") {
  const Ball<3> ball{.centre = {0.1, 0.2, 0.0}, .radius = 3.3};
  const Cuboid<3> around{.lower = {-4, -4, -4}, .upper = {4, 4, 4}};
  const auto cubic = lattice_body(CubicLattice{.spacing = 1.0, .orientation = generic()}, around, ball);
  CHECK(pairs_of(cubic) == pairs_at<3>(cubic.points.positions, {1.0, std::sqrt(2.0)}));
  const Tensor<2> turn = Eigen::Rotation2D<double>(0.4).toRotationMatrix();
  const Ball<2> disc{.centre = {0.1, 0.2}, .radius = 5.3};
  const Cuboid<2> square{.lower = {-6, -6}, .upper = {6, 6}};
  const auto triangular = lattice_body(TriangularLattice{.spacing = 1.0, .orientation = turn}, square, disc);
  CHECK(pairs_of(triangular) == pairs_at<2>(triangular.points.positions, {1.0}));
  CHECK(mean_coordination(triangular, [](const Vector<2>& x) { return x.norm() < 4.0; }) == 6.0);
  CHECK(triangular.points.volume == doctest::Approx(std::sqrt(0.75)).epsilon(1e-14));
  const auto diagonal = lattice_body(SquareLattice{.spacing = 1.0, .orientation = turn}, square, disc);
  CHECK(pairs_of(diagonal) == pairs_at<2>(diagonal.points.positions, {1.0, std::sqrt(2.0)}));
  CHECK(mean_coordination(diagonal, [](const Vector<2>& x) { return x.norm() < 3.5; }) == 8.0);
}

TEST_CASE("A15: in a block, bonds in a free face weigh 1/2, on a free edge 1/4, all others 1") {
  const int n = 3;
  const auto block = lattice_block(CubicLattice{.spacing = 1.0}, {n, n, n}, SurfaceBonds::shared);
  CHECK(block.points.positions.size() == 64);
  CHECK(block.bonds.size() == static_cast<std::size_t>(3 * n * (n + 1) * (n + 1) + 6 * n * n * (n + 1)));
  CHECK(block.volume == doctest::Approx(27.0).epsilon(1e-14));
  CHECK(block.points.volume == doctest::Approx(27.0 / 64.0).epsilon(1e-14));
  for (const auto& bond : block.bonds) {
    const Vector<3>& a = block.points.positions[bond.i];
    const Vector<3>& b = block.points.positions[bond.j];
    int faces = 0;  // that hold the whole bond
    for (int d = 0; d < 3; ++d) faces += a[d] == b[d] && (a[d] == 0.0 || a[d] == n) ? 1 : 0;
    CHECK(bond.weight == std::pow(0.5, faces));
  }
  for (const auto& bond : lattice_block(CubicLattice{.spacing = 1.0}, {n, n, n}).bonds) CHECK(bond.weight == 1.0);
}

TEST_CASE("A15: weights are shares of cells on any shape, so they add up to those of an endless lattice of as many cells") {
  const auto check = [](const auto& body, double bonds_per_node, double node_volume) {
    double sum = 0.0;
    for (const auto& bond : body.bonds) {
      CHECK((bond.weight > 0.0 && bond.weight <= 1.0));
      sum += bond.weight;
    }
    CHECK(sum == doctest::Approx(bonds_per_node * body.volume / node_volume).epsilon(1e-12));
    for (const std::uint32_t count : bonds_per_bead(body)) CHECK(count > 0);
  };
  const auto body = sphere(8, generic(), SurfaceBonds::shared);
  check(body, 9.0, l * l * l);
  const Cuboid<3> around{.lower = {-3, -3, -3}, .upper = {3, 3, 3}};
  const Ball<3> small{.centre = {0, 0, 0}, .radius = 2.1};
  CHECK(lattice_body(CubicLattice{.spacing = 1.0}, around, small).points.positions.size() == 33);
  const auto cube = lattice_body(CubicLattice{.spacing = 1.0}, around, small, SurfaceBonds::shared);
  CHECK(cube.points.positions.size() == 27);  // without the six tips, which are beads of no whole cell
  check(cube, 9.0, 1.0);
  const Ball<2> disc{.centre = {0.1, 0.2}, .radius = 5.3};
  const Cuboid<2> square{.lower = {-6, -6}, .upper = {6, 6}};
  check(lattice_body(TriangularLattice{.spacing = 0.5}, square, disc, SurfaceBonds::shared), 3.0, 0.25 * std::sqrt(0.75));
  check(lattice_body(SquareLattice{.spacing = 0.5}, square, disc, SurfaceBonds::shared), 3.0, 0.25);  // 2 edges, 2 halved diagonals
  check(lattice_block(TriangularLattice{.spacing = 0.5}, {4, 7}, SurfaceBonds::shared), 3.0, 0.25 * std::sqrt(0.75));
}

TEST_CASE("a cuboid is filled up to its lower faces and not to its upper ones, whatever the lattice's node") {
  const auto body = lattice_body(CubicLattice{.spacing = 1.0, .node = {100.0, -50.0, 7.0}}, {.lower = {0, 0, 0}, .upper = {4, 3, 2}});
  CHECK(body.points.positions.size() == 24);
  CHECK(body.points.positions.front() == Vector<3>(0, 0, 0));
  CHECK(body.points.positions.back() == Vector<3>(3, 2, 1));
  CHECK(body.points.positions[1] == Vector<3>(1, 0, 0));
}

TEST_CASE("A10: bonds of a sphere are divided between core and shell; those across go to the shell, to the core, or stand apart") {
  const auto body = sphere(8);
  const Ball<3> core{.centre = {0, 0, 0}, .radius = 0.8 * 8 * l};
  const auto ends_inside = [&](const auto& bond) {
    return (core.contains(body.points.positions[bond.i]) ? 1 : 0) + (core.contains(body.points.positions[bond.j]) ? 1 : 0);
  };
  std::array<std::size_t, 3> count{};
  for (const auto& bond : body.bonds) ++count[static_cast<std::size_t>(ends_inside(bond))];
  CHECK((count[0] > 0 && count[1] > 0 && count[2] > 0));

  const auto apart = split_core_shell(body, core, InterfaceBonds::separate);
  CHECK(apart.core.size() == count[2]);
  CHECK(apart.shell.size() == count[0]);
  CHECK(apart.interface.size() == count[1]);
  for (const auto& bond : apart.interface) CHECK(ends_inside(bond) == 1);
  for (const auto& bond : apart.core) CHECK(ends_inside(bond) == 2);
  const auto to_shell = split_core_shell(body, core), to_core = split_core_shell(body, core, InterfaceBonds::core);
  CHECK((to_shell.core.size() == count[2] && to_shell.shell.size() == count[0] + count[1] && to_shell.interface.empty()));
  CHECK((to_core.core.size() == count[2] + count[1] && to_core.shell.size() == count[0] && to_core.interface.empty()));
  CHECK(harmonic_mean(200.0, 20.0) == doctest::Approx(2.0 / (1.0 / 200.0 + 1.0 / 20.0)).epsilon(1e-15));
  CHECK(harmonic_mean(0.0, 0.0) == 0.0);
  CHECK(harmonic_mean(0.0, 5.0) == 0.0);
  CHECK(complaint([] { return harmonic_mean(1.0, -2.0); }) ==
        "lattice_spring::harmonic_mean: stiffness must be finite and >= 0 N/m, got -2");
  CHECK(complaint([&] { return split(body, 1, [](const auto&, const auto&) { return 1u; }); }) ==
        "lattice_spring::split: the rule must name one of 1 lists, from 0, got 1");
}

TEST_CASE("lattice bodies: what cannot be built is told by name and value") {
  const Cuboid<3> unit{.lower = {0, 0, 0}, .upper = {1, 1, 1}};
  CHECK(complaint([&] { return lattice_body(CubicLattice{.spacing = 0.0}, unit); }) ==
        "lattice_spring::CubicLattice: spacing must be finite and > 0 m, got 0");
  CHECK(complaint([&] { return lattice_body(CubicLattice{.spacing = 0.1, .orientation = 2.0 * Tensor<3>::Identity()}, unit); }) ==
        "lattice_spring::CubicLattice: orientation must be a rotation, |R^T R - 1| <= 1e-9, got a matrix with 3");
  const Tensor<2> mirror{{-1.0, 0.0}, {0.0, 1.0}};
  CHECK(complaint([&] { return lattice_block(SquareLattice{.spacing = 0.1, .orientation = mirror}, {2, 2}); }) ==
        "lattice_spring::SquareLattice: orientation must be a rotation, determinant 1, got a reflection, determinant -1");
  CHECK(complaint([] { return lattice_block(TriangularLattice{.spacing = 0.1}, {2, 0}); }) ==
        "lattice_spring::lattice_block: cells must be >= 1 in each direction, got 0");
  CHECK(complaint([&] { return lattice_body(CubicLattice{.spacing = 0.1, .node = {NAN, 0, 0}}, unit); }) ==
        "lattice_spring::CubicLattice: node must be finite [m], got nan");
  CHECK(complaint([&] { return lattice_body(CubicLattice{.spacing = 1e-4}, unit); }) ==
        "lattice_spring: the bounding cuboid must hold at most 2^31 lattice nodes, got 1001500750125");
  CHECK(complaint([] { return lattice_body(CubicLattice{.spacing = 1.0}, {.lower = {0.1, 0.1, 0.1}, .upper = {0.9, 0.9, 0.9}}); }) ==
        "lattice_spring: no node of the lattice lies inside the shape, got a spacing of 1 m");
  CHECK(complaint([&] {
          return lattice_body(CubicLattice{.spacing = 0.9}, {.lower = {0, 0, 0}, .upper = {2, 2, 0.8}}, SurfaceBonds::shared);
        }) == "lattice_spring: no whole cell of the lattice lies inside the shape, got a spacing of 0.9 m");
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(complaint([&] { return lattice_body(CubicLattice{.spacing = 0.9}, {.lower = {0, 0, 0}, .upper = {2, 2, infinity}}); }) ==
        "lattice_spring::lattice_body: upper bound of the cuboid must be finite [m], got inf");
}
