#pragma once
#include <concepts>
#include <type_traits>

namespace dmp::rheology {

/// Contract of a law of the dynamic viscosity over the temperature. T is any value type.
///   viscosity(temperature)  mu [Pa s], > 0; temperature [K]
///   admits(temperature), demand()  only of a law with a limited range, as all of the library: whether it holds there, false for NaN; and
///                           what it asks for, "rheology::Arrhenius: temperature must be in [273, 373] K"
template <class L>
concept ViscosityOfTemperature = std::is_trivially_copyable_v<L> && requires(const L law, double temperature) {
  { law.viscosity(temperature) } -> std::same_as<double>;
};

/// Contract of a law of the apparent viscosity over the shear rate sqrt(2 D:D), D = (grad v + grad v^T)/2.
///   apparent_viscosity(shear_rate)  mu [Pa s], >= 0, finite for every shear rate >= 0 [1/s]
template <class L>
concept ViscosityOfShearRate = std::is_trivially_copyable_v<L> && requires(const L law, double shear_rate) {
  { law.apparent_viscosity(shear_rate) } -> std::same_as<double>;
};

}  // namespace dmp::rheology
