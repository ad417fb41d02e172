#include "rheology/laws.hpp"
#include <dmp/rheology/sutherland.hpp>

namespace rheology = dmp::rheology;

namespace {
constexpr rheology::TemperatureRange wide{.lowest = 100.0, .highest = 1900.0};
constexpr rheology::Sutherland air{.coefficient = 1.458e-6, .sutherland_temperature = 110.4, .temperature_range = wide};
}  // namespace

TEST_CASE("Sutherland's gas obeys the laws of a viscosity of the temperature, and thickens when heated") {
  check_viscosity_of_temperature_laws(air, Becomes::thicker);
  check_viscosity_of_temperature_laws(
      rheology::Sutherland{.coefficient = 1e-6, .sutherland_temperature = 0.0, .temperature_range = {.lowest = 1e-3, .highest = 1e5}},
      Becomes::thicker);
}

TEST_CASE("VISC-0: value of Sutherland's air; and at sea level of the U.S. Standard Atmosphere, 288.15 K, 1.7894e-5 Pa s") {
  CHECK(test::relative_error(air.viscosity(300.0), 1.84600e-5) < 1e-5);
  CHECK(test::relative_error(air.viscosity(288.15), 1.7894e-5) < 2e-5);  // printed with 5 digits
}

TEST_CASE("Sutherland's gas that is very hot, or without attraction, is one of hard spheres: four times as hot, twice as viscous") {
  const rheology::Sutherland spheres{.coefficient = 3.0, .sutherland_temperature = 0.0, .temperature_range = wide};
  CHECK(spheres.viscosity(400.0) / spheres.viscosity(100.0) == doctest::Approx(2.0));
  CHECK(spheres.viscosity(1.0) == doctest::Approx(3.0));
  CHECK(air.viscosity(4e9) / air.viscosity(1e9) == doctest::Approx(2.0));
  CHECK(air.viscosity(4e-6) / air.viscosity(1e-6) == doctest::Approx(8.0));  // very cold: T^(3/2)
}

TEST_CASE("Sutherland's gas refuses a repulsion, which it cannot have: its viscosity would be infinite at some temperature") {
  auto law = air;
  law.sutherland_temperature = -110.4;
  CHECK(test::complaint_about(law) == "rheology::Sutherland: sutherland_temperature must be finite and >= 0 K, got -110.4");
  law = air;
  law.coefficient = 0.0;
  CHECK(test::complaint_about(law) == "rheology::Sutherland: coefficient must be finite and > 0 Pa s K^(-1/2), got 0");
  CHECK_FALSE(air.admits(-110.4));
  CHECK_FALSE(air.admits(-1.0));  // the root would be no number
  CHECK(air.demand() == "rheology::Sutherland: temperature must be in [100, 1900] K");
}
