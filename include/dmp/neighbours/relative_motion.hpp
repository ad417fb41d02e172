#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>
#include <dmp/core/aligned.hpp>
#include <dmp/core/pack.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/box.hpp>
#include <dmp/neighbours/cells.hpp>
#include <dmp/neighbours/counting_sort.hpp>

namespace dmp::neighbours {

/// Particles of one block that were in the same coarse cell when the lists were built, rows first .. end - 1.
struct Run {
  std::uint32_t first, end, cell;
};

/// How much of the skin of neighbour lists has been used up, place by place: by how much neighbours may have approached each other since
/// the lists were built, and how much of what kept others apart. What moves along together wears no lists, however fast.
///
/// Coarse cells are somewhat wider than the lists reach. Neighbours lie in the same cell or in two that touch. With separation s then and
/// relative displacement u since, |s + u| >= |s| + s.u/|s|: along an axis that sets their cells apart only motion towards each other
/// counts. Two in cells that do not touch have at least one width in between, along some axis, and may approach each other along it by what
/// the width is more than the reach before they use up any skin. Both are bounds, from the extremes of the displacements in each cell.
/// Where that for neighbours exceeds the skin, `have_met` looks at every pair.
template <int Dim>
class RelativeMotion {
 public:
  /// Coarse cells over `bounds`, all groups together, for lists that reach as far as `cutoff` and `skin` [m]. Wider cells where these would
  /// be many more than the `particles`. Nobody is followed yet.
  void build(const Bounds<Dim>& bounds, const geometry::Box<Dim>& box, double cutoff, double skin, std::size_t particles) {
    cutoff_ = cutoff;
    skin_ = skin;
    reach_ = cutoff + skin;
    // Wider than the reach, so that those on the two sides of a cell, whom nobody looks at pair by pair, do not wear the lists long before
    // those in cells that touch; not much, since these use up more the wider they are.
    const std::array<Vector<Dim>, 2> corners{bounds.lower, bounds.upper};
    cells_ = Cells<Dim>(2, Positions<Dim>{corners}, reach_ + 0.7 * skin, std::min(4.0 * static_cast<double>(particles) + 64.0, 1e6));
    periodic_ = box.periodic;
    for (std::size_t d = 0; d < Dim; ++d) period_[d] = box.extent()[static_cast<int>(d)];
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
      Run run{static_cast<std::uint32_t>(blocks.begin(block)), 0, 0};
      for (std::size_t i = blocks.begin(block); i < blocks.end(block); ++i) {
        const auto cell = index(positions[i]);
        run.end = static_cast<std::uint32_t>(i);
        if (run.first < run.end && cell != run.cell) {
          function(run);
          run.first = run.end;
        }
        run.cell = cell;
      }
      run.end = static_cast<std::uint32_t>(blocks.end(block));
      if (run.first < run.end) function(run);
    };
    first_run.assign(blocks.size() + 1, 0);
    for_each_block(blocks, [&](std::size_t, std::size_t block) {
      std::size_t count = 0;
      find_runs(block, [&count](const Run&) { ++count; });
      first_run[block + 1] = count;
    });
    first_run[0] = runs_.size();
    for (std::size_t block = 0; block < blocks.size(); ++block) first_run[block + 1] += first_run[block];
    resize_with_margin(runs_, first_run.back());
    for_each_block(blocks, [&](std::size_t, std::size_t block) {
      std::size_t run = first_run[block];
      find_runs(block, [&](const Run& found) { runs_[run++] = found; });
    });
    resize_with_margin(displacement_, runs_.size());
    const Bounds<Dim> none{Vector<Dim>::Zero(), Vector<Dim>::Zero()};
    std::fill(displacement_.data() + first_run[0], displacement_.data() + runs_.size(), none);
  }
  /// After the last group: lists the cells where somebody is, with their images, and the packs of cells that touch them, since much of the
  /// box of a splash is air.
  void find_occupied() {
    by_cell_.sort(runs_.size(), total(), [this](std::size_t run) { return runs_[run].cell; });
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
  [[nodiscard]] const Cells<Dim>& cells() const noexcept { return cells_; }
  /// Calls function(number, run) for the runs of block b of a group that is followed.
  template <class Function>
  void for_each_run(std::span<const std::size_t> first_run, std::size_t block, Function&& function) const {
    for (std::size_t run = first_run[block]; run < first_run[block + 1]; ++run) function(run, runs_[run]);
  }
  /// How far [m] the particles of a run have gone since the lists were built; zero at first.
  void set_displacement(std::size_t run, const Bounds<Dim>& bounds) noexcept { displacement_[run] = bounds; }

  struct Wear {
    double nearby = 0.0;    ///< of the skin [m], where those in cells that touch have used up most
    double afar = 0.0;      ///< the same of all others
    double farthest = 0.0;  ///< how far [m] the farthest particle has gone along an axis, whoever goes with it

    void add(const Wear& other) noexcept {
      nearby = std::max(nearby, other.nearby);
      afar = std::max(afar, other.afar);
    }
  };
  /// From the displacements of all runs; then used(cell) holds too: by how much [m], at most, particles in that cell and any of their
  /// neighbours have approached each other. What is not a number counts for nothing: a check of the state finds it.
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
    Wear wear = merge_ranges(
        Ranges(near_.size(), 256), Wear{},
        [this](std::size_t first, std::size_t last) {
          Lanes nearby(0.0), afar(0.0);
          for (std::size_t k = first; k < last; ++k) look_around(near_[k], nearby, afar);
          Wear result;
          for (int lane = 0; lane < Lanes::width; ++lane) result.add({nearby[lane], afar[lane]});
          return result;
        },
        [](Wear a, const Wear& b) {
          a.add(b);
          return a;
        });
    wear.afar = std::max(wear.afar, used_by<double>(2, [&all](int d) { return all.upper[d] - all.lower[d]; }));
    wear.farthest = std::max(-all.lower.minCoeff(), all.upper.maxCoeff());
    return wear;
  }
  /// A group that is followed: its first run, and where its particles were when the lists were built and are now.
  struct Followed {
    std::size_t first_run;
    std::span<const Vector<Dim>> then, now;
  };
  /// Whether two in cells that touch, which lists of cut-offs from `shortest` [m] on may lack, could act on each other now: pair by pair,
  /// where find_wear found more used up than the skin. True unseen where that would be more than `pairs_worth_it` for each particle, so
  /// that it costs less than new lists.
  [[nodiscard]] bool have_met(std::span<const Followed> groups, double shortest) {
    std::size_t pairs_left = 0;
    for (const Followed& group : groups) pairs_left += pairs_worth_it * group.now.size();
    suspects_.clear();
    for (const auto& [cell, original] : occupied_) {
      if (cell != original || !(used_[cell] > skin_)) continue;
      for (std::size_t side = sides.size() / 2; side < sides.size(); ++side) {  // itself and those behind it: every two once
        if (!(approach_squared<double>(cell, sides[side]) > skin_ * skin_)) continue;
        const Suspects two = suspects(cell, sides[side]);
        const std::size_t pairs = count(cell) * count(two.other);
        if (pairs > pairs_left) return true;
        pairs_left -= pairs;
        suspects_.push_back(two);
      }
    }
    std::atomic<bool> met = false;
    for_each_range(Ranges(suspects_.size(), 64), [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last && !met.load(std::memory_order_relaxed); ++k)
        if (have_met(groups, suspects_[k], shortest)) met.store(true, std::memory_order_relaxed);
    });
    return met;
  }
  [[nodiscard]] double used(std::uint32_t cell) const noexcept { return used_[cell]; }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return runs_.capacity() * sizeof(Run) + displacement_.capacity() * sizeof(Bounds<Dim>) + by_cell_.bytes() +
           (2 * Dim * lower_[0].capacity() + used_.capacity()) * sizeof(double) + occupied_.capacity() * sizeof(Occupied) +
           touches_.capacity() + near_.capacity() * sizeof(std::uint32_t) + suspects_.capacity() * sizeof(Suspects);
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
  /// Bound, squared, of how much those in a cell, or a pack of cells, and those at one side of it have approached each other.
  template <class T>
  [[nodiscard]] T approach_squared(std::size_t cell, const Place& side) const noexcept {
    using std::max;
    const auto load = [](const double* from) {
      if constexpr (std::is_same_v<T, double>) return *from;
      else return T::load(from);
    };
    const std::size_t other = cell + away(side);
    T result(0.0);
    for (std::size_t d = 0; d < Dim; ++d) {
      T approach(0.0);
      if (side[d] <= 0) approach = max(approach, load(&upper_[d][other]) - load(&lower_[d][cell]));
      if (side[d] >= 0) approach = max(approach, load(&upper_[d][cell]) - load(&lower_[d][other]));
      result += approach * approach;
    }
    return result;
  }
  /// What is used up in a pack of cells, towards those that touch them and between those on their two sides.
  void look_around(std::size_t cell, Lanes& nearby, Lanes& afar) noexcept {
    Lanes most_squared(0.0);
    std::array<Lanes, Dim> before, behind;  // the largest displacement of those before the cell along each axis, the least behind it
    before.fill(Bounds<Dim>{}.upper[0]);
    behind.fill(Bounds<Dim>{}.lower[0]);
    for (const auto& side : sides) {
      most_squared = max(most_squared, approach_squared<Lanes>(cell, side));
      for (std::size_t d = 0; d < Dim; ++d) {
        if (side[d] < 0) before[d] = max(before[d], Lanes::load(&upper_[d][cell + away(side)]));
        if (side[d] > 0) behind[d] = min(behind[d], Lanes::load(&lower_[d][cell + away(side)]));
      }
    }
    const Lanes used = sqrt(most_squared);
    used.store(&used_[cell]);
    nearby = max(nearby, used);
    const auto approach = [&](int d) { return before[static_cast<std::size_t>(d)] - behind[static_cast<std::size_t>(d)]; };
    afar = max(afar, used_by<Lanes>(1, approach));
  }
  /// Two cells to be looked at pair by pair; particles of the second are moved by `shift`: it may be seen behind a periodic face.
  struct Suspects {
    std::uint32_t cell, other;
    Vector<Dim> shift;
  };
  [[nodiscard]] Suspects suspects(std::uint32_t cell, const Place& side) const noexcept {
    Suspects result{cell, 0, Vector<Dim>::Zero()};
    std::size_t rest = cell + away(side);
    for (std::size_t d = Dim; d-- > 0; rest %= stride_[d]) {
      const int place = static_cast<int>(rest / stride_[d]), from = original(place, d);
      result.other += static_cast<std::uint32_t>(static_cast<std::size_t>(from) * stride_[d]);
      if (place < from) result.shift[static_cast<int>(d)] = -period_[d];
      if (place > from) result.shift[static_cast<int>(d)] = period_[d];
    }
    return result;
  }
  /// Particles in a cell.
  [[nodiscard]] std::size_t count(std::uint32_t cell) const noexcept {
    std::size_t result = 0;
    for (std::size_t r = by_cell_.begin(cell); r < by_cell_.begin(cell + 1); ++r)
      result += runs_[by_cell_.rows()[r]].end - runs_[by_cell_.rows()[r]].first;
    return result;
  }
  /// Some particles of a cell, component by component; those that fill up the last pack are nowhere near.
  struct Some {
    static constexpr std::size_t most = 64;
    alignas(64) std::array<std::array<double, most>, Dim> then, now;
    std::size_t count = 0;
  };
  /// As many as there is room for, from number `from` of the cell on.
  void gather(std::span<const Followed> groups, std::uint32_t cell, std::size_t from, Some& some) const noexcept {
    some.count = 0;
    for (std::size_t r = by_cell_.begin(cell); r < by_cell_.begin(cell + 1); ++r) {
      const std::size_t run = by_cell_.rows()[r];
      const Followed* group = &groups.back();
      while (group->first_run > run) --group;
      for (std::size_t i = runs_[run].first; i < runs_[run].end && some.count < Some::most; ++i) {
        if (from > 0) {
          --from;
          continue;
        }
        for (std::size_t d = 0; d < Dim; ++d) {
          some.then[d][some.count] = group->then[i].data()[d];
          some.now[d][some.count] = group->now[i].data()[d];
        }
        ++some.count;
      }
    }
    for (std::size_t k = some.count; k % Lanes::width != 0; ++k)
      for (std::size_t d = 0; d < Dim; ++d) some.then[d][k] = some.now[d][k] = 1e150;
  }
  [[nodiscard]] bool have_met(std::span<const Followed> groups, const Suspects& two, double shortest) const noexcept {
    Some some, others;
    for (std::size_t i = 0; gather(groups, two.cell, i, some), some.count > 0; i += some.count)
      for (std::size_t j = 0; gather(groups, two.other, j, others), others.count > 0; j += others.count)
        if (have_met(some, others, two.shift, shortest)) return true;
    return false;
  }
  [[nodiscard]] bool have_met(const Some& some, const Some& others, const Vector<Dim>& shift, double shortest) const noexcept {
    const double listed = (1.0 - 1e-12) * (shortest + skin_);  // pairs are that were within this distance
    for (std::size_t i = 0; i < some.count; ++i)
      for (std::size_t j = 0; j < others.count; j += Lanes::width) {
        Lanes then(0.0), now(0.0);  // distances, squared
        for (std::size_t d = 0; d < Dim; ++d) {
          const double to = shift.data()[d];
          const Lanes s_then = Lanes::load(&others.then[d][j]) - (some.then[d][i] - to);
          const Lanes s_now = Lanes::load(&others.now[d][j]) - (some.now[d][i] - to);
          then += s_then * s_then;
          now += s_now * s_now;
        }
        const auto suspicious = then > listed * listed && now < cutoff_ * cutoff_;
        if (suspicious.bits() != 0)
          for (int lane = 0; lane < Lanes::width; ++lane)
            if (suspicious[lane] && std::sqrt(then[lane]) - std::sqrt(now[lane]) > (1.0 - 1e-9) * skin_) return true;
      }
    return false;
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

  static constexpr std::size_t pairs_worth_it = 8;

  Cells<Dim> cells_;
  std::array<bool, Dim> periodic_{};
  std::array<double, Dim> period_{};                // of those axes [m]
  double cutoff_ = 0.0, skin_ = 0.0, reach_ = 0.0;  // [m]
  std::array<std::size_t, Dim + 1> stride_{};  // of cells in memory, with one more around them all, and whole packs of them in a row
  std::vector<Run> runs_;                      // of all groups
  std::vector<Bounds<Dim>> displacement_;      // of their particles
  CountingSort by_cell_;                       // runs in the order of their cells
  std::array<AlignedVector<double>, Dim> lower_, upper_;  // displacements in each cell
  AlignedVector<double> used_;
  std::vector<Occupied> occupied_;     // cells where somebody is
  std::vector<std::uint8_t> touches_;  // of each cell: 1 if such a one touches it, or is it
  std::vector<std::uint32_t> near_;    // the first of each pack of cells that are touched
  std::vector<Suspects> suspects_;
};

}  // namespace dmp::neighbours
