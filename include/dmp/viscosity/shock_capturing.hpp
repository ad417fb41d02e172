#pragma once
#include <dmp/core/field.hpp>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::viscosity {

/// Artificial viscosity with the local sound speed, for shocks: acts on approaching pairs only.
///   Pi_ij = (-alpha c_mean s* + beta s*^2)/rho_mean,  s* = h s/(r^2 + 0.01 h^2)   if s < 0, else 0   [Pa m^6/kg^2], >= 0: repels
/// s = r_ij . v_ij, means of the two particles, h = support radius (twice the smoothing length of most sources: their alpha is twice ours,
/// their beta four times). beta keeps particles from crossing in strong shocks. Keeps linear and angular momentum. Finite at r = 0, where
/// it is 0. No model of a given viscosity, see Artificial, which has one sound speed for all.
/// J. J. Monaghan, Annu. Rev. Astron. Astrophys. 30 (1992) 543-574, doi:10.1146/annurev.aa.30.090192.002551, eq. 4.2.
struct ShockCapturing {
  using reads = Fields<field::Density, field::SoundSpeed>;
  Required<double> alpha;  ///< linear term [-], >= 0
  double beta = 0.0;       ///< quadratic term [-], >= 0

  template <class Pair, class I, class J>
  [[nodiscard]] auto along_separation(const Pair& pair, const I& i, const J& j, double support_radius) const noexcept {
    const double h = support_radius;
    const auto convergence = h * min(pair.approach, 0.0) / (pair.distance_squared + 0.01 * h * h);  // s*, <= 0 [m/s]
    return convergence * (2.0 * beta * convergence - alpha * (i.sound_speed + j.sound_speed)) / (i.density + j.density);
  }
  /// What damping_rate takes for nu [m^2/s]: (h/2)(alpha c + beta |s*|), with |s*| = 4 u for two particles that meet at speed u each, half
  /// a support apart.
  [[nodiscard]] double kinematic_viscosity(double sound_speed, double speed, double support_radius) const noexcept {
    return 0.5 * support_radius * (alpha * sound_speed + 4.0 * beta * speed);
  }
  /// lambda = 2 nu (integral of |F|)/d [1/s], reached when every pair approaches.
  [[nodiscard]] double damping_rate(double nu, double, double radial_factor_integral, int dimension) const noexcept {
    return 2.0 * nu * radial_factor_integral / dimension;
  }
};

inline void validate(const ShockCapturing& law) {
  require_not_negative("viscosity::ShockCapturing: alpha", law.alpha, "-");
  require_not_negative("viscosity::ShockCapturing: beta", law.beta, "-");
}

}  // namespace dmp::viscosity
