#pragma once
#include <string_view>
#include <dmp/integrator/extrapolated_verlet.hpp>

namespace dmp::integrator {

/// ExtrapolatedVerlet, except that laws see the state of half a step ago, rho(t + dt/2), at the positions of t + dt, as LAMMPS' fix sph
/// does it; for comparison with LAMMPS. The lag makes sound waves grow by (omega dt)^2/4 per step: stable only for dt < 2 (nu + D)/c^2, nu
/// and D the kinematic viscosity and the diffusivity of density [m^2/s], a bound that no law can state.
struct LammpsVerlet : ExtrapolatedVerlet {
  static constexpr std::string_view name = "extrapolated-velocity Verlet, half-step state";
  static constexpr double state_damping_limit = 2.0;
  static constexpr bool keeps_rates = false;
  [[nodiscard]] static double seen_state(double state, double, double, double) noexcept { return state; }
};

}  // namespace dmp::integrator
