#pragma once
#include <string>
#include <string_view>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>
#include <dmp/rheology/temperature_range.hpp>

namespace dmp::rheology {

/// Gas whose molecules repel each other as a power of the distance: it thickens when heated.
///   mu(T) = B T^n  [Pa s]
/// n = 1/2 is hard spheres, n = 1 Maxwell molecules. Air at 300 K: B = 4.093e-7 Pa s K^(-2/3), n = 2/3. This is no law of the shear
/// rate; see PowerLaw. LAMMPS extension of A. Albano et al., ChemEngineering 5 (2021) 30, doi:10.3390/chemengineering5020030:
/// `viscosity PowerLawGas B`, which never reads n.
struct PowerLawGas {
  static constexpr std::string_view name = "power-law gas";
  Required<double> coefficient;        ///< B [Pa s K^(-n)], > 0
  Required<double> exponent;           ///< n [-], > 0
  TemperatureRange temperature_range;  ///< of the fit

  template <class T>
  [[nodiscard]] T viscosity(const T& temperature) const noexcept {
    return coefficient * pow(temperature, exponent);
  }
  [[nodiscard]] bool admits(double temperature) const noexcept { return temperature_range.contains(temperature); }
  [[nodiscard]] std::string demand() const { return demand_of("rheology::PowerLawGas", temperature_range); }
};

inline void validate(const PowerLawGas& law) {
  require_positive("rheology::PowerLawGas: coefficient", law.coefficient, "Pa s K^(-n)");
  require_positive("rheology::PowerLawGas: exponent", law.exponent, "[-]");
  require_viscosity_over_range("rheology::PowerLawGas", law);
}

}  // namespace dmp::rheology
