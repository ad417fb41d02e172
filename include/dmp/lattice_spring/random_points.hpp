#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/fill.hpp>
#include <dmp/geometry/shape.hpp>
#include <dmp/lattice_spring/detail/checks.hpp>
#include <dmp/neighbours/spatial_order.hpp>

namespace dmp::lattice_spring {

/// Points uniformly at random, none nearer than `least_distance` to one before it: random sequential addition. It jams: in 3D at about
/// 0.733/least_distance^3 points per volume (packing fraction 0.384), in 2D at 0.696/least_distance^2 (0.547). It ends at `most_points`, or
/// after `most_failures` trials inside the shape that found no room, one after the other: ask how many there are.
/// J. Feder, J. Theor. Biol. 87 (1980) 237-254; 3D: D. W. Cooper, Phys. Rev. A 38 (1988) 522-524.
struct RandomAddition {
  Required<double> least_distance;  ///< [m], > 0
  std::size_t most_points = std::numeric_limits<std::uint32_t>::max();
  std::size_t most_failures = 1000000;
  std::uint64_t seed = 1;  ///< the same seed, the same points
};
inline void validate(const RandomAddition& addition) {
  require_positive("lattice_spring::RandomAddition: least_distance", addition.least_distance, "m");
  require(addition.most_points >= 1 && addition.most_points <= std::numeric_limits<std::uint32_t>::max(),
          "lattice_spring::RandomAddition: most_points must be from 1 to 2^32 - 1", static_cast<double>(addition.most_points));
  require(addition.most_failures >= 1, "lattice_spring::RandomAddition: most_failures must be >= 1",
          static_cast<double>(addition.most_failures));
}

/// Volume [m^Dim] of the part of a shape inside a cuboid, by counting `per_side`^Dim midpoints: exact for the cuboid itself, to about 1e-4
/// for a ball that just fits into it.
template <int Dim, class S>
  requires geometry::Shape<S, Dim>
[[nodiscard]] double volume_of(const S& shape, const geometry::Cuboid<Dim>& within, int per_side = Dim == 3 ? 128 : 1024) {
  validate(shape);
  validate(within);
  require(per_side >= 1, "lattice_spring::volume_of: per_side must be >= 1", per_side);
  const Vector<Dim> step = (within.upper - within.lower) / per_side;
  detail::require_finite<Dim>("lattice_spring::volume_of: extent of the cuboid", step, "m");
  std::array<int, Dim> at{};
  std::size_t hits = 0;
  for (std::size_t d = 0; d < Dim;) {
    Vector<Dim> x = within.lower;
    for (std::size_t e = 0; e < Dim; ++e) x[static_cast<int>(e)] += (at[e] + 0.5) * step[static_cast<int>(e)];
    hits += shape.contains(x) ? 1 : 0;
    for (d = 0; d < Dim && ++at[d] == per_side; ++d) at[d] = 0;
  }
  return static_cast<double>(hits) * step.prod();
}

/// Points by random sequential addition inside both `within` and `shape`, sorted so that neighbours in space are neighbours in memory.
/// `volume` of the shape [m^Dim], shared out to the points: 0 counts it (volume_of).
template <int Dim, class S>
  requires geometry::Shape<S, Dim>
[[nodiscard]] geometry::Points<Dim> random_points(const RandomAddition& addition, const geometry::Cuboid<Dim>& within, const S& shape,
                                                  double volume = 0.0) {
  validate(addition);
  validate(within);
  validate(shape);
  detail::require_finite<Dim>("lattice_spring::random_points: lower bound of the cuboid", within.lower, "m");
  detail::require_finite<Dim>("lattice_spring::random_points: upper bound of the cuboid", within.upper, "m");
  require_not_negative("lattice_spring::random_points: volume", volume, "m^Dim");
  constexpr double most_cells = 1073741824.0;     // 2^30
  constexpr std::size_t most_outside = 10000000;  // trials, one after the other, that miss the shape
  constexpr std::uint32_t empty = std::numeric_limits<std::uint32_t>::max();

  // Cells whose diagonal is the least distance: none holds two points, and a point that is too near lies at most two cells away.
  const double least = addition.least_distance, width = least / std::sqrt(static_cast<double>(Dim));
  std::array<std::ptrdiff_t, Dim> count, stride;
  double cells = 1.0;
  for (int d = 0; d < Dim; ++d) cells *= std::floor((within.upper[d] - within.lower[d]) / width) + 5.0;
  require(cells <= most_cells,
          "lattice_spring::random_points: the bounding cuboid must hold at most 2^30 cells of least_distance/sqrt(Dim)", cells);
  std::ptrdiff_t places = 1;
  for (std::size_t d = 0; d < Dim; ++d) {
    const int e = static_cast<int>(d);
    stride[d] = places;
    count[d] = static_cast<std::ptrdiff_t>((within.upper[e] - within.lower[e]) / width) + 5;  // two spare ones on each side
    places *= count[d];
  }
  std::vector<std::uint32_t> point_in(static_cast<std::size_t>(places), empty);
  std::vector<std::ptrdiff_t> nearby;  // offsets of the cells around, the nearest first: most trials end there
  {
    std::vector<std::pair<int, std::ptrdiff_t>> all;
    std::array<int, Dim> at;
    at.fill(-2);
    for (std::size_t d = 0; d < Dim;) {
      std::ptrdiff_t offset = 0;
      int squared = 0, gap = 0;
      for (std::size_t e = 0; e < Dim; ++e) {
        offset += at[e] * stride[e];
        squared += at[e] * at[e];
        gap += at[e] == 2 || at[e] == -2 ? 1 : 0;  // squared distance from cell to cell in widths
      }
      if (gap < Dim) all.emplace_back(squared, offset);
      for (d = 0; d < Dim && ++at[d] == 3; ++d) at[d] = -2;
    }
    std::sort(all.begin(), all.end());
    for (const auto& [squared, offset] : all) nearby.push_back(offset);
  }

  std::mt19937_64 generator(addition.seed);
  const auto uniform = [&generator] { return static_cast<double>(generator() >> 11) * 0x1p-53; };  // [0, 1), the same with any library
  std::vector<Vector<Dim>> points;
  for (std::size_t failures = 0, outside = 0; points.size() < addition.most_points && failures < addition.most_failures;) {
    Vector<Dim> x;
    for (int d = 0; d < Dim; ++d) x[d] = within.lower[d] + uniform() * (within.upper[d] - within.lower[d]);
    if (!within.contains(x) || !shape.contains(x)) {
      if (++outside == most_outside)
        throw ParameterError("lattice_spring::random_points: the shape must fill some of the bounding cuboid, got none in 1e7 trials");
      continue;
    }
    outside = 0;
    std::ptrdiff_t cell = 0;
    for (std::size_t d = 0; d < Dim; ++d) {
      const int e = static_cast<int>(d);
      const auto at = static_cast<std::ptrdiff_t>((x[e] - within.lower[e]) / width) + 2;
      cell += std::min(at, count[d] - 3) * stride[d];
    }
    const bool room = std::none_of(nearby.begin(), nearby.end(), [&](std::ptrdiff_t offset) {
      const std::uint32_t other = point_in[static_cast<std::size_t>(cell + offset)];
      return other != empty && (points[other] - x).squaredNorm() < least * least;
    });
    if (!room) {
      ++failures;
      continue;
    }
    failures = 0;
    point_in[static_cast<std::size_t>(cell)] = static_cast<std::uint32_t>(points.size());
    points.push_back(x);
  }

  neighbours::SpatialOrder<Dim> order;
  order.build(points, 2.0 * least, 0.0);
  geometry::Points<Dim> result{.positions = {}, .spacing = least, .volume = 0.0};
  result.positions.reserve(points.size());
  for (const std::uint32_t row : order.rows()) result.positions.push_back(points[row]);
  if (volume == 0.0) volume = volume_of<Dim>(shape, within);
  result.volume = volume / static_cast<double>(points.size());
  return result;
}

/// The same inside a cuboid.
template <int Dim>
[[nodiscard]] geometry::Points<Dim> random_points(const RandomAddition& addition, const geometry::Cuboid<Dim>& within) {
  validate(within);
  return random_points<Dim>(addition, within, within, (within.upper - within.lower).prod());
}

}  // namespace dmp::lattice_spring
