#pragma once
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::potential {

/// Lennard-Jones 12-6 pair potential, plainly truncated (the force jumps at the cut-off unless that is 2^(1/6) sigma).
///   U(r) = 4 eps [(sigma/r)^12 - (sigma/r)^6]                [J]
///   f(r) = (24 eps/r^2) [2 (sigma/r)^12 - (sigma/r)^6]       [N/m], force on i = f r_ij, > 0 repels
/// A cut-off <= 2^(1/6) sigma leaves the repulsion alone. Not finite at r = 0: coincident particles stop the run.
/// J. E. Lennard-Jones, Proc. R. Soc. A 106 (1924) 463-477, doi:10.1098/rspa.1924.0082.
struct LennardJones {
  Required<double> energy_scale;  ///< eps [J], >= 0
  Required<double> diameter;      ///< sigma [m], > 0: where U is 0
  Required<double> cutoff;        ///< [m], > 0

  template <class T>
  [[nodiscard]] T force_factor(const T& distance_squared) const noexcept {
    const T inverse = 1.0 / distance_squared, s6 = cube(square<double>(diameter) * inverse);
    return select(distance_squared < square<double>(cutoff), 24.0 * energy_scale * inverse * s6 * (2.0 * s6 - 1.0), 0.0);
  }
  template <class T>
  [[nodiscard]] T energy(const T& distance_squared) const noexcept {
    const T s6 = cube(square<double>(diameter) / distance_squared);
    return select(distance_squared < square<double>(cutoff), 4.0 * energy_scale * s6 * (s6 - 1.0), 0.0);
  }
  /// U'' at r = sigma, (4 * 156 - 4 * 42) eps/sigma^2.
  [[nodiscard]] double largest_stiffness() const noexcept { return 456.0 * energy_scale / square<double>(diameter); }
};

inline void validate(const LennardJones& law) {
  require_not_negative("potential::LennardJones: energy_scale", law.energy_scale, "J");
  require_positive("potential::LennardJones: diameter", law.diameter, "m");
  require_positive("potential::LennardJones: cutoff", law.cutoff, "m");
}

}  // namespace dmp::potential
