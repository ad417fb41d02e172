#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/detail/checks.hpp>
#include <dmp/geometry/lattice.hpp>
#include <dmp/geometry/shape.hpp>

namespace dmp::geometry {

/// Places for particles.
template <int Dim>
struct Points {
  std::vector<Vector<Dim>> positions;  ///< [m]
  double spacing = 0.0;                ///< distance to the nearest neighbour [m]; 0 = unknown
  double volume = 0.0;                 ///< per point [m^Dim], so that the mass is density * volume; 0 = unknown
};

namespace detail {

/// Cells of a lattice from `first` to `last`, both included, in each direction.
template <int Dim>
struct CellRange {
  std::array<std::int64_t, Dim> first, last;
};

/// The cells that cover `within`, with one to spare on each side against rounding.
template <Lattice L>
[[nodiscard]] CellRange<L::dimension> cells_that_cover(const Cuboid<L::dimension>& within, const L& lattice) {
  constexpr double most_cells = 4294967296.0;         // 2^32: more points than a 32-bit index can name
  constexpr double largest_index = 4503599627370496.0;  // 2^52: beyond it a double no longer holds i + 1/2
  const Vector<L::dimension> cell = lattice.cell();
  CellRange<L::dimension> range;
  double cells = 1.0;
  for (int d = 0; d < L::dimension; ++d) {
    const double first = std::floor((within.lower[d] - lattice.origin[d]) / cell[d]) - 1.0;
    const double last = std::floor((within.upper[d] - lattice.origin[d]) / cell[d]) + 1.0;
    const double farthest = std::max(std::abs(first), std::abs(last));
    require(farthest < largest_index, "geometry::fill: the bounding cuboid must lie within 2^52 cells of the lattice's origin", farthest);
    cells *= last - first - 1.0;
    const auto index = static_cast<std::size_t>(d);
    range.first[index] = static_cast<std::int64_t>(first);
    range.last[index] = static_cast<std::int64_t>(last);
  }
  require(cells <= most_cells, "geometry::fill: the bounding cuboid must hold at most 2^32 lattice cells", cells);
  return range;
}

}  // namespace detail

/// The points of `lattice` inside both `within` and `shape`. Their order is fixed: cell by cell, x running fastest.
/// Each coordinate is rounded once, so fills of neighbouring shapes on the same lattice fit together without gap or double points.
///   const auto drop = fill(Cubic<2>{.spacing = 0.01}, {.lower = {0, 0}, .upper = {1, 1}}, Ball<2>{.centre = {0.5, 0.5}, .radius = 0.3});
template <Lattice L, class S>
  requires Shape<S, L::dimension>
[[nodiscard]] Points<L::dimension> fill(const L& lattice, const Cuboid<L::dimension>& within, const S& shape) {
  constexpr int dim = L::dimension;
  validate(lattice);
  validate(within);
  validate(shape);
  detail::require_finite<dim>("geometry::fill: lower bound of the cuboid", within.lower, "m");
  detail::require_finite<dim>("geometry::fill: upper bound of the cuboid", within.upper, "m");
  const auto [first, last] = detail::cells_that_cover(within, lattice);
  const auto sites = lattice.sites();
  const Vector<dim> cell = lattice.cell();

  Points<dim> points{.positions = {}, .spacing = lattice.nearest_distance(), .volume = volume_per_point(lattice)};
  auto index = first;
  for (std::size_t direction = 0; direction < dim;) {
    for (const Vector<dim>& site : sites) {
      Vector<dim> position;
      for (int d = 0; d < dim; ++d)
        position[d] = std::fma(static_cast<double>(index[static_cast<std::size_t>(d)]) + site[d], cell[d], lattice.origin[d]);
      if (within.contains(position) && shape.contains(position)) points.positions.push_back(position);
    }
    for (direction = 0; direction < dim && ++index[direction] > last[direction]; ++direction) index[direction] = first[direction];
  }
  if (points.positions.empty())
    throw ParameterError("geometry::fill: no lattice point lies inside the shape, got a lattice with points " + to_text(points.spacing) +
                         " m apart and a bounding cuboid from " + detail::to_text<dim>(within.lower) + " to " +
                         detail::to_text<dim>(within.upper) + " m");
  return points;
}

/// All the points of `lattice` inside a cuboid.
template <Lattice L>
[[nodiscard]] Points<L::dimension> fill(const L& lattice, const Cuboid<L::dimension>& within) {
  return fill(lattice, within, within);
}

/// Points on the straight line between two positions, both included, `spacing` apart; the length must be a whole number of spacings,
/// to within 1e-6 of one. The volume is spacing^Dim: the line stands for a layer as thick as its spacing.
template <int Dim>
[[nodiscard]] Points<Dim> line(const Vector<Dim>& from, const Vector<Dim>& to, double spacing) {
  constexpr double tolerance = 1e-6;           // of a spacing
  constexpr double most_points = 4294967296.0;  // as in fill
  detail::require_finite<Dim>("geometry::line: from", from, "m");
  detail::require_finite<Dim>("geometry::line: to", to, "m");
  require_positive("geometry::line: spacing", spacing, "m");
  const double length = (to - from).norm();
  const double intervals = std::round(length / spacing);
  if (!(intervals >= 1.0 && intervals < most_points && std::abs(length / spacing - intervals) <= tolerance))
    throw ParameterError("geometry::line: the length must be a whole number of spacings, from 1 to 2^32, got length " + to_text(length) +
                         " m and spacing " + to_text(spacing) + " m");
  const double actual_spacing = length / intervals;
  Points<Dim> points{.positions = {}, .spacing = actual_spacing, .volume = std::pow(actual_spacing, Dim)};
  const auto count = static_cast<std::size_t>(intervals);
  points.positions.reserve(count + 1);
  for (std::size_t i = 0; i < count; ++i) points.positions.push_back(from + (static_cast<double>(i) / intervals) * (to - from));
  points.positions.push_back(to);
  return points;
}

/// The points of both sets, first those of `a`. Both must have the same volume per point (or both none that is known), to 1e-6; the
/// spacing becomes unknown (0) where the two differ. Points in the same place stay double: sets are expected not to overlap.
template <int Dim>
[[nodiscard]] Points<Dim> merge(Points<Dim> a, const Points<Dim>& b) {
  constexpr double tolerance = 1e-6;
  const auto agree = [](double x, double y) { return std::abs(x - y) <= tolerance * std::max(std::abs(x), std::abs(y)); };
  if (!agree(a.volume, b.volume))
    throw ParameterError("geometry::merge: both sets must have the same volume per point, got " + to_text(a.volume) + " and " +
                         to_text(b.volume) + " m^" + std::to_string(Dim));
  if (!agree(a.spacing, b.spacing)) a.spacing = 0.0;
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  return a;
}

}  // namespace dmp::geometry
