#pragma once
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::bond {

/// Harmonic bond.  U = (1/2) k (r - r0)^2 [J], tension dU/dr = k (r - r0) [N]; force on i: -tension n_ij, n_ij = (r_i - r_j)/r.
/// Sources that print U = K (r - r0)^2 (LAMMPS among them) mean k = 2K.
struct Harmonic {
  Required<double> stiffness;  ///< k [N/m], >= 0

  /// The bond that LAMMPS calls bond_coeff K r0, K in U = K (r - r0)^2.
  [[nodiscard]] static Harmonic from_lammps(double K) { return {.stiffness = 2.0 * K}; }
  [[nodiscard]] auto tension(const auto& bond) const noexcept { return stiffness * (bond.length - bond.rest_length); }
  [[nodiscard]] auto energy(const auto& bond) const noexcept { return 0.5 * stiffness * square(bond.length - bond.rest_length); }
  [[nodiscard]] double largest_stiffness() const noexcept { return stiffness; }
};

inline void validate(const Harmonic& law) { require_not_negative("bond::Harmonic: stiffness", law.stiffness, "N/m"); }

}  // namespace dmp::bond
