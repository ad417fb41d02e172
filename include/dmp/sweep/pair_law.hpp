#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
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

namespace detail {

/// Where holds(r), true near 0, ends for the first time between 0 and `most` [m]; it may hold again farther out. What ends and begins again
/// within most/64 is not seen.
template <class Holds>
[[nodiscard]] double first_end(double most, const Holds& holds) {
  const double part = most / 64.0;
  double least = 0.0;
  while (least + part < most && holds(least + part)) least += part;
  most = std::min(most, least + part);
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (least + most);
    (holds(middle) ? least : most) = middle;
  }
  return least;
}

}  // namespace detail

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
  /// Stable: omega dt < limit for a particle held by contacts on all sides, omega^2 <= 2 * 6 U''/m (Gershgorin). Resolved:
  /// collision_step.
  void step_limits(const StepState& a, const StepState& b, StepLimit& limit) const {
    limit.oscillate(12.0 * potential.largest_stiffness() / std::min(a.mass, b.mass), a.oscillation_limit, "pair potential");
    const double reduced_mass = 1.0 / (1.0 / a.mass + 1.0 / b.mass);
    if (reduced_mass < std::numeric_limits<double>::infinity() && potential.largest_stiffness() > 0.0)
      limit.resolve(collision_step(reduced_mass, a.speed + b.speed, a.acceleration + b.acceleration), "collisions of a pair potential");
  }

  /// The step [s] that resolves the worst collision of two particles of this reduced mass [kg], relative speed [m/s] and acceleration
  /// [m/s^2]: omega dt <= 1 where they turn back, omega^2 = U''/mass, which keeps the speed of a head-on collision to 1 %, of what it is at
  /// most if they attract each other first; and, should the potential not turn them back, a quarter of the cut-off. They are taken to turn
  /// back where U first falls below their energy, counted from the inside: at the core. Wells, hills and shoulders farther out are resolved
  /// since stability asks for more, as long as largest_stiffness bounds U'' there. Their energy is m v^2/2 + U where the force is m a, so
  /// that the step stays about the same throughout the collision of two alone; it is chosen anew in every step, since others accelerate
  /// them too. Particles squeezed from all sides have no acceleration: that is what largest_stiffness is stated for.
  [[nodiscard]] double collision_step(double mass, double speed, double acceleration) const {
    const auto force = [this](double r) { return r * potential.force_factor(r * r); };
    const auto energy = [this](double r) { return potential.energy(r * r); };
    const double now = detail::first_end(cutoff(), [&](double r) { return !(force(r) < mass * acceleration); });
    const double available = 0.5 * mass * speed * speed + std::max(0.0, energy(now));
    const double closest = detail::first_end(cutoff(), [&](double r) { return !(energy(r) < available); });
    const double crossing = 0.25 * cutoff() / speed, nearby = 0.999 * closest;
    const double stiffness = (force(nearby) - force(closest)) / (closest - nearby);
    return stiffness > 0.0 ? std::min(crossing, std::sqrt(mass / stiffness)) : crossing;
  }
};
template <class L>
inline constexpr bool is_potential = false;
template <class P>
inline constexpr bool is_potential<PotentialForce<P>> = true;
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
