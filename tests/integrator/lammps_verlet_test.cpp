#include "integrator/laws.hpp"
#include <dmp/integrator/lammps_verlet.hpp>

using dmp::integrator::LammpsVerlet;

TEST_CASE("LAMMPS' Verlet obeys the laws of integrators, except that sound always grows") {
  static_assert(LammpsVerlet::oscillation_limit == 2.0 && LammpsVerlet::damping_limit == 1.0);
  check_integrator_laws<LammpsVerlet>(
      {.order = 2, .damped_order = 2, .state_order = 2, .position_exact = true, .reversible = true, .sound_limit = 0.0});
}

TEST_CASE("with LAMMPS' Verlet sound grows by (omega dt)^2/4 per step") {
  for (const double step : {0.02, 0.05, 0.1}) {
    CAPTURE(step);
    const int steps = static_cast<int>(4.0 / (step * step));
    CHECK(std::log(test::loudness<LammpsVerlet>(step, 2 * steps) / test::loudness<LammpsVerlet>(step, steps)) ==
          doctest::Approx(1.0).epsilon(0.05));
  }
}
