#include "support/compare.hpp"
#include <doctest/doctest.h>
#include <dmp/core/field.hpp>
#include <dmp/core/pack.hpp>
#include <dmp/thermal/conductivity.hpp>

namespace thermal = dmp::thermal;

TEST_CASE("water of 0.6 W/(m K) has 0.6 W/(m K) everywhere, in numbers and in packs") {
  static_assert(test::is_plain<thermal::Conductivity> && sizeof(thermal::Conductivity) == sizeof(double));
  static_assert(thermal::Conductivity::reads::count == 0);
  static_assert(std::is_same_v<thermal::Conductivity::writes, dmp::Fields<dmp::field::ThermalConductivity>>);
  const thermal::Conductivity water{.thermal_conductivity = 0.6};
  validate(water);
  dmp::View<2, double, dmp::Fields<dmp::field::ThermalConductivity>> particle{};
  water.apply(particle);
  CHECK(particle.thermal_conductivity == 0.6);
  dmp::View<2, dmp::Pack<double, 2>, dmp::Fields<dmp::field::ThermalConductivity>> particles{};
  water.apply(particles);
  CHECK(particles.thermal_conductivity[0] == 0.6);
  CHECK(particles.thermal_conductivity[1] == 0.6);
}

TEST_CASE("a conductivity may be 0, an insulator, but not negative") {
  CHECK(test::complaint_about(thermal::Conductivity{.thermal_conductivity = 0.0}) == "");
  CHECK(test::complaint_about(thermal::Conductivity{.thermal_conductivity = -1.0}) ==
        "thermal::Conductivity: thermal_conductivity must be finite and >= 0 W/(m K), got -1");
  CHECK(test::complaint_about(thermal::Conductivity{.thermal_conductivity = NAN}) ==
        "thermal::Conductivity: thermal_conductivity must be finite and >= 0 W/(m K), got nan");
}
