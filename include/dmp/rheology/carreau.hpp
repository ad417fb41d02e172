#pragma once
#include <string_view>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::rheology {

/// Fluid of two Newtonian plateaus and a power law between them, smooth at rest.
///   mu = mu_inf + (mu_0 - mu_inf) [1 + (lambda shear_rate)^2]^((n-1)/2)  [Pa s]
/// Thins when sheared, or thickens if mu_inf > mu_0. Bounded by its plateaus because n <= 1.
/// P. J. Carreau, Trans. Soc. Rheol. 16 (1972) 99-127, doi:10.1122/1.549276.
struct Carreau {
  static constexpr std::string_view name = "carreau";
  Required<double> zero_shear_viscosity;      ///< mu_0 [Pa s], > 0
  Required<double> infinite_shear_viscosity;  ///< mu_inf [Pa s], >= 0
  Required<double> time_constant;             ///< lambda [s], > 0
  Required<double> power_law_index;           ///< n [-], > 0 and <= 1; 1 is Newton's fluid of mu_0

  template <class T>
  [[nodiscard]] T apparent_viscosity(const T& shear_rate) const noexcept {
    const double thinning = zero_shear_viscosity - infinite_shear_viscosity;
    return infinite_shear_viscosity + thinning * pow(1.0 + square(time_constant * shear_rate), 0.5 * (power_law_index - 1.0));
  }
};

inline void validate(const Carreau& law) {
  require_positive("rheology::Carreau: zero_shear_viscosity", law.zero_shear_viscosity, "Pa s");
  require_not_negative("rheology::Carreau: infinite_shear_viscosity", law.infinite_shear_viscosity, "Pa s");
  require_positive("rheology::Carreau: time_constant", law.time_constant, "s");
  require(law.power_law_index > 0.0 && law.power_law_index <= 1.0, "rheology::Carreau: power_law_index must be > 0 and <= 1",
          law.power_law_index);
}

}  // namespace dmp::rheology
