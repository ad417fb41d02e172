#pragma once
#include <cmath>
#include <dmp/bond/concept.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::bond {

/// Spring of a solid whose Poisson ratio is not that of central springs, 1/(N + 1). A part of its stiffness acts along the bond, the rest
/// through the mean strain e = theta/S of all bonds at its ends, theta = sum of k r0 (r - r0), S = sum of k r0^2 over the bonds of a
/// particle:
///   U = sum over bonds of (1/2)(1 - |D|) k (r - r0)^2 + sum over particles of (D/4) theta^2/S [J]
///   tension = (1 - |D|) k (r - r0) + (D/2) k r0 (e_i + e_j) [N],  energy = (1/2) tension (r - r0): these of all bonds sum to U
/// D > 0 resists changes of volume more, D < 0 less; shear feels k (1 - |D|). D = 0 is Harmonic. From Young's modulus and Poisson ratio:
/// lattice_spring::springs_for(body, ElasticConstants<Dim>::from_young(E, nu)), whose two numbers are these. e is a column of the group,
/// field::BondStrain, and takes a sweep over the bonds of its own, before that of the forces.
/// (1 - 2 |D|) or 1 times (1/2) k (r - r0)^2 <= U for D < 0 or >= 0, and U <= that with k (1 - |D|) or k: no step is shorter than that of
/// springs k. All bonds at a particle that have a dispersive share must have the same one, else there is no energy.
/// M. Kot, ChemEngineering 5 (2021) 3, doi:10.3390/chemengineering5010003, section 2; his weights 1/(b r) have no energy, these do.
struct Dispersive {
  Required<double> stiffness;         ///< k [N/m], >= 0, direct and dispersive together
  Required<double> dispersive_share;  ///< D, -1/2 <= D < 1

  [[nodiscard]] auto tension(const auto& bond) const noexcept {
    return stiffness * ((1.0 - std::fabs(dispersive_share)) * (bond.length - bond.rest_length) +
                        (0.5 * dispersive_share) * (bond.rest_length * bond.strain_of_ends));
  }
  template <class Bond>
  [[nodiscard]] auto energy(const Bond& bond) const noexcept {
    static_assert(SeesStrainOfEnds<Bond>,
                  "dmp: bond::Dispersive: the energy of a bond depends on the strains of all bonds at its ends, which are not known when "
                  "bonds are asked whether they break; take bond::LargestStrain");
    return 0.5 * (tension(bond) * (bond.length - bond.rest_length));
  }
  [[nodiscard]] double largest_stiffness() const noexcept { return (dispersive_share < 0.0 ? 1.0 + dispersive_share : 1.0) * stiffness; }
};

inline void validate(const Dispersive& law) {
  require_not_negative("bond::Dispersive: stiffness", law.stiffness, "N/m");
  require(law.dispersive_share >= -0.5 && law.dispersive_share < 1.0, "bond::Dispersive: dispersive_share must be >= -0.5 and < 1",
          law.dispersive_share);
}

}  // namespace dmp::bond
