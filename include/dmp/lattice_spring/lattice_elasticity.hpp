#pragma once
#include <numbers>
#include <dmp/core/require.hpp>
#include <dmp/lattice_spring/elastic_constants.hpp>
#include <dmp/lattice_spring/lattice.hpp>

/// From the stiffness of the springs of a lattice to the elastic constants, and back. All have lambda = mu, so nu = 1/4 in 3D and 1/3 in
/// 2D; from C_ijkl = (1/V) sum of k L^2 n_i n_j n_k n_l over the bonds of a cell. M. Kot, ChemEngineering 5 (2021) 3,
/// doi:10.3390/chemengineering5010003, eq. 3.
namespace dmp::lattice_spring {

namespace detail {
// Shear modulus per stiffness of a bond with weight 1.
[[nodiscard]] inline double shear_per_stiffness(const CubicLattice& lattice) { return 1.0 / lattice.spacing; }    // [1/m]
[[nodiscard]] inline double shear_per_stiffness(const TriangularLattice&) { return 0.25 * std::numbers::sqrt3; }  // [-]
[[nodiscard]] inline double shear_per_stiffness(const SquareLattice&) { return 0.5; }                             // [-]
}  // namespace detail

/// Constants of a lattice whose bonds have this stiffness [N/m] (times their weights).
template <SpringLattice L>
[[nodiscard]] ElasticConstants<L::dimension> elastic_constants(const L& lattice, double stiffness) {
  validate(lattice);
  require_positive("lattice_spring::elastic_constants: stiffness", stiffness, "N/m");
  const double mu = stiffness * detail::shear_per_stiffness(lattice);
  return ElasticConstants<L::dimension>::from_lame(mu, mu);
}

/// Stiffness [N/m] of the bonds of a lattice with this Young's modulus [Pa, in 2D N/m]: E l/2.5 of the cubic, (sqrt(3)/2) E of the
/// triangular, (3/4) E of the square lattice.
template <SpringLattice L>
[[nodiscard]] double stiffness_for(const L& lattice, double youngs_modulus) {
  validate(lattice);
  require_positive("lattice_spring::stiffness_for: youngs_modulus", youngs_modulus, "Pa");
  constexpr double N = L::dimension;
  return youngs_modulus * (N + 1.0) / (2.0 * (N + 2.0)) / detail::shear_per_stiffness(lattice);  // E = 2 mu (N + 2)/(N + 1), eq. 3 of Kot
}

}  // namespace dmp::lattice_spring
