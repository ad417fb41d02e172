#include "kernel/laws.hpp"
#include <dmp/kernel/wendland_c2.hpp>
#include <dmp/kernel/wendland_c4.hpp>

namespace kernel = dmp::kernel;

TEST_CASE("Wendland's C4 kernel obeys the laws of kernels in 1D, 2D and 3D") { check_kernel_laws<kernel::WendlandC4>(); }
TEST_CASE("Wendland's C4 kernel ends at its support radius, whatever that is") { check_kernel_ends_at_its_support<kernel::WendlandC4>(); }
TEST_CASE("Wendland's C4 kernel refuses a support radius that is no length") {
  check_kernel_refuses_bad_support<kernel::WendlandC4>("kernel::WendlandC4");
}

TEST_CASE("Wendland's C4 kernel is as wide as Dehnen and Aly's table 1 says") {
  CHECK(test::relative_error(0.5 / standard_deviation(kernel::WendlandC4<1>{.support_radius = 1.0}), 1.936492) < 1e-6);
  CHECK(test::relative_error(0.5 / standard_deviation(kernel::WendlandC4<2>{.support_radius = 1.0}), 2.171239) < 1e-6);
  CHECK(test::relative_error(0.5 / standard_deviation(kernel::WendlandC4<3>{.support_radius = 1.0}), 2.207940) < 1e-6);
}

TEST_CASE("Wendland's C4 kernel needs 1.14 times the support of C2 for the same width") {
  CHECK(standard_deviation(kernel::WendlandC2<2>{.support_radius = 1.0}) /
            standard_deviation(kernel::WendlandC4<2>{.support_radius = 1.0}) ==
        doctest::Approx(1.14).epsilon(0.005));
  CHECK(standard_deviation(kernel::WendlandC2<3>{.support_radius = 1.0}) /
            standard_deviation(kernel::WendlandC4<3>{.support_radius = 1.0}) ==
        doctest::Approx(1.14).epsilon(0.005));
}

TEST_CASE("Wendland's C4 kernel has a positive Fourier transform, so particles do not pair") {
  const kernel::WendlandC4<3> wendland{.support_radius = 1.0};
  for (const double k : test::evenly(1.0, 60.0, 60)) {
    CAPTURE(k);
    CHECK(test::integral([&](double r) { return 4.0 * 3.14159265358979 * r * std::sin(k * r) / k * wendland.value(r); }, 0.0, 1.0) > 0.0);
  }
}
