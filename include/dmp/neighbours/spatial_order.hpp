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
  /// `particles_per_cell`: where there are any, 0 unknown.
  void build(std::span<const Vector<Dim>> positions, double cell_width, double particles_per_cell) {
    const Cells<Dim> cells(positions.size(), Positions<Dim>{positions}, cell_width);
    if (!(particles_per_cell > 0.0)) particles_per_cell = static_cast<double>(positions.size()) / static_cast<double>(cells.total());
    const double side =
        std::pow(static_cast<double>(Blocks::rows_wanted(positions.size())) / std::max(particles_per_cell, 1e-3), 1.0 / Dim);
    // The place of a cell in the order is a sum of one number per direction.
    std::array<int, Dim> blocks, width;
    int cells_per_block = 1, number_of_blocks = 1;
    for (std::size_t d = 0; d < Dim; ++d) {
      blocks[d] = std::max(1, static_cast<int>(std::lround(cells.count[d] / side)));
      width[d] = (cells.count[d] + blocks[d] - 1) / blocks[d];
      cells_per_block *= width[d];
      number_of_blocks *= blocks[d];
    }
    int block_stride = cells_per_block, cell_stride = 1;
    for (std::size_t d = 0; d < Dim; ++d) {
      place_[d].resize(static_cast<std::size_t>(cells.count[d]));
      for (int c = 0; c < cells.count[d]; ++c)
        place_[d][static_cast<std::size_t>(c)] = static_cast<std::size_t>(c / width[d] * block_stride + c % width[d] * cell_stride);
      block_stride *= blocks[d];
      cell_stride *= width[d];
    }
    sort_.sort(positions.size(), static_cast<std::size_t>(number_of_blocks * cells_per_block), [&](std::size_t k) {
      std::size_t place = 0;
      for (int d = 0; d < Dim; ++d) place += place_[static_cast<std::size_t>(d)][static_cast<std::size_t>(cells.along(positions[k][d], d))];
      return place;
    });
    bounds_.assign(1, 0);
    const std::size_t most = 4 * Blocks::rows_wanted(positions.size());  // where a few far away make cells wide, blocks would be few
    static_assert(4 * Blocks::rows_wanted(std::numeric_limits<std::size_t>::max()) <= Blocks::most_rows);
    for (int block = 1; block <= number_of_blocks; ++block) {
      const std::size_t first = bounds_.back(), rows = sort_.begin(static_cast<std::size_t>(block * cells_per_block)) - first;
      const std::size_t parts = (rows + most - 1) / most;
      for (std::size_t part = 1; part <= parts; ++part) bounds_.push_back(first + rows * part / parts);
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
