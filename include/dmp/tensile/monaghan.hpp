#pragma once
#include <dmp/core/field.hpp>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::tensile {

/// Artificial repulsion against the tensile instability: particles under tension no longer clump.
///   R_ij = (R_i + R_j) (W(r)/W(dx))^n  [Pa m^6/kg^2], >= 0: repels; 0 for r >= support radius
///   R_i  = eps |P_i| if P_i < 0, else 0;   plus 0.01 (P_i + P_j) if both are > 0;   P = p/rho^2
/// dx = spacing of the particles, smaller than the support radius h: for dx >= h, W(dx) = 0 and R_ij is not finite.
/// J. J. Monaghan, J. Comput. Phys. 159 (2000) 290-311, doi:10.1006/jcph.2000.6439.
struct Monaghan {
  using reads = Fields<field::PressureTerm>;
  Required<double> spacing;  ///< dx [m], > 0
  double strength = 0.2;     ///< eps [-], >= 0; 0.2 is the value of the source
  double exponent = 4.0;     ///< n [-], > 0; 4 is the value of the source

  template <class Pair, class I, class J, class Kernel>
  [[nodiscard]] auto correction(const Pair& pair, const I& i, const J& j, const Kernel& kernel) const noexcept {
    const auto tension = max(-i.pressure_term, 0.0) + max(-j.pressure_term, 0.0);
    const auto both = i.pressure_term + j.pressure_term;
    const auto squeezed = select(min(i.pressure_term, j.pressure_term) > 0.0, 0.01 * both, 0.0);
    const double at_spacing = kernel.value(static_cast<double>(spacing));
    return (strength * tension + squeezed) * power(kernel.value(pair.distance) * (1.0 / at_spacing), exponent);
  }
};

inline void validate(const Monaghan& law) {
  require_positive("tensile::Monaghan: spacing", law.spacing, "m");
  require_not_negative("tensile::Monaghan: strength", law.strength, "[-]");
  require(law.exponent > 0.0 && law.exponent <= 16.0, "tensile::Monaghan: exponent must be > 0 and <= 16", law.exponent);
}

}  // namespace dmp::tensile
