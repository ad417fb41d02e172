#pragma once
#include <dmp/bond/maxwell.hpp>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::bond {

/// Standard linear solid (Zener): a spring in parallel with a Maxwell branch. Stiff to what is fast, soft to what is slow.
///   tension = k_e (r - r0) + q [N],  dq/dt = k_m dr/dt - q k_m/c_m,  U = (1/2) k_e (r - r0)^2 + q^2/(2 k_m) [J];  q steps as in
///   bond::Maxwell
/// Closed forms: creep (F/k_e)[1 - k_m/(k_e + k_m) e^(-t/t_c)], t_c = c_m (k_e + k_m)/(k_e k_m), under a force F; relaxation
/// X (k_e + k_m e^(-t/tau)), tau = c_m/k_m, at an extension X. It dissipates q^2/c_m >= 0 [W].
/// C. Zener, Elasticity and Anelasticity of Metals (University of Chicago Press, 1948).
struct StandardLinearSolid {
  Required<double> stiffness;         ///< k_e [N/m], >= 0: of the spring, which stays
  Required<double> branch_stiffness;  ///< k_m [N/m], >= 0: of the spring in the branch, which relaxes
  Required<double> branch_damping;    ///< c_m [N s/m], >= 0: of the dashpot in the branch; 0: no branch

  [[nodiscard]] auto tension(const auto& bond) const noexcept {
    return stiffness * (bond.length - bond.rest_length) + branch().tension(bond);
  }
  [[nodiscard]] auto energy(const auto& bond) const noexcept {
    return 0.5 * stiffness * square(bond.length - bond.rest_length) + branch().energy(bond);
  }
  [[nodiscard]] auto memory_after(double dt) const noexcept { return branch().memory_after(dt); }
  [[nodiscard]] double largest_stiffness() const noexcept { return stiffness + branch_stiffness; }

 private:
  [[nodiscard]] Maxwell branch() const noexcept { return {.stiffness = branch_stiffness, .damping = branch_damping}; }
};

inline void validate(const StandardLinearSolid& law) {
  require_not_negative("bond::StandardLinearSolid: stiffness", law.stiffness, "N/m");
  require_not_negative("bond::StandardLinearSolid: branch_stiffness", law.branch_stiffness, "N/m");
  require_not_negative("bond::StandardLinearSolid: branch_damping", law.branch_damping, "N s/m");
}

}  // namespace dmp::bond
