#pragma once
#include <concepts>
#include <type_traits>
namespace dmp::thermal {
template <class L>
concept ThermalLaw = std::is_trivially_copyable_v<L> && requires(const L law, double x) {
  { law.temperature(x) } -> std::same_as<double>;
  { law.specific_energy(x) } -> std::same_as<double>;
  { law.specific_heat() } -> std::convertible_to<double>;
};
}  // namespace dmp::thermal
