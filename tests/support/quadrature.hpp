#pragma once
#include <numbers>

namespace test {

/// Integral of f from a to b: Gauss-Legendre, 8 points on each of 64 panels. Exact for piecewise polynomials up to degree 15 whose
/// joints lie at multiples of (b - a)/64.
template <class Function>
[[nodiscard]] double integral(const Function& f, double a, double b) {
  constexpr double node[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  constexpr double weight[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
  constexpr int panels = 64;
  const double half = 0.5 * (b - a) / panels;
  double sum = 0.0;
  for (int panel = 0; panel < panels; ++panel) {
    const double middle = a + (2 * panel + 1) * half;
    for (int n = 0; n < 4; ++n) sum += weight[n] * (f(middle - half * node[n]) + f(middle + half * node[n]));
  }
  return sum * half;
}

/// Area of the sphere of radius r in `dimension` dimensions; in 1D it is two points.
[[nodiscard]] inline double sphere_area(int dimension, double r) {
  return dimension == 1 ? 2.0 : dimension == 2 ? 2.0 * std::numbers::pi * r : 4.0 * std::numbers::pi * r * r;
}

/// Integral of f(r) over the ball of radius h.
template <class Function>
[[nodiscard]] double ball_integral(int dimension, double h, const Function& f) {
  return integral([&](double r) { return f(r) * sphere_area(dimension, r); }, 0.0, h);
}

}  // namespace test
