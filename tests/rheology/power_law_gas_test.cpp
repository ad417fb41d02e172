#include "rheology/laws.hpp"
#include <dmp/rheology/power_law_gas.hpp>

namespace rheology = dmp::rheology;

namespace {
rheology::PowerLawGas gas(double coefficient, double exponent) {
  return {.coefficient = coefficient, .exponent = exponent, .temperature_range = {.lowest = 200.0, .highest = 600.0}};
}
}  // namespace

TEST_CASE("a gas of molecules that repel each other obeys the laws of a viscosity of the temperature, and thickens when heated") {
  check_viscosity_of_temperature_laws(gas(4.093e-7, 2.0 / 3.0), Becomes::thicker);
  check_viscosity_of_temperature_laws(gas(1e-6, 0.5), Becomes::thicker);
  check_viscosity_of_temperature_laws(gas(1e-8, 1.0), Becomes::thicker);
}

TEST_CASE("VISC-0: value of air as a power-law gas") {
  CHECK(test::relative_error(gas(4.093e-7, 2.0 / 3.0).viscosity(300.0), 1.83424e-5) < 1e-5);
}

TEST_CASE("eight times as hot: air is 4 times, hard spheres are sqrt(8) times, Maxwell molecules are 8 times as viscous") {
  const auto factor = [](double exponent) { return gas(1e-6, exponent).viscosity(1600.0) / gas(1e-6, exponent).viscosity(200.0); };
  CHECK(factor(2.0 / 3.0) == doctest::Approx(4.0));
  CHECK(factor(0.5) == doctest::Approx(2.8284271247461903));
  CHECK(factor(1.0) == doctest::Approx(8.0));
  CHECK(gas(3.0, 0.7).viscosity(1.0) == 3.0);
}

TEST_CASE("a power-law gas refuses an exponent that cools it, and one that makes it infinite") {
  CHECK(test::complaint_about(gas(0.0, 0.5)) == "rheology::PowerLawGas: coefficient must be finite and > 0 Pa s K^(-n), got 0");
  CHECK(test::complaint_about(gas(1.0, -0.5)) == "rheology::PowerLawGas: exponent must be finite and > 0 [-], got -0.5");
  CHECK(test::complaint_about(gas(1.0, 150.0)) ==
        "rheology::PowerLawGas: viscosity at 200 K, an end of temperature_range, must be finite and > 0 Pa s, got inf");
}
