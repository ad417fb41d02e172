#pragma once
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::eos {

/// Tait's equation of state of a nearly incompressible liquid.
///   p(rho) = B [(rho/rho0)^gamma - 1] + p_b  [Pa],   B = c0^2 rho0/gamma
///   c(rho) = c0 (rho/rho0)^((gamma-1)/2)     [m/s]
/// Compression gives p > p_b. J. J. Monaghan, J. Comput. Phys. 110 (1994) 399-406, doi:10.1006/jcph.1994.1034, eq. 3.1.
struct Tait {
  Required<double> rest_density;     ///< rho0 [kg/m^3], > 0
  Required<double> sound_speed_0;    ///< c0 [m/s] at rho0, > 0; about 10 times the largest flow speed
  double exponent = 7.0;             ///< gamma [-], >= 1; 7 is water
  double background_pressure = 0.0;  ///< p_b [Pa]

  template <class T>
  [[nodiscard]] T pressure(const T& density) const noexcept {
    return stiffness() * (power(density * (1.0 / rest_density), exponent) - 1.0) + background_pressure;
  }
  template <class T>
  [[nodiscard]] T sound_speed(const T& density) const noexcept {
    return sound_speed_0 * power(density * (1.0 / rest_density), (exponent - 1.0) / 2.0);
  }
  template <class T>
  [[nodiscard]] T density(const T& pressure) const noexcept {
    return rest_density * pow((pressure - background_pressure) * (1.0 / stiffness()) + 1.0, 1.0 / exponent);
  }
  [[nodiscard]] double stiffness() const noexcept { return sound_speed_0 * sound_speed_0 * rest_density / exponent; }  ///< B [Pa]
};

inline void validate(const Tait& eos) {
  require_positive("eos::Tait: rest_density", eos.rest_density, "kg/m^3");
  require_positive("eos::Tait: sound_speed_0", eos.sound_speed_0, "m/s");
  require(eos.exponent >= 1.0 && eos.exponent < 1e3, "eos::Tait: exponent must be >= 1 and < 1000", eos.exponent);
  require_finite("eos::Tait: background_pressure", eos.background_pressure, "Pa");
}

}  // namespace dmp::eos
