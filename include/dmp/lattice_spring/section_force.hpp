#pragma once
#include <cstddef>
#include <span>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/shape.hpp>
#include <dmp/lattice_spring/body.hpp>
#include <dmp/lattice_spring/detail/checks.hpp>
#include <dmp/lattice_spring/tensor.hpp>

namespace dmp::lattice_spring {

/// Force [N] that the upper side of the plane x_axis = position exerts on the lower one: sum of T n over the bonds that cross it, n up;
/// component `axis` > 0 is tension. Put the plane between the beads of a lattice, not through them.
template <int Dim>
[[nodiscard]] Vector<Dim> section_force(std::span<const neighbours::Bond> bonds, std::span<const double> tensions,
                                        std::span<const Vector<Dim>> positions, int axis, double position) {
  detail::require_same_size("lattice_spring::section_force", "tensions", tensions.size(), bonds.size());
  detail::require_ends("lattice_spring::section_force", bonds, positions.size());
  Vector<Dim> sum = Vector<Dim>::Zero();
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const Vector<Dim>&i = positions[bonds[b].i], &j = positions[bonds[b].j];
    if ((i[axis] < position) == (j[axis] < position)) continue;
    sum += (i[axis] < position ? tensions[b] : -tensions[b]) * (j - i).normalized();
  }
  return sum;
}

/// Mean stress [Pa] in a region of this volume [m^Dim]: (1/V) sum of L T n n^T over the bonds whose midpoints lie in it.
template <int Dim, class S>
  requires geometry::Shape<S, Dim>
[[nodiscard]] Tensor<Dim> mean_stress(std::span<const neighbours::Bond> bonds, std::span<const double> tensions,
                                      std::span<const Vector<Dim>> positions, const S& inside, double volume) {
  validate(inside);
  require_positive("lattice_spring::mean_stress: volume", volume, "m^Dim");
  detail::require_same_size("lattice_spring::mean_stress", "tensions", tensions.size(), bonds.size());
  detail::require_ends("lattice_spring::mean_stress", bonds, positions.size());
  Tensor<Dim> sum = Tensor<Dim>::Zero();
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const Vector<Dim>&i = positions[bonds[b].i], &j = positions[bonds[b].j], apart = j - i;
    if (!(apart.squaredNorm() > 0.0) || !inside.contains(0.5 * (i + j))) continue;
    sum += tensions[b] / apart.norm() * apart * apart.transpose();
  }
  return sum / volume;
}

}  // namespace dmp::lattice_spring
