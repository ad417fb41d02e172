#pragma once
#include <dmp/core/field.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::diffusion {

/// Density diffusion of delta-SPH: smooths the pressure noise of weakly compressible SPH.
///   drho_i/dt += sum_j m_j F flux_ij,   flux_ij = 2 delta h_s c (rho_i - rho_j)/rho_j  [m^2/s],   F = (1/r) dW/dr <= 0
/// h_s = h/2 is the smoothing length, h the support radius; a denser particle loses. Tends to drho/dt = delta h_s c lap(rho).
/// Written with F it needs no softening and is finite at r = 0. The sum of V_i rho_i is kept, V = m/rho: rho_j flux_ij = -rho_i flux_ji.
/// Without the gradient correction of Antuono et al. 2010: near a free surface under gravity it works against the hydrostatic profile.
/// D. Molteni, A. Colagrossi, Comput. Phys. Commun. 180 (2009) 861-872, doi:10.1016/j.cpc.2008.12.004;
/// M. Antuono, A. Colagrossi, S. Marrone, D. Molteni, Comput. Phys. Commun. 181 (2010) 532-549, doi:10.1016/j.cpc.2009.11.002.
struct MolteniColagrossi {
  using reads = Fields<field::Density>;
  Required<double> sound_speed;  ///< c [m/s], > 0: that of the equation of state
  double delta = 0.1;            ///< [-], >= 0; 0.1 is the value of the sources

  template <class Pair, class I, class J>
  [[nodiscard]] auto flux(const Pair&, const I& i, const J& j, double support_radius) const noexcept {
    return (delta * support_radius * sound_speed) * (i.density - j.density) / j.density;
  }
  /// lambda = 2 delta h_s c (integral of |F|)  [1/s], the rate at which one particle's excess decays: bounds the time step.
  [[nodiscard]] double damping_rate(double support_radius, double radial_factor_integral) const noexcept {
    return delta * support_radius * sound_speed * radial_factor_integral;
  }
};

inline void validate(const MolteniColagrossi& law) {
  require_positive("diffusion::MolteniColagrossi: sound_speed", law.sound_speed, "m/s");
  require_not_negative("diffusion::MolteniColagrossi: delta", law.delta, "[-]");
}

}  // namespace dmp::diffusion
