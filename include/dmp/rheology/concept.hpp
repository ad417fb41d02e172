#pragma once
#include <concepts>
#include <string>
#include <type_traits>

namespace dmp::rheology {

/// Contract of a law of the dynamic viscosity over the temperature. T is any value type.
///   viscosity(temperature)  mu [Pa s], > 0; temperature [K]
template <class L>
concept ViscosityOfTemperature = std::is_trivially_copyable_v<L> && requires(const L law, double temperature) {
  { law.viscosity(temperature) } -> std::same_as<double>;
};

/// A law that says where it holds. Those of the library do; a user's law may do without, and then holds everywhere.
///   admits(temperature)  whether it holds there [K]; false for NaN
///   demand()             what it asks for, as a text: "rheology::Arrhenius: temperature must be in [273, 373] K"
template <class L>
concept LimitsTemperature = requires(const L law, double temperature) {
  { law.admits(temperature) } -> std::same_as<bool>;
  { law.demand() } -> std::convertible_to<std::string>;
};

/// Contract of a law of the apparent viscosity over the shear rate sqrt(2 D:D), D = (grad v + grad v^T)/2.
///   apparent_viscosity(shear_rate)  mu [Pa s], >= 0, finite for every shear rate >= 0 [1/s]
template <class L>
concept ViscosityOfShearRate = std::is_trivially_copyable_v<L> && requires(const L law, double shear_rate) {
  { law.apparent_viscosity(shear_rate) } -> std::same_as<double>;
};

}  // namespace dmp::rheology
