#include "integrator/laws.hpp"
#include <dmp/integrator/symplectic_euler.hpp>

using dmp::integrator::SymplecticEuler;

TEST_CASE("symplectic Euler obeys the laws of integrators: first order, not reversible, stable to omega dt = 2 and lambda dt = 2") {
  static_assert(SymplecticEuler::oscillation_limit == 2.0 && SymplecticEuler::damping_limit == 2.0);
  check_integrator_laws<SymplecticEuler>(
      {.order = 1, .damped_order = 1, .state_order = 1, .position_exact = false, .reversible = false, .sound_limit = 0.71});
}

TEST_CASE("symplectic Euler keeps v^2 + x^2 - dt x v of an oscillator, not its energy") {
  constexpr double step = 0.5;
  auto p = test::particle<SymplecticEuler>(1.0, 0.0, [](double x, double, double) { return -x; });
  double most = 0.0;
  for (int n = 0; n < 10000; ++n) {
    p.step(step);
    CHECK(std::fabs(p.v() * p.v() + p.x() * p.x() - step * p.x() * p.v() - 1.0) < 1e-11);
    most = std::max(most, std::fabs(p.v() * p.v() + p.x() * p.x() - 1.0));
  }
  CHECK(most > 0.2);  // dt x v, at most dt/2 of the energy
}
