#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/fill.hpp>
#include <dmp/lattice_spring/body.hpp>
#include <dmp/neighbours/cell_grid.hpp>

namespace dmp::lattice_spring {

/// How stiff the bonds of a network are against each other.
///   uniform_stiffness  k the same for all: all weights 1
///   uniform_tension    k L the same for all: weight (mean length)/L. Beads inside are then nearer to equilibrium at uniform strain.
enum class StiffnessRule { uniform_stiffness, uniform_tension };

/// Bonds between all points closer than `reach` [m]. Random points least_distance apart need reach >= 1.7 least_distance at the density of
/// jamming, or there are too few bonds to make a solid (less than 12 per bead); 1.924 gives the 18 of the cubic lattice.
/// M. Kot, ChemEngineering 5 (2021) 3, doi:10.3390/chemengineering5010003.
template <int Dim>
[[nodiscard]] Body<Dim> network(geometry::Points<Dim> points, double reach, StiffnessRule rule = StiffnessRule::uniform_stiffness) {
  require_positive("lattice_spring::network: reach", reach, "m");
  if (!(reach > points.spacing))
    throw ParameterError("lattice_spring::network: reach must be > the distance of nearest points, " + to_text(points.spacing) +
                         " m, or there are no bonds, got " + to_text(reach));
  Body<Dim> body{.points = std::move(points), .bonds = {}, .volume = 0.0};
  const auto& x = body.points.positions;
  body.volume = body.points.volume * static_cast<double>(x.size());
  neighbours::CellGrid<Dim> grid;
  grid.build(x, reach);
  std::vector<double> length;
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < x.size(); ++i) {
    found.clear();
    grid.find(x[i], reach, i, found);
    std::sort(found.begin(), found.end());
    for (const std::uint32_t j : found) {
      const double apart = (x[i] - x[j]).norm();  // the grid may find a little more than asked for
      if (j < i || !(apart < reach)) continue;
      body.bonds.push_back({.i = i, .j = j});
      length.push_back(apart);
    }
  }
  if (body.bonds.empty())
    throw ParameterError("lattice_spring::network: reach must be > the distance of nearest points, or there are no bonds, got " +
                         to_text(reach) + " m among " + std::to_string(x.size()) + " points");
  if (rule == StiffnessRule::uniform_tension) {
    double mean = 0.0;
    for (const double apart : length) mean += apart / static_cast<double>(length.size());
    for (std::size_t b = 0; b < length.size(); ++b) {
      if (!(length[b] > 0.0))
        throw ParameterError("lattice_spring::network: two points must not coincide, got points " + std::to_string(body.bonds[b].i) +
                             " and " + std::to_string(body.bonds[b].j));
      body.bonds[b].weight = mean / length[b];
    }
  }
  return body;
}

}  // namespace dmp::lattice_spring
