#pragma once
#include <cmath>
#include "support/compare.hpp"
#include "support/dual.hpp"
#include <doctest/doctest.h>
#include <dmp/core/pack.hpp>
#include <dmp/eos/concept.hpp>

/// What every p(rho) must obey. `background_pressure` is the pressure that it states at rho0.
template <class E>
void check_equation_of_state_laws(const E& eos, double background_pressure) {
  static_assert(dmp::eos::explain_equation_of_state<E>() && dmp::eos::EquationOfState<E>);
  static_assert(test::is_plain<E>);
  const double rho0 = eos.rest_density;
  const double stiffness = rho0 * eos.sound_speed(rho0) * eos.sound_speed(rho0);  // [Pa], the scale of every error
  CAPTURE(rho0);
  const auto p = [&](const auto& rho) { return eos.pressure(rho); };

  validate(eos);
  CHECK(std::fabs(p(rho0) - background_pressure) <= 1e-13 * stiffness);
  double before = p(0.699 * rho0);
  for (const double rho : test::evenly(0.7 * rho0, 1.3 * rho0, 101)) {
    CAPTURE(rho);
    const double c = eos.sound_speed(rho);
    CHECK(test::relative_error(c * c, test::slope(p, rho)) < 1e-12);  // c^2 = dp/drho
    CHECK(p(rho) > before);
    CHECK(test::relative_error(eos.density(p(rho)), rho) < 1e-12);
    before = p(rho);
  }
  CHECK(std::isfinite(p(0.0)));
  CHECK(std::isfinite(p(10.0 * rho0)));

  const auto densities = test::evenly(0.7 * rho0, 1.3 * rho0, 256);
  const auto c = [&](const auto& rho) { return eos.sound_speed(rho); };
  const auto inverse = [&](const auto& rho) { return eos.density(eos.pressure(rho)); };
  CHECK(test::lane_error<double, dmp::native_width<double>>(p, densities) < 1e-14);
  CHECK(test::lane_error<double, dmp::native_width<double>>(c, densities) < 1e-14);
  CHECK(test::lane_error<double, dmp::native_width<double>>(inverse, densities) < 1e-14);
  CHECK(test::lane_error<float, dmp::native_width<float>>(p, densities) < 1e-5);
  CHECK(test::lane_error<float, dmp::native_width<float>>(c, densities) < 1e-5);
}

/// What every p(rho, e) must obey, around one state.
template <class E>
void check_thermal_equation_of_state_laws(const E& eos, double density, double specific_energy) {
  static_assert(dmp::eos::explain_equation_of_state<E>() && dmp::eos::ThermalEquationOfState<E>);
  static_assert(test::is_plain<E>);
  validate(eos);
  for (const double rho : test::evenly(0.5 * density, 2.0 * density, 7))
    for (const double e : test::evenly(0.5 * specific_energy, 2.0 * specific_energy, 7)) {
      CAPTURE(rho);
      CAPTURE(e);
      using test::Dual;
      const double p = eos.pressure(rho, e), c = eos.sound_speed(rho, e);
      const double by_density = test::slope([&](Dual x) { return eos.pressure(x, Dual(e)); }, rho);
      const double by_energy = test::slope([&](Dual x) { return eos.pressure(Dual(rho), x); }, e);
      CHECK(test::relative_error(c * c, by_density + p / (rho * rho) * by_energy) < 1e-12);  // dp/drho at constant entropy
      CHECK(test::relative_error(eos.specific_energy(p, rho), e) < 1e-12);
      CHECK(by_energy > 0.0);
    }
  const auto energies = test::evenly(0.5 * specific_energy, 2.0 * specific_energy, 256);
  const auto p = [&](const auto& e) { return eos.pressure(std::decay_t<decltype(e)>(density), e); };
  const auto c = [&](const auto& e) { return eos.sound_speed(std::decay_t<decltype(e)>(density), e); };
  CHECK(test::lane_error<double, dmp::native_width<double>>(p, energies) < 1e-14);
  CHECK(test::lane_error<double, dmp::native_width<double>>(c, energies) < 1e-14);
  CHECK(test::lane_error<float, dmp::native_width<float>>(p, energies) < 1e-5);
  CHECK(test::lane_error<float, dmp::native_width<float>>(c, energies) < 1e-5);
}
