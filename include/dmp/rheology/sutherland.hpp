#pragma once
#include <string>
#include <string_view>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>
#include <dmp/rheology/temperature_range.hpp>

namespace dmp::rheology {

/// Gas of hard spheres that attract each other weakly: it thickens when heated.
///   mu(T) = C1 T^(3/2)/(T + C2)  [Pa s]
/// Air: C1 = 1.458e-6 Pa s K^(-1/2), C2 = 110.4 K (U.S. Standard Atmosphere, 1976).
/// W. Sutherland, Phil. Mag. 36 (1893) 507-531, doi:10.1080/14786449308620508. LAMMPS extension of A. Albano et al., ChemEngineering 5
/// (2021) 30, doi:10.3390/chemengineering5020030: `viscosity SutherlandViscosityLaw C1 C2`.
struct Sutherland {
  static constexpr std::string_view name = "sutherland";
  Required<double> coefficient;             ///< C1 [Pa s K^(-1/2)], > 0
  Required<double> sutherland_temperature;  ///< C2 [K], >= 0: strength of the attraction; 0 is hard spheres
  TemperatureRange temperature_range;       ///< of the fit

  template <class T>
  [[nodiscard]] T viscosity(const T& temperature) const noexcept {
    return coefficient * temperature * sqrt(temperature) / (temperature + sutherland_temperature);
  }
  [[nodiscard]] bool admits(double temperature) const noexcept { return temperature_range.contains(temperature); }
  [[nodiscard]] std::string demand() const { return demand_of("rheology::Sutherland", temperature_range); }
};

inline void validate(const Sutherland& law) {
  require_positive("rheology::Sutherland: coefficient", law.coefficient, "Pa s K^(-1/2)");
  require_not_negative("rheology::Sutherland: sutherland_temperature", law.sutherland_temperature, "K");
  require_viscosity_over_range("rheology::Sutherland", law);
}

}  // namespace dmp::rheology
