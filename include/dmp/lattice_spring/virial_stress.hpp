#pragma once
#include <cstddef>
#include <span>
#include <vector>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/box.hpp>
#include <dmp/lattice_spring/body.hpp>
#include <dmp/lattice_spring/detail/checks.hpp>
#include <dmp/lattice_spring/tensor.hpp>

namespace dmp::lattice_spring {

/// Stress of each bead [Pa, in 2D N/m], tension positive: sigma_i = (1/(2 V_i)) sum over its bonds of L T n n^T, with the tensions T [N] in
/// the order of the bonds (tensions(...), weights included) and one volume V_i per bead [m^Dim]: l^3 of a bead inside a cubic lattice,
/// points.volume of a network. Of several lists of bonds: the sum of theirs. Beads in the surface have part of that volume only.
/// M. Sahputra, A. Alexiadis, M. J. Adams, ChemEngineering 4 (2020) 30,
/// doi:10.3390/chemengineering4020030.
template <int Dim>
[[nodiscard]] std::vector<Tensor<Dim>> virial_stress(std::span<const neighbours::Bond> bonds, std::span<const double> tensions,
                                                     std::span<const Vector<Dim>> positions, double volume_per_bead,
                                                     const geometry::Box<Dim>& box = geometry::Box<Dim>::unbounded()) {
  require_positive("lattice_spring::virial_stress: volume_per_bead", volume_per_bead, "m^Dim");
  detail::require_same_size("lattice_spring::virial_stress", "tensions", tensions.size(), bonds.size());
  detail::require_ends("lattice_spring::virial_stress", bonds, positions.size());
  std::vector<Tensor<Dim>> stress(positions.size(), Tensor<Dim>::Zero());
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const Vector<Dim> apart = neighbours::minimum_image<Dim>(positions[bonds[b].j] - positions[bonds[b].i], box);
    const double length = apart.norm();
    if (!(length > 0.0)) continue;  // no direction
    const Tensor<Dim> half = (0.5 * tensions[b] / (length * volume_per_bead)) * apart * apart.transpose();
    stress[bonds[b].i] += half;
    stress[bonds[b].j] += half;
  }
  return stress;
}

/// The part of motion: -(m/V_i) v' v'^T, v' the velocity less the mean over the bead and those bonded to it. To be added to the virial; in
/// slow loading it is below 1 % of it, or the loading was not slow.
template <int Dim>
[[nodiscard]] std::vector<Tensor<Dim>> kinetic_stress(std::span<const neighbours::Bond> bonds, std::span<const Vector<Dim>> velocities,
                                                      double mass, double volume_per_bead) {
  require_positive("lattice_spring::kinetic_stress: mass", mass, "kg");
  require_positive("lattice_spring::kinetic_stress: volume_per_bead", volume_per_bead, "m^Dim");
  detail::require_ends("lattice_spring::kinetic_stress", bonds, velocities.size());
  std::vector<Vector<Dim>> sum(velocities.begin(), velocities.end());
  std::vector<double> count(velocities.size(), 1.0);
  for (const neighbours::Bond& bond : bonds) {
    sum[bond.i] += velocities[bond.j];
    sum[bond.j] += velocities[bond.i];
    count[bond.i] += 1.0;
    count[bond.j] += 1.0;
  }
  std::vector<Tensor<Dim>> stress(velocities.size());
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    const Vector<Dim> own = velocities[i] - sum[i] / count[i];
    stress[i] = (-mass / volume_per_bead) * own * own.transpose();
  }
  return stress;
}

}  // namespace dmp::lattice_spring
