#pragma once
#include <string_view>

namespace dmp::integrator {

/// Symplectic (semi-implicit) Euler: v += dt a(x), x += dt v, then rho += dt drho/dt with the rate at the new v and x; laws see the new
/// velocity, and rho + dt (2 drho/dt - the one before). Sound is stable for omega dt < 0.71.
/// First order, symplectic for forces of position: its energy error oscillates and does not grow. One kick per step.
/// E. Hairer, C. Lubich, G. Wanner, Acta Numerica 12 (2003) 399-450, doi:10.1017/S0962492902000144.
struct SymplecticEuler {
  static constexpr std::string_view name = "symplectic Euler";
  static constexpr double oscillation_limit = 2.0, damping_limit = 2.0, state_damping_limit = 0.28;
  static constexpr double coupled_limit = 1.0, coupled_damping = 1.5;
  static constexpr bool keeps_rates = true;

  template <class Value>
  static void begin(Value& x, Value& v, const Value& a, double dt) noexcept {
    v += dt * a;
    x += dt * v;
  }
  template <class Value>
  [[nodiscard]] static Value seen(const Value& v, const Value&, double) noexcept {
    return v;
  }
  template <class Value>
  static void end(Value&, const Value&, double) noexcept {}
  static void begin_state(double&, double, double) noexcept {}
  [[nodiscard]] static double seen_state(double state, double rate, double previous, double dt) noexcept {
    return state + dt * (2.0 * rate - previous);
  }
  static void end_state(double& state, double rate, double dt) noexcept { state += dt * rate; }
};

}  // namespace dmp::integrator
