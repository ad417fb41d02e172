#pragma once
#include <cmath>
#include <type_traits>
#include <dmp/core/field.hpp>
#include <dmp/core/require.hpp>
#include <dmp/diffusion/concept.hpp>
#include <dmp/diffusion/none.hpp>
#include <dmp/kernel/concept.hpp>
#include <dmp/sweep/step_limit.hpp>
#include <dmp/tensile/concept.hpp>
#include <dmp/tensile/none.hpp>
#include <dmp/viscosity/concept.hpp>
#include <dmp/viscosity/none.hpp>

namespace dmp::sph {

namespace detail {
template <class Law>
consteval int dimension_or(int dimension) {
  if constexpr (requires { Law::dimension; }) return Law::dimension;
  return dimension;
}
}  // namespace detail

enum class Energy { left_out, carried };

/// Continuity and momentum of a fluid, and the energy equation if it is carried, fused in one pass over the pairs.
///   drho_i/dt =  sum_j m_j F (r_ij . v_ij)                                                      [kg/m^3/s]
///   dv_i/dt   = -sum_j m_j (p_i/rho_i^2 + p_j/rho_j^2 + Pi_ij + R_ij) F r_ij + sum_j m_j kappa_ij F v_ij  [m/s^2]
///   de_i/dt   = (1/2) sum_j m_j F [(p_i/rho_i^2 + p_j/rho_j^2 + Pi_ij + R_ij) r_ij . v_ij - kappa_ij v_ij^2]  [W/kg]
/// F = (1/r) dW/dr <= 0: approaching particles gain density, p > 0 repels. Pi_ij or kappa_ij is the viscosity law, R_ij the tensile
/// correction; a diffusion law adds sum_j m_j F flux_ij to the density. What is None is not there. Kinetic energy and m_i e_i together are
/// kept: what one loses the other gains.
/// J. J. Monaghan, Rep. Prog. Phys. 68 (2005) 1703-1759, doi:10.1088/0034-4885/68/8/R01, eqs. 2.17 and 3.8.
template <class K, class V = viscosity::None, class D = diffusion::None, class C = tensile::None,
          Energy E = Energy::left_out>
struct WeaklyCompressible {
  static_assert(kernel::explain_kernel<K>() && viscosity::explain_viscosity<V>() && diffusion::explain_diffusion<D>() &&
                tensile::explain_tensile_correction<C>());
  static_assert(detail::dimension_or<V>(K::dimension) == K::dimension,
                "dmp: sph::WeaklyCompressible: the viscosity law is made for another dimension than the kernel");
  using reads = unite<Fields<field::Density, field::PressureTerm>, typename V::reads, typename D::reads, typename C::reads>;
  using writes = unite<Fields<field::Acceleration, field::DensityRate>,
                       std::conditional_t<E == Energy::carried, Fields<field::SpecificEnergyRate>, Fields<>>>;
  static constexpr bool uses_velocity = true;
  static constexpr int dimension = K::dimension;

  K kernel;
  [[no_unique_address]] V viscosity{};
  [[no_unique_address]] D diffusion{};
  [[no_unique_address]] C tensile{};

  [[nodiscard]] double cutoff() const noexcept { return kernel.support_radius; }

  template <class Pair, class I, class J, class Sums>
  void add(const Pair& pair, const I& i, const J& j, Sums& sums) const noexcept {
    const double h = kernel.support_radius;
    const auto m_F = j.mass * kernel.radial_factor(pair.distance);
    auto pressure = i.pressure_term + j.pressure_term;
    if constexpr (viscosity::ActsAlongSeparation<V>) pressure = pressure + viscosity.along_separation(pair, i, j, h);
    if constexpr (tensile::Corrects<C>) pressure = pressure + tensile.correction(pair, i, j, kernel);
    sums.acceleration -= (m_F * pressure) * pair.separation;
    if constexpr (viscosity::ActsAlongVelocity<V>)
      sums.acceleration += (m_F * viscosity.along_velocity(pair, i, j)) * pair.relative_velocity;
    if constexpr (E == Energy::carried) {
      sums.specific_energy_rate += (0.5 * m_F) * (pressure * pair.approach);
      if constexpr (viscosity::ActsAlongVelocity<V>)
        sums.specific_energy_rate -=
            (0.5 * m_F) * viscosity.along_velocity(pair, i, j) * dot(pair.relative_velocity, pair.relative_velocity);
    }
    sums.density_rate += m_F * pair.approach;
    if constexpr (diffusion::Diffuses<D>) sums.density_rate += m_F * diffusion.flux(pair, i, j, h);
  }

  /// Sound must not cross a quarter of the support in a step (Courant), nor a body at rest fall through a quarter of it; and the viscosity
  /// law's damping must stay within what the integrator stands.
  void step_limits(const sweep::StepState& state, sweep::StepLimit& limit) const {
    const double h = kernel.support_radius;
    limit.sound = (state.sound_speed + state.speed) / (0.25 * h);
    limit.require_below(1.0 / limit.sound, "sound");
    if (state.acceleration > 0.0) limit.resolve(0.25 * std::sqrt(h / state.acceleration), "acceleration");
    double nu = state.kinematic_viscosity;
    if constexpr (requires { viscosity.kinematic_viscosity(h, h, h); })
      nu = viscosity.kinematic_viscosity(state.sound_speed, state.speed, h);
    const double rate = viscosity.damping_rate(nu, h, kernel::largest_radial_factor_sum(kernel), K::dimension);
    limit.damp(rate, state.damping_limit, "viscosity");
    if constexpr (requires { diffusion.damping_rate(h, h); })
      limit.require_below(state.state_damping_limit / diffusion.damping_rate(h, kernel::largest_radial_factor_sum(kernel)),
                          "density diffusion");
  }
};

/// With the energy equation: for gases, shocks, and liquids whose pressure depends on the energy.
template <class K, class V = viscosity::None, class D = diffusion::None, class C = tensile::None>
using Compressible = WeaklyCompressible<K, V, D, C, Energy::carried>;

template <class K, class V, class D, class C, Energy E>
void validate(const WeaklyCompressible<K, V, D, C, E>& law) {
  check_parameters(law.kernel);
  check_parameters(law.viscosity);
  check_parameters(law.diffusion);
  check_parameters(law.tensile);
  if constexpr (requires { law.tensile.spacing; })
    require(law.tensile.spacing < law.kernel.support_radius,
            "sph::WeaklyCompressible: spacing of the tensile correction must be < the support radius [m]", law.tensile.spacing);
}

}  // namespace dmp::sph
