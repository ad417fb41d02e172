#pragma once
#include <concepts>
#include <type_traits>
#include <dmp/core/field.hpp>
#include <dmp/core/pair.hpp>

namespace dmp::diffusion {

/// Law that smooths the density: flux_ij [m^2/s] in drho_i/dt += sum_j m_j F flux_ij. rho_j flux_ij = -rho_i flux_ji keeps the
/// sum of V rho.
template <class D>
concept Diffuses = requires(const D law, const Pair<2, double> pair,
                            const View<2, double, unite<typename D::reads, Fields<field::Mass>>> particle, double h) {
  { law.flux(pair, particle, particle, h) } -> std::same_as<double>;
};

/// Contract of a diffusion law: the fields it `reads` of both particles, and `flux` unless it is None.
template <class D>
concept DiffusionLaw = std::is_trivially_copyable_v<D> && requires(const D law) {
  typename D::reads;
};

template <class D>
consteval bool explain_diffusion() {
  static_assert(
      requires { typename D::reads; }, "dmp: not a DiffusionLaw: no `using reads = Fields<...>;`, the fields it reads of both particles");
  static_assert(std::is_empty_v<D> || Diffuses<D>,
                "dmp: not a DiffusionLaw: it has parameters but no `T flux(pair, i, j, support_radius) const` [m^2/s]");
  return DiffusionLaw<D>;
}

}  // namespace dmp::diffusion
