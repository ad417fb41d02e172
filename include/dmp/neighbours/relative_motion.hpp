#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>
#include <dmp/core/threads.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/box.hpp>
#include <dmp/neighbours/cells.hpp>

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
};

/// Particles of one group that were in the same coarse cell when the lists were built, rows first .. first of the next run.
template <int Dim>
struct Run {
  std::uint32_t first, cell;
  Bounds<Dim> displacement{Vector<Dim>::Zero(), Vector<Dim>::Zero()};  ///< of its particles, since then
};

/// How much of the skin of neighbour lists has been used up, place by place: by how much neighbours have moved relative to each other since
/// the lists were built. What moves along together wears no lists, however fast. Coarse cells are as wide as the lists reach, so that
/// neighbours lie in the same cell or in two that touch.
template <int Dim>
class RelativeMotion {
 public:
  /// Coarse cells over `bounds`, all groups together; `reach` [m]: cut-off and skin. Wider cells where these would be many more than the
  /// `particles`.
  void build(const Bounds<Dim>& bounds, const geometry::Box<Dim>& box, double reach, std::size_t particles) {
    cells_ = Cells<Dim>(
        2, [&](std::size_t k) -> const Vector<Dim>& { return k == 0 ? bounds.lower : bounds.upper; }, reach,
        std::min(4.0 * static_cast<double>(particles) + 64.0, 1e6));
    periodic_ = box.periodic;
    moved_.assign(cells_.total(), {});
    used_.assign(cells_.total(), 0.0);
  }
  [[nodiscard]] std::uint32_t cell_of(const Vector<Dim>& x) const noexcept { return static_cast<std::uint32_t>(cells_.index(x)); }
  void start() noexcept { std::fill(moved_.begin(), moved_.end(), Bounds<Dim>{}); }
  void add(std::span<const Run<Dim>> runs) noexcept {
    for (const auto& run : runs) moved_[run.cell].add(run.displacement);
  }
  /// The largest relative displacement [m] of neighbours anywhere; used(cell): of particles in that cell from all their neighbours.
  [[nodiscard]] double finish() {
    return merge_ranges(
        Ranges(cells_.total(), 256), 0.0,
        [this](std::size_t first, std::size_t last) {
          double largest = 0.0;
          for (std::size_t cell = first; cell < last; ++cell) largest = std::max(largest, used_[cell] = largest_around(cell));
          return largest;
        },
        [](double a, double b) { return std::max(a, b); });
  }
  /// How far [m] the farthest particle has gone along an axis, whoever goes with it.
  [[nodiscard]] double farthest() const noexcept {
    double result = 0.0;
    for (const auto& cell : moved_)
      if (cell.lower[0] <= cell.upper[0]) result = std::max({result, -cell.lower.minCoeff(), cell.upper.maxCoeff()});
    return result;
  }
  [[nodiscard]] double used(std::uint32_t cell) const noexcept { return used_[cell]; }
  [[nodiscard]] std::size_t bytes() const noexcept { return moved_.capacity() * sizeof(Bounds<Dim>) + used_.capacity() * sizeof(double); }

 private:
  [[nodiscard]] double largest_around(std::size_t cell) const noexcept {
    const auto& own = moved_[cell];
    if (!(own.lower[0] <= own.upper[0])) return 0.0;
    std::array<int, Dim> at;
    std::size_t rest = cell;
    for (std::size_t d = 0; d < Dim; ++d) {
      at[d] = static_cast<int>(rest % static_cast<std::size_t>(cells_.count[d]));
      rest /= static_cast<std::size_t>(cells_.count[d]);
    }
    Bounds<Dim> around = own;
    add_neighbours(around, at, Dim - 1, 0);
    return (around.upper - own.lower).cwiseMax(own.upper - around.lower).norm();
  }
  void add_neighbours(Bounds<Dim>& around, const std::array<int, Dim>& at, int direction, std::size_t before) const noexcept {
    if (direction < 0) {
      around.add(moved_[before]);
      return;
    }
    const auto d = static_cast<std::size_t>(direction);
    const int count = cells_.count[d];
    for (int c = at[d] - 1; c <= at[d] + 1; ++c) {
      const int wrapped = periodic_[d] ? (c + count) % count : c;
      if (wrapped >= 0 && wrapped < count)
        add_neighbours(around, at, direction - 1, before * static_cast<std::size_t>(count) + static_cast<std::size_t>(wrapped));
    }
  }

  Cells<Dim> cells_;
  std::array<bool, Dim> periodic_{};
  std::vector<Bounds<Dim>> moved_;  // displacements in each cell
  std::vector<double> used_;
};

}  // namespace dmp::neighbours
