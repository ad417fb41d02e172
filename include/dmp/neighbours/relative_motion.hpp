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
#include <dmp/geometry/box.hpp>
#include <dmp/neighbours/cells.hpp>
#include <dmp/neighbours/counting_sort.hpp>

namespace dmp::neighbours {

/// Particles of one block that were in the same coarse cell when the lists were built, rows first .. first of the next run.
struct Run {
  std::uint32_t first, cell;
};

/// How much of the skin of neighbour lists has been used up, place by place: by how much neighbours have moved relative to each other since
/// the lists were built, and how much of what kept others apart. What moves along together wears no lists, however fast.
///
/// Coarse cells are somewhat wider than the lists reach. Neighbours lie in the same cell or in two that touch, and have used up their
/// relative displacement. Two in cells that do not touch have at least one width in between, along some axis, and may approach each other
/// along it by what the width is more than the reach before they use up any skin.
template <int Dim>
class RelativeMotion {
 public:
  /// Coarse cells over `bounds`, all groups together, for lists that reach as far as `cutoff` and `skin` [m]. Wider cells where these would
  /// be many more than the `particles`. Nobody is followed yet.
  void build(const Bounds<Dim>& bounds, const geometry::Box<Dim>& box, double cutoff, double skin, std::size_t particles) {
    reach_ = cutoff + skin;
    // Half a skin wider: in shear, those on the two sides of a cell then use up no more than those in cells that touch.
    const std::array<Vector<Dim>, 2> corners{bounds.lower, bounds.upper};
    cells_ = Cells<Dim>(2, Positions<Dim>{corners}, reach_ + 0.5 * skin, std::min(4.0 * static_cast<double>(particles) + 64.0, 1e6));
    periodic_ = box.periodic;
    stride_[0] = 1;
    for (std::size_t d = 0; d < Dim; ++d) {
      auto cells = static_cast<std::size_t>(cells_.count[d]);
      if (d == 0) cells = (cells + Lanes::width - 1) / Lanes::width * Lanes::width;
      stride_[d + 1] = stride_[d] * (cells + 2);
    }
    runs_.clear();
    displacement_.clear();
    for (auto& x : lower_) x.assign(total(), Bounds<Dim>{}.lower[0]);
    for (auto& x : upper_) x.assign(total(), Bounds<Dim>{}.upper[0]);
    used_.assign(total(), 0.0);
  }
  /// Follows a group from where it is now. Sets first_run: the runs of block b are number first_run[b] .. first_run[b + 1] - 1.
  void follow(const Blocks& blocks, std::span<const Vector<Dim>> positions, std::vector<std::size_t>& first_run) {
    const auto find_runs = [&](std::size_t block, auto&& function) {
      std::uint32_t last = 0;
      for (std::size_t i = blocks.begin(block); i < blocks.end(block); ++i)
        if (const auto cell = index(positions[i]); i == blocks.begin(block) || cell != last)
          function(static_cast<std::uint32_t>(i), last = cell);
    };
    first_run.assign(blocks.size() + 1, 0);
    for_each_block(blocks, [&](std::size_t, std::size_t block) {
      std::size_t count = 0;
      find_runs(block, [&count](std::uint32_t, std::uint32_t) { ++count; });
      first_run[block + 1] = count;
    });
    first_run[0] = runs_.size();
    for (std::size_t block = 0; block < blocks.size(); ++block) first_run[block + 1] += first_run[block];
    resize_with_margin(runs_, first_run.back());
    for_each_block(blocks, [&](std::size_t, std::size_t block) {
      std::size_t run = first_run[block];
      find_runs(block, [&](std::uint32_t i, std::uint32_t cell) { runs_[run++] = {i, cell}; });
    });
    resize_with_margin(displacement_, runs_.size());
    const Bounds<Dim> none{Vector<Dim>::Zero(), Vector<Dim>::Zero()};
    std::fill(displacement_.data() + first_run[0], displacement_.data() + runs_.size(), none);
    by_cell_.sort(runs_.size(), total(), [this](std::size_t run) { return runs_[run].cell; });
    find_occupied();
  }
  [[nodiscard]] const Cells<Dim>& cells() const noexcept { return cells_; }
  /// Calls function(number, run, the first row beyond it) for the runs of block b of a group that is followed.
  template <class Function>
  void for_each_run(const Blocks& blocks, std::span<const std::size_t> first_run, std::size_t block, Function&& function) const {
    const std::size_t end = first_run[block + 1];
    for (std::size_t run = first_run[block]; run < end; ++run)
      function(run, runs_[run], run + 1 < end ? runs_[run + 1].first : blocks.end(block));
  }
  /// How far [m] the particles of a run have gone since the lists were built; zero at first.
  void set_displacement(std::size_t run, const Bounds<Dim>& bounds) noexcept { displacement_[run] = bounds; }

