#pragma once
#include <cmath>

namespace test {

/// Number with a derivative (forward mode): f(Dual(x, 1)).derivative is f'(x), to rounding. A value type that laws accept.
struct Dual {
  double value = 0.0, derivative = 0.0;
  constexpr Dual() noexcept = default;
  constexpr Dual(double x, double slope = 0.0) noexcept : value(x), derivative(slope) {}

  friend constexpr Dual operator+(Dual a, Dual b) noexcept { return {a.value + b.value, a.derivative + b.derivative}; }
  friend constexpr Dual operator-(Dual a, Dual b) noexcept { return {a.value - b.value, a.derivative - b.derivative}; }
  friend constexpr Dual operator*(Dual a, Dual b) noexcept { return {a.value * b.value, a.derivative * b.value + a.value * b.derivative}; }
  friend constexpr Dual operator/(Dual a, Dual b) noexcept {
    return {a.value / b.value, (a.derivative * b.value - a.value * b.derivative) / (b.value * b.value)};
  }
  friend constexpr Dual operator+(Dual a, double b) noexcept { return a + Dual(b); }
  friend constexpr Dual operator-(Dual a, double b) noexcept { return a - Dual(b); }
  friend constexpr Dual operator*(Dual a, double b) noexcept { return a * Dual(b); }
  friend constexpr Dual operator/(Dual a, double b) noexcept { return a / Dual(b); }
  friend constexpr Dual operator+(double a, Dual b) noexcept { return Dual(a) + b; }
  friend constexpr Dual operator-(double a, Dual b) noexcept { return Dual(a) - b; }
  friend constexpr Dual operator*(double a, Dual b) noexcept { return Dual(a) * b; }
  friend constexpr Dual operator/(double a, Dual b) noexcept { return Dual(a) / b; }
  friend constexpr Dual operator-(Dual a) noexcept { return {-a.value, -a.derivative}; }

  friend constexpr bool operator<(Dual a, Dual b) noexcept { return a.value < b.value; }
  friend constexpr bool operator>(Dual a, Dual b) noexcept { return a.value > b.value; }
  friend constexpr bool operator<=(Dual a, Dual b) noexcept { return a.value <= b.value; }
  friend constexpr bool operator>=(Dual a, Dual b) noexcept { return a.value >= b.value; }

  friend constexpr Dual select(bool holds, Dual yes, Dual no) noexcept { return holds ? yes : no; }
  friend constexpr Dual min(Dual a, Dual b) noexcept { return b < a ? b : a; }
  friend constexpr Dual max(Dual a, Dual b) noexcept { return a < b ? b : a; }
  friend constexpr Dual abs(Dual a) noexcept { return a.value < 0.0 ? -a : a; }
  friend Dual sqrt(Dual a) noexcept { return {std::sqrt(a.value), a.derivative / (2.0 * std::sqrt(a.value))}; }
  friend Dual exp(Dual a) noexcept { return {std::exp(a.value), a.derivative * std::exp(a.value)}; }
  friend Dual log(Dual a) noexcept { return {std::log(a.value), a.derivative / a.value}; }
  friend Dual pow(Dual a, double n) noexcept { return {std::pow(a.value, n), a.derivative * n * std::pow(a.value, n - 1.0)}; }
};

/// f'(x) of a function that is generic in its value type.
template <class Function>
[[nodiscard]] double slope(const Function& f, double x) {
  return Dual(f(Dual(x, 1.0))).derivative;
}

}  // namespace test
