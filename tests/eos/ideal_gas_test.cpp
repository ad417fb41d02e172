#include "eos/laws.hpp"
#include <dmp/eos/ideal_gas.hpp>

namespace eos = dmp::eos;

TEST_CASE("the ideal gas obeys the laws of thermal equations of state") {
  check_thermal_equation_of_state_laws(eos::IdealGas{}, 1.2, 2e5);
  check_thermal_equation_of_state_laws(eos::IdealGas{.heat_capacity_ratio = 5.0 / 3.0}, 0.17, 9e5);
  check_thermal_equation_of_state_laws(eos::IdealGas{}, 1.0, 1e12);
}

TEST_CASE("air at sea level of the standard atmosphere (101325 Pa, 1.2250 kg/m^3) carries sound at 340.294 m/s") {
  const eos::IdealGas air{};  // ISO 2533: 288.15 K
  const double e = air.specific_energy(101325.0, 1.2250);
  CHECK(air.sound_speed(1.2250, e) == doctest::Approx(340.294).epsilon(1e-5));
  CHECK(e == doctest::Approx(2.5 * 287.05287 * 288.15).epsilon(1e-5));  // five degrees of freedom, R = 287.05287 J/(kg K)
}

TEST_CASE("a gas of molecules without energy has neither pressure nor sound") {
  CHECK(eos::IdealGas{}.pressure(1.2, 0.0) == 0.0);
  CHECK(eos::IdealGas{}.sound_speed(1.2, 0.0) == 0.0);
}

TEST_CASE("the ideal gas refuses a heat capacity ratio of 1 and less") {
  CHECK(test::complaint_about(eos::IdealGas{.heat_capacity_ratio = 1.0}) ==
        "eos::IdealGas: heat_capacity_ratio must be > 1 and < 1000, got 1");
  CHECK(test::complaint_about(eos::IdealGas{.heat_capacity_ratio = NAN}) ==
        "eos::IdealGas: heat_capacity_ratio must be > 1 and < 1000, got nan");
}

TEST_CASE("the ideal gas does not admit a specific energy or a density of 0 and less") {
  const eos::IdealGas air{};
  CHECK(air.admits(1.2, 2e5));
  CHECK(air.admits(1e-300, 1e-300));
  for (const double nothing : {0.0, -0.0, -1.0, double(NAN), double(-INFINITY)}) {
    CAPTURE(nothing);
    CHECK_FALSE(air.admits(1.2, nothing));
    CHECK_FALSE(air.admits(nothing, 2e5));
  }
  CHECK(air.demand() == "eos::IdealGas: specific_energy must be > 0 J/kg and density > 0 kg/m^3");
}
