#pragma once
#include <concepts>
#include <type_traits>

namespace dmp::thermal {

/// Contract of a thermal law, the temperature of a material by its specific internal energy e. T is any value type.
///   temperature(e)      [K], rises with e
///   specific_energy(T)  [J/kg], the inverse
///   specific_heat()     [J/(kg K)], > 0: the least de/dT, so that 1/c is the largest response of the temperature: bounds the time step
/// Optional, what errors speak of:
///   admits(e)           whether such a state exists: T > 0
///   demand()            the rule that `admits` checks, in words
template <class L>
concept ThermalLaw = std::is_trivially_copyable_v<L> && requires(const L law, double x) {
  { law.temperature(x) } -> std::same_as<double>;
  { law.specific_energy(x) } -> std::same_as<double>;
  { law.specific_heat() } -> std::same_as<double>;
};

template <class L>
consteval bool explain_thermal_law() {
  static_assert(
      requires(const L law, double e) {
        { law.temperature(e) } -> std::same_as<double>;
      },
      "dmp: not a ThermalLaw: no `T temperature(T specific_energy) const` [K]");
  static_assert(
      requires(const L law, double temperature) {
        { law.specific_energy(temperature) } -> std::same_as<double>;
      },
      "dmp: not a ThermalLaw: no `T specific_energy(T temperature) const` [J/kg], the inverse of temperature");
  static_assert(
      requires(const L law) {
        { law.specific_heat() } -> std::same_as<double>;
      },
      "dmp: not a ThermalLaw: no `double specific_heat() const` [J/(kg K)], the least de/dT, which bounds the time step");
  return ThermalLaw<L>;
}

}  // namespace dmp::thermal
