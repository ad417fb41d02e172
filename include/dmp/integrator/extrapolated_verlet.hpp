#pragma once
#include <string_view>

namespace dmp::integrator {

/// Velocity Verlet that shows laws the velocity and the state extrapolated to the end of the step.
///   begin: v += (dt/2) a,  x += dt v,  rho += (dt/2) drho/dt
///          laws see v* = v(t) + dt a(t) and rho* = rho(t) + (dt/2) [3 drho/dt(t) - drho/dt(t - dt)]
///   end:   v += (dt/2) a,              rho += (dt/2) drho/dt
/// Second order also with velocity-dependent forces. Damping is stable for lambda dt < 1, half of what the half-step velocity allows.
/// Sound, in which density and velocity drive each other, is stable for omega dt < 0.76 without any viscosity, and damped by about
/// (omega dt)^4/8 per step (eigenvalues of the step); with rho* of first order it would grow for any step.
/// The velocity as in G. C. Ganzenmueller, M. O. Steinhauser, P. Van Liedekerke, The implementation of Smooth Particle Hydrodynamics in
/// LAMMPS (2011); that code shows laws rho(t + dt/2): integrator::LammpsVerlet.
struct ExtrapolatedVerlet {
  static constexpr std::string_view name = "extrapolated-velocity Verlet";
  static constexpr double oscillation_limit = 2.0, damping_limit = 1.0, state_damping_limit = 0.5;
  static constexpr double coupled_limit = 1.0, coupled_damping = 0.75;
  static constexpr bool keeps_rates = true;

  template <class Value>
  static void begin(Value& x, Value& v, const Value& a, double dt) noexcept {
    v += 0.5 * dt * a;
    x += dt * v;
  }
  template <class Value>
  [[nodiscard]] static Value seen(const Value& v, const Value& a, double dt) noexcept {
    return v + 0.5 * dt * a;
  }
  template <class Value>
  static void end(Value& v, const Value& a, double dt) noexcept {
    v += 0.5 * dt * a;
  }
  static void begin_state(double& state, double rate, double dt) noexcept { state += 0.5 * dt * rate; }
  [[nodiscard]] static double seen_state(double state, double rate, double previous, double dt) noexcept {
    return state + dt * (rate - 0.5 * previous);
  }
  static void end_state(double& state, double rate, double dt) noexcept { state += 0.5 * dt * rate; }
};

}  // namespace dmp::integrator
