#pragma once
#include <cmath>
#include "support/compare.hpp"
#include "support/dual.hpp"
#include <doctest/doctest.h>
#include <dmp/core/pack.hpp>
#include <dmp/thermal/concept.hpp>

/// What every thermal law must obey between two temperatures [K].
template <class L>
void check_thermal_laws(const L& law, double coldest, double hottest) {
  static_assert(dmp::thermal::explain_thermal_law<L>() && dmp::thermal::ThermalLaw<L>);
  static_assert(test::is_plain<L>);
  validate(law);
  const auto temperature = [&](const auto& e) { return law.temperature(e); };
  const auto energy = [&](const auto& kelvin) { return law.specific_energy(kelvin); };
  double largest_response = 0.0;
  for (const double kelvin : test::evenly(coldest, hottest, 101)) {
    CAPTURE(kelvin);
    const double e = energy(kelvin), response = test::slope(temperature, e);
    CHECK(std::fabs(law.temperature(e) - kelvin) <= 1e-12 * hottest);
    CHECK(test::relative_error(response * test::slope(energy, kelvin), 1.0) < 1e-12);  // each is the inverse of the other
    CHECK(response > 0.0);
    largest_response = std::fmax(largest_response, response);
    if constexpr (requires { law.admits(e); }) CHECK(law.admits(e) == (kelvin > 0.0));
  }
  CHECK(largest_response * law.specific_heat() <= 1.0 + 1e-12);  // a bound, and not a loose one
  CHECK(largest_response * law.specific_heat() >= 0.9);

  const auto energies = test::evenly(energy(coldest), energy(hottest), 256), temperatures = test::evenly(coldest, hottest, 256);
  CHECK(test::lane_error<double, dmp::native_width<double>>(temperature, energies) < 1e-14);
  CHECK(test::lane_error<double, dmp::native_width<double>>(energy, temperatures) < 1e-14);
  CHECK(test::lane_error<float, dmp::native_width<float>>(temperature, energies) < 1e-5);
  CHECK(test::lane_error<float, dmp::native_width<float>>(energy, temperatures) < 1e-5);
}
