#pragma once
#include <concepts>
#include <type_traits>

namespace dmp::bond {

/// What a bond law sees. A law that states its `largest_damping` is compiled into a loop that also loads velocities, any other is not.
template <class T>
struct Stretch {
  T length;       ///< r [m], > 0
  T rest_length;  ///< r0 [m], >= 0
};
template <class T>
struct MovingStretch : Stretch<T> {
  T length_rate;  ///< dr/dt [m/s], > 0 while the bond lengthens
};

template <class B>
concept UsesVelocity = requires(const B law) {
  { law.largest_damping() } -> std::convertible_to<double>;
};

namespace detail {
template <class B>
using State = std::conditional_t<UsesVelocity<B>, MovingStretch<double>, Stretch<double>>;
}  // namespace detail

/// Contract of a bond law.
///   tension(bond)        [N], > 0 pulls the ends together; the force on i is -tension n_ij
///   energy(bond)         [J], stored (elastic) energy, of which the elastic tension is the derivative; runs do without, conformance does
///   not largest_stiffness()  [N/m], largest dT/dr, for the time step largest_damping()    [N s/m], largest dT/d(dr/dt), for the time step;
///   only of a law that uses `length_rate`
template <class B>
concept BondPotential = std::is_trivially_copyable_v<B> && requires(const B law, const detail::State<B> bond) {
  { law.tension(bond) } -> std::same_as<double>;
  { law.largest_stiffness() } -> std::convertible_to<double>;
};

template <class B>
consteval bool explain_bond_potential() {
  using State = detail::State<B>;
  static_assert(
      requires(const B b, const State s) {
        { b.tension(s) } -> std::same_as<double>;
      },
      "dmp: not a BondPotential: no `T tension(const Bond& bond) const` [N], > 0 pulls the ends together; bond has length, rest_length, "
      "length_rate");
  static_assert(
      requires(const B b) {
        { b.largest_stiffness() } -> std::convertible_to<double>;
      },
      "dmp: not a BondPotential: no `double largest_stiffness() const` [N/m], which bounds the time step");
  return BondPotential<B>;
}

}  // namespace dmp::bond
