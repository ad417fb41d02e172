#pragma once
#include <cmath>
#include <cstddef>
#include <span>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/lattice_spring/detail/checks.hpp>

namespace dmp::lattice_spring {

/// What a measured force curve says of a sphere as a whole.
struct HertzFit {
  double youngs_modulus;  ///< E [Pa]
  double zero;            ///< delta0 [m]: the curve begins at approach -delta0
  double prefactor;       ///< A [N/m^(3/2)]
  double residual;        ///< rms of the difference of F^(2/3) from the line, as a fraction of its rms
};

enum class HertzZero { free, fixed };  ///< fixed: delta0 = 0

/// Least squares of F^(2/3) = A^(2/3) (delta + delta0) over approaches [m] and forces [N], and E = 3 (1 - nu^2) A/sqrt(2R) (Hertz). The
/// zero is free unless told otherwise: facets and gaps of a body of beads shift it by about a bond length, and E by 10 % with it.
[[nodiscard]] inline HertzFit fit_hertz(std::span<const double> approach, std::span<const double> force, double radius,
                                        double poisson_ratio, HertzZero zero = HertzZero::free) {
  require_positive("lattice_spring::fit_hertz: radius", radius, "m");
  require(poisson_ratio > -1.0 && poisson_ratio <= 0.5, "lattice_spring::fit_hertz: poisson_ratio must be > -1 and <= 0.5", poisson_ratio);
  detail::require_same_size("lattice_spring::fit_hertz", "forces", force.size(), approach.size());
  const auto n = static_cast<double>(approach.size());
  require(n >= (zero == HertzZero::free ? 2.0 : 1.0), "lattice_spring::fit_hertz: points must number 2 or more, 1 with a fixed zero", n);
  double mean_x = 0.0, mean_y = 0.0;
  for (std::size_t k = 0; k < approach.size(); ++k) {
    require_finite("lattice_spring::fit_hertz: approach", approach[k], "m");
    require_not_negative("lattice_spring::fit_hertz: force", force[k], "N");
    if (zero == HertzZero::fixed) continue;
    mean_x += approach[k] / n;
    mean_y += std::cbrt(square(force[k])) / n;
  }
  double xx = 0.0, xy = 0.0;
  for (std::size_t k = 0; k < approach.size(); ++k) {
    xx += square(approach[k] - mean_x);
    xy += (approach[k] - mean_x) * (std::cbrt(square(force[k])) - mean_y);
  }
  require(xx > 0.0, "lattice_spring::fit_hertz: approaches must not all be the same, or 0, sum of squares > 0 m^2", xx);
  const double slope = xy / xx;
  require(slope > 0.0, "lattice_spring::fit_hertz: the force must grow with the approach, slope of F^(2/3) > 0 N^(2/3)/m", slope);
  const double intercept = mean_y - slope * mean_x;
  double difference = 0.0, size = 0.0;
  for (std::size_t k = 0; k < approach.size(); ++k) {
    const double y = std::cbrt(square(force[k]));
    difference += square(y - slope * approach[k] - intercept);
    size += y * y;
  }
  const double A = slope * std::sqrt(slope);
  return {.youngs_modulus = 3.0 * (1.0 - square(poisson_ratio)) * A / std::sqrt(2.0 * radius),
          .zero = intercept / slope,
          .prefactor = A,
          .residual = std::sqrt(difference / size)};
}

}  // namespace dmp::lattice_spring
