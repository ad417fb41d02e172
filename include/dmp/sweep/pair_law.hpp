#pragma once
#include <cmath>
#include <concepts>
#include <type_traits>
#include <dmp/core/field.hpp>
#include <dmp/core/pair.hpp>
#include <dmp/core/require.hpp>
#include <dmp/potential/concept.hpp>
#include <dmp/sweep/step_limit.hpp>

namespace dmp::sweep {

template <class L>
concept StatesItsBounds = requires(const L law, const StepState state, StepLimit limit) { law.step_limits(state, limit); } ||
                          requires(const L law, const StepState state, StepLimit limit) { law.step_limits(state, state, limit); };
/// Contract of a pair law, what a gather sweep sums over the neighbours of a particle.
///   using reads  = Fields<...>      of both particles; their mass is always there
///   using writes = Fields<...>      rates of change: Acceleration, Force, DensityRate, ...
///   uses_velocity                   whether relative_velocity and approach are needed
///   cutoff()                        [m]; the law is exactly 0 beyond it
///   add(pair, i, j, sums)           adds what j does to i
///   step_limits(state, limit)       states its bounds of the time step, from extremes over both groups: what it does to velocities by
///                                   limit.damp and limit.oscillate, which add up with bonds and forcings, the rest by require_below; or
///   step_limits(a, b, limit)        the same from the extremes over either group
template <class L>
concept PairLaw = std::is_trivially_copyable_v<L> && StatesItsBounds<L> && requires(const L law) {
  typename L::reads;
  typename L::writes;
  { L::uses_velocity } -> std::convertible_to<bool>;
  { law.cutoff() } -> std::convertible_to<double>;
};

template <class L>
consteval bool explain_pair_law() {
  static_assert(
      requires {
        typename L::reads;
        typename L::writes;
        L::uses_velocity;
      },
      "dmp: not a PairLaw: it needs `using reads = Fields<...>;`, `using writes = Fields<...>;` and `static constexpr bool uses_velocity`");
  static_assert(
      requires(const L law) {
        { law.cutoff() } -> std::convertible_to<double>;
      },
      "dmp: not a PairLaw: no `double cutoff() const` [m]");
  static_assert(
      StatesItsBounds<L>,
      "dmp: not a PairLaw: no `void step_limits(const StepState&, StepLimit&) const`, its bounds of the time step");
  return PairLaw<L>;
}

/// A pair potential as a pair law: force f(r^2) r_ij [N] on i.
template <class P>
struct PotentialForce {
  using reads = Fields<>;
  using writes = Fields<field::Force>;
  static constexpr bool uses_velocity = false;
  P potential;

  [[nodiscard]] double cutoff() const noexcept { return potential.cutoff; }
  template <class Pair, class I, class J, class Sums>
  void add(const Pair& pair, const I&, const J&, Sums& sums) const noexcept {
    sums.force += potential.force_factor(pair.distance_squared) * pair.separation;
  }
  /// omega dt < limit for a particle held by contacts on all sides: omega^2 <= 2 * 6 U''/m (Gershgorin).
  void step_limits(const StepState& state, StepLimit& limit) const {
    limit.oscillate(12.0 * potential.largest_stiffness() / state.mass, state.oscillation_limit, "pair potential");
  }
};
template <class P>
void validate(const PotentialForce<P>& law) {
  check_parameters(law.potential);
}

/// What an interaction holds for a law that its user named.
template <class L>
[[nodiscard]] constexpr auto as_pair_law(const L& law) {
  if constexpr (potential::PairPotential<L>) {
    return PotentialForce<L>{law};
  } else {
    if constexpr (requires { law.force_factor(1.0); }) static_assert(potential::explain_pair_potential<L>());
    else static_assert(explain_pair_law<L>());
    return law;
  }
}

}  // namespace dmp::sweep
