#pragma once
#include <concepts>
#include <type_traits>

namespace dmp::potential {

/// Contract of a short-range pair potential. T is any value type.
///   force_factor(r^2)    f [N/m]: force on i = f r_ij, > 0 repels; 0 beyond the cut-off
///   energy(r^2)          U [J], 0 beyond the cut-off
///   cutoff               [m]
///   largest_stiffness()  [N/m], for the time step: U'' is at most this from the closest approach that the law is meant for out to the
///                        cut-off, over all wells and hills. Nearer, where only fast particles come, U rises inwards (a core) or ends (a
///                        hill): there the scene finds U'' itself. It may miss what is narrower than 1/64 of the cut-off
template <class P>
concept PairPotential = std::is_trivially_copyable_v<P> && requires(const P law, double x) {
  { law.force_factor(x) } -> std::same_as<double>;
  { law.energy(x) } -> std::same_as<double>;
  { law.cutoff } -> std::convertible_to<double>;
  { law.largest_stiffness() } -> std::convertible_to<double>;
};

template <class P>
consteval bool explain_pair_potential() {
  static_assert(
      requires(const P p, double x) {
        { p.force_factor(x) } -> std::same_as<double>;
      },
      "dmp: not a PairPotential: no `T force_factor(T distance_squared) const` [N/m], force on i = factor r_ij");
  static_assert(
      requires(const P p, double x) {
        { p.energy(x) } -> std::same_as<double>;
      },
      "dmp: not a PairPotential: no `T energy(T distance_squared) const` [J]");
  static_assert(
      requires(const P p) {
        { p.cutoff } -> std::convertible_to<double>;
      },
      "dmp: not a PairPotential: no `cutoff` [m]");
  static_assert(
      requires(const P p) {
        { p.largest_stiffness() } -> std::convertible_to<double>;
      },
      "dmp: not a PairPotential: no `double largest_stiffness() const` [N/m], which bounds the time step");
  return PairPotential<P>;
}

}  // namespace dmp::potential
