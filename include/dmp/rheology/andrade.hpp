#pragma once
#include <string>
#include <string_view>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>
#include <dmp/rheology/temperature_range.hpp>

namespace dmp::rheology {

/// Liquid, fit with four parameters.
///   mu(T) = A exp(B/T + C T + D T^2)  [Pa s]
/// C and D have any sign, so that nothing bounds mu outside of the range: with D > 0 it grows beyond all limits when heated.
/// Two parameters: E. N. da C. Andrade, Nature 125 (1930) 309-310, doi:10.1038/125309b0. Four: LAMMPS extension of A. Albano et al.,
/// ChemEngineering 5 (2021) 30, doi:10.3390/chemengineering5020030: `viscosity FourParameterExp A B C D`.
struct Andrade {
  static constexpr std::string_view name = "andrade";
  Required<double> pre_exponential_factor;  ///< A [Pa s], > 0
  Required<double> inverse_coefficient;     ///< B [K]
  Required<double> linear_coefficient;      ///< C [1/K]
  Required<double> quadratic_coefficient;   ///< D [1/K^2]
  TemperatureRange temperature_range;       ///< of the fit

  template <class T>
  [[nodiscard]] T viscosity(const T& temperature) const noexcept {
    const double b = inverse_coefficient, c = linear_coefficient, d = quadratic_coefficient;
    return pre_exponential_factor * exp(b / temperature + (c + d * temperature) * temperature);
  }
  [[nodiscard]] bool admits(double temperature) const noexcept { return temperature_range.contains(temperature); }
  [[nodiscard]] std::string demand() const { return demand_of("rheology::Andrade", temperature_range); }
};

inline void validate(const Andrade& law) {
  require_positive("rheology::Andrade: pre_exponential_factor", law.pre_exponential_factor, "Pa s");
  require_finite("rheology::Andrade: inverse_coefficient", law.inverse_coefficient, "K");
  require_finite("rheology::Andrade: linear_coefficient", law.linear_coefficient, "1/K");
  require_finite("rheology::Andrade: quadratic_coefficient", law.quadratic_coefficient, "1/K^2");
  require_viscosity_over_range("rheology::Andrade", law);
}

}  // namespace dmp::rheology
