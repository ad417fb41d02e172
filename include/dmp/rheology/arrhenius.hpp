#pragma once
#include <string>
#include <string_view>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>
#include <dmp/rheology/temperature_range.hpp>

namespace dmp::rheology {

/// Liquid that flows by thermal activation: it thins when heated.
///   mu(T) = C1 exp(C2/T)  [Pa s]
/// Far below the range mu explodes: with C2 = 1880 K it is a million times that of 295 K at 93 K, and infinite at 2.6 K.
/// E. N. da C. Andrade, Nature 125 (1930) 309-310, doi:10.1038/125309b0. LAMMPS extension of A. Albano et al., ChemEngineering 5 (2021)
/// 30, doi:10.3390/chemengineering5020030: `viscosity Arrhenius C1 C2`; its C1 = 1.83e-4 is 100 times that of water.
struct Arrhenius {
  static constexpr std::string_view name = "arrhenius";
  Required<double> pre_exponential_factor;  ///< C1 [Pa s], > 0: the limit at infinite temperature
  Required<double> activation_temperature;  ///< C2 = E/R [K], >= 0
  TemperatureRange temperature_range;       ///< of the fit

  template <class T>
  [[nodiscard]] T viscosity(const T& temperature) const noexcept {
    return pre_exponential_factor * exp(activation_temperature / temperature);
  }
  [[nodiscard]] bool admits(double temperature) const noexcept { return temperature_range.contains(temperature); }
  [[nodiscard]] std::string demand() const { return demand_of("rheology::Arrhenius", temperature_range); }
};

inline void validate(const Arrhenius& law) {
  require_positive("rheology::Arrhenius: pre_exponential_factor", law.pre_exponential_factor, "Pa s");
  require_not_negative("rheology::Arrhenius: activation_temperature", law.activation_temperature, "K");
  require_viscosity_over_range("rheology::Arrhenius", law);
}

}  // namespace dmp::rheology
