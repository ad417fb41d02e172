#pragma once
#include <numbers>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::kernel {

/// Cubic B-spline M4, q = r/h, h = support radius (twice the smoothing length of the sources that let the spline end at 2h).
///   W(r) = (1/s)(1 - 6q^2 + 6q^3)    q <= 1/2     (2/s)(1 - q)^3                  q > 1/2    [m^-Dim]      0 for r >= h
///   F(r) = (1/r) dW/dr
///        = -(6/(s h^2))(2 - 3q)      q <= 1/2     -(6/(s h^2))(1 - q)^2/q         q > 1/2    [m^-(Dim+2)]  <= 0, finite at r = 0
///   s    = 3h/4, 7 pi h^2/40, pi h^3/8  [m^Dim]  Dim = 1, 2, 3
/// Both functions are written with powers of (1 - q)_+ and (1/2 - q)_+. F costs one division per pair, the other kernels none.
/// J. J. Monaghan, J. C. Lattanzio, Astron. Astrophys. 149 (1985) 135-143 (no DOI); constants: W. Dehnen, H. Aly, Mon. Not. R.
/// Astron. Soc. 425 (2012) 1068-1082, doi:10.1111/j.1365-2966.2012.21439.x, table 1.
template <int Dim>
struct CubicSpline {
  static constexpr int dimension = Dim;
  Required<double> support_radius;  ///< h [m], > 0

  template <class T>
  [[nodiscard]] T value(const T& r) const noexcept {
    const double h = support_radius;
    const T rest = max(h - r, 0.0) * (1.0 / h), core = max(0.5 * h - r, 0.0) * (1.0 / h);
    return (2.0 / volume()) * (cube(rest) - 4.0 * cube(core));
  }
  template <class T>
  [[nodiscard]] T radial_factor(const T& r) const noexcept {
    const double h = support_radius;
    const T q = r * (1.0 / h), rest = max(h - r, 0.0) * (1.0 / h);
    return (-6.0 / (volume() * h * h)) * select(q < 0.5, 2.0 - 3.0 * q, square(rest) / max(q, 0.5));
  }

 private:
  [[nodiscard]] double volume() const noexcept {  // s
    const double h = support_radius;
    return Dim == 1 ? 3.0 * h / 4.0 : Dim == 2 ? 7.0 * std::numbers::pi * h * h / 40.0 : std::numbers::pi * h * h * h / 8.0;
  }
};

template <int Dim>
void validate(const CubicSpline<Dim>& kernel) {
  require_positive("kernel::CubicSpline: support_radius", kernel.support_radius, "m");
}

}  // namespace dmp::kernel