  struct Wear {
    double used = 0.0;      ///< of the skin [m], where it is most
    double farthest = 0.0;  ///< how far [m] the farthest particle has gone along an axis, whoever goes with it
  };
  /// From the displacements of all runs; then used(cell) holds too: the largest relative displacement [m] of particles in that cell from
  /// any of their neighbours. What is not a number counts for nothing: a check of the state finds it.
  [[nodiscard]] Wear find_wear() {
    const Bounds<Dim> all = merge_ranges(
        Ranges(occupied_.size(), 256), Bounds<Dim>{},
        [this](std::size_t first, std::size_t last) {
          Bounds<Dim> result;
          for (std::size_t k = first; k < last; ++k) result.add(find_displacements(occupied_[k]));
          return result;
        },
        [](Bounds<Dim> a, const Bounds<Dim>& b) {
          a.add(b);
          return a;
        });
    if (all.empty()) return {};
    const double around = merge_ranges(
        Ranges(near_.size(), 256), 0.0,
        [this](std::size_t first, std::size_t last) {
          Lanes result(0.0);
          for (std::size_t k = first; k < last; ++k) result = max(result, look_around(near_[k]));
          double most = 0.0;
          for (int lane = 0; lane < Lanes::width; ++lane) most = std::max(most, result[lane]);
          return most;
        },
        [](double a, double b) { return std::max(a, b); });
    const double anywhere = used_by<double>(2, [&all](int d) { return all.upper[d] - all.lower[d]; });
    return {std::max(around, anywhere), std::max(-all.lower.minCoeff(), all.upper.maxCoeff())};
  }
  [[nodiscard]] double used(std::uint32_t cell) const noexcept { return used_[cell]; }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return runs_.capacity() * sizeof(Run) + displacement_.capacity() * sizeof(Bounds<Dim>) + by_cell_.bytes() +
           (2 * Dim * lower_[0].capacity() + used_.capacity()) * sizeof(double) + occupied_.capacity() * sizeof(Occupied) +
           touches_.capacity() + near_.capacity() * sizeof(std::uint32_t);
  }

 private:
  using Lanes = Pack<double, native_width<double>>;
  using Place = std::array<int, Dim>;  // of a cell along each direction: 1 .. count, and what is around these

