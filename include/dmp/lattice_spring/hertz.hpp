#pragma once
#include <cmath>
#include <limits>
#include <numbers>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::lattice_spring {

/// An elastic sphere between two rigid frictionless plates, which approach each other by delta in total [m]; good to delta/(2R) of 5 to 10
/// %.
///   F = A delta^(3/2),  A = E sqrt(2R)/(3 (1 - nu^2)) [N/m^(3/2)],  contact radius a = sqrt(R delta/2),  p0 = 3F/(2 pi a^2)
/// H. Hertz, J. reine angew. Math. 92 (1882) 156-171, with half of the approach on each side.
/// M. Sahputra, A. Alexiadis, M. J. Adams, ChemEngineering 4 (2020) 30,
/// doi:10.3390/chemengineering4020030.
struct Hertz {
  Required<double> radius;          ///< R of the sphere [m], > 0
  Required<double> youngs_modulus;  ///< E [Pa], > 0
  Required<double> poisson_ratio;   ///< nu, -1 < nu <= 1/2

  /// A [N/m^(3/2)]
  [[nodiscard]] double prefactor() const noexcept {
    return youngs_modulus * std::sqrt(2.0 * radius) / (3.0 * (1.0 - square(double(poisson_ratio))));
  }
  /// F [N]; 0 while the plates do not touch the sphere (delta < 0).
  [[nodiscard]] double force(double approach) const noexcept { return approach > 0.0 ? prefactor() * approach * std::sqrt(approach) : 0.0; }
  /// dF/d delta [N/m]
  [[nodiscard]] double stiffness(double approach) const noexcept { return approach > 0.0 ? 1.5 * prefactor() * std::sqrt(approach) : 0.0; }
  /// Approach [m] under a force >= 0 [N].
  [[nodiscard]] double approach(double force) const noexcept { return std::cbrt(square(force / prefactor())); }
  /// a [m]
  [[nodiscard]] double contact_radius(double approach) const noexcept { return approach > 0.0 ? std::sqrt(0.5 * radius * approach) : 0.0; }
  /// p0 [Pa], in the middle of the contact.
  [[nodiscard]] double peak_pressure(double approach) const noexcept {
    const double a = contact_radius(approach);
    return a > 0.0 ? 1.5 * force(approach) / (std::numbers::pi * a * a) : 0.0;
  }
  /// Force [N] of a sphere of Kelvin-Voigt bonds with one ratio tau = b/k [s] for all, while the contact grows, without inertia:
  /// F + tau dF/dt = A delta^(3/2) + B delta^(1/2) d(delta)/dt with B = (3/2) A tau.
  [[nodiscard]] double viscoelastic_force(double approach, double approach_rate, double relaxation_time) const noexcept {
    return force(approach) + relaxation_time * stiffness(approach) * approach_rate;
  }
};
inline void validate(const Hertz& contact) {
  require_positive("lattice_spring::Hertz: radius", contact.radius, "m");
  require_positive("lattice_spring::Hertz: youngs_modulus", contact.youngs_modulus, "Pa");
  require(contact.poisson_ratio > -1.0 && contact.poisson_ratio <= 0.5, "lattice_spring::Hertz: poisson_ratio must be > -1 and <= 0.5",
          contact.poisson_ratio);
}

/// Stresses on the axis of a Hertz contact, as fractions of its peak pressure p0; tension positive.
struct AxisStress {
  double axial, radial;                                                                   ///< along the axis, and across it
  [[nodiscard]] double shear() const noexcept { return 0.5 * std::abs(axial - radial); }  ///< largest shear stress
};
/// At depth zeta a below the contact, zeta = z/a >= 0:
///   sigma_z = -p0/(1 + zeta^2),  sigma_r = -p0 [(1 + nu)(1 - zeta atan(1/zeta)) - 1/(2 (1 + zeta^2))]
/// K. L. Johnson, Contact Mechanics, Cambridge 1985, section 3.4.
[[nodiscard]] inline AxisStress hertz_axis_stress(double zeta, double poisson_ratio) {
  require_not_negative("lattice_spring::hertz_axis_stress: zeta", zeta, "contact radii");
  require(poisson_ratio > -1.0 && poisson_ratio <= 0.5, "lattice_spring::hertz_axis_stress: poisson_ratio must be > -1 and <= 0.5",
          poisson_ratio);
  const double q = 1.0 / (1.0 + zeta * zeta);
  return {.axial = -q, .radial = -((1.0 + poisson_ratio) * (1.0 - zeta * std::atan2(1.0, zeta)) - 0.5 * q)};
}

/// Where the shear stress on the axis is largest, in contact radii, and how large, as a fraction of p0: 0.464 and 0.3217 for nu = 0.25.
struct DeepestShear {
  double zeta, shear;
};
[[nodiscard]] inline DeepestShear hertz_largest_shear(double poisson_ratio) {
  double low = 0.0, high = 2.0;  // one maximum in there, golden section
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  while (high - low > 1e-9) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (hertz_axis_stress(a, poisson_ratio).shear() > hertz_axis_stress(b, poisson_ratio).shear()) high = b;
    else low = a;
  }
  const double zeta = 0.5 * (low + high);
  return {.zeta = zeta, .shear = hertz_axis_stress(zeta, poisson_ratio).shear()};
}

/// I(x) = (3/2) int_0^1 sqrt(u) exp(-(1 - u) x) du, x = T/tau >= 0: how much of the force of a Maxwell branch with relaxation time tau is
/// left at the end of a ramp of duration T at constant speed in a Hertz contact (force as delta^(3/2)). 1 at 0, falling as 3/(2x).
/// The hold curve of a standard linear solid is F(t) = C delta^(3/2) [E_inf + (E_0 - E_inf) I(T/tau) exp(-t/tau)].
[[nodiscard]] inline double ramp_relaxation(double x) {
  require_not_negative("lattice_spring::ramp_relaxation: x", x, "T/tau");
  constexpr double asymptotic_from = 50.0;  // where the smallest term of the asymptotic series is below rounding
  double term = 1.0, sum = 0.0;
  if (x < asymptotic_from) {  // Kummer's M(3/2, 5/2, x) exp(-x): all terms are positive
    for (int n = 0; term > 1e-18 * sum || n < x; ++n, term *= x / n) sum += 1.5 / (1.5 + n) * term;
    return sum * std::exp(-x);
  }
  for (int n = 0; n < 40 && term > 1e-18; term *= (2 * n + 1) / (2.0 * x), ++n) sum += term;  // Dawson's integral: (2n - 1)!!/(2x)^n
  return 1.5 / x * (1.0 - 0.5 / x * sum);
}

}  // namespace dmp::lattice_spring
