#pragma once
#include <string_view>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::rheology {

/// Fluid of two Newtonian plateaus and a power law between them; half-way between the plateaus at shear_rate = 1/lambda.
///   mu = mu_inf + (mu_0 - mu_inf)/(1 + (lambda shear_rate)^m)  [Pa s]
/// Thins when sheared, or thickens if mu_inf > mu_0. Bounded by its plateaus. For m < 1 it leaves the plateau at rest with an infinite
/// slope. M. M. Cross, J. Colloid Sci. 20 (1965) 417-437, doi:10.1016/0095-8522(65)90022-X.
struct Cross {
  static constexpr std::string_view name = "cross";
  Required<double> zero_shear_viscosity;      ///< mu_0 [Pa s], > 0
  Required<double> infinite_shear_viscosity;  ///< mu_inf [Pa s], >= 0
  Required<double> time_constant;             ///< lambda [s], > 0
  Required<double> exponent;                  ///< m [-], > 0; with mu_inf = 0 the shear stress falls in fast shear for m > 1

  template <class T>
  [[nodiscard]] T apparent_viscosity(const T& shear_rate) const noexcept {
    const double thinning = zero_shear_viscosity - infinite_shear_viscosity;
    return infinite_shear_viscosity + thinning / (1.0 + pow(time_constant * shear_rate, exponent));
  }
};

inline void validate(const Cross& law) {
  require_positive("rheology::Cross: zero_shear_viscosity", law.zero_shear_viscosity, "Pa s");
  require_not_negative("rheology::Cross: infinite_shear_viscosity", law.infinite_shear_viscosity, "Pa s");
  require_positive("rheology::Cross: time_constant", law.time_constant, "s");
  require_positive("rheology::Cross: exponent", law.exponent, "[-]");
}

}  // namespace dmp::rheology
