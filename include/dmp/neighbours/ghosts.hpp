#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>
#include <dmp/core/threads.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/box.hpp>

namespace dmp::neighbours {

/// Copies of particles that a sweep reads as neighbours but does not own: the images behind the periodic faces of the box. Pair loops know
/// neither boxes nor images. Particles owned by other processes would be further entries of the same kind.
template <int Dim>
struct Ghosts {
  std::vector<std::uint32_t> owner;  ///< row of the original
  std::vector<Vector<Dim>> shift;    ///< what to add to its position [m]

  [[nodiscard]] std::size_t size() const noexcept { return owner.size(); }

  /// Images of all particles within `reach` [m] of a periodic face, edges and corners included. The box must be longer than `reach` in
  /// each periodic direction, and all positions lie in it.
  void build(std::span<const Vector<Dim>> positions, const geometry::Box<Dim>& box, double reach) {
    owner.clear();
    shift.clear();
    for (int d = 0; d < Dim; ++d) {
      if (!box.periodic[static_cast<std::size_t>(d)]) continue;
      const double length = box.upper[d] - box.lower[d];
      const std::size_t before = owner.size();
      const auto near_lower = [&](double x) { return x < box.lower[d] + reach; };
      const auto near_upper = [&](double x) { return x >= box.upper[d] - reach; };
      const Ranges ranges(positions.size());
      near_.resize(std::max(near_.size(), ranges.size()));
      for_each_range(ranges, [&](std::size_t range, std::size_t first, std::size_t last) {
        near_[range].clear();
        for (std::size_t row = first; row < last; ++row)
          if (near_lower(positions[row][d]) || near_upper(positions[row][d])) near_[range].push_back(static_cast<std::uint32_t>(row));
      });
      const auto image = [&](std::uint32_t row, Vector<Dim> by, double x) {
        if (near_lower(x)) add(row, by, d, length);
        if (near_upper(x)) add(row, by, d, -length);
      };
      for (std::size_t range = 0; range < ranges.size(); ++range)
        for (const std::uint32_t row : near_[range]) image(row, Vector<Dim>::Zero(), positions[row][d]);
      for (std::size_t ghost = 0; ghost < before; ++ghost) image(owner[ghost], shift[ghost], positions[owner[ghost]][d] + shift[ghost][d]);
    }
  }

 private:
  std::vector<std::vector<std::uint32_t>> near_;  // rows near the faces of one direction, per range of rows

  void add(std::uint32_t row, Vector<Dim> by, int direction, double length) {
    by[direction] += length;
    owner.push_back(row);
    shift.push_back(by);
  }
};

}  // namespace dmp::neighbours
