#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>
#include <dmp/core/aligned.hpp>
#include <dmp/core/pack.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/neighbours/cells.hpp>
#include <dmp/neighbours/counting_sort.hpp>

namespace dmp::neighbours {

/// Whom a search found: rows, and their squared distances divided by that of the search.
struct Found {
  std::vector<std::uint32_t> rows;
  std::vector<float> fraction;
  std::size_t size = 0;

  void make_room(std::size_t more) {
    if (rows.size() >= size + more) return;
    rows.resize(2 * (size + more));
    fraction.resize(rows.size());
  }
};

/// Particles sorted into equal cells, for finding all of them within a distance. Cells are stored row after row along the first direction,
/// so that the candidates of one row of cells lie side by side and are tested in vector registers, in single precision: all that are closer
/// than the radius are found, and perhaps some that are farther by less than `margin()`.
template <int Dim>
class CellGrid {
 public:
  /// Sorts `positions` into cells of at least `cell_width` [m]; wider where that would make many more cells than particles.
  void build(std::span<const Vector<Dim>> positions, double cell_width) { build(Positions<Dim>{positions}, cell_width); }
  /// The same for particles and their ghosts.
  void build(const Positions<Dim>& position, double cell_width) {
    const std::size_t count = position.size();
    cells_ = Cells<Dim>(count, position, cell_width);
    sort_.sort(count, cells_.total(), [&](std::size_t k) { return cells_.index(position(k)); });
    const std::span<const std::uint32_t> rows = sort_.rows();
    margin_ = 0.0;
    for (std::size_t d = 0; d < Dim; ++d) margin_ = std::max(margin_, 4e-7 * cells_.width[static_cast<int>(d)] * cells_.count[d]);
    exact_.clear();
    if (!(margin_ <= 1e-2 * cell_width)) {  // some particle has gone far away: single precision no longer tells the others apart
      margin_ = 0.0;
      for (std::size_t k = 0; k < count; ++k) exact_.push_back(position(k));
    }
    for (auto& x : coordinate_) resize_with_margin(x, count + (packs_at_once + 1) * Lanes::width);
    for_each_range(Ranges(count), [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        const Vector<Dim> x = position(rows[k]);
        for (int d = 0; d < Dim; ++d) coordinate_[d][k] = static_cast<float>(x[d] - cells_.lower[d]);
      }
    });
    for (auto& x : coordinate_) std::fill(x.end() - (packs_at_once + 1) * Lanes::width, x.end(), std::numeric_limits<float>::infinity());
  }

  /// Rows of the particles in cell order: sorting particles by it makes neighbours in space neighbours in memory.
  [[nodiscard]] std::span<const std::uint32_t> order() const noexcept { return sort_.rows(); }

  /// How much farther [m] than the radius of a search a particle may be that is found: 4e-7 of the longest extent of all particles, and not
  /// more than a hundredth of a cell.
  [[nodiscard]] double margin() const noexcept { return margin_; }
  /// Appends to `found` the rows of all particles closer than `radius` [m] to `x`, except row `self` (pass `nobody` for none).
  static constexpr std::uint32_t nobody = 0xffffffffu;
  void find(const Vector<Dim>& x, double radius, std::uint32_t self, std::vector<std::uint32_t>& found) const {
    Found all;
    find(x, radius, all);
    for (std::size_t k = 0; k < all.size; ++k)
      if (all.rows[k] != self) found.push_back(all.rows[k]);
  }
  /// Appends to `found` all particles closer than `radius` [m] to `x`.
  void find(const Vector<Dim>& x, double least_radius, Found& found) const {
    if (order().empty()) return;
    const double radius = least_radius + margin_;
    // Along each direction the cells within reach, and how far (squared) x is from each.
    constexpr int most = 8;  // cells are at least half a radius wide unless the caller wants otherwise
    std::array<int, Dim> low, high;
    std::array<std::array<double, most>, Dim> aside;
    bool few = true;
    for (std::size_t d = 0; d < Dim; ++d) {
      low[d] = cells_.along(x[static_cast<int>(d)] - radius, static_cast<int>(d));
      high[d] = cells_.along(x[static_cast<int>(d)] + radius, static_cast<int>(d));
      few = few && (d == 0 || high[d] - low[d] < most);
    }
    if (few)
      for (int d = 1; d < Dim; ++d)
        for (int c = low[static_cast<std::size_t>(d)]; c <= high[static_cast<std::size_t>(d)]; ++c)
          aside[static_cast<std::size_t>(d)][static_cast<std::size_t>(c - low[static_cast<std::size_t>(d)])] = aside_squared(x[d], c, d);
    std::array<Lanes, Dim> relative;
    for (std::size_t d = 0; d < Dim; ++d) relative[d] = x[static_cast<int>(d)] - cells_.lower[static_cast<int>(d)];
    const auto row_of_cells = [&](std::size_t row, double aside_of_row) {
      double reach = radius;
      if constexpr (Dim > 1) {
        if (aside_of_row >= radius * radius) return;
        reach = std::sqrt(radius * radius - aside_of_row) + 1e-12 * radius;
      }
      const std::size_t first = row + static_cast<std::size_t>(cells_.along(x[0] - reach, 0));
      const std::size_t last = row + static_cast<std::size_t>(cells_.along(x[0] + reach, 0)) + 1;
      if (exact_.empty()) test(sort_.begin(first), sort_.begin(last), relative, static_cast<float>(radius * radius * (1.0 + 1e-6)), found);
      else test_exactly(sort_.begin(first), sort_.begin(last), x, radius * radius, found);
    };
    if constexpr (Dim == 1) {
      row_of_cells(0, 0.0);
    } else {
      const auto distance = [&](int d, int c) {
        if (few) return aside[static_cast<std::size_t>(d)][static_cast<std::size_t>(c - low[static_cast<std::size_t>(d)])];
        return aside_squared(x[d], c, d);
      };
      const auto in_plane = [&](std::size_t plane, double aside_of_plane) {
        for (int c = low[1]; c <= high[1]; ++c)
          row_of_cells((plane + static_cast<std::size_t>(c)) * static_cast<std::size_t>(cells_.count[0]), aside_of_plane + distance(1, c));
      };
      if constexpr (Dim == 2) in_plane(0, 0.0);
      else
        for (int c = low[2]; c <= high[2]; ++c)
          in_plane(static_cast<std::size_t>(c) * static_cast<std::size_t>(cells_.count[1]), distance(2, c));
    }
  }

