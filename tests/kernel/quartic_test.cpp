#include "kernel/laws.hpp"
#include "support/lattice.hpp"
#include <dmp/kernel/quartic.hpp>

namespace kernel = dmp::kernel;

TEST_CASE("the quartic kernel obeys the laws of kernels in 1D, 2D and 3D") { check_kernel_laws<kernel::Quartic>(); }
TEST_CASE("the quartic kernel ends at its support radius, whatever that is") { check_kernel_ends_at_its_support<kernel::Quartic>(); }
TEST_CASE("the quartic kernel refuses a support radius that is no length") {
  check_kernel_refuses_bad_support<kernel::Quartic>("kernel::Quartic");
}

TEST_CASE("the quartic kernel has the constants of the published codes") {
  CHECK(test::relative_error(kernel::Quartic<2>{.support_radius = 1.0}.value(0.0), 1.5915494309189535) < 1e-15);  // sheet 06, 2.1
  CHECK(test::relative_error(kernel::Quartic<3>{.support_radius = 1.0}.value(0.0), 2.1541870227086615) < 1e-15);
}

TEST_CASE("the quartic kernel sums these densities on square and hexagonal lattices") {
  struct Row {
    double support, square, hexagonal;
  };
  for (const Row row : {Row{1.3, 1.0464, 0.9516}, Row{1.5, 0.9773, 0.9627}, Row{2.0, 1.0009, 1.0068}, Row{2.6, 0.9982, 0.9998},
                        Row{3.0, 1.0000, 1.0003}}) {  // sheet 06, section 2.1
    CAPTURE(row.support);
    const kernel::Quartic<2> quartic{.support_radius = row.support};
    double square = quartic.value(0.0), hexagonal = quartic.value(0.0) * std::sqrt(0.75);
    test::for_each_site<2>(row.support, [&](const auto& x, double volume) { square += volume * quartic.value(std::sqrt(dot(x, x))); });
    test::for_each_hexagonal_site(row.support,
                                  [&](const auto& x, double volume) { hexagonal += volume * quartic.value(std::sqrt(dot(x, x))); });
    CHECK(std::fabs(square - row.square) <= 0.5001e-4);
    CHECK(std::fabs(hexagonal - row.hexagonal) <= 0.5001e-4);
  }
}
