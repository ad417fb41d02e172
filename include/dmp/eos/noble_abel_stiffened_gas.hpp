#pragma once
#include <limits>
#include <string>
#include <string_view>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::eos {

/// Noble-Abel stiffened gas: liquid or vapour whose pressure and temperature follow from density and specific internal energy e.
///   theta(rho, e) = e - q - p_inf (1/rho - b)                     [J/kg]; theta > 0 means T > 0, p > -p_inf and c^2 > 0 alike
///   p(rho, e)     = (gamma - 1) theta/(1/rho - b) - p_inf         [Pa], not below the cut-off
///   T(rho, e)     = theta/c_v                                     [K]
///   c(rho, e)     = sqrt(gamma (gamma - 1) theta)/(1 - b rho)     [m/s], as if there were no cut-off
///   e(p, rho)     = q + (p + gamma p_inf)(1/rho - b)/(gamma - 1)  [J/kg], often < 0 where q < 0
///   rho(p, T)     = 1/[b + (gamma - 1) c_v T/(p + p_inf)]         [kg/m^3]
/// A liquid needs double precision: p is what p_inf leaves of p + p_inf, which for water in single precision goes in steps of 64 Pa.
/// O. Le Metayer, R. Saurel, Phys. Fluids 28 (2016) 046102, doi:10.1063/1.4945981. In SPH: A. Albano et al., ChemEngineering 5
/// (2021) 30, doi:10.3390/chemengineering5020030, eq. 7 and 8; its code takes one constant c, and computes no T.
struct NobleAbelStiffenedGas {
  static constexpr std::string_view name = "eos::NobleAbelStiffenedGas";
  Required<double> heat_capacity_ratio;                              ///< gamma [-], > 1
  Required<double> stiffening_pressure;                              ///< p_inf [Pa], >= 0; 0 in a vapour
  Required<double> covolume;                                         ///< b [m^3/kg], >= 0: the density stays below 1/b
  Required<double> heat_of_formation;                                ///< q [J/kg], what e is counted from; may be < 0
  Required<double> specific_heat_capacity;                           ///< c_v [J/(kg K)], > 0
  double least_pressure = -std::numeric_limits<double>::infinity();  ///< tension cut-off [Pa], e.g. 0: p is at least that; default: none

  template <class T>
  [[nodiscard]] T theta(const T& density, const T& specific_energy) const noexcept {
    return specific_energy - heat_of_formation - stiffening_pressure * (1.0 / density - covolume);
  }
  template <class T>
  [[nodiscard]] T pressure(const T& density, const T& specific_energy) const noexcept {
    const T thermal = (heat_capacity_ratio - 1.0) * theta(density, specific_energy) / (1.0 / density - covolume);
    return max(thermal - stiffening_pressure, least_pressure);
  }
  template <class T>
  [[nodiscard]] T temperature(const T& density, const T& specific_energy) const noexcept {
    return theta(density, specific_energy) * (1.0 / specific_heat_capacity);
  }
  template <class T>
  [[nodiscard]] T sound_speed(const T& density, const T& specific_energy) const noexcept {
    return sqrt(heat_capacity_ratio * (heat_capacity_ratio - 1.0) * theta(density, specific_energy)) / (1.0 - covolume * density);
  }
  template <class T>
  [[nodiscard]] T specific_energy(const T& pressure, const T& density) const noexcept {
    return heat_of_formation +
           (1.0 / (heat_capacity_ratio - 1.0)) * (pressure + heat_capacity_ratio * stiffening_pressure) * (1.0 / density - covolume);
  }
  /// The density [kg/m^3] at a pressure [Pa] and a temperature [K].
  template <class T>
  [[nodiscard]] T density_at(const T& pressure, const T& temperature) const noexcept {
    return 1.0 / (covolume + (heat_capacity_ratio - 1.0) * specific_heat_capacity * temperature / (pressure + stiffening_pressure));
  }
  [[nodiscard]] double specific_heat() const noexcept { return specific_heat_capacity; }  ///< de/dT at constant density [J/(kg K)]

  [[nodiscard]] bool admits(double density, double specific_energy) const noexcept {
    return density > 0.0 && covolume * density < 1.0 - 1e-6 && theta(density, specific_energy) > 0.0;
  }
  [[nodiscard]] std::string demand() const {
    return std::string(name) +
           ": theta = e - q - p_inf (1/rho - b) must be > 0 and b rho < 1 - 1e-6, with q = " + to_text(heat_of_formation) +
           " J/kg, p_inf = " + to_text(stiffening_pressure) + " Pa, b = " + to_text(covolume) + " m^3/kg";
  }
};

inline void validate(const NobleAbelStiffenedGas& eos) {
  require(eos.heat_capacity_ratio > 1.0 && eos.heat_capacity_ratio < 1e3,
          "eos::NobleAbelStiffenedGas: heat_capacity_ratio must be > 1 and < 1000", eos.heat_capacity_ratio);
  require_not_negative("eos::NobleAbelStiffenedGas: stiffening_pressure", eos.stiffening_pressure, "Pa");
  require_not_negative("eos::NobleAbelStiffenedGas: covolume", eos.covolume, "m^3/kg");
  require_finite("eos::NobleAbelStiffenedGas: heat_of_formation", eos.heat_of_formation, "J/kg");
  require_positive("eos::NobleAbelStiffenedGas: specific_heat_capacity", eos.specific_heat_capacity, "J/(kg K)");
  require(eos.least_pressure < std::numeric_limits<double>::infinity(),
          "eos::NobleAbelStiffenedGas: least_pressure must be finite, or -infinity for none [Pa]", eos.least_pressure);
}

/// Water and its vapour by Le Metayer & Saurel 2016, whose c_p of the liquid, 4285 J/(kg K), makes gamma 1.187; they round it to 1.19.
/// At 1 atm the liquid is 5 % too dense at 300 K and 2 % at 373 K, where the latent heat comes out 4 % low.
inline constexpr NobleAbelStiffenedGas liquid_water{.heat_capacity_ratio = 1.19,
                                                    .stiffening_pressure = 7.028e8,
                                                    .covolume = 6.61e-4,
                                                    .heat_of_formation = -1177788.0,
                                                    .specific_heat_capacity = 3610.0};
inline constexpr NobleAbelStiffenedGas water_vapour{.heat_capacity_ratio = 1.47,
                                                    .stiffening_pressure = 0.0,
                                                    .covolume = 0.0,
                                                    .heat_of_formation = 2077616.0,
                                                    .specific_heat_capacity = 955.0};

}  // namespace dmp::eos
