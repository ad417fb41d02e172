#pragma once
#include <dmp/core/field.hpp>
#include <dmp/core/require.hpp>
#include <dmp/kernel/concept.hpp>

namespace dmp::sph {

/// Density from the particles around, a summed law:  rho_i = m_i W(0) + sum_j m_j W(r_ij)   [kg/m^3].
/// With `every` = 1 the density of the scene is this sum; with more it is put back to the sum every so often, which undoes the drift of
/// the continuity equation. Near a free surface the sum falls short: there ShepardDensity.
/// J. J. Monaghan, Rep. Prog. Phys. 68 (2005) 1703-1759, doi:10.1088/0034-4885/68/8/R01, eq. 2.8. (LAMMPS: pair_style sph/rhosum.)
template <class K>
struct DensitySum {
  static_assert(kernel::explain_kernel<K>());
  using reads = Fields<>;
  using sums = Fields<field::Density>;
  using sets = Fields<field::Density>;
  static constexpr bool uses_velocity = false;
  K kernel;

  [[nodiscard]] double cutoff() const noexcept { return kernel.support_radius; }
  void add(const auto& pair, const auto&, const auto& j, auto& total) const noexcept {
    total.density += j.mass * kernel.value(pair.distance);
  }
  void set(auto& particle, const auto& total) const noexcept { particle.density = particle.mass * kernel.value(0.0) + total.density; }
};
template <class K>
void validate(const DensitySum<K>& law) {
  check_parameters(law.kernel);
}

}  // namespace dmp::sph
