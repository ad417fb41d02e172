#include "thermal/laws.hpp"
#include <dmp/thermal/linear.hpp>

namespace thermal = dmp::thermal;

TEST_CASE("the linear thermal law obeys the laws of thermal laws") {
  check_thermal_laws(thermal::Linear{.specific_heat_capacity = 4117.5, .reference_temperature = 300.0}, 273.15, 373.15);
  check_thermal_laws(thermal::Linear{.specific_heat_capacity = 385.0, .reference_temperature = 293.15, .reference_energy = -2e5}, 1.0,
                     1300.0);
  check_thermal_laws(thermal::Linear{.specific_heat_capacity = 1.0}, 0.1, 2.0);
}

TEST_CASE("4184 J heat a kilogram of water by 1 K, one thermochemical kilocalorie") {
  const thermal::Linear water{.specific_heat_capacity = 4184.0, .reference_temperature = 288.0, .reference_energy = 1e5};
  CHECK(water.temperature(1e5) == 288.0);
  CHECK(water.temperature(1e5 + 4184.0) == doctest::Approx(289.0).epsilon(1e-14));
  CHECK(water.specific_energy(288.0) == 1e5);
}

TEST_CASE("the specific heat is per kilogram: one joule warms a particle of 2.16e-8 kg by 1/(m c) = 11244 K, not by 1/c = 0.24 mK") {
  const double mass = 2.16e-8, c = 4117.5, energy = 1.0;  // [kg], [J/(kg K)], [J] of the particle
  CHECK(thermal::Linear{.specific_heat_capacity = c}.temperature(energy / mass) == doctest::Approx(11243.8).epsilon(1e-5));
}

TEST_CASE("the linear thermal law admits what is warmer than 0 K, at negative energies too") {
  const thermal::Linear water{.specific_heat_capacity = 4000.0, .reference_temperature = 300.0, .reference_energy = 2e5};
  CHECK(water.admits(-1e6 + 1.0));
  CHECK_FALSE(water.admits(-1e6));
  CHECK_FALSE(water.admits(-2e6));
  CHECK_FALSE(water.admits(double(NAN)));
  CHECK(water.demand() == "thermal::Linear: temperature must be > 0 K, that is specific_energy > -1e+06 J/kg");
}

TEST_CASE("the linear thermal law refuses parameters that are no material") {
  CHECK(test::complaint_about(thermal::Linear{.specific_heat_capacity = 0.0}) ==
        "thermal::Linear: specific_heat_capacity must be finite and > 0 J/(kg K), got 0");
  CHECK(test::complaint_about(thermal::Linear{.specific_heat_capacity = 1.0, .reference_temperature = -273.15}) ==
        "thermal::Linear: reference_temperature must be finite and >= 0 K, got -273.15");
  CHECK(test::complaint_about(thermal::Linear{.specific_heat_capacity = 1.0, .reference_energy = NAN}) ==
        "thermal::Linear: reference_energy must be finite [J/kg], got nan");
}
