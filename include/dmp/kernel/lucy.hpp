#pragma once
#include <numbers>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::kernel {

/// Lucy's bell-shaped smoothing kernel, q = r/h, h = support radius (not a smoothing length).
///   W(r) = (1/s)(1 + 3q)(1 - q)^3               [m^-Dim]      0 for r >= h
///   F(r) = (1/r) dW/dr = -12 (1 - q)^2/(s h^2)  [m^-(Dim+2)]  <= 0, finite at r = 0
///   s    = 4h/5, pi h^2/5, 16 pi h^3/105        [m^Dim]       Dim = 1, 2, 3
/// L. B. Lucy, Astron. J. 82 (1977) 1013-1024, doi:10.1086/112164.
template <int Dim>
struct Lucy {
  static constexpr int dimension = Dim;
  Required<double> support_radius;  ///< h [m], > 0

  template <class T>
  [[nodiscard]] T value(const T& r) const noexcept {
    const T rest = one_minus_q(r);
    return (1.0 / volume()) * (4.0 - 3.0 * rest) * cube(rest);
  }
  template <class T>
  [[nodiscard]] T radial_factor(const T& r) const noexcept {
    return (-12.0 / (volume() * square<double>(support_radius))) * square(one_minus_q(r));
  }

 private:
  template <class T>
  [[nodiscard]] T one_minus_q(const T& r) const noexcept {  // exactly 0 at the support
    return max(support_radius - r, 0.0) * (1.0 / support_radius);
  }
  [[nodiscard]] double volume() const noexcept {  // s
    const double h = support_radius;
    return Dim == 1 ? 4.0 * h / 5.0 : Dim == 2 ? std::numbers::pi * h * h / 5.0 : 16.0 * std::numbers::pi * h * h * h / 105.0;
  }
};

template <int Dim>
void validate(const Lucy<Dim>& kernel) {
  require_positive("kernel::Lucy: support_radius", kernel.support_radius, "m");
}

}  // namespace dmp::kernel
