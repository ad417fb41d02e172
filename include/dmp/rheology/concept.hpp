#pragma once
#include <concepts>
#include <type_traits>
namespace dmp::rheology {
template <class L>
concept ViscosityOfTemperature = std::is_trivially_copyable_v<L> && requires(const L law, double temperature) {
  { law.viscosity(temperature) } -> std::same_as<double>;
};
template <class L>
concept ViscosityOfShearRate = std::is_trivially_copyable_v<L> && requires(const L law, double shear_rate) {
  { law.apparent_viscosity(shear_rate) } -> std::same_as<double>;
};
}  // namespace dmp::rheology
