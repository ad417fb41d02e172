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
template <int Dim>
struct Run {
  std::uint32_t first, cell;
  Bounds<Dim> displacement{Vector<Dim>::Zero(), Vector<Dim>::Zero()};  ///< of its particles, since then
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
    // By half a skin: in shear, three widths that part as much more than two leave room for that much.
    cells_ = Cells<Dim>(
        2, [&](std::size_t k) -> const Vector<Dim>& { return k == 0 ? bounds.lower : bounds.upper; }, reach_ + 0.5 * skin,
        std::min(4.0 * static_cast<double>(particles) + 64.0, 1e6));
    periodic_ = box.periodic;
    runs_.clear();
    moved_.resize(cells_.total());
    used_.assign(cells_.total(), 0.0);
  }
  /// Follows a group from where it is now. Sets first_run: the runs of block b are number first_run[b] .. first_run[b + 1] - 1.
  void follow(const Blocks& blocks, std::span<const Vector<Dim>> positions, std::vector<std::size_t>& first_run) {
    const auto for_each_run = [&](std::size_t block, auto&& function) {
      std::uint32_t last = 0;
      for (std::size_t i = blocks.begin(block); i < blocks.end(block); ++i)
        if (const auto cell = static_cast<std::uint32_t>(cells_.index(positions[i])); i == blocks.begin(block) || cell != last)
          function(static_cast<std::uint32_t>(i), last = cell);
    };
    first_run.assign(blocks.size() + 1, 0);
    for_each_block(blocks, [&](std::size_t, std::size_t block) {
      std::size_t count = 0;
      for_each_run(block, [&count](std::uint32_t, std::uint32_t) { ++count; });
      first_run[block + 1] = count;
    });
    first_run[0] = runs_.size();
    for (std::size_t block = 0; block < blocks.size(); ++block) first_run[block + 1] += first_run[block];
    resize_with_margin(runs_, first_run.back());
    for_each_block(blocks, [&](std::size_t, std::size_t block) {
      std::size_t run = first_run[block];
      for_each_run(block, [&](std::uint32_t i, std::uint32_t cell) { runs_[run++] = {i, cell}; });
    });
    by_cell_.sort(runs_.size(), cells_.total(), [this](std::size_t run) { return runs_[run].cell; });
  }
  /// Runs `begin` .. `end` - 1, for their displacements to be set.
  [[nodiscard]] std::span<Run<Dim>> runs(std::size_t begin, std::size_t end) noexcept { return {runs_.data() + begin, end - begin}; }

  struct Wear {
    double used = 0.0;      ///< of the skin [m], where it is most
    double farthest = 0.0;  ///< how far [m] the farthest particle has gone along an axis, whoever goes with it
  };
  /// From the displacements of all runs; then used(cell) holds too: the largest relative displacement [m] of particles in that cell from any
  /// of their neighbours. What is not a number counts for nothing: a check of the state finds it.
  [[nodiscard]] Wear find_wear() {
    const Ranges cells(cells_.total(), 256);
    const Bounds<Dim> all = merge_ranges(
        cells, Bounds<Dim>{},
        [this](std::size_t first, std::size_t last) {
          Bounds<Dim> result;
          for (std::size_t cell = first; cell < last; ++cell) {
            Bounds<Dim> moved;
            for (std::size_t k = by_cell_.begin(cell); k < by_cell_.begin(cell + 1); ++k) moved.add(runs_[by_cell_.rows()[k]].displacement);
            result.add(moved_[cell] = moved);
          }
          return result;
        },
        [](Bounds<Dim> a, const Bounds<Dim>& b) {
          a.add(b);
          return a;
        });
    if (all.empty()) return {};
    const double around = merge_ranges(
        cells, 0.0,
        [this](std::size_t first, std::size_t last) {
          double result = 0.0;
          for (std::size_t cell = first; cell < last; ++cell) {
            const Around found = look_around(cell);
            used_[cell] = found.relative;
            result = std::max({result, found.relative, used_by(found.approach, 1)});
          }
          return result;
        },
        [](double a, double b) { return std::max(a, b); });
    return {std::max(around, used_by(all.upper - all.lower, 2)), std::max(-all.lower.minCoeff(), all.upper.maxCoeff())};
  }
  [[nodiscard]] double used(std::uint32_t cell) const noexcept { return used_[cell]; }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return runs_.capacity() * sizeof(Run<Dim>) + by_cell_.bytes() + moved_.capacity() * sizeof(Bounds<Dim>) +
           used_.capacity() * sizeof(double);
  }

 private:
  struct Around {
    double relative;       // displacement of particles in a cell, and in those that touch it, at most
    Vector<Dim> approach;  // of particles on its two sides, along each axis
  };
  [[nodiscard]] Around look_around(std::size_t cell) const noexcept {
    const auto& own = moved_[cell];
    std::array<int, Dim> at;
    std::size_t rest = cell;
    for (std::size_t d = 0; d < Dim; ++d) {
      at[d] = static_cast<int>(rest % static_cast<std::size_t>(cells_.count[d]));
      rest /= static_cast<std::size_t>(cells_.count[d]);
    }
    double largest_squared = 0.0;
    Bounds<Dim> sides;  // upper: of those before the cell along each axis; lower: of those behind it
    std::array<int, Dim> offset;
    for_each_around(at, offset, Dim - 1, 0, [&](std::size_t other) {
      const auto& its = moved_[other];
      if (its.empty()) return;
      if (!own.empty()) largest_squared = std::max(largest_squared, (its.upper - own.lower).cwiseMax(own.upper - its.lower).squaredNorm());
      for (int d = 0; d < Dim; ++d) {
        const int side = offset[static_cast<std::size_t>(d)];
        if (side < 0) sides.upper[d] = std::max(sides.upper[d], its.upper[d]);
        if (side > 0) sides.lower[d] = std::min(sides.lower[d], its.lower[d]);
      }
    });
    return {std::sqrt(largest_squared), sides.upper - sides.lower};
  }
  /// What particles that approach each other along an axis use up of the skin, with so many cells in between or more.
  [[nodiscard]] double used_by(const Vector<Dim>& approach, int cells_between) const noexcept {
    double result = 0.0;
    for (int d = 0; d < Dim; ++d)
      if (cells_.count[static_cast<std::size_t>(d)] > cells_between + 1)
        result = std::max(result, approach[d] - cells_between * cells_.width[d] + reach_);
    return result;
  }
  /// Calls function(cell) for the cell `at` and those that touch it, with `offset` -1, 0 or 1 along each axis.
  template <class Function>
  void for_each_around(const std::array<int, Dim>& at, std::array<int, Dim>& offset, int direction, std::size_t before,
                       const Function& function) const noexcept {
    if (direction < 0) {
      function(before);
      return;
    }
    const auto d = static_cast<std::size_t>(direction);
    const int count = cells_.count[d];
    for (offset[d] = -1; offset[d] <= 1; ++offset[d]) {
      const int c = at[d] + offset[d], wrapped = periodic_[d] ? (c + count) % count : c;
      if (wrapped >= 0 && wrapped < count)
        for_each_around(at, offset, direction - 1, before * static_cast<std::size_t>(count) + static_cast<std::size_t>(wrapped), function);
    }
  }

  Cells<Dim> cells_;
  std::array<bool, Dim> periodic_{};
  double reach_ = 0.0;              // [m]
  std::vector<Run<Dim>> runs_;      // of all groups
  CountingSort by_cell_;            // runs in the order of their cells
  std::vector<Bounds<Dim>> moved_;  // displacements in each cell
  std::vector<double> used_;
};

}  // namespace dmp::neighbours
