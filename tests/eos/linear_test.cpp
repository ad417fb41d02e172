#include "eos/laws.hpp"
#include <dmp/eos/linear.hpp>
#include <dmp/eos/tait.hpp>

namespace eos = dmp::eos;

TEST_CASE("the linear equation obeys the laws of equations of state") {
  check_equation_of_state_laws(eos::Linear{.rest_density = 1060.0, .sound_speed_0 = 16.0}, 0.0);
  check_equation_of_state_laws(eos::Linear{.rest_density = 1000.0, .sound_speed_0 = 1484.0, .background_pressure = -1e5}, -1e5);
  check_equation_of_state_laws(eos::Linear{.rest_density = 1e3, .sound_speed_0 = 1e8}, 0.0);
}

TEST_CASE("the linear liquid of 20 m/s carries 4000 Pa at 1 % compression") {
  CHECK(eos::Linear{.rest_density = 1000.0, .sound_speed_0 = 20.0}.pressure(1010.0) == doctest::Approx(4000.0).epsilon(1e-12));
}

TEST_CASE("the linear equation is Tait's tangent: they part by a fifth of a percent of p at 0.07 % compression") {
  const eos::Linear linear{.rest_density = 1000.0, .sound_speed_0 = 10.0};
  const eos::Tait tait{.rest_density = 1000.0, .sound_speed_0 = 10.0};
  const double stretch = 7e-4;  // Tait = linear (1 + (gamma - 1)/2 stretch + ...)
  CHECK(tait.pressure(1000.0 * (1.0 + stretch)) / linear.pressure(1000.0 * (1.0 + stretch)) - 1.0 ==
        doctest::Approx(3.0 * stretch).epsilon(2e-3).scale(0.0));
}

TEST_CASE("the linear equation refuses parameters that are no liquid") {
  CHECK(test::complaint_about(eos::Linear{.rest_density = -1.0, .sound_speed_0 = 1.0}) ==
        "eos::Linear: rest_density must be finite and > 0 kg/m^3, got -1");
  CHECK(test::complaint_about(eos::Linear{.rest_density = 1.0, .sound_speed_0 = NAN}) ==
        "eos::Linear: sound_speed_0 must be finite and > 0 m/s, got nan");
  CHECK(test::complaint_about(eos::Linear{.rest_density = 1.0, .sound_speed_0 = 1.0, .background_pressure = INFINITY}) ==
        "eos::Linear: background_pressure must be finite [Pa], got inf");
}
