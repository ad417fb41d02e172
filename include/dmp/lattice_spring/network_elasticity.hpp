#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/shape.hpp>
#include <dmp/lattice_spring/body.hpp>
#include <dmp/lattice_spring/detail/checks.hpp>

namespace dmp::lattice_spring {

namespace detail {
/// Sum of w L^2 over the bonds whose midpoints count.
template <int Dim, class Counts>
[[nodiscard]] double sum_of_squares(const Body<Dim>& body, const Counts& counts) {
  const auto& x = body.points.positions;
  require_ends("lattice_spring::affine_bulk_modulus", body.bonds, x.size());
  double sum = 0.0;
  for (const neighbours::Bond& bond : body.bonds)
    if (counts(0.5 * (x[bond.i] + x[bond.j]))) sum += bond.weight * (x[bond.i] - x[bond.j]).squaredNorm();
  return sum;
}
}  // namespace detail

/// Bulk modulus K = (1/(N^2 V)) sum of k w L^2 [Pa] that a network has while all beads follow a uniform strain: an upper bound of what it
/// has when they relax, exact for complete lattices. Each bond once; V the volume of the whole body.
/// M. Kot, ChemEngineering 5 (2021) 3, doi:10.3390/chemengineering5010003, eq. 14. With dispersion it
/// is (1 + 2/N) C, eq. 15, and springs act directly with k (1 - |D|).
template <int Dim>
[[nodiscard]] double affine_bulk_modulus(const Body<Dim>& body, double stiffness) {
  require_positive("lattice_spring::affine_bulk_modulus: volume of the body", body.volume, "m^Dim");
  return stiffness * detail::sum_of_squares(body, [](const auto&) { return true; }) / (Dim * Dim * body.volume);
}
/// The same of the bonds with midpoints in the shape `inside`, and of its volume [m^Dim]: keep it one bond length clear of the surface,
/// where bonds are missing.
template <int Dim, class S>
  requires geometry::Shape<S, Dim>
[[nodiscard]] double affine_bulk_modulus(const Body<Dim>& body, double stiffness, const S& inside, double volume) {
  validate(inside);
  require_positive("lattice_spring::affine_bulk_modulus: volume", volume, "m^Dim");
  return stiffness * detail::sum_of_squares(body, [&](const Vector<Dim>& x) { return inside.contains(x); }) / (Dim * Dim * volume);
}

/// Stiffness k [N/m] of the law, for bonds of weight 1, that gives a network the (affine) bulk modulus K [Pa].
template <int Dim>
[[nodiscard]] double stiffness_for_bulk_modulus(const Body<Dim>& body, double bulk_modulus) {
  require_positive("lattice_spring::stiffness_for_bulk_modulus: bulk_modulus", bulk_modulus, "Pa");
  return bulk_modulus / affine_bulk_modulus(body, 1.0);
}
template <int Dim, class S>
  requires geometry::Shape<S, Dim>
[[nodiscard]] double stiffness_for_bulk_modulus(const Body<Dim>& body, double bulk_modulus, const S& inside, double volume) {
  require_positive("lattice_spring::stiffness_for_bulk_modulus: bulk_modulus", bulk_modulus, "Pa");
  return bulk_modulus / affine_bulk_modulus(body, 1.0, inside, volume);
}

/// S_kL = mean over beads of |sum k L n| / sum k L [-], over those that `counts(position)`: 0 where a uniform expansion leaves no force on
/// any bead. Count inner beads only, a bond length clear of the surface. Kot, eq. 20.
template <int Dim, class Counts>
[[nodiscard]] double mean_imbalance(const Body<Dim>& body, const Counts& counts) {
  const auto& x = body.points.positions;
  detail::require_ends("lattice_spring::mean_imbalance", body.bonds, x.size());
  std::vector<Vector<Dim>> force(x.size(), Vector<Dim>::Zero());
  std::vector<double> sum(x.size(), 0.0);
  for (const neighbours::Bond& bond : body.bonds) {
    const Vector<Dim> apart = bond.weight * (x[bond.j] - x[bond.i]);
    force[bond.i] += apart;
    force[bond.j] -= apart;
    sum[bond.i] += apart.norm();
    sum[bond.j] += apart.norm();
  }
  double total = 0.0, beads = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (sum[i] > 0.0 && counts(x[i])) {
      total += force[i].norm() / sum[i];
      beads += 1.0;
    }
  return beads > 0.0 ? total / beads : 0.0;
}

}  // namespace dmp::lattice_spring
