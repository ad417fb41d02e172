#include "kernel/laws.hpp"
#include <dmp/kernel/lucy.hpp>
#include <dmp/kernel/wendland_c2.hpp>

namespace kernel = dmp::kernel;

TEST_CASE("Wendland's C2 kernel obeys the laws of kernels in 1D, 2D and 3D") { check_kernel_laws<kernel::WendlandC2>(); }
TEST_CASE("Wendland's C2 kernel ends at its support radius, whatever that is") { check_kernel_ends_at_its_support<kernel::WendlandC2>(); }
TEST_CASE("Wendland's C2 kernel refuses a support radius that is no length") {
  check_kernel_refuses_bad_support<kernel::WendlandC2>("kernel::WendlandC2");
}

TEST_CASE("Wendland's C2 kernel is as wide as Dehnen and Aly's table 1 says") {
  CHECK(test::relative_error(0.5 / standard_deviation(kernel::WendlandC2<1>{.support_radius = 1.0}), 1.620185) < 1e-6);
  CHECK(test::relative_error(0.5 / standard_deviation(kernel::WendlandC2<2>{.support_radius = 1.0}), 1.897367) < 1e-6);
  CHECK(test::relative_error(0.5 / standard_deviation(kernel::WendlandC2<3>{.support_radius = 1.0}), 1.936492) < 1e-6);
}

TEST_CASE("Wendland's C2 kernel is Lucy's on the line, and not in space") {
  for (const double r : {0.0, 0.2, 0.7, 0.95}) {
    CAPTURE(r);
    CHECK(test::relative_error(kernel::WendlandC2<1>{.support_radius = 1.0}.value(r), kernel::Lucy<1>{.support_radius = 1.0}.value(r)) <
          1e-14);
    CHECK(test::relative_error(kernel::WendlandC2<3>{.support_radius = 1.0}.value(r), kernel::Lucy<3>{.support_radius = 1.0}.value(r)) >
          0.1);
  }
}

TEST_CASE("Wendland's C2 kernel damps at 14/h^2 in 2D and in 3D") {
  CHECK(dmp::kernel::radial_factor_integral(kernel::WendlandC2<2>{.support_radius = 0.5}) == doctest::Approx(56.0).epsilon(1e-5));
  CHECK(dmp::kernel::radial_factor_integral(kernel::WendlandC2<3>{.support_radius = 0.5}) == doctest::Approx(56.0).epsilon(1e-5));
}

TEST_CASE("Wendland's C2 kernel has a positive Fourier transform, so particles do not pair") {
  const kernel::WendlandC2<3> wendland{.support_radius = 1.0};
  for (const double k : test::evenly(1.0, 60.0, 60)) {
    CAPTURE(k);
    CHECK(test::integral([&](double r) { return 4.0 * 3.14159265358979 * r * std::sin(k * r) / k * wendland.value(r); }, 0.0, 1.0) > 0.0);
  }
}
