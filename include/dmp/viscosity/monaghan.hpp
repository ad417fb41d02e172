#pragma once
#include <dmp/core/field.hpp>
#include <dmp/core/mean.hpp>

namespace dmp::viscosity {

/// Laminar viscosity along the line of centres, on all pairs: for flows where angular momentum must be kept.
///   Pi_ij = -(d + 2)(mu_i + mu_j)/(rho_i rho_j) s/(r^2 + 0.01 h^2)   [Pa m^6/kg^2], s = r_ij . v_ij, d = Dim, h = support radius
/// Approaching pairs (s < 0) repel, separating ones attract. Keeps linear and angular momentum. Finite at r = 0, where it is 0.
/// The dynamic viscosity mu [Pa s] is a property of each group (rheology::Constant, ...). The 0.01 h^2 lowers the effective mu by
/// 4.4 % in 2D and 3.3 % in 3D (Lucy's kernel, continuum); at h = 2.6 spacings on a square lattice it is 12 % low in all.
/// J. J. Monaghan, Rep. Prog. Phys. 68 (2005) 1703-1759, doi:10.1088/0034-4885/68/8/R01, written in mu instead of alpha and c.
template <int Dim, class Mean = ArithmeticMean>
struct Monaghan {
  using reads = Fields<field::Density, field::DynamicViscosity>;
  static constexpr int dimension = Dim;

  template <class Pair, class I, class J>
  [[nodiscard]] auto along_separation(const Pair& pair, const I& i, const J& j, double support_radius) const noexcept {
    const double softening = 0.01 * support_radius * support_radius;  // [m^2]
    return (-(Dim + 2.0)) * Mean::twice(i.dynamic_viscosity, j.dynamic_viscosity) * pair.approach /
           (i.density * j.density * (pair.distance_squared + softening));
  }
  /// lambda = 2 nu (integral of |F|)((d + 2)/d)(2 - 1/d): 60 nu/h^2 in 2D, 58 nu/h^2 in 3D with Lucy's kernel  [1/s]. One particle that
  /// moves through others at rest is damped without the last factor; where those along the line of its motion move against it, up to as
  /// much faster (the largest eigenvalues of lattices, tests/viscosity/lattice_rates_test.cpp).
  [[nodiscard]] double damping_rate(double nu, double, double radial_factor_integral, int) const noexcept {
    return 2.0 * nu * radial_factor_integral * ((Dim + 2.0) / Dim) * (2.0 - 1.0 / Dim);
  }
};

template <int Dim, class Mean>
void validate(const Monaghan<Dim, Mean>&) {}

}  // namespace dmp::viscosity
