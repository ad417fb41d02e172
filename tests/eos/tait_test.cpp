#include "eos/laws.hpp"
#include <dmp/eos/tait.hpp>

namespace eos = dmp::eos;

TEST_CASE("Tait's equation obeys the laws of equations of state") {
  check_equation_of_state_laws(eos::Tait{.rest_density = 1060.0, .sound_speed_0 = 16.0}, 0.0);
  check_equation_of_state_laws(eos::Tait{.rest_density = 1000.0, .sound_speed_0 = 1484.0, .background_pressure = 1e5}, 1e5);
  check_equation_of_state_laws(eos::Tait{.rest_density = 1.2, .sound_speed_0 = 340.0, .exponent = 1.4}, 0.0);
  check_equation_of_state_laws(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 1.0, .exponent = 1.0}, 0.0);
  check_equation_of_state_laws(eos::Tait{.rest_density = 1e3, .sound_speed_0 = 1e8}, 0.0);
}

TEST_CASE("Tait's water at double its bracket (rho/rho0)^7 = 2 has the pressure c0^2 rho0/7, and 2^(6/7) the stiffness") {
  const eos::Tait water{.rest_density = 1000.0, .sound_speed_0 = 1400.0};
  const double rho = 1000.0 * 1.1040895136738123;  // 2^(1/7)
  CHECK(water.pressure(rho) == doctest::Approx(2.8e8).epsilon(1e-12));
  CHECK(water.density(2.8e8) == doctest::Approx(rho).epsilon(1e-12));
  CHECK(water.sound_speed(rho) * water.sound_speed(rho) == doctest::Approx(1.96e6 * 1.8114473285278132).epsilon(1e-12));
}

TEST_CASE("Tait's liquid resists compression, and pulls when stretched") {
  const eos::Tait water{.rest_density = 1000.0, .sound_speed_0 = 10.0};
  CHECK(water.pressure(1001.0) > 0.0);
  CHECK(water.pressure(999.0) < 0.0);
}

TEST_CASE("Tait refuses parameters that are no liquid") {
  CHECK(test::complaint_about(eos::Tait{.rest_density = 0.0, .sound_speed_0 = 1.0}) ==
        "eos::Tait: rest_density must be finite and > 0 kg/m^3, got 0");
  CHECK(test::complaint_about(eos::Tait{.rest_density = 1.0, .sound_speed_0 = -16.0}) ==
        "eos::Tait: sound_speed_0 must be finite and > 0 m/s, got -16");
  CHECK(test::complaint_about(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 1.0, .exponent = 0.5}) ==
        "eos::Tait: exponent must be >= 1 and < 1000, got 0.5");
  CHECK(test::complaint_about(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 1.0, .background_pressure = NAN}) ==
        "eos::Tait: background_pressure must be finite [Pa], got nan");
}
