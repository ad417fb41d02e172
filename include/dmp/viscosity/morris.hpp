#pragma once
#include <dmp/core/field.hpp>
#include <dmp/core/mean.hpp>

namespace dmp::viscosity {

/// Laminar viscosity, the default for flows that mu controls.
///   dv_i/dt += sum_j m_j kappa_ij F v_ij,   kappa_ij = (mu_i + mu_j)/(rho_i rho_j)  [m^5/(kg s)], F <= 0: opposes v_ij.
/// The dynamic viscosity mu [Pa s] is a property of each group (rheology::Constant, ...). Keeps linear, not angular momentum.
/// J. P. Morris, P. J. Fox, Y. Zhu, J. Comput. Phys. 136 (1997) 214-226, doi:10.1006/jcph.1997.5776, eq. 22.
template <class Mean = ArithmeticMean>
struct Morris {
  using reads = Fields<field::Density, field::DynamicViscosity>;

  template <class Pair, class I, class J>
  [[nodiscard]] auto along_velocity(const Pair&, const I& i, const J& j) const noexcept {
    return Mean::twice(i.dynamic_viscosity, j.dynamic_viscosity) / (i.density * j.density);
  }
  /// lambda = 2 nu (integral of |F|): 20 nu/h^2 in 2D, 21 nu/h^2 in 3D with Lucy's kernel  [1/s].
  [[nodiscard]] double damping_rate(double nu, double, double radial_factor_integral, int) const noexcept {
    return 2.0 * nu * radial_factor_integral;
  }
};

template <class Mean>
void validate(const Morris<Mean>&) {}

}  // namespace dmp::viscosity
