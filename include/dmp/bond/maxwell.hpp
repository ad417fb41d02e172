#pragma once
#include <cmath>
#include <limits>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::bond {

/// Maxwell bond: spring and dashpot in series, a viscoelastic liquid. It forgets its length: the rest length plays no part.
///   tension = q [N],  dq/dt = k dr/dt - q/tau,  tau = c/k,  U = q^2/(2k) [J];  q = 0 at the length that the bond has when the scene is
///   made q <- q e^(-h) + k dr (1 - e^(-h))/h,  h = dt/tau: exact for a step of constant length rate, and never more force than the spring
///   has
/// Closed forms: creep F (1/k + t/c) under a force F, relaxation k X e^(-t/tau) at an extension X. It dissipates q^2/c >= 0 [W].
/// J. C. Maxwell, Phil. Trans. R. Soc. Lond. 157 (1867) 49-88, doi:10.1098/rstl.1867.0004; the step is ours.
struct Maxwell {
  Required<double> stiffness;  ///< k [N/m], >= 0
  Required<double> damping;    ///< c [N s/m], >= 0; 0: no force at all

  [[nodiscard]] auto tension(const auto& bond) const noexcept { return bond.memory; }
  [[nodiscard]] auto energy(const auto& bond) const noexcept { return (stiffness > 0.0 ? 0.5 / stiffness : 0.0) * square(bond.memory); }
  [[nodiscard]] auto memory_after(double dt) const noexcept {
    const double h = damping > 0.0 ? dt * stiffness / damping : std::numeric_limits<double>::infinity();
    const double decay = std::exp(-h), gain = stiffness * (h > 0.0 ? -std::expm1(-h) / h : 1.0);
    return [decay, gain](const auto& bond) { return decay * bond.memory + gain * bond.length_change; };
  }
  [[nodiscard]] double largest_stiffness() const noexcept { return stiffness; }
};

inline void validate(const Maxwell& law) {
  require_not_negative("bond::Maxwell: stiffness", law.stiffness, "N/m");
  require_not_negative("bond::Maxwell: damping", law.damping, "N s/m");
}

}  // namespace dmp::bond
