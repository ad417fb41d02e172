#pragma once
#include <string>
#include <string_view>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::thermal {

/// Temperature of an ideal gas, of the energy that `eos::IdealGas` has.
///   T(e) = M (gamma - 1) e/R  [K],   e specific internal energy [J/kg],   c_v = R/(M (gamma - 1))  [J/(kg K)]
/// A. Albano et al., ChemEngineering 5 (2021) 30, doi:10.3390/chemengineering5020030, eq. 11, there with M in kg/kmol.
struct Gas {
  static constexpr std::string_view name = "thermal::Gas";
  static constexpr double gas_constant = 8.31446261815324;  ///< R [J/(mol K)], exact in the SI of 2019
  Required<double> molar_mass;                              ///< M [kg/mol], > 0; 0.018 is water, 0.029 is air
  double heat_capacity_ratio = 1.4;                         ///< gamma = c_p/c_v [-], > 1; that of the equation of state

  template <class T>
  [[nodiscard]] T temperature(const T& specific_energy) const noexcept {
    return (1.0 / specific_heat()) * specific_energy;
  }
  template <class T>
  [[nodiscard]] T specific_energy(const T& temperature) const noexcept {
    return specific_heat() * temperature;
  }
  [[nodiscard]] double specific_heat() const noexcept { return gas_constant / (molar_mass * (heat_capacity_ratio - 1.0)); }

  [[nodiscard]] bool admits(double specific_energy) const noexcept { return temperature(specific_energy) > 0.0; }
  [[nodiscard]] std::string demand() const { return std::string(name) + ": temperature must be > 0 K, that is specific_energy > 0 J/kg"; }
};

inline void validate(const Gas& law) {
  require(law.molar_mass > 0.0 && law.molar_mass < 1.0, "thermal::Gas: molar_mass must be > 0 and < 1 kg/mol (not g/mol or kg/kmol)",
          law.molar_mass);
  require(law.heat_capacity_ratio > 1.0 && law.heat_capacity_ratio < 1e3, "thermal::Gas: heat_capacity_ratio must be > 1 and < 1000",
          law.heat_capacity_ratio);
}

}  // namespace dmp::thermal
