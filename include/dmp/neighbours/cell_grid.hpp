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
/// than the radius are found, and perhaps some that are farther by less than `margin()`. Across that direction cells are sliced, so that
/// few candidates lie beyond the ends of what is within reach of a row: long rows, of few candidates in vain.
template <int Dim>
class CellGrid {
 public:
  /// Sorts `positions` into cells of at least `cell_width` [m], and these into slices; wider where that would make many more slices than
  /// particles.
  void build(std::span<const Vector<Dim>> positions, double cell_width) { build(Positions<Dim>{positions}, cell_width); }
  /// The same for particles and their ghosts.
  void build(const Positions<Dim>& position, double cell_width) {
    const std::size_t count = position.size();
    cells_ = Cells<Dim>(count, position, cell_width, static_cast<double>(count) + 16.0);
    margin_ = 0.0;
    for (std::size_t d = 0; d < Dim; ++d) margin_ = std::max(margin_, 4e-7 * cells_.width[static_cast<int>(d)] * cells_.count[d]);
    const bool far_away = !(margin_ <= 1e-2 * cell_width);  // some particle: single precision no longer tells the others apart
    if (far_away) margin_ = 0.0;
    else cells_.divide(0, slices);
    sort_.sort(count, cells_.total(), [&](std::size_t k) { return cells_.index(position(k)); });
    const std::span<const std::uint32_t> rows = sort_.rows();
    exact_.clear();
    for (std::size_t k = 0; far_away && k < count; ++k) exact_.push_back(position(k));
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
  /// Rows that a search leaves out, `count` of them from `first` on.
  struct LeftOut {
    std::uint32_t first = 0, count = 0;
  };
  /// Appends to `found` all particles closer than `radius` [m] to `x`.
  void find(const Vector<Dim>& x, double least_radius, Found& found, LeftOut left_out = {}) const {
    if (order().empty()) return;
    const Query query{.x = x, .radius = least_radius + margin_, .left_out = left_out};
    const double radius_squared = query.radius * query.radius;
    std::array<int, Dim> low, high;  // cells within reach along each direction
    for (std::size_t d = 0; d < Dim; ++d) {
      low[d] = cells_.along(x[static_cast<int>(d)] - query.radius, static_cast<int>(d));
      high[d] = cells_.along(x[static_cast<int>(d)] + query.radius, static_cast<int>(d));
    }
    RowsOfCells rows;
    const auto add = [&](std::size_t first_cell, double aside_squared) {  // no branch but for a full buffer: it would be foretold wrongly
      rows.first_cell[rows.count] = first_cell;
      rows.aside_squared[rows.count] = aside_squared;
      rows.count += aside_squared >= radius_squared ? 0u : 1u;
      if (rows.count == RowsOfCells::most) search(query, rows, found);
    };
    if constexpr (Dim == 1) {
      add(0, 0.0);
    } else {
      const auto in_plane = [&](std::size_t plane, double aside_of_plane) {
        for (int c = low[1]; c <= high[1]; ++c)
          add((plane + static_cast<std::size_t>(c)) * static_cast<std::size_t>(cells_.count[0]),
              aside_of_plane + aside_squared(x[1], c, 1));
      };
      if constexpr (Dim == 2) in_plane(0, 0.0);
      else
        for (int c = low[2]; c <= high[2]; ++c)
          in_plane(static_cast<std::size_t>(c) * static_cast<std::size_t>(cells_.count[1]), aside_squared(x[2], c, 2));
    }
    search(query, rows, found);
  }

  [[nodiscard]] std::size_t bytes() const noexcept {
    return sort_.bytes() + Dim * coordinate_[0].capacity() * sizeof(float) + exact_.capacity() * sizeof(Vector<Dim>);
  }

 private:
  using Lanes = Pack<float, selecting_width>;

  /// Not more than the square of the distance of x from whatever lies in a cell along d.
  [[nodiscard]] double aside_squared(double x, int cell, int d) const noexcept {
    const double at = (x - cells_.lower[d]) * cells_.inverse_width[d] - cell, slack = 1e-9;  // in cells, from the lower end of this one
    const double aside = std::max(0.0, std::max(-at, at - 1.0) - slack) * cells_.width[d];
    return aside * aside;
  }
  struct Query {
    Vector<Dim> x;
    double radius;
    LeftOut left_out;
  };
  /// Rows of cells along the first direction: the first cell, and how far (squared) from x the others' directions put all of the row.
  struct RowsOfCells {
    static constexpr std::size_t most = 32;
    std::size_t count = 0, first_cell[most];
    alignas(64) double aside_squared[most];
  };
  /// All candidates of some rows of cells, which are forgotten.
  void search(const Query& query, RowsOfCells& rows, Found& found) const {
    using Doubles = Pack<double, native_width<double>>;
    alignas(64) double from[RowsOfCells::most], to[RowsOfCells::most];
    const double last_cell = cells_.count[0] - 1.0, x = query.x[0] - cells_.lower[0];
    for (std::size_t k = 0; k < rows.count; k += Doubles::width) {  // how far each row is within reach, several at once
      const Doubles reach = sqrt(max(query.radius * query.radius - Doubles::load(rows.aside_squared + k), 0.0)) + 1e-12 * query.radius;
      const auto cell = [&](Doubles at) { return min(max(0.0, at * cells_.inverse_width[0]), last_cell); };  // not a number: 0
      cell(x - reach).store(from + k);
      cell(x + reach).store(to + k);
    }
    std::array<std::uint32_t, RowsOfCells::most> first, last;  // candidates of each
    std::size_t candidates = 0;
    for (std::size_t k = 0; k < rows.count; ++k) {
      first[k] = static_cast<std::uint32_t>(sort_.begin(rows.first_cell[k] + static_cast<std::size_t>(from[k])));
      last[k] = static_cast<std::uint32_t>(sort_.begin(rows.first_cell[k] + static_cast<std::size_t>(to[k]) + 1));
      candidates += last[k] - first[k];
    }
    found.make_room(candidates + (packs_at_once + 1) * Lanes::width);
    const Test test(*this, query);
    for (std::size_t k = 0; candidates > 0 && k < rows.count; ++k) {
      if (exact_.empty()) found.size = test(first[k], last[k], found.rows.data(), found.fraction.data(), found.size);
      else test_exactly(first[k], last[k], query, found);
    }
    rows.count = 0;
  }

  /// The test of candidates, with what all rows of cells have in common.
  struct Test {
    std::array<const float*, Dim> coordinate;
    const std::uint32_t* order;
    std::array<Lanes, Dim> x;
    Lanes radius_squared, scale;
    LeftOut left_out;

    Test(const CellGrid& grid, const Query& query)
        : order(grid.order().data()), radius_squared(query.radius * query.radius * (1.0 + 1e-6)), left_out(query.left_out) {
      scale = 1.0 / radius_squared;
      for (std::size_t d = 0; d < Dim; ++d) {
        coordinate[d] = grid.coordinate_[d].data();
        x[d] = query.x[static_cast<int>(d)] - grid.cells_.lower[static_cast<int>(d)];
      }
    }
    /// Candidates first .. last - 1; returns the new number of those found.
    [[nodiscard, gnu::always_inline]] std::size_t operator()(std::size_t first, std::size_t last, std::uint32_t* rows, float* fractions,
                                                             std::size_t size) const noexcept {
      constexpr int width = Lanes::width;
      const auto one_pack = [&](std::size_t k, std::ptrdiff_t left) __attribute__((always_inline)) {
        Lanes distance_squared(0.0);
        unrolled<Dim>([&](auto d) __attribute__((always_inline)) {
          const Lanes difference = Lanes::load(coordinate[d] + k) - x[d];
          distance_squared += difference * difference;
        });
        typename Lanes::Rows numbers;
        __builtin_memcpy(&numbers, order + k, sizeof(numbers));
        const Mask<float, width> wanted{numbers - left_out.first >= left_out.count};
        const auto beyond = static_cast<unsigned>(std::clamp<std::ptrdiff_t>(left, 0, width));  // no branch: it would be foretold wrongly
        const unsigned near = (distance_squared < radius_squared && wanted).bits() & ~(~0u << beyond);
        compress<width>(numbers, near, rows + size);
        const Lanes fraction = distance_squared * scale;
        __builtin_memcpy(&numbers, &fraction.raw, sizeof(numbers));
        compress<width>(numbers, near, reinterpret_cast<std::uint32_t*>(fractions + size));
        size += static_cast<std::size_t>(__builtin_popcount(near));
      };
      const auto count = static_cast<std::ptrdiff_t>(last - first);
      unrolled<packs_at_once>([&](auto p) __attribute__((always_inline)) {  // most rows: no branch
        one_pack(first + p * width, count - static_cast<std::ptrdiff_t>(p * width));
      });
      for (std::ptrdiff_t k = packs_at_once * width; k < count; k += width) one_pack(first + static_cast<std::size_t>(k), count - k);
      return size;
    }
  };

  /// The same one by one in double precision.
  void test_exactly(std::size_t first, std::size_t last, const Query& query, Found& found) const {
    const double radius_squared = query.radius * query.radius;
    for (std::size_t k = first; k < last; ++k) {
      const std::uint32_t row = order()[k];
      const double distance_squared = (exact_[row] - query.x).squaredNorm();
      if (!(distance_squared < radius_squared) || row - query.left_out.first < query.left_out.count) continue;
      found.rows[found.size] = row;
      found.fraction[found.size++] = static_cast<float>(distance_squared / radius_squared);
    }
  }

  static constexpr int packs_at_once = Lanes::width < 16 ? 2 : 1, slices = 4;

  Cells<Dim> cells_;
  CountingSort sort_;
  AlignedVector<float> coordinate_[Dim];  // from the lower end of the cells
  double margin_ = 0.0;
  std::vector<Vector<Dim>> exact_;  // positions by row, where single precision does not serve; otherwise empty
};

}  // namespace dmp::neighbours
