#pragma once
#include <numbers>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::kernel {

/// Wendland's kernel of smoothness C2, q = r/h, h = support radius. A different polynomial in 1D (there it equals Lucy's).
///   W(r) = (1/s)(1 - q)^4 (1 + 4q)    1D: (1/s)(1 - q)^3 (1 + 3q)   [m^-Dim]      0 for r >= h
///   F(r) = -20 (1 - q)^3/(s h^2)      1D: -12 (1 - q)^2/(s h^2)     [m^-(Dim+2)]  (1/r) dW/dr <= 0, finite at r = 0
///   s    = 4h/5, pi h^2/7, 2 pi h^3/21                              [m^Dim]       Dim = 1, 2, 3
/// Its Fourier transform is positive: particles do not pair, however many neighbours they have.
/// H. Wendland, Adv. Comput. Math. 4 (1995) 389-396, doi:10.1007/BF02123482; constants: W. Dehnen, H. Aly, Mon. Not. R. Astron. Soc.
/// 425 (2012) 1068-1082, doi:10.1111/j.1365-2966.2012.21439.x, table 1.
template <int Dim>
struct WendlandC2 {
  static constexpr int dimension = Dim;
  Required<double> support_radius;  ///< h [m], > 0

  template <class T>
  [[nodiscard]] T value(const T& r) const noexcept {
    const T q = r * (1.0 / support_radius), left = rest(r);
    if constexpr (Dim == 1) return (1.0 / volume()) * (1.0 + 3.0 * q) * cube(left);
    else return (1.0 / volume()) * (1.0 + 4.0 * q) * square(square(left));
  }
  template <class T>
  [[nodiscard]] T radial_factor(const T& r) const noexcept {
    const double scale = 1.0 / (volume() * square<double>(support_radius));
    if constexpr (Dim == 1) return (-12.0 * scale) * square(rest(r));
    else return (-20.0 * scale) * cube(rest(r));
  }

 private:
  template <class T>
  [[nodiscard]] T rest(const T& r) const noexcept {  // (1 - q)_+ [-]
    const double h = support_radius;
    return max(h - r, 0.0) * (1.0 / h);
  }
  [[nodiscard]] double volume() const noexcept {  // s
    const double h = support_radius;
    return Dim == 1 ? 4.0 * h / 5.0 : Dim == 2 ? std::numbers::pi * h * h / 7.0 : 2.0 * std::numbers::pi * h * h * h / 21.0;
  }
};

template <int Dim>
void validate(const WendlandC2<Dim>& kernel) {
  require_positive("kernel::WendlandC2: support_radius", kernel.support_radius, "m");
}

}  // namespace dmp::kernel