  [[nodiscard]] std::size_t bytes() const noexcept { return sort_.bytes() + Dim * coordinate_[0].capacity() * sizeof(float); }

 private:
  using Lanes = Pack<float, native_width<float>>;

  /// Not more than the square of the distance of x from whatever lies in a cell along d.
  [[nodiscard]] double aside_squared(double x, int cell, int d) const noexcept {
    const double at = (x - cells_.lower[d]) * cells_.inverse_width[d] - cell, slack = 1e-9;  // in cells, from the lower end of this one
    const double aside = std::max(0.0, std::max(-at, at - 1.0) - slack) * cells_.width[d];
    return aside * aside;
  }
  /// Candidates first .. last - 1 of one row of cells.
  void test(std::size_t first, std::size_t last, const std::array<Lanes, Dim>& x, float radius_squared, Found& found) const {
    constexpr int width = Lanes::width;
    found.make_room(last - first + (packs_at_once + 1) * width);
    const std::uint32_t* const row = order().data() + first;
    std::array<const float*, Dim> coordinate;
    for (std::size_t d = 0; d < Dim; ++d) coordinate[d] = coordinate_[d].data() + first;
    std::uint32_t* const rows = found.rows.data();
    float* const fractions = found.fraction.data();
    std::size_t size = found.size;
    const Lanes radius(radius_squared), scale(1.0 / radius_squared);
    const auto one_pack = [&](std::ptrdiff_t k, std::ptrdiff_t left) __attribute__((always_inline)) {
      Lanes distance_squared(0.0);
      unrolled<Dim>([&](auto d) __attribute__((always_inline)) {
        const Lanes difference = Lanes::load(coordinate[d] + k) - x[d];
        distance_squared += difference * difference;
      });
      const auto beyond = static_cast<unsigned>(std::clamp<std::ptrdiff_t>(left, 0, width));  // no branch: it would be foretold wrongly
      const unsigned near = (distance_squared < radius).bits() & ~(~0u << beyond);
      typename Lanes::Rows numbers;
      __builtin_memcpy(&numbers, row + k, sizeof(numbers));
      compress<width>(numbers, near, rows + size);
      const Lanes fraction = distance_squared * scale;
      __builtin_memcpy(&numbers, &fraction.raw, sizeof(numbers));
      compress<width>(numbers, near, reinterpret_cast<std::uint32_t*>(fractions + size));
      size += static_cast<std::size_t>(__builtin_popcount(near));
    };
    const auto left = static_cast<std::ptrdiff_t>(last - first);
    unrolled<packs_at_once>([&](auto p) __attribute__((always_inline)) { one_pack(p * width, left - p * width); });  // most rows: no branch
    for (std::ptrdiff_t k = packs_at_once * width; k < left; k += width) one_pack(k, left - k);
    found.size = size;
  }

  /// The same one by one in double precision.
  void test_exactly(std::size_t first, std::size_t last, const Vector<Dim>& x, double radius_squared, Found& found) const {
    found.make_room(last - first);
    for (std::size_t k = first; k < last; ++k) {
      const std::uint32_t row = order()[k];
      const double distance_squared = (exact_[row] - x).squaredNorm();
      if (!(distance_squared < radius_squared)) continue;
      found.rows[found.size] = row;
      found.fraction[found.size++] = static_cast<float>(distance_squared / radius_squared);
    }
  }

  static constexpr int packs_at_once = Lanes::width >= 16 ? 1 : 2;

  Cells<Dim> cells_;
  CountingSort sort_;
  AlignedVector<float> coordinate_[Dim];  // from the lower end of the cells
  double margin_ = 0.0;
  std::vector<Vector<Dim>> exact_;  // positions by row, where single precision does not serve; otherwise empty
};

}  // namespace dmp::neighbours
