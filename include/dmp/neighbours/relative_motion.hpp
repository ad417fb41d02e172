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

/// The smallest box that holds some vectors; empty until one is added.
template <int Dim>
struct Bounds {
  Vector<Dim> lower = Vector<Dim>::Constant(std::numeric_limits<double>::max()), upper = -lower;

  void add(const Vector<Dim>& x) noexcept {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  void add(const Bounds& other) noexcept {
    lower = lower.cwiseMin(other.lower);
    upper = upper.cwiseMax(other.upper);
  }
  [[nodiscard]] bool empty() const noexcept { return !(lower[0] <= upper[0]); }
};

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
    cells_ = Cells<Dim>(
        2, [&](std::size_t k) -> const Vector<Dim>& { return k == 0 ? bounds.lower : bounds.upper; }, reach_ + 0.5 * skin,
        std::min(4.0 * static_cast<double>(particles) + 64.0, 1e6));
    periodic_ = box.periodic;
    stride_[0] = 1;
    for (std::size_t d = 0; d < Dim; ++d) {
      auto cells = static_cast<std::size_t>(cells_.count[d]);
      if (d == 0) cells = (cells + Lanes::width - 1) / Lanes::width * Lanes::width;
      stride_[d + 1] = stride_[d] * (cells + 2);
    }
    runs_.clear();
    displacement_.clear();
    for (auto& x : lower_) x.resize(total());
    for (auto& x : upper_) x.resize(total());
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
  }
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
    const Ranges rows(total() / stride_[1], 32);  // of cells along the first direction
    const Bounds<Dim> all = merge_ranges(
        rows, Bounds<Dim>{},
        [this](std::size_t first, std::size_t last) {
          Bounds<Dim> result;
          for (std::size_t row = first; row < last; ++row) result.add(find_displacements(row));
          return result;
        },
        [](Bounds<Dim> a, const Bounds<Dim>& b) {
          a.add(b);
          return a;
        });
    if (all.empty()) return {};
    const double around = merge_ranges(
        rows, 0.0,
        [this](std::size_t first, std::size_t last) {
          double result = 0.0;
          for (std::size_t row = first; row < last; ++row) result = std::max(result, look_around(row));
          return result;
        },
        [](double a, double b) { return std::max(a, b); });
    const double anywhere = used_by<double>(2, [&all](int d) { return all.upper[d] - all.lower[d]; });
    return {std::max(around, anywhere), std::max(-all.lower.minCoeff(), all.upper.maxCoeff())};
  }
  [[nodiscard]] double used(std::uint32_t cell) const noexcept { return used_[cell]; }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return runs_.capacity() * sizeof(Run) + displacement_.capacity() * sizeof(Bounds<Dim>) + by_cell_.bytes() +
           (2 * Dim * lower_[0].capacity() + used_.capacity()) * sizeof(double);
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
  /// Place of the first cell of a row.
  [[nodiscard]] Place place_of(std::size_t row) const noexcept {
    Place place{};
    std::size_t cell = row * stride_[1];
    for (std::size_t d = Dim; d-- > 1; cell %= stride_[d]) place[d] = static_cast<int>(cell / stride_[d]);
    return place;
  }
  [[nodiscard]] bool inside(int place, std::size_t d) const noexcept { return place >= 1 && place <= cells_.count[d]; }
  /// The place of which this one is an image behind a periodic face; itself in between, 0 where nobody is.
  [[nodiscard]] int original(int place, std::size_t d) const noexcept {
    const int count = cells_.count[d];
    if (inside(place, d)) return place;
    return !periodic_[d] || place > count + 1 ? 0 : place == 0 ? count : 1;
  }
  /// Displacements in the cells of a row, or of the row of which it is an image; returns those of all.
  Bounds<Dim> find_displacements(std::size_t row) noexcept {
    Bounds<Dim> all;
    Place place = place_of(row);
    std::size_t first = 0;
    bool nobody = false;
    for (std::size_t d = 1; d < Dim; ++d) {
      const int from = original(place[d], d);
      nobody = nobody || from == 0;
      first += static_cast<std::size_t>(from) * stride_[d];
    }
    for (std::size_t k = 0; k < stride_[1]; ++k) {
      Bounds<Dim> moved;
      if (const int from = original(static_cast<int>(k), 0); from > 0 && !nobody) {
        const std::size_t cell = first + static_cast<std::size_t>(from);
        for (std::size_t r = by_cell_.begin(cell); r < by_cell_.begin(cell + 1); ++r) moved.add(displacement_[by_cell_.rows()[r]]);
        all.add(moved);
      }
      for (std::size_t d = 0; d < Dim; ++d) {
        lower_[d][row * stride_[1] + k] = moved.lower[static_cast<int>(d)];
        upper_[d][row * stride_[1] + k] = moved.upper[static_cast<int>(d)];
      }
    }
    return all;
  }
  /// What is used up in the cells of a row, towards those that touch them and between those on their two sides; returns the most.
  double look_around(std::size_t row) noexcept {
    const Place place = place_of(row);
    for (std::size_t d = 1; d < Dim; ++d)
      if (!inside(place[d], d)) return 0.0;
    Lanes result(0.0);
    for (int k = 1; k <= cells_.count[0]; k += Lanes::width) {
      const std::size_t cell = row * stride_[1] + static_cast<std::size_t>(k);
      Lanes relative_squared(0.0);
      std::array<Lanes, Dim> before, behind;  // the largest displacement of those before the cell along each axis, the least behind it
      before.fill(Bounds<Dim>{}.upper[0]);
      behind.fill(Bounds<Dim>{}.lower[0]);
      for (const auto& side : sides) {
        std::ptrdiff_t away = 0;
        for (std::size_t d = 0; d < Dim; ++d) away += side[d] * static_cast<std::ptrdiff_t>(stride_[d]);
        const std::size_t other = cell + static_cast<std::size_t>(away);
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
      result = max(result, max(relative, used_by<Lanes>(1, approach)));
    }
    double most = 0.0;
    for (int lane = 0; lane < Lanes::width; ++lane) most = std::max(most, result[lane]);
    return most;
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
};

}  // namespace dmp::neighbours
