#pragma once
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>
#include <dmp/geometry/shape.hpp>
#include <dmp/lattice_spring/body.hpp>
#include <dmp/lattice_spring/elastic_constants.hpp>
#include <dmp/lattice_spring/network_elasticity.hpp>

namespace dmp::lattice_spring {

/// How the springs of a bead share the force that gives a body another Poisson ratio than 1/(N + 1). Both add D (1 + 2/N) C to the bulk
/// modulus and leave the shear modulus alone, inside lattices exactly.
///   energy_consistent  in parts of k L0: U = sum of (1/2)(1 - |D|) k (L - L0)^2 + sum over beads of (D/4) theta^2/S, with
///                      theta = sum of k L0 (L - L0) and S = sum of k L0^2 over the bead's springs. Stable for all -1/2 <= D <= 1.
///   by_number          in parts of 1/(b L), b the bead's number of springs: M. Kot's rule. The same where k L^2 is; elsewhere it has no
///                      potential, its matrix is unsymmetric, and on the cubic lattice undamped motion grows beyond D of about 0.85.
enum class Dispersion { energy_consistent, by_number };

/// Springs of one stiffness, times the weights of the bonds, that act directly with k (1 - |D|) and share the rest.
/// M. Kot, ChemEngineering 5 (2021) 3, doi:10.3390/chemengineering5010003, section 2.
struct Springs {
  Required<double> stiffness;     ///< k [N/m], > 0, of a bond with weight 1; the direct and the dispersive share together
  double dispersive_share = 0.0;  ///< D, -1/2 <= D <= 1; 0: central springs alone, and no cost. 1 is a fluid, -1/2 has no bulk modulus
  Dispersion dispersion = Dispersion::energy_consistent;
  double added_share =
      0.0;  ///< >= 0: springs act directly with k (1 - |D| + this); 1e-6 holds what D = -1/2 or 1 would leave without energy
};
inline void validate(const Springs& springs) {
  require_positive("lattice_spring::Springs: stiffness", springs.stiffness, "N/m");
  require(springs.dispersive_share >= -0.5 && springs.dispersive_share <= 1.0,
          "lattice_spring::Springs: dispersive_share must be >= -0.5 and <= 1", springs.dispersive_share);
  require_not_negative("lattice_spring::Springs: added_share", springs.added_share, "");
}

/// The springs that give a body these constants while it follows a uniform strain: (1 + 2/N) C = (1/(N^2 V)) sum of k L^2, over the whole
/// body, or over the bonds with midpoints in `inside`, of this volume [m^Dim]. constants.warning() tells of a nu that is hard to work with.
/// M. Kot, eq. 15.
template <int Dim>
[[nodiscard]] Springs springs_for(const Body<Dim>& body, const ElasticConstants<Dim>& constants,
                                  Dispersion dispersion = Dispersion::energy_consistent) {
  return {.stiffness = stiffness_for_bulk_modulus(body, (1.0 + 2.0 / Dim) * constants.spring_modulus),
          .dispersive_share = constants.dispersive_share,
          .dispersion = dispersion};
}
template <int Dim, class S>
  requires geometry::Shape<S, Dim>
[[nodiscard]] Springs springs_for(const Body<Dim>& body, const ElasticConstants<Dim>& constants, const S& inside, double volume,
                                  Dispersion dispersion = Dispersion::energy_consistent) {
  return {.stiffness = stiffness_for_bulk_modulus(body, (1.0 + 2.0 / Dim) * constants.spring_modulus, inside, volume),
          .dispersive_share = constants.dispersive_share,
          .dispersion = dispersion};
}

}  // namespace dmp::lattice_spring
