#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>
#include <dmp/core/aligned.hpp>
#include <dmp/core/pack.hpp>
#include <dmp/core/vector.hpp>

namespace dmp::neighbours {

/// Particles sorted into equal cells, for finding all of them within a distance. Cells are stored row after row along the first direction,
/// so that the candidates of one row of cells lie side by side and are tested in vector registers.
template <int Dim>
class CellGrid {
 public:
  /// Sorts `positions` into cells of at least `cell_width` [m]; wider where that would make many more cells than particles.
  void build(std::span<const Vector<Dim>> positions, double cell_width) {
    const std::size_t count = positions.size();
    lower_ = Vector<Dim>::Zero();
    Vector<Dim> upper = Vector<Dim>::Zero();
    if (count > 0) lower_ = upper = positions[0];
    for (const auto& x : positions) {
      lower_ = lower_.cwiseMin(x);
      upper = upper.cwiseMax(x);
    }
    const auto cells_of = [&](double width) {
      double total = 1.0;
      for (int d = 0; d < Dim; ++d) total *= std::max(1.0, std::floor((upper[d] - lower_[d]) / width));
      return total;
    };
    double width = cell_width;
    while (cells_of(width) > 4.0 * static_cast<double>(count) + 64.0) width *= 1.25;
    std::size_t total = 1;
    for (int d = 0; d < Dim; ++d) {
      cells_[d] = static_cast<int>(std::max(1.0, std::floor((upper[d] - lower_[d]) / width)));
      inverse_width_[d] = upper[d] > lower_[d] ? cells_[d] / (upper[d] - lower_[d]) : 0.0;
      total *= static_cast<std::size_t>(cells_[d]);
    }
    cell_.resize(count);
    start_.assign(total + 1, 0);
    for (std::size_t k = 0; k < count; ++k) {
      cell_[k] = static_cast<std::uint32_t>(cell_of(positions[k]));
      ++start_[cell_[k] + 1];
    }
    for (std::size_t c = 0; c < total; ++c) start_[c + 1] += start_[c];
    row_.resize(count + padding, 0);
    for (auto& x : coordinate_) x.resize(count + padding, 0.0);
    cursor_.assign(start_.begin(), start_.end() - 1);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t to = cursor_[cell_[k]]++;
      row_[to] = static_cast<std::uint32_t>(k);
      for (int d = 0; d < Dim; ++d) coordinate_[d][to] = positions[k][d];
    }
    count_ = count;
  }

  /// Rows of the particles in cell order: sorting particles by it makes neighbours in space neighbours in memory.
  [[nodiscard]] std::span<const std::uint32_t> order() const noexcept { return {row_.data(), count_}; }

  /// Appends to `found` the rows of all particles closer than `radius` [m] to `x`, except row `self` (pass `nobody` for none).
  static constexpr std::uint32_t nobody = 0xffffffffu;
  void find(const Vector<Dim>& x, double radius, std::uint32_t self, std::vector<std::uint32_t>& found) const {
    if (count_ == 0) return;
    std::array<int, Dim> low, high, at;
    for (int d = 0; d < Dim; ++d) {
      low[static_cast<std::size_t>(d)] = cell_along(x[d] - radius, d);
      high[static_cast<std::size_t>(d)] = cell_along(x[d] + radius, d);
    }
    at = low;
    for (;;) {  // over the rows of cells
      std::size_t row = 0;
      for (int d = Dim - 1; d > 0; --d)
        row = (row + static_cast<std::size_t>(at[static_cast<std::size_t>(d)])) * static_cast<std::size_t>(cells_[d - 1]);
      test(start_[row + static_cast<std::size_t>(low[0])], start_[row + static_cast<std::size_t>(high[0]) + 1], x, radius * radius, self,
           found);
      int d = 1;
      for (; d < Dim; ++d) {
        auto& index = at[static_cast<std::size_t>(d)];
        if (++index <= high[static_cast<std::size_t>(d)]) break;
        index = low[static_cast<std::size_t>(d)];
      }
      if (d >= Dim) return;
    }
  }

  [[nodiscard]] std::size_t bytes() const noexcept {
    return (start_.capacity() + cell_.capacity() + cursor_.capacity() + row_.capacity()) * sizeof(std::uint32_t) +
           Dim * coordinate_[0].capacity() * sizeof(double);
  }

 private:
  using Lanes = Pack<double, native_width<double>>;
  static constexpr std::size_t padding = Lanes::width;

  [[nodiscard]] int cell_along(double x, int d) const noexcept {
    const double cell = (x - lower_[d]) * inverse_width_[d];
    return static_cast<int>(
        std::min(std::max(0.0, cell), cells_[d] - 1.0));  // in this order: a position that is not a number goes to cell 0
  }
  [[nodiscard]] std::size_t cell_of(const Vector<Dim>& x) const noexcept {
    std::size_t cell = static_cast<std::size_t>(cell_along(x[Dim - 1], Dim - 1));
    for (int d = Dim - 2; d >= 0; --d) cell = cell * static_cast<std::size_t>(cells_[d]) + static_cast<std::size_t>(cell_along(x[d], d));
    return cell;
  }
  void test(std::size_t first, std::size_t last, const Vector<Dim>& x, double radius_squared, std::uint32_t self,
            std::vector<std::uint32_t>& found) const {
    std::size_t size = found.size();
    found.resize(size + (last - first) + padding);
    std::uint32_t* const out = found.data();
    for (std::size_t k = first; k < last; k += padding) {
      Lanes distance_squared(0.0);
      for (int d = 0; d < Dim; ++d) {
        const Lanes difference = Lanes::load(coordinate_[d].data() + k) - x[d];
        distance_squared += difference * difference;
      }
      const auto near = distance_squared < radius_squared;
      const std::size_t lanes = std::min(padding, last - k);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const std::uint32_t row = row_[k + lane];
        out[size] = row;
        size += static_cast<std::size_t>(near[static_cast<int>(lane)] && row != self);
      }
    }
    found.resize(size);
  }

  Vector<Dim> lower_ = Vector<Dim>::Zero(), inverse_width_ = Vector<Dim>::Zero();
  Eigen::Matrix<int, Dim, 1> cells_ = Eigen::Matrix<int, Dim, 1>::Ones();
  std::vector<std::uint32_t> start_{0, 0}, cell_, cursor_, row_;
  AlignedVector<double> coordinate_[Dim];
  std::size_t count_ = 0;
};

}  // namespace dmp::neighbours
