#include "integrator/laws.hpp"
#include <dmp/integrator/leapfrog.hpp>

using dmp::integrator::Leapfrog;

TEST_CASE("leapfrog obeys the laws of integrators: second order, first in damping, reversible, stable to omega dt = 2 and lambda dt = 2") {
  static_assert(Leapfrog::oscillation_limit == 2.0 && Leapfrog::damping_limit == 2.0);
  check_integrator_laws<Leapfrog>(
      {.order = 2, .damped_order = 1, .state_order = 1, .position_exact = true, .reversible = true, .sound_limit = 0.71});
}

TEST_CASE("leapfrog swings an oscillator at the frequency 2 asin(omega dt/2)/dt, for ever") {
  for (const double step : {0.1, 0.5, 1.0, 1.9}) {
    CAPTURE(step);
    const double frequency = 2.0 * std::asin(0.5 * step) / step;
    auto p = test::particle<Leapfrog>(1.0, 0.0, [](double x, double, double) { return -x; });
    for (int n = 1; n <= 10000; ++n) {
      p.step(step);
      if (n % 1000 == 0) CHECK(std::fabs(p.x() - std::cos(frequency * n * step)) < 1e-9);
    }
  }
}

TEST_CASE("laws see the velocity half a step before the end") {
  double x = 0.0, v = 1.0;
  Leapfrog::begin(x, v, -0.5, 0.2);
  CHECK(Leapfrog::seen(v, -0.5, 0.2) == doctest::Approx(1.0 - 0.5 * 0.1).epsilon(1e-15));
}
