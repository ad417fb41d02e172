#pragma once
#include <concepts>
#include <type_traits>

namespace dmp::kernel {

/// Contract of a smoothing kernel. T is any value type; r >= 0 [m]. Both functions are exactly 0 for r >= support_radius.
///   value(r)          W                 [m^-Dim]
///   radial_factor(r)  F = (1/r) dW/dr   [m^-(Dim+2)], <= 0 and finite at r = 0; the gradient is grad_i W = F r_ij
///   lattice_excess    optional, see largest_radial_factor_sum
template <class K>
concept Kernel = std::is_trivially_copyable_v<K> && requires(const K kernel, double r) {
  { K::dimension } -> std::convertible_to<int>;
  { kernel.support_radius } -> std::convertible_to<double>;
  { kernel.value(r) } -> std::same_as<double>;
  { kernel.radial_factor(r) } -> std::same_as<double>;
};

template <class K>
consteval bool explain_kernel() {
  static_assert(
      requires {
        { K::dimension } -> std::convertible_to<int>;
      },
      "dmp: not a Kernel: no `static constexpr int dimension`, 1, 2 or 3");
  static_assert(
      requires(const K k) {
        { k.support_radius } -> std::convertible_to<double>;
      },
      "dmp: not a Kernel: no `support_radius` [m], the distance where W becomes 0");
  static_assert(
      requires(const K k, double r) {
        { k.value(r) } -> std::same_as<double>;
      },
      "dmp: not a Kernel: no `T value(T r) const`, W [m^-Dim]");
  static_assert(
      requires(const K k, double r) {
        { k.radial_factor(r) } -> std::same_as<double>;
      },
      "dmp: not a Kernel: no `T radial_factor(T r) const`, (1/r) dW/dr [m^-(Dim+2)]");
  return Kernel<K>;
}

/// Integral of |F| over all space [m^-2], the rate at which a pair law damps one particle among others, per diffusivity.
/// Lucy: 10/h^2 in 2D, 10.5/h^2 in 3D. Midpoint rule over 1000 shells.
template <class K>
[[nodiscard]] double radial_factor_integral(const K& kernel) {
  constexpr int shells = 1000;
  constexpr double pi = 3.14159265358979323846;
  const double h = kernel.support_radius, thickness = h / shells;
  double result = 0.0;
  for (int shell = 0; shell < shells; ++shell) {
    const double r = (shell + 0.5) * thickness;
    const double area = K::dimension == 1 ? 2.0 : K::dimension == 2 ? 2.0 * pi * r : 4.0 * pi * r * r;
    result -= kernel.radial_factor(r) * area * thickness;
  }
  return result;
}

/// Largest sum_j V_j |F_ij| (1 - cos k . r_ij) of all motions k of a lattice [m^-2], what bounds the time step: the integral, exceeded by
/// at most 3 % on square, hexagonal, cubic and close-packed lattices (tests/viscosity/lattice_rates_test.cpp) unless the kernel states
/// `lattice_excess`, by how many times.
template <class K>
[[nodiscard]] double largest_radial_factor_sum(const K& kernel) {
  if constexpr (requires { K::lattice_excess; }) return K::lattice_excess * radial_factor_integral(kernel);
  else return radial_factor_integral(kernel);
}

}  // namespace dmp::kernel
