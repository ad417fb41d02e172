#pragma once

namespace dmp {

/// A vector as a law sees it: Dim numbers of a value type (double, a SIMD pack, a dual number). User code outside laws and sweeps
/// writes Vector<Dim> (core/vector.hpp), which is Eigen's.
template <int Dim, class T>
struct Components {
  T component[Dim];

  [[nodiscard]] constexpr T& operator[](int d) noexcept { return component[d]; }
  [[nodiscard]] constexpr const T& operator[](int d) const noexcept { return component[d]; }

  friend constexpr Components operator+(Components a, const Components& b) noexcept { return a += b; }
  friend constexpr Components operator-(Components a, const Components& b) noexcept { return a -= b; }
  friend constexpr Components operator*(const T& factor, Components a) noexcept {
    for (T& x : a.component) x = factor * x;
    return a;
  }
  constexpr Components& operator+=(const Components& b) noexcept {
    for (int d = 0; d < Dim; ++d) component[d] = component[d] + b.component[d];
    return *this;
  }
  constexpr Components& operator-=(const Components& b) noexcept {
    for (int d = 0; d < Dim; ++d) component[d] = component[d] - b.component[d];
    return *this;
  }
};

template <int Dim, class T>
[[nodiscard]] constexpr T dot(const Components<Dim, T>& a, const Components<Dim, T>& b) noexcept {
  T result = a.component[0] * b.component[0];
  for (int d = 1; d < Dim; ++d) result = result + a.component[d] * b.component[d];
  return result;
}

}  // namespace dmp
