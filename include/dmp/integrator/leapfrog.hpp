#pragma once
#include <string_view>

namespace dmp::integrator {

/// Leapfrog in kick-drift-kick form; laws see the half-step velocity.
///   begin: v += (dt/2) a,  x += dt v;   laws see v(t + dt/2) and rho(t) + dt (2 drho/dt - the one before)
///   end:   v += (dt/2) a,  rho += dt drho/dt
/// Second order, time-reversible and symplectic for forces of position; first order in damping, stable for lambda dt < 2.
/// Sound, in which density and velocity drive each other, is stable for omega dt < 0.71 without any viscosity.
/// L. Verlet, Phys. Rev. 159 (1967) 98-103, doi:10.1103/PhysRev.159.98.
struct Leapfrog {
  static constexpr std::string_view name = "leapfrog";
  static constexpr double oscillation_limit = 2.0, damping_limit = 2.0, state_damping_limit = 0.28;
  static constexpr double coupled_limit = 1.0, coupled_damping = 1.5;
  static constexpr bool keeps_rates = true;

  template <class Value>
  static void begin(Value& x, Value& v, const Value& a, double dt) noexcept {
    v += 0.5 * dt * a;
    x += dt * v;
  }
  template <class Value>
  [[nodiscard]] static Value seen(const Value& v, const Value&, double) noexcept {
    return v;
  }
  template <class Value>
  static void end(Value& v, const Value& a, double dt) noexcept {
    v += 0.5 * dt * a;
  }
  static void begin_state(double&, double, double) noexcept {}
  [[nodiscard]] static double seen_state(double state, double rate, double previous, double dt) noexcept {
    return state + dt * (2.0 * rate - previous);
  }
  static void end_state(double& state, double rate, double dt) noexcept { state += dt * rate; }
};

}  // namespace dmp::integrator
