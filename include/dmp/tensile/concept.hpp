#pragma once
#include <concepts>
#include <type_traits>
#include <dmp/core/field.hpp>
#include <dmp/core/pair.hpp>

namespace dmp::tensile {

namespace detail {
struct AnyKernel {
  double support_radius = 1.0;
  template <class T>
  T value(const T& r) const noexcept {
    return r;
  }
};
}  // namespace detail

/// Law that keeps particles from clumping under tension: R_ij [Pa m^6/kg^2], added to p_i/rho_i^2 + p_j/rho_j^2. R_ij = R_ji >= 0.
template <class C>
concept Corrects = requires(const C law, const Pair<2, double> pair,
                            const View<2, double, unite<typename C::reads, Fields<field::Mass>>> particle, const detail::AnyKernel kernel) {
  { law.correction(pair, particle, particle, kernel) } -> std::same_as<double>;
};

/// Contract of a tensile correction: the fields it `reads` of both particles, and `correction` unless it is None.
template <class C>
concept TensileCorrection = std::is_trivially_copyable_v<C> && requires(const C law) {
  typename C::reads;
};

template <class C>
consteval bool explain_tensile_correction() {
  static_assert(
      requires { typename C::reads; },
      "dmp: not a TensileCorrection: no `using reads = Fields<...>;`, the fields it reads of both particles");
  static_assert(std::is_empty_v<C> || Corrects<C>,
                "dmp: not a TensileCorrection: it has parameters but no `T correction(pair, i, j, kernel) const` [Pa m^6/kg^2]");
  return TensileCorrection<C>;
}

}  // namespace dmp::tensile
