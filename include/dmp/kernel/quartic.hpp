#pragma once
#include <numbers>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::kernel {

/// Kernel (1 - q^2)^4 of density summation in LAMMPS (`sph/rhosum`, there "quadric"), q = r/h, h = support radius.
///   W(r) = (1/s)(1 - q^2)^4                            [m^-Dim]      0 for r >= h
///   F(r) = (1/r) dW/dr = -8 (1 - q^2)^3/(s h^2)        [m^-(Dim+2)]  <= 0, finite at r = 0
///   s    = 256h/315, pi h^2/5, 512 pi h^3/3465         [m^Dim]       Dim = 1, 2, 3
/// Flat at r = 0 and a function of r^2: sums densities more accurately than Lucy's, but pushes close pairs apart less.
/// A. Albano, E. le Guillou, A. Danze, I. Moulitsas, I. H. Sahputra, A. Rahmat, C. A. Duque-Daza, X. Shang, K. C. Ng, M. Ariane,
/// A. Alexiadis, ChemEngineering 5 (2021) 30, doi:10.3390/chemengineering5020030.
template <int Dim>
struct Quartic {
  static constexpr int dimension = Dim;
  static constexpr double lattice_excess = 1.08;  ///< of the fastest damping over the integral of |F|, at h of about two spacings
  Required<double> support_radius;                ///< h [m], > 0

  template <class T>
  [[nodiscard]] T value(const T& r) const noexcept {
    return (1.0 / volume()) * square(square(rest(r)));
  }
  template <class T>
  [[nodiscard]] T radial_factor(const T& r) const noexcept {
    return (-8.0 / (volume() * square<double>(support_radius))) * cube(rest(r));
  }

 private:
  template <class T>
  [[nodiscard]] T rest(const T& r) const noexcept {  // (1 - q^2)_+ [-]
    const double h = support_radius;
    return max((h - r) * (h + r), 0.0) * (1.0 / (h * h));
  }
  [[nodiscard]] double volume() const noexcept {  // s
    const double h = support_radius;
    return Dim == 1 ? 256.0 * h / 315.0 : Dim == 2 ? std::numbers::pi * h * h / 5.0 : 512.0 * std::numbers::pi * h * h * h / 3465.0;
  }
};

template <int Dim>
void validate(const Quartic<Dim>& kernel) {
  require_positive("kernel::Quartic: support_radius", kernel.support_radius, "m");
}

}  // namespace dmp::kernel
