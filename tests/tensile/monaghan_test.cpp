#include "tensile/laws.hpp"
#include <dmp/kernel/cubic_spline.hpp>
#include <dmp/tensile/monaghan.hpp>

namespace tensile = dmp::tensile;

namespace {

constexpr double spacing = 1.0;
const dmp::kernel::CubicSpline<2> kernel{.support_radius = 2.6 * spacing};  // the spline and the 1.3 spacings of the source
const tensile::Monaghan law{.spacing = spacing};

double correction(double P_i, double P_j, double distance) {
  test::Particle<2> i{}, j{};
  i.pressure_term = P_i;
  j.pressure_term = P_j;
  j.position[0] = distance;
  return law.correction(test::pair_of<2>(i, j), i, j, kernel);
}

}  // namespace

TEST_CASE("Monaghan's tensile correction obeys the laws of tensile corrections in 1D, 2D and 3D") {
  static_assert(sizeof(tensile::Monaghan) == 3 * sizeof(double));
  check_tensile_laws<1>(tensile::Monaghan{.spacing = 0.4});
  check_tensile_laws<2>(tensile::Monaghan{.spacing = 0.4});
  check_tensile_laws<3>(tensile::Monaghan{.spacing = 0.4, .strength = 0.3, .exponent = 3.5});
}

TEST_CASE("at the particle spacing a fifth of the tension comes back as repulsion, a hundredth of a pressure") {
  CHECK(correction(-10.0, -5.0, spacing) == doctest::Approx(0.2 * 15.0).epsilon(1e-12));
  CHECK(correction(-10.0, 5.0, spacing) == doctest::Approx(0.2 * 10.0).epsilon(1e-12));
  CHECK(correction(10.0, -5.0, spacing) == doctest::Approx(0.2 * 5.0).epsilon(1e-12));
  CHECK(correction(10.0, 5.0, spacing) == doctest::Approx(0.01 * 15.0).epsilon(1e-12));
}

TEST_CASE("the repulsion grows 23.6-fold from the spacing to contact, and fades beyond") {
  const double at_spacing = 1.0 - 6.0 / (2.6 * 2.6) + 6.0 / (2.6 * 2.6 * 2.6);  // M4 spline at q = 1/2.6, 1 at q = 0
  CHECK(correction(-1.0, -1.0, 0.0) / correction(-1.0, -1.0, spacing) == doctest::Approx(std::pow(1.0 / at_spacing, 4)).epsilon(1e-12));
  CHECK(correction(-1.0, -1.0, 0.0) / correction(-1.0, -1.0, spacing) == doctest::Approx(23.6).epsilon(2e-3));
  CHECK(correction(-1.0, -1.0, 2.0 * spacing) < 0.01 * correction(-1.0, -1.0, spacing));
  CHECK(correction(-1.0, -1.0, 2.6 * spacing) == 0.0);
}

TEST_CASE("Monaghan's tensile correction refuses parameters that would attract or are no number") {
  using Correction = tensile::Monaghan;
  CHECK(test::complaint_about(Correction{.spacing = 0.0}) == "tensile::Monaghan: spacing must be finite and > 0 m, got 0");
  CHECK(test::complaint_about(Correction{.spacing = 1.0, .strength = -0.2}) ==
        "tensile::Monaghan: strength must be finite and >= 0 [-], got -0.2");
  CHECK(test::complaint_about(Correction{.spacing = 1.0, .exponent = 0.0}) == "tensile::Monaghan: exponent must be > 0 and <= 16, got 0");
  CHECK(test::complaint_about(Correction{.spacing = NAN}) == "tensile::Monaghan: spacing must be finite and > 0 m, got nan");
}
