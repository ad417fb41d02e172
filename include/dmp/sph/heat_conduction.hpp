#pragma once
#include <dmp/core/field.hpp>
#include <dmp/core/mean.hpp>
#include <dmp/core/require.hpp>
#include <dmp/kernel/concept.hpp>
#include <dmp/sweep/step_limit.hpp>

namespace dmp::sph {

/// Heat conduction inside a phase and between phases (Fourier):
///   de_i/dt = sum_j m_j kappa_ij (T_i - T_j) F/(rho_i rho_j)   [W/kg],  kappa_ij = twice the mean of kappa_i and kappa_j [W/(m K)], F <= 0
/// What i gains (m_i de_i/dt) j loses. The harmonic mean keeps the flux continuous where the conductivity jumps; with the arithmetic mean
/// the error at a jump is some eight times as large, and the light side asks for a shorter step. Temperature and conductivity are
/// properties of each group: thermal laws, or an equation of state that knows the temperature. Specific heats are per kilogram (LAMMPS'
/// sph/heatconduction exchanges energy per particle instead of temperature, and takes a diffusivity).
/// P. W. Cleary, J. J. Monaghan, J. Comput. Phys. 148 (1999) 227-264, doi:10.1006/jcph.1998.6118, eq. 25 and 28.
template <class K, class Mean = HarmonicMean>
struct HeatConduction {
  static_assert(kernel::explain_kernel<K>());
  static constexpr int dimension = K::dimension;
  using reads = Fields<field::Density, field::Temperature, field::ThermalConductivity>;
  using writes = Fields<field::SpecificEnergyRate>;
  static constexpr bool uses_velocity = false;
  K kernel;

  [[nodiscard]] double cutoff() const noexcept { return kernel.support_radius; }
  void add(const auto& pair, const auto& i, const auto& j, auto& sums) const noexcept {
    const auto conductivity = Mean::twice(i.thermal_conductivity, j.thermal_conductivity);
    sums.specific_energy_rate += j.mass * kernel.radial_factor(pair.distance) * conductivity * (i.temperature - j.temperature) /
                                 (i.density * j.density);
  }
  /// lambda = kappa_ij (integral of |F|)/(rho c): 20 D/h^2 in 2D inside a phase, with Lucy's kernel  [1/s].
  void step_limits(const sweep::StepState& a, const sweep::StepState& b, sweep::StepLimit& limit) const {
    const double reach = kernel::largest_radial_factor_sum(kernel) * Mean::twice(a.thermal_conductivity, b.thermal_conductivity);
    const double least_capacity = a.heat_capacity < b.heat_capacity ? a.heat_capacity : b.heat_capacity;
    if (reach > 0.0) limit.require_below(a.state_damping_limit * least_capacity / reach, "heat conduction");
  }
};
template <class K, class Mean>
void validate(const HeatConduction<K, Mean>& law) {
  check_parameters(law.kernel);
}

}  // namespace dmp::sph
