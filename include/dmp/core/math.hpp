#pragma once
#include <concepts>

/// Functions of one number that every value type T of a law offers: here for double; for a SIMD pack in core/pack.hpp; a user's
/// own number type brings overloads in its own namespace. Laws call them unqualified. Branches in a law are `select`, `min`, `max`.
/// Built-in functions of the compiler: <cmath> would be a third of what a law alone costs to compile (docs/performance.md).
namespace dmp {

// Templates, so that a user's code that also sees the functions of <math.h> is not ambiguous.
template <std::same_as<double> T>
[[nodiscard]] T sqrt(T x) noexcept {
  return __builtin_sqrt(x);
}
template <std::same_as<double> T>
[[nodiscard]] T exp(T x) noexcept {
  return __builtin_exp(x);
}
template <std::same_as<double> T>
[[nodiscard]] T log(T x) noexcept {
  return __builtin_log(x);
}
template <std::same_as<double> T>
[[nodiscard]] T abs(T x) noexcept {
  return __builtin_fabs(x);
}
template <std::same_as<double> T>
[[nodiscard]] T pow(T x, double n) noexcept {
  return __builtin_pow(x, n);
}
[[nodiscard]] constexpr double min(double a, double b) noexcept { return b < a ? b : a; }
[[nodiscard]] constexpr double max(double a, double b) noexcept { return a < b ? b : a; }
/// holds ? yes : no, for every lane of a value type.
[[nodiscard]] constexpr double select(bool holds, double yes, double no) noexcept { return holds ? yes : no; }

template <class T>
[[nodiscard]] constexpr T square(const T& x) noexcept {
  return x * x;
}
template <class T>
[[nodiscard]] constexpr T cube(const T& x) noexcept {
  return x * x * x;
}

/// x^n. A whole exponent (7 of Tait's water, 12 of Lennard-Jones) costs a few products, any other one a `pow`.
template <class T>
[[nodiscard]] T power(const T& x, double n) noexcept {
  if (n == static_cast<double>(static_cast<int>(n)) && n >= 1.0 && n <= 16.0) {
    T result = x, base = x;
    for (int left = static_cast<int>(n) - 1; left > 0; left /= 2, base = base * base)
      if (left % 2 == 1) result = result * base;
    return result;
  }
  return pow(x, n);
}

}  // namespace dmp
