#include "rheology/laws.hpp"
#include <dmp/rheology/cross.hpp>

namespace rheology = dmp::rheology;

namespace {
rheology::Cross fluid(double at_rest, double in_fast_shear, double exponent) {
  return {.zero_shear_viscosity = at_rest, .infinite_shear_viscosity = in_fast_shear, .time_constant = 0.25, .exponent = exponent};
}
}  // namespace

TEST_CASE("Cross' fluid obeys the laws of a viscosity of the shear rate, and stays between its plateaus") {
  check_viscosity_of_shear_rate_laws(fluid(0.056, 0.00345, 1.028), Becomes::thinner, 0.00345, 0.056);  // blood
  check_viscosity_of_shear_rate_laws(fluid(10.0, 0.0, 2.0 / 3.0), Becomes::thinner, 0.0, 10.0);
  check_viscosity_of_shear_rate_laws(fluid(10.0, 1.0, 0.2), Becomes::thinner, 1.0, 10.0);
  check_viscosity_of_shear_rate_laws(fluid(1.0, 10.0, 2.0), Becomes::thicker, 1.0, 10.0);
}

TEST_CASE("Cross' fluid has its plateaus at rest and in very fast shear, and is half-way between them at 1/lambda") {
  for (const double exponent : {0.5, 2.0 / 3.0, 1.0, 2.0}) {
    CAPTURE(exponent);
    CHECK(fluid(9.0, 1.0, exponent).apparent_viscosity(0.0) == 9.0);
    CHECK(fluid(9.0, 1.0, exponent).apparent_viscosity(1e30) == doctest::Approx(1.0));
    CHECK(fluid(9.0, 1.0, exponent).apparent_viscosity(4.0) == doctest::Approx(5.0));
  }
}

TEST_CASE("Cross' fluid approaches its plateaus as powers m of the shear rate") {
  const auto above = [](double rate) { return fluid(9.0, 1.0, 0.5).apparent_viscosity(rate) - 1.0; };
  CHECK(above(1e12) / above(4e12) == doctest::Approx(2.0).epsilon(1e-5));
  const auto below = [](double rate) { return 9.0 - fluid(9.0, 1.0, 0.5).apparent_viscosity(rate); };
  CHECK(below(4e-12) / below(1e-12) == doctest::Approx(2.0).epsilon(1e-5));
}

TEST_CASE("Cross' fluid refuses parameters that are none") {
  CHECK(test::complaint_about(fluid(0.0, 1.0, 1.0)) == "rheology::Cross: zero_shear_viscosity must be finite and > 0 Pa s, got 0");
  CHECK(test::complaint_about(fluid(1.0, -1.0, 1.0)) == "rheology::Cross: infinite_shear_viscosity must be finite and >= 0 Pa s, got -1");
  CHECK(test::complaint_about(fluid(1.0, 0.0, 0.0)) == "rheology::Cross: exponent must be finite and > 0 [-], got 0");
  auto law = fluid(1.0, 0.0, 1.0);
  law.time_constant = NAN;
  CHECK(test::complaint_about(law) == "rheology::Cross: time_constant must be finite and > 0 s, got nan");
}
