#pragma once
#include <string>
#include <string_view>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::rheology {

/// Ostwald-de Waele fluid: thins (n < 1) or thickens (n > 1) when sheared.
///   mu = K g^(n-1)  [Pa s],   g = sqrt(shear_rate^2 + g_min^2),   held in [mu_min, mu_max]
/// The bare law is infinite (n < 1) or 0 (n > 1) at rest, and the reverse in fast shear. Its three limits are part of the model and have
/// no defaults: g_min well below the shear rates of interest, mu_min and mu_max well outside of their viscosities. mu_max bounds the
/// time step. W. Ostwald, Kolloid-Z. 36 (1925) 99-117; the limits are ours.
struct PowerLaw {
  static constexpr std::string_view name = "power law";
  Required<double> consistency_index;  ///< K [Pa s^n], > 0
  Required<double> power_law_index;    ///< n [-], > 0; 1 is Newton's fluid
  Required<double> lowest_shear_rate;  ///< g_min [1/s], > 0
  Required<double> lowest_viscosity;   ///< mu_min [Pa s], >= 0
  Required<double> highest_viscosity;  ///< mu_max [Pa s], > 0 and >= mu_min

  template <class T>
  [[nodiscard]] T apparent_viscosity(const T& shear_rate) const noexcept {
    const double low = lowest_viscosity, high = highest_viscosity;
    const T g_squared = square(shear_rate) + square<double>(lowest_shear_rate);
    return min(max(consistency_index * pow(g_squared, 0.5 * (power_law_index - 1.0)), low), high);
  }
};

inline void validate(const PowerLaw& law) {
  require_positive("rheology::PowerLaw: consistency_index", law.consistency_index, "Pa s^n");
  require_positive("rheology::PowerLaw: power_law_index", law.power_law_index, "[-]");
  require_positive("rheology::PowerLaw: lowest_shear_rate", law.lowest_shear_rate, "1/s");
  require_not_negative("rheology::PowerLaw: lowest_viscosity", law.lowest_viscosity, "Pa s");
  require_positive("rheology::PowerLaw: highest_viscosity", law.highest_viscosity, "Pa s");
  require(law.highest_viscosity >= law.lowest_viscosity,
          ("rheology::PowerLaw: highest_viscosity must be >= lowest_viscosity = " + to_text(law.lowest_viscosity) + " Pa s").c_str(),
          law.highest_viscosity);
}

}  // namespace dmp::rheology
