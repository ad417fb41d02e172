// Layers pushed through each other: sheet 01, section 6.
#include <array>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/lattice_spring.hpp>

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
