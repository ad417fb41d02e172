#pragma once
#include <string>
#include <string_view>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::thermal {

/// Temperature of a liquid or a solid of constant specific heat.
///   T(e) = T0 + (e - e0)/c  [K],   e specific internal energy [J/kg];   T = e/c unless told otherwise
/// c is per kilogram. LAMMPS holds the energy E = m e [J] of a particle and wants m c [J/K] instead, `cv` of atom style sph and C_l of
/// the liquid below: a specific heat given there moves T by a factor m too little.
/// A. Albano et al., ChemEngineering 5 (2021) 30, doi:10.3390/chemengineering5020030, eq. 10.
struct Linear {
  static constexpr std::string_view name = "thermal::Linear";
  Required<double> specific_heat_capacity;  ///< c [J/(kg K)], > 0; c_p of a liquid or solid
  double reference_temperature = 0.0;       ///< T0 [K], >= 0
  double reference_energy = 0.0;            ///< e0 [J/kg] at T0

  template <class T>
  [[nodiscard]] T temperature(const T& specific_energy) const noexcept {
    return reference_temperature + (specific_energy - reference_energy) * (1.0 / specific_heat_capacity);
  }
  template <class T>
  [[nodiscard]] T specific_energy(const T& temperature) const noexcept {
    return reference_energy + specific_heat_capacity * (temperature - reference_temperature);
  }
  [[nodiscard]] double specific_heat() const noexcept { return specific_heat_capacity; }

  [[nodiscard]] bool admits(double specific_energy) const noexcept { return temperature(specific_energy) > 0.0; }
  [[nodiscard]] std::string demand() const {
    return std::string(name) + ": temperature must be > 0 K, that is specific_energy > " + to_text(specific_energy(0.0)) + " J/kg";
  }
};

inline void validate(const Linear& law) {
  require_positive("thermal::Linear: specific_heat_capacity", law.specific_heat_capacity, "J/(kg K)");
  require_not_negative("thermal::Linear: reference_temperature", law.reference_temperature, "K");
  require_finite("thermal::Linear: reference_energy", law.reference_energy, "J/kg");
}

}  // namespace dmp::thermal
