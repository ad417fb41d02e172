#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <Eigen/LU>

#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/shape.hpp>
#include <dmp/lattice_spring/body.hpp>
#include <dmp/lattice_spring/detail/checks.hpp>
#include <dmp/lattice_spring/detail/node_grid.hpp>
#include <dmp/lattice_spring/lattice.hpp>

namespace dmp::lattice_spring {

/// What a bond in the surface of a body weighs. A bond belongs in equal parts to the lattice cells around it.
///   full    as inside: the surface is somewhat too stiff. Volume of the body: that of one node times their number.
///   shared  (whole cells of the body around it)/(cells around it in an endless lattice): 1/2 in a free face, 1/4 on a free edge of a cubic
///           lattice. Every cell is complete, and a uniform strain is in equilibrium up to the surface. Nodes and bonds of no whole
///           cell are left out. Volume of the body: that of its cells.
enum class SurfaceBonds { full, shared };

/// The nodes of `lattice` inside both `within` and `shape`, bonded; in a fixed order, the first direction of the lattice running fastest.
/// A node on the very surface of the shape is in or out by rounding: where the count matters, put the surface between nodes, as in
///   const double l = 12.5e-6;  // the sphere |r| < 32 l, with 137,059 beads and 1,196,670 bonds
///   const auto sphere = lattice_body(CubicLattice{.spacing = l}, {.lower = {-33 * l, -33 * l, -33 * l}, .upper = {33 * l, 33 * l, 33 *
///   l}},
///                                    Ball<3>{.centre = {0, 0, 0}, .radius = (32 - 1e-6) * l});
template <SpringLattice L, class S>
  requires geometry::Shape<S, L::dimension>
[[nodiscard]] Body<L::dimension> lattice_body(const L& lattice, const geometry::Cuboid<L::dimension>& within, const S& shape,
                                              SurfaceBonds surface = SurfaceBonds::full) {
  constexpr int dim = L::dimension;
  validate(lattice);
  validate(within);
  validate(shape);
  detail::require_finite<dim>("lattice_spring::lattice_body: lower bound of the cuboid", within.lower, "m");
  detail::require_finite<dim>("lattice_spring::lattice_body: upper bound of the cuboid", within.upper, "m");
  const Tensor<dim> basis = lattice.basis(), to_steps = basis.inverse();
  Vector<dim> lowest = Vector<dim>::Constant(std::numeric_limits<double>::infinity()), highest = -lowest;
  for (unsigned corner = 0; corner < 1u << dim; ++corner) {
    Vector<dim> x = within.lower;
    for (int d = 0; d < dim; ++d)
      if ((corner >> d & 1u) != 0) x[d] = within.upper[d];
    const Vector<dim> steps = to_steps * (x - lattice.node);
    lowest = lowest.cwiseMin(steps);
    highest = highest.cwiseMax(steps);
  }
  for (int d = 0; d < dim; ++d) {  // one step to spare against rounding
    lowest[d] = std::floor(lowest[d]) - 1.0;
    highest[d] = std::ceil(highest[d]) + 1.0;
  }
  detail::NodeGrid<dim> grid(lowest, highest);
  grid.for_each_place([&](std::size_t place, const Vector<dim>& steps) {
    const Vector<dim> position = lattice.node + basis * steps;
    grid.inside[place] = within.contains(position) && shape.contains(position) ? 1 : 0;
  });
  return detail::connect(lattice, grid, surface == SurfaceBonds::shared);
}

/// All the nodes of `lattice` inside a cuboid.
template <SpringLattice L>
[[nodiscard]] Body<L::dimension> lattice_body(const L& lattice, const geometry::Cuboid<L::dimension>& within,
                                              SurfaceBonds surface = SurfaceBonds::full) {
  return lattice_body(lattice, within, within, surface);
}

/// A block of whole cells, `cells` along each direction of the lattice, from its node: cells + 1 nodes in each direction. On a turned or
/// triangular lattice a turned cuboid or a parallelogram.
template <SpringLattice L>
[[nodiscard]] Body<L::dimension> lattice_block(const L& lattice, const std::array<int, static_cast<std::size_t>(L::dimension)>& cells,
                                               SurfaceBonds surface = SurfaceBonds::full) {
  constexpr int dim = L::dimension;
  validate(lattice);
  Vector<dim> highest;
  for (std::size_t d = 0; d < dim; ++d) {
    require(cells[d] >= 1, "lattice_spring::lattice_block: cells must be >= 1 in each direction", cells[d]);
    highest[static_cast<int>(d)] = cells[d];
  }
  detail::NodeGrid<dim> grid(Vector<dim>::Zero(), highest);
  grid.for_each_place([&](std::size_t place, const Vector<dim>&) { grid.inside[place] = 1; });
  return detail::connect(lattice, grid, surface == SurfaceBonds::shared);
}

}  // namespace dmp::lattice_spring
