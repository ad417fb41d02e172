#include "kernel/laws.hpp"
#include "support/lattice.hpp"
#include <dmp/kernel/lucy.hpp>

namespace kernel = dmp::kernel;

TEST_CASE("Lucy's kernel obeys the laws of kernels in 1D, 2D and 3D") { check_kernel_laws<kernel::Lucy>(); }
TEST_CASE("Lucy's kernel ends at its support radius, whatever that is") { check_kernel_ends_at_its_support<kernel::Lucy>(); }
TEST_CASE("Lucy's kernel refuses a support radius that is no length") { check_kernel_refuses_bad_support<kernel::Lucy>("kernel::Lucy"); }

TEST_CASE("Lucy's kernel has the constants of the published codes: 60/pi in 2D, 315/(4 pi) in 3D") {
  constexpr double h = 1.0, r = 0.4;  // sheet 06, section 2.1
  CHECK(test::relative_error(kernel::Lucy<2>{.support_radius = h}.value(0.0), 1.5915494309189535) < 1e-15);
  CHECK(test::relative_error(kernel::Lucy<3>{.support_radius = h}.value(0.0), 2.0889086280811263) < 1e-15);
  CHECK(test::relative_error(kernel::Lucy<2>{.support_radius = h}.radial_factor(r), -19.098593171027440 * (h - r) * (h - r)) < 1e-14);
  CHECK(test::relative_error(kernel::Lucy<3>{.support_radius = h}.radial_factor(r), -25.066903536973515 * (h - r) * (h - r)) < 1e-14);
  CHECK(test::relative_error(kernel::Lucy<1>{.support_radius = h}.radial_factor(r), -15.0 * (h - r) * (h - r)) < 1e-14);
}

TEST_CASE("Lucy's kernel damps at 10/h^2 in 2D and 10.5/h^2 in 3D") {
  CHECK(dmp::kernel::radial_factor_integral(kernel::Lucy<2>{.support_radius = 2.0}) == doctest::Approx(10.0 / 4.0).epsilon(1e-5));
  CHECK(dmp::kernel::radial_factor_integral(kernel::Lucy<3>{.support_radius = 2.0}) == doctest::Approx(10.5 / 4.0).epsilon(1e-5));
}

TEST_CASE("Lucy's kernel delivers this share of a gradient on square, hexagonal and cubic lattices") {
  struct Row {
    double support, square, hexagonal, square_density, hexagonal_density;
  };
  for (const Row row :
       {Row{1.3, 0.7122, 0.9252, 1.0949, 1.0145}, Row{1.5, 0.8877, 1.0890, 1.0238, 1.0210}, Row{2.0, 1.0064, 0.9423, 1.0201, 1.0086},
        Row{2.6, 1.0061, 1.0055, 1.0000, 1.0041}, Row{3.0, 1.0008, 0.9924, 1.0029, 1.0003}}) {  // sheet 06, section 2.1
    CAPTURE(row.support);
    const kernel::Lucy<2> lucy{.support_radius = row.support};
    double square = 0.0, hexagonal = 0.0, square_density = lucy.value(0.0), hexagonal_density = lucy.value(0.0) * std::sqrt(0.75);
    test::for_each_site<2>(row.support, [&](const auto& x, double volume) {
      square -= volume * lucy.radial_factor(std::sqrt(dot(x, x))) * x[0] * x[0];
      square_density += volume * lucy.value(std::sqrt(dot(x, x)));
    });
    test::for_each_hexagonal_site(row.support, [&](const auto& x, double volume) {
      hexagonal -= volume * lucy.radial_factor(std::sqrt(dot(x, x))) * x[0] * x[0];
      hexagonal_density += volume * lucy.value(std::sqrt(dot(x, x)));
    });
    CHECK(std::fabs(square - row.square) <= 0.5001e-4);
    CHECK(std::fabs(hexagonal - row.hexagonal) <= 0.5001e-4);
    CHECK(std::fabs(square_density - row.square_density) <= 0.5001e-4);
    CHECK(std::fabs(hexagonal_density - row.hexagonal_density) <= 0.5001e-4);
  }
  struct Cubic {
    double support, share;
  };
  for (const Cubic cubic :
       {Cubic{2.25, 0.976}, Cubic{2.5, 0.968}, Cubic{2.75, 1.013}, Cubic{3.0, 1.006}, Cubic{3.5, 0.998}}) {  // sheet 02, 2.1
    CAPTURE(cubic.support);
    const kernel::Lucy<3> lucy{.support_radius = cubic.support};
    double share = 0.0;
    test::for_each_site<3>(cubic.support,
                           [&](const auto& x, double volume) { share -= volume * lucy.radial_factor(std::sqrt(dot(x, x))) * x[0] * x[0]; });
    CHECK(std::fabs(share - cubic.share) <= 0.5001e-3);
  }
}
