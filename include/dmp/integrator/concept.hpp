#pragma once
#include <concepts>

namespace dmp::integrator {

/// Contract of a time stepper. One step is: begin (kick and drift to the end of the step), forces there, end. Value is a position or
/// a velocity (a number or a Vector), or a state such as density with its rate.
///   begin(x, v, a, dt), end(v, a, dt)            motion, a from the last evaluation in begin, from the new one in end
///   seen(v, a, dt)                               velocity that laws see in the evaluation between the two; a is still the last one
///   begin_state(s, rate, dt), end_state(s, rate, dt), seen_state(s, rate, previous, dt)    the same for a state with a rate; `previous`
///                                                is the rate of the step before if the integrator `keeps_rates`
///   oscillation_limit                            stable for omega dt < this (undamped oscillator)
///   damping_limit, state_damping_limit           stable for lambda dt < this (dv/dt = -lambda v; ds/dt = -lambda s)
///   coupled_limit, coupled_damping               optional. Springs on what also carries sound, whose state is extrapolated over the step,
///                                                are stable for (dt/bound of sound)^2 + (omega dt/coupled_limit)^2 < 1, or where damping
///                                                makes up for it: lambda > coupled_damping dt/(bound of sound)^2
template <class I>
concept Integrator = requires(double x, double v, const double a, double dt) {
  I::begin(x, v, a, dt);
  I::end(v, a, dt);
  { I::seen(x, a, dt) } -> std::convertible_to<double>;
  I::begin_state(x, a, dt);
  I::end_state(x, a, dt);
  { I::seen_state(x, a, a, dt) } -> std::convertible_to<double>;
  { I::oscillation_limit } -> std::convertible_to<double>;
  { I::damping_limit } -> std::convertible_to<double>;
  { I::state_damping_limit } -> std::convertible_to<double>;
  { I::keeps_rates } -> std::convertible_to<bool>;
  I::name;
};

template <class I>
consteval bool explain_integrator() {
  static_assert(
      requires(double x, double v, const double a, double dt) {
        I::begin(x, v, a, dt);
        I::end(v, a, dt);
        I::seen(v, a, dt);
      },
      "dmp: not an Integrator: no static `begin(x, v, a, dt)`, `end(v, a, dt)` and `seen(v, a, dt)`");
  static_assert(
      requires(double s, const double rate, double dt) {
        I::begin_state(s, rate, dt);
        I::end_state(s, rate, dt);
        I::seen_state(s, rate, rate, dt);
      },
      "dmp: not an Integrator: no static `begin_state(s, rate, dt)`, `end_state(s, rate, dt)` and `seen_state(s, rate, previous, dt)`");
  static_assert(
      requires {
        I::oscillation_limit;
        I::damping_limit;
        I::state_damping_limit;
        I::keeps_rates;
        I::name;
      },
      "dmp: not an Integrator: no `oscillation_limit`, `damping_limit`, `state_damping_limit`, `keeps_rates` and `name`");
  return Integrator<I>;
}

}  // namespace dmp::integrator
