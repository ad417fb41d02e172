#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>
#include <dmp/core/threads.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/neighbours/cells.hpp>
#include <dmp/neighbours/counting_sort.hpp>

namespace dmp::neighbours {

/// An order in which neighbours in space are neighbours in memory: compact blocks of cells, one after the other, and cell by cell in each.
template <int Dim>
class SpatialOrder {
 public:
  /// Cells of at least `cell_width` [m] over the positions; `particles_per_cell`: where there are any, 0 unknown.
  void build(std::span<const Vector<Dim>> positions, double cell_width, double particles_per_cell) {
    build(positions, Cells<Dim>(positions.size(), Positions<Dim>{positions}, cell_width), particles_per_cell, 1);
  }
  /// Given cells; those in one are sorted into its `parts` along each direction.
  void build(std::span<const Vector<Dim>> positions, const Cells<Dim>& cells, double particles_per_cell, int parts) {
    Bounds<Dim> bounds = bounds_of<Dim>(positions.size(), Positions<Dim>{positions});  // perhaps a part of the cells
    if (bounds.empty()) bounds.add(cells.lower);
    // The place of a part of a cell in the order is a sum of one number per direction.
    Cells<Dim> divided = cells;
    std::array<int, Dim> first, count, blocks, width;
    double total = 1.0;
    int places_per_cell = 1, number_of_blocks = 1;
    for (std::size_t d = 0; d < Dim; ++d) {
      const int along = static_cast<int>(d);
      divided.divide(along, parts);
      first[d] = cells.along(bounds.lower[along], along);
      count[d] = cells.along(bounds.upper[along], along) + 1 - first[d];
      total *= count[d];
      places_per_cell *= parts;
    }
    if (!(particles_per_cell > 0.0)) particles_per_cell = static_cast<double>(positions.size()) / total;
    const double side =
        std::pow(static_cast<double>(Blocks::rows_wanted(positions.size())) / std::max(particles_per_cell, 1e-3), 1.0 / Dim);
    int places_per_block = places_per_cell;
    for (std::size_t d = 0; d < Dim; ++d) {
      // A cell at least, and all of them at most: particles far away make cells wide, so that few could fill a block each.
      blocks[d] = static_cast<int>(std::clamp(std::round(count[d] / side), 1.0, static_cast<double>(count[d])));
      width[d] = (count[d] + blocks[d] - 1) / blocks[d];
      places_per_block *= width[d];
      number_of_blocks *= blocks[d];
    }
    int block_stride = places_per_block, cell_stride = places_per_cell, part_stride = places_per_cell;
    for (std::size_t d = 0; d < Dim; ++d) {
      part_stride /= parts;  // slices across the first direction one after the other
      place_[d].assign(static_cast<std::size_t>(divided.count[d]), 0);
      for (int part = 0; part < parts * count[d]; ++part) {
        const int cell = part / parts;
        place_[d][static_cast<std::size_t>(parts * first[d] + part)] =
            static_cast<std::size_t>(cell / width[d] * block_stride + cell % width[d] * cell_stride + part % parts * part_stride);
      }
      block_stride *= blocks[d];
      cell_stride *= width[d];
    }
    sort_.sort(positions.size(), static_cast<std::size_t>(number_of_blocks * places_per_block), [&](std::size_t k) {
      std::size_t place = 0;
      for (std::size_t d = 0; d < Dim; ++d) {
        const int along = static_cast<int>(d);
        place += place_[d][static_cast<std::size_t>(divided.along(positions[k][along], along))];
      }
      return place;
    });
    bounds_.assign(1, 0);
    const std::size_t most = 4 * Blocks::rows_wanted(positions.size());  // where a few far away make cells wide, blocks would be few
    static_assert(4 * Blocks::rows_wanted(std::numeric_limits<std::size_t>::max()) <= Blocks::most_rows);
    for (int block = 1; block <= number_of_blocks; ++block) {
      const std::size_t begin = bounds_.back(), rows = sort_.begin(static_cast<std::size_t>(block * places_per_block)) - begin;
      const std::size_t pieces = (rows + most - 1) / most;
      for (std::size_t piece = 1; piece <= pieces; ++piece) bounds_.push_back(begin + rows * piece / pieces);
    }
    if (bounds_.size() == 1) bounds_.push_back(0);
  }

  /// rows()[k]: which row comes k-th.
  [[nodiscard]] std::span<const std::uint32_t> rows() const noexcept { return sort_.rows(); }
  /// Bounds of the blocks in the new order, for Blocks::set_bounds.
  [[nodiscard]] std::span<const std::size_t> bounds() const noexcept { return bounds_; }
  [[nodiscard]] std::size_t bytes() const noexcept { return sort_.bytes(); }

 private:
  std::array<std::vector<std::size_t>, Dim> place_;
  CountingSort sort_;
  std::vector<std::size_t> bounds_;
};

}  // namespace dmp::neighbours
