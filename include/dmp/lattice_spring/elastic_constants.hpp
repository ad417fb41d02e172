#pragma once
#include <cmath>
#include <string>
#include <dmp/core/require.hpp>

namespace dmp::lattice_spring {

/// All constants of an isotropic elastic body in N = Dim = 2 or 3 dimensions, in Pa (N/m in 2D), made from any two of them. Central springs
/// alone have lambda = mu, Q = D = 0, nu = 1/(N + 1); the rest is borne by a dispersive force between the springs of a bead.
/// M. Kot, ChemEngineering 5 (2021) 3, doi:10.3390/chemengineering5010003, eqs. 1-13.
template <int Dim>
struct ElasticConstants {
  static_assert(Dim == 2 || Dim == 3, "dmp: elastic constants exist in 2 and 3 dimensions");
  double youngs_modulus;        ///< E = 2 mu (N lambda + 2 mu)/((N - 1) lambda + 2 mu), > 0
  double poisson_ratio;         ///< nu, -1 < nu < 1/(N - 1); near either end see warning()
  double shear_modulus;         ///< mu
  double first_lame_parameter;  ///< lambda
  double bulk_modulus;          ///< K = lambda + 2 mu/N
  double dispersion_ratio;      ///< Q = (lambda - mu)/(mu (1 + 2/N)) > -1
  double spring_modulus;        ///< C = mu (1 + |Q|): the shear modulus that the springs would have with the dispersive share in them
  double dispersive_share;      ///< D = Q/(1 + |Q|), -1/2 < D < 1; springs act directly with k (1 - |D|)

  /// nu of N = 3 below 1/2, of N = 2 below 1: beyond, the body would not resist compression.
  static constexpr double largest_poisson_ratio = 1.0 / (Dim - 1);
  /// nu outside of these is possible, and warned about. In 2D they have the Q of those of 3D, -0.993 and 13.8.
  static constexpr double least_advised = Dim == 3 ? -0.95 : -0.973, most_advised = Dim == 3 ? 0.48 : 0.935;

  /// What to expect of springs with such a nu, for the user to read; empty for advised ones. Nothing is printed.
  [[nodiscard]] std::string warning() const {
    if (poisson_ratio >= least_advised && poisson_ratio <= most_advised) return {};
    return "lattice_spring::ElasticConstants: poisson_ratio " + to_text(poisson_ratio) + " lies outside " + to_text(least_advised) +
           " to " + to_text(most_advised) +
           (poisson_ratio > 0.0 ? ": nearly incompressible; solvers take many steps, and undamped motion by Dispersion::by_number may grow"
                                : ": hardly resists compression; direct and dispersive forces nearly cancel, and solvers may stall without "
                                  "supports or Springs::added_share");
  }

  /// From lambda > -2 mu/N and mu > 0 [Pa].
  [[nodiscard]] static ElasticConstants from_lame(double first_lame_parameter, double shear_modulus) {
    require_positive("lattice_spring::ElasticConstants: shear_modulus", shear_modulus, "Pa");
    require_finite("lattice_spring::ElasticConstants: first_lame_parameter", first_lame_parameter, "Pa");
    const double lambda = first_lame_parameter, mu = shear_modulus, N = Dim, bulk = lambda + 2.0 * mu / N;
    if (!(bulk > 0.0))
      throw ParameterError("lattice_spring::ElasticConstants: first_lame_parameter must be > -2/" + std::to_string(Dim) +
                           " shear_modulus, got " + to_text(lambda) + " and " + to_text(mu) + " Pa");
    const double denominator = (N - 1.0) * lambda + 2.0 * mu, Q = (lambda - mu) / (mu * (1.0 + 2.0 / N));
    return {.youngs_modulus = 2.0 * mu * N * bulk / denominator,
            .poisson_ratio = lambda / denominator,
            .shear_modulus = mu,
            .first_lame_parameter = lambda,
            .bulk_modulus = bulk,
            .dispersion_ratio = Q,
            .spring_modulus = mu * (1.0 + std::abs(Q)),
            .dispersive_share = Q / (1.0 + std::abs(Q))};
  }

  /// From E > 0 [Pa] and -1 < nu < 1/(N - 1).
  [[nodiscard]] static ElasticConstants from_young(double youngs_modulus, double poisson_ratio) {
    require_positive("lattice_spring::ElasticConstants: youngs_modulus", youngs_modulus, "Pa");
    require(poisson_ratio > -1.0 && poisson_ratio < largest_poisson_ratio,
            Dim == 3 ? "lattice_spring::ElasticConstants: poisson_ratio in 3D must be > -1 and < 0.5"
                     : "lattice_spring::ElasticConstants: poisson_ratio in 2D must be > -1 and < 1",
            poisson_ratio);
    const double N = Dim, nu = poisson_ratio, mu = youngs_modulus / (2.0 * (1.0 + nu));
    ElasticConstants all = from_lame(2.0 * mu * nu / (1.0 - (N - 1.0) * nu), mu);
    all.youngs_modulus = youngs_modulus;
    all.poisson_ratio = nu;
    all.bulk_modulus = youngs_modulus / (N * (1.0 - (N - 1.0) * nu));  // without the cancellation of lambda + 2 mu/N near nu = -1
    return all;
  }

  /// From C > 0 [Pa] and -1/2 < D < 1: eqs. 9 and 10.
  [[nodiscard]] static ElasticConstants from_springs(double spring_modulus, double dispersive_share) {
    require_positive("lattice_spring::ElasticConstants: spring_modulus", spring_modulus, "Pa");
    require(dispersive_share > -0.5 && dispersive_share < 1.0, "lattice_spring::ElasticConstants: dispersive_share must be > -0.5 and < 1",
            dispersive_share);
    const double N = Dim, C = spring_modulus, D = dispersive_share;
    ElasticConstants all = from_lame(C * ((1.0 + 2.0 / N) * D - std::abs(D) + 1.0), C * (1.0 - std::abs(D)));
    all.bulk_modulus = C * (1.0 + 2.0 / N) * (D - std::abs(D) + 1.0);
    all.spring_modulus = C;
    all.dispersive_share = D;
    return all;
  }
};

}  // namespace dmp::lattice_spring
