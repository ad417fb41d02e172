#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>
#include <Eigen/LU>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/lattice_spring/body.hpp>
#include <dmp/lattice_spring/lattice.hpp>

namespace dmp::lattice_spring::detail {

/// The nodes of a lattice in a range of steps, one place each, with one spare place all around that stays empty.
template <int Dim>
struct NodeGrid {
  Vector<Dim> first = Vector<Dim>::Zero();            ///< steps of the first place, whole numbers
  std::array<std::ptrdiff_t, Dim> count{}, stride{};  ///< places
  std::vector<std::uint8_t> inside;

  NodeGrid(const Vector<Dim>& lowest, const Vector<Dim>& highest) {  // whole numbers of steps
    constexpr double most = 2147483648.0;                            // 2^31: more nodes than a 32-bit index of a bond should name
    double total = 1.0;
    for (int d = 0; d < Dim; ++d) total *= highest[d] - lowest[d] + 3.0;
    require(total <= most, "lattice_spring: the bounding cuboid must hold at most 2^31 lattice nodes", total);
    first = lowest - Vector<Dim>::Ones();
    std::ptrdiff_t places = 1;
    for (std::size_t d = 0; d < Dim; ++d) {
      stride[d] = places;
      count[d] = static_cast<std::ptrdiff_t>(highest[static_cast<int>(d)] - lowest[static_cast<int>(d)]) + 3;
      places *= count[d];
    }
    inside.assign(static_cast<std::size_t>(places), 0);
  }

  [[nodiscard]] std::ptrdiff_t offset(const Steps<Dim>& steps) const noexcept {
    std::ptrdiff_t sum = 0;
    for (std::size_t d = 0; d < Dim; ++d) sum += steps[d] * stride[d];
    return sum;
  }
  /// Calls function(place, steps) for all places but the spare ones, the first direction running fastest.
  template <class Function>
  void for_each_place(const Function& function) const {
    std::array<std::ptrdiff_t, Dim> at;
    at.fill(1);
    for (std::size_t d = 0; d < Dim;) {
      std::ptrdiff_t place = 0;
      Vector<Dim> steps;
      for (std::size_t e = 0; e < Dim; ++e) {
        place += at[e] * stride[e];
        steps[static_cast<int>(e)] = first[static_cast<int>(e)] + static_cast<double>(at[e]);
      }
      function(static_cast<std::size_t>(place), steps);
      for (d = 0; d < Dim && ++at[d] > count[d] - 2; ++d) at[d] = 1;
    }
  }
};

/// The cells, and where their lowest node lies from a bond's first end, that have both ends of a bond among their corners.
struct Sharer {
  std::uint8_t cell;
  std::ptrdiff_t base;
};

/// Beads at the nodes marked in `grid`, and the bonds between them. `shared`: see SurfaceBonds.
template <class L>
[[nodiscard]] Body<L::dimension> connect(const L& lattice, NodeGrid<L::dimension>& grid, bool shared) {
  constexpr int dim = L::dimension;
  constexpr auto bonds = L::bonds();
  constexpr auto cells = L::cells();
  const Tensor<dim> basis = lattice.basis();
  const double volume_per_node = basis.determinant();

  std::array<std::vector<Sharer>, bonds.size()> sharers;
  std::vector<std::uint8_t> whole;  // one bit per kind of cell, at its lowest node
  double whole_cells = 0.0;
  if (shared) {
    for (std::size_t b = 0; b < bonds.size(); ++b)
      for (std::size_t c = 0; c < cells.size(); ++c)
        for (const Steps<dim>& from : cells[c])
          for (const Steps<dim>& to : cells[c]) {
            bool spans = true;
            Steps<dim> back{};
            for (std::size_t d = 0; d < dim; ++d) {
              spans = spans && to[d] - from[d] == bonds[b].to[d];
              back[d] = -from[d];
            }
            if (spans) sharers[b].push_back({static_cast<std::uint8_t>(1u << c), grid.offset(back)});
          }
    whole.assign(grid.inside.size(), 0);
    std::vector<std::uint8_t> in_some_cell(grid.inside.size(), 0);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      std::vector<std::ptrdiff_t> corners;
      for (const Steps<dim>& corner : cells[c]) corners.push_back(grid.offset(corner));
      grid.for_each_place([&](std::size_t place, const Vector<dim>&) {
        const auto corner = [&](std::ptrdiff_t offset) { return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(place) + offset); };
        for (const std::ptrdiff_t offset : corners)
          if (!grid.inside[corner(offset)]) return;
        whole[place] = static_cast<std::uint8_t>(whole[place] | (1u << c));
        whole_cells += 1.0;
        for (const std::ptrdiff_t offset : corners) in_some_cell[corner(offset)] = 1;
      });
    }
    grid.inside.swap(in_some_cell);
  }

  constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> row(grid.inside.size(), nobody);
  Body<dim> body;
  std::vector<std::size_t> places;
  grid.for_each_place([&](std::size_t place, const Vector<dim>& steps) {
    if (!grid.inside[place]) return;
    row[place] = static_cast<std::uint32_t>(places.size());
    places.push_back(place);
    body.points.positions.push_back(lattice.node + basis * steps);
  });
  if (places.empty())
    throw ParameterError("lattice_spring: no " + std::string(shared ? "whole cell" : "node") +
                         " of the lattice lies inside the shape, got a spacing of " + to_text(lattice.spacing) + " m");

  std::array<std::ptrdiff_t, bonds.size()> partner;
  for (std::size_t b = 0; b < bonds.size(); ++b) partner[b] = grid.offset(bonds[b].to);
  body.bonds.reserve(places.size() * bonds.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t b = 0; b < bonds.size(); ++b) {
      const auto from = static_cast<std::ptrdiff_t>(places[i]);
      const std::uint32_t j = row[static_cast<std::size_t>(from + partner[b])];
      if (j == nobody) continue;
      double weight = bonds[b].weight;
      if (shared) {
        int present = 0;
        for (const Sharer& sharer : sharers[b]) present += (whole[static_cast<std::size_t>(from + sharer.base)] & sharer.cell) != 0 ? 1 : 0;
        if (present == 0) continue;
        weight *= static_cast<double>(present) / static_cast<double>(sharers[b].size());
      }
      body.bonds.push_back({.i = static_cast<std::uint32_t>(i), .j = j, .weight = weight});
    }
  body.points.spacing = lattice.spacing;
  body.volume =
      shared ? whole_cells / static_cast<double>(cells.size()) * volume_per_node : static_cast<double>(places.size()) * volume_per_node;
  body.points.volume = body.volume / static_cast<double>(places.size());
  return body;
}

}  // namespace dmp::lattice_spring::detail
