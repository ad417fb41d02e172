#include "forcing/laws.hpp"
#include <dmp/forcing/drag.hpp>

namespace forcing = dmp::forcing;

TEST_CASE("drag obeys the laws of forcings in 1D, 2D and 3D") {
  check_forcing_laws<1>(forcing::Drag{.coefficient = 0.3});
  check_forcing_laws<2>(forcing::Drag{.coefficient = 0.3});
  check_forcing_laws<3>(forcing::Drag{.coefficient = 1e12});
}

TEST_CASE("drag of 0.5 N s/m on 2 kg at 4 m/s slows it by 1 m/s^2, and by 0.25 per second") {
  const forcing::Drag drag{.coefficient = 0.5};
  const auto a = drag.acceleration(forcing::Subject<2>{{}, {4.0, 0.0}, 2.0, 0.0});
  CHECK(a[0] == doctest::Approx(-1.0).epsilon(1e-15));
  CHECK(a[1] == 0.0);
  CHECK(drag.damping_rate(2.0) == doctest::Approx(0.25).epsilon(1e-15));
}

TEST_CASE("drag refuses to push") {
  CHECK(test::complaint_about(forcing::Drag{.coefficient = -0.5}) == "forcing::Drag: coefficient must be finite and >= 0 N s/m, got -0.5");
}
