#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <dmp/core/threads.hpp>
#include <dmp/core/vector.hpp>

namespace dmp::neighbours {

/// Positions of particles, and after them those of their ghosts: row owner[k], moved by shift[k].
template <int Dim>
struct Positions {
  std::span<const Vector<Dim>> particles;
  std::span<const std::uint32_t> owner{};
  std::span<const Vector<Dim>> shift{};

  [[nodiscard]] std::size_t size() const noexcept { return particles.size() + owner.size(); }
  [[nodiscard]] Vector<Dim> operator()(std::size_t k) const noexcept {
    if (k < particles.size()) return particles[k];
    return particles[owner[k - particles.size()]] + shift[k - particles.size()];
  }
};

/// The smallest box that holds some vectors; empty until one is added.
template <int Dim>
struct Bounds {
  Vector<Dim> lower = Vector<Dim>::Constant(std::numeric_limits<double>::max());
  Vector<Dim> upper = Vector<Dim>::Constant(std::numeric_limits<double>::lowest());

  void add(const Vector<Dim>& x) noexcept { add(Bounds{x, x}); }
  void add(const Bounds& other) noexcept {
    for (int d = 0; d < Dim; ++d) {  // in this order: what is not a number counts for nothing
      lower[d] = std::min(lower[d], other.lower[d]);
      upper[d] = std::max(upper[d], other.upper[d]);
    }
  }
  [[nodiscard]] bool empty() const noexcept { return !(lower[0] <= upper[0]); }
};

/// That of position(0 .. size - 1).
template <int Dim, class Position>
[[nodiscard]] Bounds<Dim> bounds_of(std::size_t size, const Position& position) {
  return merge_ranges(
      Ranges(size), Bounds<Dim>{},
      [&](std::size_t first, std::size_t last) {
        Bounds<Dim> part;
        for (std::size_t k = first; k < last; ++k) part.add(position(k));
        return part;
      },
      [](Bounds<Dim> a, const Bounds<Dim>& b) {
        a.add(b);
        return a;
      });
}

/// Equal cells over the bounding box of some positions.
template <int Dim>
struct Cells {
  Vector<Dim> lower = Vector<Dim>::Zero(), width = Vector<Dim>::Zero(), inverse_width = Vector<Dim>::Zero();
  std::array<int, Dim> count = [] {
    std::array<int, Dim> one;
    one.fill(1);
    return one;
  }();

  Cells() = default;
  /// Cells of at least `least_width` [m] over position(0 .. size - 1); wider where that would make many more cells than particles.
  template <class Position>
  Cells(std::size_t size, const Position& position, double least_width)
      : Cells(size, position, least_width, 4.0 * static_cast<double>(size) + 64.0) {}
  /// The same with a number of cells that the caller bounds.
  template <class Position>
  Cells(std::size_t size, const Position& position, double least_width, double most_cells) {
    const Bounds<Dim> all = bounds_of<Dim>(size, position);
    if (size == 0) return;
    lower = all.lower;
    Vector<Dim> extent;
    for (int d = 0; d < Dim; ++d) extent[d] = std::max(0.0, all.upper[d] - all.lower[d]);
    const auto cells_of = [&](double w) {
      double total = 1.0;
      for (int d = 0; d < Dim; ++d) total *= std::max(1.0, std::floor(extent[d] / w));
      return total;
    };
    while (cells_of(least_width) > most_cells) least_width *= 1.25;
    for (int d = 0; d < Dim; ++d) {
      auto& cells = count[static_cast<std::size_t>(d)];
      cells = static_cast<int>(std::max(1.0, std::floor(extent[d] / least_width)));
      width[d] = extent[d] / cells;
      inverse_width[d] = extent[d] > 0.0 ? cells / extent[d] : 0.0;
    }
  }

  /// Cuts every cell into `parts` slices across direction d.
  void divide(int d, int parts) noexcept {
    count[static_cast<std::size_t>(d)] *= parts;
    width[d] /= parts;
    inverse_width[d] *= parts;
  }

  [[nodiscard]] std::size_t total() const noexcept {
    std::size_t result = 1;
    for (const int cells : count) result *= static_cast<std::size_t>(cells);
    return result;
  }
  /// Cell of x, counted along the first direction first.
  [[nodiscard]] std::size_t index(const Vector<Dim>& x) const noexcept {
    std::size_t cell = 0;
    for (int d = Dim - 1; d >= 0; --d)
      cell = cell * static_cast<std::size_t>(count[static_cast<std::size_t>(d)]) + static_cast<std::size_t>(along(x[d], d));
    return cell;
  }
  /// Cell of x along direction d; the first or last one beyond the ends.
  [[nodiscard]] int along(double x, int d) const noexcept {
    const double cell = (x - lower[d]) * inverse_width[d];
    const double last = count[static_cast<std::size_t>(d)] - 1.0;
    return static_cast<int>(std::min(std::max(0.0, cell), last));  // in this order: a position that is not a number goes to cell 0
  }
};

}  // namespace dmp::neighbours
