#include "rheology/laws.hpp"
#include <dmp/rheology/power_law.hpp>

namespace rheology = dmp::rheology;

namespace {
/// K = 3 Pa s^n, mu in [0.01, 1000] Pa s.
rheology::PowerLaw fluid(double index, double lowest_shear_rate) {
  return {.consistency_index = 3.0,
          .power_law_index = index,
          .lowest_shear_rate = lowest_shear_rate,
          .lowest_viscosity = 0.01,
          .highest_viscosity = 1000.0};
}
}  // namespace

TEST_CASE("power-law fluids obey the laws of a viscosity of the shear rate") {
  check_viscosity_of_shear_rate_laws(fluid(0.5, 0.25), Becomes::thinner, 0.01, 6.0);
  check_viscosity_of_shear_rate_laws(fluid(0.5, 1e-12), Becomes::thinner, 0.01, 1000.0);
  check_viscosity_of_shear_rate_laws(fluid(0.1, 1e-300), Becomes::thinner, 0.01, 1000.0);
  check_viscosity_of_shear_rate_laws(fluid(1.5, 0.25), Becomes::thicker, 1.5, 1000.0);
  check_viscosity_of_shear_rate_laws(fluid(1.5, 1e-300), Becomes::thicker, 0.01, 1000.0);
  check_viscosity_of_shear_rate_laws(fluid(1.0, 0.1), Becomes::thinner, 3.0, 3.0);
  check_viscosity_of_shear_rate_laws(fluid(1.0, 0.1), Becomes::thicker, 3.0, 3.0);
}

TEST_CASE("a power-law fluid that is sheared much faster than its lowest shear rate has the shear stress K g^n") {
  CHECK(16.0 * fluid(0.5, 1e-6).apparent_viscosity(16.0) == doctest::Approx(12.0));
  CHECK(16.0 * fluid(1.5, 1e-6).apparent_viscosity(16.0) == doctest::Approx(192.0));
  CHECK(fluid(0.25, 1e-6).apparent_viscosity(1.0) == doctest::Approx(3.0));
}

TEST_CASE("a power-law fluid at rest: n < 1 and n > 1 have the viscosity of the lowest shear rate, or the limit that comes first") {
  CHECK(fluid(0.5, 0.25).apparent_viscosity(0.0) == doctest::Approx(6.0));  // 3/sqrt(1/4)
  CHECK(fluid(1.5, 0.25).apparent_viscosity(0.0) == doctest::Approx(1.5));  // 3 sqrt(1/4)
  CHECK(fluid(0.5, 1e-9).apparent_viscosity(0.0) == 1000.0);
  CHECK(fluid(1.5, 1e-9).apparent_viscosity(0.0) == 0.01);
  CHECK(fluid(0.5, 3.0).apparent_viscosity(4.0) == doctest::Approx(3.0 / 2.23606797749979));  // sqrt(3^2 + 4^2) = 5
}

TEST_CASE("a power-law fluid in very fast shear stops at the other limit") {
  CHECK(fluid(0.5, 0.25).apparent_viscosity(1e9) == 0.01);
  CHECK(fluid(1.5, 0.25).apparent_viscosity(1e9) == 1000.0);
}

TEST_CASE("a power-law fluid refuses parameters that are none") {
  const auto complaint = [](auto member, double value) {
    auto law = fluid(0.5, 0.1);
    law.*member = value;
    return test::complaint_about(law);
  };
  using Law = rheology::PowerLaw;
  CHECK(complaint(&Law::consistency_index, 0.0) == "rheology::PowerLaw: consistency_index must be finite and > 0 Pa s^n, got 0");
  CHECK(complaint(&Law::power_law_index, 0.0) == "rheology::PowerLaw: power_law_index must be finite and > 0 [-], got 0");
  CHECK(complaint(&Law::lowest_shear_rate, 0.0) == "rheology::PowerLaw: lowest_shear_rate must be finite and > 0 1/s, got 0");
  CHECK(complaint(&Law::lowest_viscosity, -1.0) == "rheology::PowerLaw: lowest_viscosity must be finite and >= 0 Pa s, got -1");
  CHECK(complaint(&Law::highest_viscosity, INFINITY) == "rheology::PowerLaw: highest_viscosity must be finite and > 0 Pa s, got inf");
  CHECK(complaint(&Law::highest_viscosity, 0.001) ==
        "rheology::PowerLaw: highest_viscosity must be >= lowest_viscosity = 0.01 Pa s, got 0.001");
}
