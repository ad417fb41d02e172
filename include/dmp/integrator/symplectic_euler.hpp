#pragma once
#include <string_view>

namespace dmp::integrator {

/// Symplectic (semi-implicit) Euler: v += dt a(x), x += dt v, rho += dt drho/dt; laws see the new velocity.
/// First order, symplectic for forces of position: its energy error oscillates and does not grow. One kick per step.
/// E. Hairer, C. Lubich, G. Wanner, Acta Numerica 12 (2003) 399-450, doi:10.1017/S0962492902000144.
struct SymplecticEuler {
  static constexpr std::string_view name = "symplectic Euler";
  static constexpr double oscillation_limit = 2.0, damping_limit = 2.0;

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
  static void begin_state(double& state, double rate, double dt) noexcept { state += dt * rate; }
  [[nodiscard]] static double seen_state(double state, double, double) noexcept { return state; }
  static void end_state(double&, double, double) noexcept {}
};

}  // namespace dmp::integrator
