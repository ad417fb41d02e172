#pragma once
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::eos {

/// Linear equation of state: a liquid of constant sound speed, and the tangent of Tait's at rho0.
///   p(rho) = c0^2 (rho - rho0) + p_b  [Pa],   c = c0  [m/s]
/// Compression gives p > p_b. Cheaper than Tait (no powers) and as good while |rho/rho0 - 1| stays below about 1 %.
/// J. P. Morris, P. J. Fox, Y. Zhu, J. Comput. Phys. 136 (1997) 214-226, doi:10.1006/jcph.1997.5776 (there p = c^2 rho).
struct Linear {
  Required<double> rest_density;     ///< rho0 [kg/m^3], > 0
  Required<double> sound_speed_0;    ///< c0 [m/s], > 0; about 10 times the largest flow speed
  double background_pressure = 0.0;  ///< p_b [Pa]

  template <class T>
  [[nodiscard]] T pressure(const T& density) const noexcept {
    return (sound_speed_0 * sound_speed_0) * (density - rest_density) + background_pressure;
  }
  template <class T>
  [[nodiscard]] T sound_speed(const T&) const noexcept {
    return T(static_cast<double>(sound_speed_0));
  }
  template <class T>
  [[nodiscard]] T density(const T& pressure) const noexcept {
    return rest_density + (pressure - background_pressure) * (1.0 / (sound_speed_0 * sound_speed_0));
  }
};

inline void validate(const Linear& eos) {
  require_positive("eos::Linear: rest_density", eos.rest_density, "kg/m^3");
  require_positive("eos::Linear: sound_speed_0", eos.sound_speed_0, "m/s");
  require_finite("eos::Linear: background_pressure", eos.background_pressure, "Pa");
}

}  // namespace dmp::eos
