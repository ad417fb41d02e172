#include "kernel/laws.hpp"
#include <dmp/kernel/cubic_spline.hpp>

namespace kernel = dmp::kernel;

TEST_CASE("the cubic spline obeys the laws of kernels in 1D, 2D and 3D") { check_kernel_laws<kernel::CubicSpline>(); }
TEST_CASE("the cubic spline ends at its support radius, whatever that is") { check_kernel_ends_at_its_support<kernel::CubicSpline>(); }
TEST_CASE("the cubic spline refuses a support radius that is no length") {
  check_kernel_refuses_bad_support<kernel::CubicSpline>("kernel::CubicSpline");
}

TEST_CASE("the cubic spline at r = 0 is 4/(3h), 40/(7 pi h^2), 8/(pi h^3), and a quarter of that at half the support") {
  constexpr double pi = 3.14159265358979323846;
  CHECK(test::relative_error(kernel::CubicSpline<1>{.support_radius = 1.0}.value(0.0), 4.0 / 3.0) < 1e-15);
  CHECK(test::relative_error(kernel::CubicSpline<2>{.support_radius = 1.0}.value(0.0), 40.0 / (7.0 * pi)) < 1e-15);
  CHECK(test::relative_error(kernel::CubicSpline<3>{.support_radius = 1.0}.value(0.0), 8.0 / pi) < 1e-15);
  CHECK(test::relative_error(kernel::CubicSpline<3>{.support_radius = 1.0}.value(0.5), 2.0 / pi) < 1e-15);
}

TEST_CASE("the cubic spline is smooth where its two halves meet") {
  const kernel::CubicSpline<2> spline{.support_radius = 1.0};
  const double below = std::nextafter(0.5, 0.0), above = std::nextafter(0.5, 1.0);
  CHECK(test::relative_error(spline.value(below), spline.value(above)) < 1e-14);
  CHECK(test::relative_error(spline.radial_factor(below), spline.radial_factor(above)) < 1e-14);
}

TEST_CASE("the cubic spline is as wide as Dehnen and Aly's table 1 says") {
  CHECK(test::relative_error(0.5 / standard_deviation(kernel::CubicSpline<1>{.support_radius = 1.0}), 1.732051) < 1e-6);
  CHECK(test::relative_error(0.5 / standard_deviation(kernel::CubicSpline<2>{.support_radius = 1.0}), 1.778002) < 1e-6);
  CHECK(test::relative_error(0.5 / standard_deviation(kernel::CubicSpline<3>{.support_radius = 1.0}), 1.825742) < 1e-6);
}
