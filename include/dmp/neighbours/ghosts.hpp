#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>
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
      const std::size_t owned = positions.size(), before = owner.size();
      const auto image = [&](std::uint32_t row, Vector<Dim> by, double x) {
        if (x < box.lower[d] + reach) add(row, by, d, length);
        if (x >= box.upper[d] - reach) add(row, by, d, -length);
      };
      for (std::size_t row = 0; row < owned; ++row) image(static_cast<std::uint32_t>(row), Vector<Dim>::Zero(), positions[row][d]);
      for (std::size_t ghost = 0; ghost < before; ++ghost) image(owner[ghost], shift[ghost], positions[owner[ghost]][d] + shift[ghost][d]);
    }
  }

 private:
  void add(std::uint32_t row, Vector<Dim> by, int direction, double length) {
    by[direction] += length;
    owner.push_back(row);
    shift.push_back(by);
  }
};

}  // namespace dmp::neighbours
