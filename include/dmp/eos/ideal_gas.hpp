#pragma once
#include <string>
#include <string_view>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>

namespace dmp::eos {

/// Ideal gas, pressure from density and specific internal energy e [J/kg].
///   p(rho, e) = (gamma - 1) rho e        [Pa]
///   c(e)      = sqrt(gamma (gamma - 1) e)  [m/s], for e >= 0
///   e(p, rho) = p/((gamma - 1) rho)      [J/kg]
/// LAMMPS `sph/idealgas` codes c = sqrt((gamma - 1) e), 15.5 % too low for gamma = 1.4.
/// J. J. Monaghan, Rep. Prog. Phys. 68 (2005) 1703-1759, doi:10.1088/0034-4885/68/8/R01.
struct IdealGas {
  static constexpr std::string_view name = "eos::IdealGas";
  double heat_capacity_ratio = 1.4;  ///< gamma = c_p/c_v [-], > 1; 1.4 is air and any diatomic gas at room temperature

  template <class T>
  [[nodiscard]] T pressure(const T& density, const T& specific_energy) const noexcept {
    return (heat_capacity_ratio - 1.0) * density * specific_energy;
  }
  template <class T>
  [[nodiscard]] T sound_speed(const T&, const T& specific_energy) const noexcept {
    return sqrt(heat_capacity_ratio * (heat_capacity_ratio - 1.0) * specific_energy);
  }
  template <class T>
  [[nodiscard]] T specific_energy(const T& pressure, const T& density) const noexcept {
    return (1.0 / (heat_capacity_ratio - 1.0)) * pressure / density;
  }

  [[nodiscard]] bool admits(double density, double specific_energy) const noexcept { return density > 0.0 && specific_energy > 0.0; }
  [[nodiscard]] std::string demand() const { return std::string(name) + ": specific_energy must be > 0 J/kg and density > 0 kg/m^3"; }
};

inline void validate(const IdealGas& eos) {
  require(eos.heat_capacity_ratio > 1.0 && eos.heat_capacity_ratio < 1e3, "eos::IdealGas: heat_capacity_ratio must be > 1 and < 1000",
          eos.heat_capacity_ratio);
}

}  // namespace dmp::eos