  [[nodiscard]] std::size_t total() const noexcept { return stride_[Dim]; }
  [[nodiscard]] std::uint32_t index(const Vector<Dim>& x) const noexcept {
    std::size_t cell = 0;
    for (int d = 0; d < Dim; ++d) cell += (static_cast<std::size_t>(cells_.along(x[d], d)) + 1) * stride_[static_cast<std::size_t>(d)];
    return static_cast<std::uint32_t>(cell);
  }
  /// From a cell to one beside it, in memory.
  [[nodiscard]] std::size_t away(const Place& side) const noexcept {
    std::size_t result = 0;
    for (std::size_t d = 0; d < Dim; ++d) result += static_cast<std::size_t>(side[d]) * stride_[d];
    return result;
  }
  [[nodiscard]] bool inside(int place, std::size_t d) const noexcept { return place >= 1 && place <= cells_.count[d]; }
  /// The place of which this one is an image behind a periodic face; itself in between, 0 where nobody is.
  [[nodiscard]] int original(int place, std::size_t d) const noexcept {
    const int count = cells_.count[d];
    if (inside(place, d)) return place;
    return !periodic_[d] || place > count + 1 ? 0 : place == 0 ? count : 1;
  }
  /// Lists the cells where somebody is, with their images, and the packs of cells that touch them: much of the box of a splash is air.
  void find_occupied() {
    occupied_.clear();
    near_.clear();
    touches_.assign(total(), 0);
    for (std::size_t row = 0; row < total(); row += stride_[1]) {  // of cells along the first direction
      Place place{};
      std::size_t first = 0, rest = row;
      bool nobody = false;
      for (std::size_t d = Dim; d-- > 1; rest %= stride_[d]) {
        place[d] = static_cast<int>(rest / stride_[d]);
        nobody = nobody || original(place[d], d) == 0;
        first += static_cast<std::size_t>(original(place[d], d)) * stride_[d];
      }
      for (std::size_t k = 0; k < stride_[1] && !nobody; ++k) {
        const auto from = static_cast<std::size_t>(original(static_cast<int>(k), 0));
        if (from == 0 || by_cell_.begin(first + from) == by_cell_.begin(first + from + 1)) continue;
        occupied_.push_back({static_cast<std::uint32_t>(row + k), static_cast<std::uint32_t>(first + from)});
        for (const auto& side : sides)
          if (const std::size_t other = row + k + away(side); other < total()) touches_[other] = 1;  // beyond the ends: not inside
      }
    }
    for (std::size_t row = 0; row < total(); row += stride_[1]) {
      bool all_inside = true;
      std::size_t rest = row;
      for (std::size_t d = Dim; d-- > 1; rest %= stride_[d]) all_inside = all_inside && inside(static_cast<int>(rest / stride_[d]), d);
      for (std::size_t k = 1; inside(static_cast<int>(k), 0) && all_inside; k += Lanes::width) {
        const auto begin = touches_.begin() + static_cast<std::ptrdiff_t>(row + k);
        if (std::find(begin, begin + Lanes::width, 1) != begin + Lanes::width) near_.push_back(static_cast<std::uint32_t>(row + k));
      }
    }
  }
  struct Occupied {
    std::uint32_t cell, original;  // of which it is an image; itself
  };
  /// Displacements in a cell.
  Bounds<Dim> find_displacements(const Occupied& one) noexcept {
    Bounds<Dim> moved;
    for (std::size_t r = by_cell_.begin(one.original); r < by_cell_.begin(one.original + 1); ++r)
      moved.add(displacement_[by_cell_.rows()[r]]);
    for (std::size_t d = 0; d < Dim; ++d) {
      lower_[d][one.cell] = moved.lower[static_cast<int>(d)];
      upper_[d][one.cell] = moved.upper[static_cast<int>(d)];
    }
    return moved;
  }
  /// What is used up in a pack of cells, towards those that touch them and between those on their two sides.
  Lanes look_around(std::size_t cell) noexcept {
    Lanes relative_squared(0.0);
    std::array<Lanes, Dim> before, behind;  // the largest displacement of those before the cell along each axis, the least behind it
    before.fill(Bounds<Dim>{}.upper[0]);
    behind.fill(Bounds<Dim>{}.lower[0]);
    for (const auto& side : sides) {
      const std::size_t other = cell + away(side);
      Lanes squared(0.0);
      for (std::size_t d = 0; d < Dim; ++d) {
        const Lanes lower = Lanes::load(&lower_[d][other]), upper = Lanes::load(&upper_[d][other]);
        const Lanes relative = max(max(upper - Lanes::load(&lower_[d][cell]), Lanes::load(&upper_[d][cell]) - lower), 0.0);
        squared += relative * relative;
        if (side[d] < 0) before[d] = max(before[d], upper);
        if (side[d] > 0) behind[d] = min(behind[d], lower);
      }
      relative_squared = max(relative_squared, squared);
    }
    const Lanes relative = sqrt(relative_squared);
    relative.store(&used_[cell]);
    const auto approach = [&](int d) { return before[static_cast<std::size_t>(d)] - behind[static_cast<std::size_t>(d)]; };
    return max(relative, used_by<Lanes>(1, approach));
  }
  /// A cell and those that touch it: -1, 0 or 1 along each direction.
  static constexpr auto sides = [] {
    std::array<Place, Dim == 1 ? 3 : Dim == 2 ? 9 : 27> result{};
    for (std::size_t k = 0; k < result.size(); ++k) {
      auto rest = static_cast<int>(k);
      for (int& along : result[k]) {
        along = rest % 3 - 1;
        rest /= 3;
      }
    }
    return result;
  }();
  /// What particles that approach each other along the axes use up of the skin, with so many cells in between or more.
  template <class T, class Approach>
  [[nodiscard]] T used_by(int cells_between, const Approach& approach) const noexcept {
    using std::max;
    T result(0.0);
    for (int d = 0; d < Dim; ++d)
      if (cells_.count[static_cast<std::size_t>(d)] > cells_between + 1)
        result = max(result, approach(d) - cells_between * cells_.width[d] + reach_);
    return result;
  }

  Cells<Dim> cells_;
  std::array<bool, Dim> periodic_{};
  double reach_ = 0.0;                         // [m]
  std::array<std::size_t, Dim + 1> stride_{};  // of cells in memory, with one more around them all, and whole packs of them in a row
  std::vector<Run> runs_;                      // of all groups
  std::vector<Bounds<Dim>> displacement_;      // of their particles
  CountingSort by_cell_;                       // runs in the order of their cells
  std::array<AlignedVector<double>, Dim> lower_, upper_;  // displacements in each cell
  AlignedVector<double> used_;
  std::vector<Occupied> occupied_;     // cells where somebody is
  std::vector<std::uint8_t> touches_;  // of each cell: 1 if such a one touches it, or is it
  std::vector<std::uint32_t> near_;    // the first of each pack of cells that are touched
};

}  // namespace dmp::neighbours
