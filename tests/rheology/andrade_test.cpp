#include "rheology/laws.hpp"
#include <dmp/rheology/andrade.hpp>

namespace rheology = dmp::rheology;

namespace {
rheology::Andrade liquid(double inverse, double linear, double quadratic, double lowest = 273.0, double highest = 373.0) {
  return {.pre_exponential_factor = 1e-6,
          .inverse_coefficient = inverse,
          .linear_coefficient = linear,
          .quadratic_coefficient = quadratic,
          .temperature_range = {.lowest = lowest, .highest = highest}};
}
}  // namespace

TEST_CASE("Andrade's liquid obeys the laws of a viscosity of the temperature") {
  check_viscosity_of_temperature_laws(liquid(1000.0, 1e-3, 1e-6), Becomes::thinner);
  check_viscosity_of_temperature_laws(liquid(1000.0, -1e-2, 0.0, 100.0, 1000.0), Becomes::thinner);
  check_viscosity_of_temperature_laws(liquid(0.0, 0.0, 1e-5), Becomes::thicker);
}

TEST_CASE("VISC-0: value of Andrade's liquid") {
  CHECK(test::relative_error(liquid(1000.0, 1e-3, 1e-6).viscosity(300.0), 4.1402e-5) < 1e-5);
}

TEST_CASE("Andrade's liquid, each coefficient alone: the same step of 1/T, of T and of T^2 is the same factor of the viscosity") {
  const auto factor = [](const rheology::Andrade& law, double from, double to) { return law.viscosity(to) / law.viscosity(from); };
  CHECK(factor(liquid(800.0 * std::log(2.0), 0.0, 0.0), 400.0, 800.0 / 3.0) == doctest::Approx(2.0));  // 2/800 to 3/800
  CHECK(factor(liquid(0.0, -0.1 * std::log(2.0), 0.0), 310.0, 300.0) == doctest::Approx(2.0));
  CHECK(factor(liquid(0.0, 0.0, 1e-4 * std::log(2.0)), 240.0, 260.0) == doctest::Approx(2.0));  // 67600 - 57600 = 1e4
}

TEST_CASE("Andrade's liquid refuses a range whose end is infinitely viscous, or not at all, and parameters that are no numbers") {
  CHECK(test::complaint_about(liquid(0.0, 0.0, 1e-3, 273.0, 800.0)).empty());
  CHECK(test::complaint_about(liquid(0.0, 0.0, 1e-3, 273.0, 1000.0)) ==
        "rheology::Andrade: viscosity at 1000 K, an end of temperature_range, must be finite and > 0 Pa s, got inf");
  CHECK(test::complaint_about(liquid(0.0, -1.0, 0.0, 273.0, 1000.0)) ==
        "rheology::Andrade: viscosity at 1000 K, an end of temperature_range, must be finite and > 0 Pa s, got 0");
  CHECK(test::complaint_about(liquid(NAN, 0.0, 0.0)) == "rheology::Andrade: inverse_coefficient must be finite [K], got nan");
  CHECK(test::complaint_about(liquid(0.0, INFINITY, 0.0)) == "rheology::Andrade: linear_coefficient must be finite [1/K], got inf");
  CHECK(test::complaint_about(liquid(0.0, 0.0, NAN)) == "rheology::Andrade: quadratic_coefficient must be finite [1/K^2], got nan");
  auto law = liquid(0.0, 0.0, 0.0);
  law.pre_exponential_factor = -1.0;
  CHECK(test::complaint_about(law) == "rheology::Andrade: pre_exponential_factor must be finite and > 0 Pa s, got -1");
}
