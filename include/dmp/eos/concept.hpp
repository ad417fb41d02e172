#pragma once
#include <concepts>
#include <type_traits>

namespace dmp::eos {

/// Contract of an equation of state p(rho). T is any value type.
///   pressure(rho)     p [Pa]
///   sound_speed(rho)  c = sqrt(dp/drho) [m/s]
///   density(p)        the inverse [kg/m^3]
///   rest_density      rho0 [kg/m^3], where a scene starts unless told otherwise
template <class E>
concept EquationOfState = std::is_trivially_copyable_v<E> && requires(const E eos, double x) {
  { eos.rest_density } -> std::convertible_to<double>;
  { eos.pressure(x) } -> std::same_as<double>;
  { eos.sound_speed(x) } -> std::same_as<double>;
  { eos.density(x) } -> std::same_as<double>;
};

/// Contract of an equation of state p(rho, e) with e the specific internal energy [J/kg].
///   pressure(rho, e) [Pa], sound_speed(rho, e) [m/s], specific_energy(p, rho) [J/kg], its inverse
/// Optional, what errors speak of:
///   admits(rho, e)  whether such a state exists, with a positive temperature and a real sound speed
///   demand()        the rule that `admits` checks, in words
template <class E>
concept ThermalEquationOfState = std::is_trivially_copyable_v<E> && requires(const E eos, double x) {
  { eos.pressure(x, x) } -> std::same_as<double>;
  { eos.sound_speed(x, x) } -> std::same_as<double>;
  { eos.specific_energy(x, x) } -> std::same_as<double>;
};

template <class E>
consteval bool explain_equation_of_state() {
  if constexpr (!ThermalEquationOfState<E>) {
    static_assert(
        requires(const E e, double rho) {
          { e.pressure(rho) } -> std::same_as<double>;
        },
        "dmp: not an EquationOfState: no `T pressure(T density) const` [Pa] (nor `pressure(density, specific_energy)`)");
    static_assert(
        requires(const E e, double rho) {
          { e.sound_speed(rho) } -> std::same_as<double>;
        },
        "dmp: not an EquationOfState: no `T sound_speed(T density) const` [m/s]");
    static_assert(
        requires(const E e, double p) {
          { e.density(p) } -> std::same_as<double>;
        },
        "dmp: not an EquationOfState: no `T density(T pressure) const` [kg/m^3], the inverse of pressure");
    static_assert(
        requires(const E e) {
          { e.rest_density } -> std::convertible_to<double>;
        },
        "dmp: not an EquationOfState: no `rest_density` [kg/m^3]");
  }
  return EquationOfState<E> || ThermalEquationOfState<E>;
}

}  // namespace dmp::eos
