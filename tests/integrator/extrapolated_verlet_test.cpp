#include "integrator/laws.hpp"
#include <dmp/integrator/extrapolated_verlet.hpp>
#include <dmp/integrator/leapfrog.hpp>

using dmp::integrator::ExtrapolatedVerlet;

TEST_CASE(
    "extrapolated-velocity Verlet obeys the laws of integrators: second order also in damping, stable to omega dt = 2 and lambda dt = 1") {
  static_assert(ExtrapolatedVerlet::oscillation_limit == 2.0 && ExtrapolatedVerlet::damping_limit == 1.0);
  check_integrator_laws<ExtrapolatedVerlet>(
      {.order = 2, .damped_order = 2, .state_order = 2, .position_exact = true, .reversible = true, .sound_limit = 0.76});
}

TEST_CASE("laws see the velocity at the end of the step: exactly, if the acceleration is constant") {
  double x = 0.0, v = 1.0;
  ExtrapolatedVerlet::begin(x, v, -0.5, 0.25);
  CHECK(ExtrapolatedVerlet::seen(v, -0.5, 0.25) == 1.0 - 0.5 * 0.25);
  ExtrapolatedVerlet::end(v, -0.5, 0.25);
  CHECK(v == 1.0 - 0.5 * 0.25);
}

TEST_CASE("without forces of velocity it is the leapfrog, bit for bit") {
  const auto pendulum = [](double x, double, double) { return -std::sin(x); };
  auto one = test::particle<ExtrapolatedVerlet>(1.0, 0.5, pendulum).run(1000, 0.1);
  auto other = test::particle<dmp::integrator::Leapfrog>(1.0, 0.5, pendulum).run(1000, 0.1);
  CHECK(one.x() == other.x());
  CHECK(one.v() == other.v());
}

TEST_CASE("extrapolated-velocity Verlet damps sound by about (omega dt)^4/8 per step") {
  for (const double step : {0.15, 0.2, 0.3}) {
    CAPTURE(step);
    const int steps = static_cast<int>(8.0 / std::pow(step, 4));
    CHECK(std::log(test::loudness<ExtrapolatedVerlet>(step, 2 * steps) / test::loudness<ExtrapolatedVerlet>(step, steps)) ==
          doctest::Approx(-1.0).epsilon(0.2));
  }
}
