#pragma once
#include <string_view>

namespace dmp::integrator {

/// Leapfrog in kick-drift-kick form; laws see the half-step velocity.
///   begin: v += (dt/2) a,  x += dt v,  rho += (dt/2) drho/dt;   laws see v(t + dt/2), rho(t + dt/2)
///   end:   v += (dt/2) a,              rho += (dt/2) drho/dt
/// Second order, time-reversible and symplectic for forces of position; first order in damping, stable for lambda dt < 2.
/// L. Verlet, Phys. Rev. 159 (1967) 98-103, doi:10.1103/PhysRev.159.98.
struct Leapfrog {
  static constexpr std::string_view name = "leapfrog";
  static constexpr double oscillation_limit = 2.0, damping_limit = 2.0;

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
  static void begin_state(double& state, double rate, double dt) noexcept { state += 0.5 * dt * rate; }
  [[nodiscard]] static double seen_state(double state, double, double) noexcept { return state; }
  static void end_state(double& state, double rate, double dt) noexcept { state += 0.5 * dt * rate; }
};

}  // namespace dmp::integrator
