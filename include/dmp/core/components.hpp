#pragma once
#include <dmp/core/unrolled.hpp>

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
  friend constexpr Components operator-(Components a) noexcept {
    unrolled<Dim>([&](auto d) __attribute__((always_inline)) { a.component[d] = -a.component[d]; });
    return a;
  }
  friend constexpr Components operator*(const T& factor, Components a) noexcept {
    unrolled<Dim>([&](auto d) __attribute__((always_inline)) { a.component[d] = factor * a.component[d]; });
    return a;
  }
  constexpr Components& operator+=(const Components& b) noexcept {
    unrolled<Dim>([&](auto d) __attribute__((always_inline)) { component[d] = component[d] + b.component[d]; });
    return *this;
  }
  constexpr Components& operator-=(const Components& b) noexcept {
    unrolled<Dim>([&](auto d) __attribute__((always_inline)) { component[d] = component[d] - b.component[d]; });
    return *this;
  }
};

template <int Dim, class T>
[[nodiscard]] constexpr T dot(const Components<Dim, T>& a, const Components<Dim, T>& b) noexcept {
  T result = a.component[0] * b.component[0];
  unrolled<Dim - 1>([&](auto d) __attribute__((always_inline)) { result = result + a.component[d + 1] * b.component[d + 1]; });
  return result;
}

}  // namespace dmp
