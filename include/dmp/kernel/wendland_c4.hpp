#pragma once
#include <numbers>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::kernel {

/// Wendland's kernel of smoothness C4, q = r/h, h = support radius. A different polynomial in 1D.
///   W(r) = (1/s)(1 - q)^6 (1 + 6q + 35q^2/3)     1D: (1/s)(1 - q)^5 (1 + 5q + 8q^2)    [m^-Dim]      0 for r >= h
///   F(r) = -(56/3)(1 + 5q)(1 - q)^5/(s h^2)      1D: -14 (1 + 4q)(1 - q)^4/(s h^2)     [m^-(Dim+2)]  (1/r) dW/dr <= 0, finite at r = 0
///   s    = 2h/3, pi h^2/9, 32 pi h^3/495                                               [m^Dim]       Dim = 1, 2, 3
/// Narrower than WendlandC2 at one support radius: the same width (standard deviation) takes h 1.14 times as large in 2D and 3D.
/// H. Wendland, Adv. Comput. Math. 4 (1995) 389-396, doi:10.1007/BF02123482; constants: W. Dehnen, H. Aly, Mon. Not. R. Astron. Soc.
/// 425 (2012) 1068-1082, doi:10.1111/j.1365-2966.2012.21439.x, table 1.
template <int Dim>
struct WendlandC4 {
  static constexpr int dimension = Dim;
  Required<double> support_radius;  ///< h [m], > 0

  template <class T>
  [[nodiscard]] T value(const T& r) const noexcept {
    const T q = r * (1.0 / support_radius), left = rest(r);
    if constexpr (Dim == 1) return (1.0 / volume()) * (1.0 + q * (5.0 + 8.0 * q)) * left * square(square(left));
    else return (1.0 / volume()) * (1.0 + q * (6.0 + (35.0 / 3.0) * q)) * square(cube(left));
  }
  template <class T>
  [[nodiscard]] T radial_factor(const T& r) const noexcept {
    const double scale = 1.0 / (volume() * square<double>(support_radius));
    const T q = r * (1.0 / support_radius), left = rest(r);
    if constexpr (Dim == 1) return (-14.0 * scale) * (1.0 + 4.0 * q) * square(square(left));
    else return (-56.0 / 3.0 * scale) * (1.0 + 5.0 * q) * left * square(square(left));
  }

 private:
  template <class T>
  [[nodiscard]] T rest(const T& r) const noexcept {  // (1 - q)_+ [-]
    const double h = support_radius;
    return max(h - r, 0.0) * (1.0 / h);
  }
  [[nodiscard]] double volume() const noexcept {  // s
    const double h = support_radius;
    return Dim == 1 ? 2.0 * h / 3.0 : Dim == 2 ? std::numbers::pi * h * h / 9.0 : 32.0 * std::numbers::pi * h * h * h / 495.0;
  }
};

template <int Dim>
void validate(const WendlandC4<Dim>& kernel) {
  require_positive("kernel::WendlandC4: support_radius", kernel.support_radius, "m");
}

}  // namespace dmp::kernel
