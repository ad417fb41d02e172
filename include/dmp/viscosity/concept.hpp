#pragma once
#include <concepts>
#include <type_traits>
#include <dmp/core/field.hpp>
#include <dmp/core/pair.hpp>

namespace dmp::viscosity {

namespace detail {
/// A particle as the check of a law sees it: the fields that the law reads, and the mass.
template <class V>
using Probe = View<2, double, unite<typename V::reads, Fields<field::Mass>>>;
}  // namespace detail

/// Law that acts along r_ij:  along_separation(pair, i, j, support_radius) = Pi_ij [Pa m^6/kg^2 = m^5/(kg s^2)], Pi_ij = Pi_ji.
///   dv_i/dt += -sum_j m_j Pi_ij F r_ij,   F = (1/r) dW/dr <= 0: Pi_ij > 0 repels. It joins p_i/rho_i^2 + p_j/rho_j^2.
/// Keeps linear and angular momentum. Must be finite at r = 0, and take energy: Pi_ij (r_ij . v_ij) <= 0.
template <class V>
concept ActsAlongSeparation = requires(const V law, const Pair<2, double> pair, const detail::Probe<V> particle, double support_radius) {
  { law.along_separation(pair, particle, particle, support_radius) } -> std::same_as<double>;
};
/// Law that acts along v_ij:  along_velocity(pair, i, j) = kappa_ij [m^5/(kg s)], kappa_ij = kappa_ji >= 0.
///   dv_i/dt += sum_j m_j kappa_ij F v_ij,   F <= 0: opposes v_ij. Keeps linear, not angular momentum.
/// The unit: m_j [kg m^(d-3)] times F [m^-(d+2)] is kg/m^5 in any dimension d, so that m_j kappa_ij F is a rate [1/s].
template <class V>
concept ActsAlongVelocity = requires(const V law, const Pair<2, double> pair, const detail::Probe<V> particle) {
  { law.along_velocity(pair, particle, particle) } -> std::same_as<double>;
};

/// Contract of a viscosity law. It declares the fields it `reads` of both particles; offers one of the two functions above, or none
/// (viscosity::None); and states the largest rate at which it damps a velocity, for the time step:
///   damping_rate(nu, support_radius, radial_factor_integral, dimension)  [1/s]
///     nu                      largest kinematic viscosity in the group [m^2/s]; unused by laws with parameters of their own. A law that
///                             makes it of the motion offers kinematic_viscosity(largest sound speed, largest speed, support_radius)
///     support_radius          h [m]
///     radial_factor_integral  integral of |F| over space [m^-2], kernel/concept.hpp
template <class V>
concept ViscosityLaw = std::is_trivially_copyable_v<V> && requires(const V law, double x) {
  typename V::reads;
  { law.damping_rate(x, x, x, 2) } -> std::same_as<double>;
};

template <class V>
consteval bool explain_viscosity() {
  static_assert(
      requires { typename V::reads; }, "dmp: not a ViscosityLaw: no `using reads = Fields<...>;`, the fields it reads of both particles");
  static_assert(
      requires(const V v, double x) {
        { v.damping_rate(x, x, x, 2) } -> std::same_as<double>;
      },
      "dmp: not a ViscosityLaw: no `double damping_rate(nu, support_radius, radial_factor_integral, dimension) const` [1/s]");
  static_assert((std::is_empty_v<V> && V::reads::count == 0) || ActsAlongSeparation<V> || ActsAlongVelocity<V>,
                "dmp: not a ViscosityLaw: neither `T along_separation(pair, i, j, support_radius) const` [Pa m^6/kg^2] nor `T "
                "along_velocity(pair, i, j) const` [m^5/(kg s)]");
  return ViscosityLaw<V>;
}

}  // namespace dmp::viscosity
