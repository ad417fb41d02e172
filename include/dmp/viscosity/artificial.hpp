#pragma once
#include <dmp/core/field.hpp>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::viscosity {

/// Artificial viscosity for shocks and for stability: acts on approaching pairs only.
///   Pi_ij = -alpha h c s/(rho_mean (r^2 + 0.01 h^2))  if s < 0, else 0   [Pa m^6/kg^2], >= 0: repels
/// s = r_ij . v_ij, rho_mean = (rho_i + rho_j)/2, h = support radius (twice the smoothing length of most sources: their alpha is
/// twice ours). Keeps linear and angular momentum. Finite at r = 0, where it is 0.
/// No model of a given viscosity: acting on all pairs it would be nu = alpha h c/(2 (d + 2)); in shear only half the pairs approach,
/// so it gives about half of that, and a normal stress besides. For a given mu: Morris, or Monaghan.
/// J. J. Monaghan, Annu. Rev. Astron. Astrophys. 30 (1992) 543-574, doi:10.1146/annurev.aa.30.090192.002551 (there with a beta term).
struct Artificial {
  using reads = Fields<field::Density>;
  Required<double> alpha;        ///< strength [-], >= 0; 0.005 to 0.05 in free-surface flow, about 0.5 in shocks
  Required<double> sound_speed;  ///< c [m/s], > 0: that of the equation of state

  template <class Pair, class I, class J>
  [[nodiscard]] auto along_separation(const Pair& pair, const I& i, const J& j, double support_radius) const noexcept {
    const double h = support_radius;
    return (-2.0 * alpha * h * sound_speed) * min(pair.approach, 0.0) / ((i.density + j.density) * (pair.distance_squared + 0.01 * h * h));
  }
  /// lambda = alpha h c (integral of |F|)/d [1/s], reached when every pair approaches: 2 nu (integral of |F|) times (d + 2)/d.
  [[nodiscard]] double damping_rate(double, double support_radius, double radial_factor_integral, int dimension) const noexcept {
    return alpha * support_radius * sound_speed * radial_factor_integral / dimension;
  }
};

inline void validate(const Artificial& law) {
  require_not_negative("viscosity::Artificial: alpha", law.alpha, "[-]");
  require_positive("viscosity::Artificial: sound_speed", law.sound_speed, "m/s");
}

}  // namespace dmp::viscosity
