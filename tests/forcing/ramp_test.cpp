#include <cmath>
#include "support/compare.hpp"
#include "support/quadrature.hpp"
#include <doctest/doctest.h>
#include <dmp/forcing/ramp.hpp>

namespace forcing = dmp::forcing;

namespace {
const forcing::Ramp ramp{.speed = -3.0, .start_up = 2.0, .hold_from = 5.0};
}

TEST_CASE("a ramp starts smoothly at 0, reaches its speed after the start-up, and holds") {
  for (const double t : {-1.0, 0.0, 5.0, 1e9}) CHECK(ramp.velocity(t) == 0.0);
  CHECK(ramp.velocity(1.0) == doctest::Approx(-1.5).epsilon(1e-14));
  for (const double t : {2.0, 4.9}) CHECK(ramp.velocity(t) == -3.0);
  CHECK(std::fabs(ramp.velocity(1e-4)) < 1e-7);  // its acceleration starts at 0 too
  CHECK(ramp.displacement(-1.0) == 0.0);
  CHECK(ramp.displacement(7.0) == doctest::Approx(-3.0 * 4.0).epsilon(1e-14));
}

TEST_CASE("the displacement of a ramp is the integral of its velocity") {
  for (const double t : {0.5, 1.0, 2.0})
    CHECK(ramp.displacement(t) == doctest::Approx(test::integral([](double s) { return ramp.velocity(s); }, 0.0, t)).epsilon(1e-10));
  CHECK(ramp.displacement(4.0) - ramp.displacement(2.0) == doctest::Approx(-6.0).epsilon(1e-14));
}

TEST_CASE("a ramp without start-up or hold is uniform motion") {
  const forcing::Ramp uniform{.speed = 2.0};
  CHECK(uniform.displacement(3.0) == 6.0);
  CHECK(uniform.velocity(1e-9) == 2.0);
  CHECK(forcing::Ramp{.speed = 0.0}.displacement(1e300) == 0.0);
}

TEST_CASE("ramps refuse to hold before they are at speed") {
  CHECK(test::complaint_about(forcing::Ramp{.speed = INFINITY}) == "forcing::Ramp: speed must be finite [m/s], got inf");
  CHECK(test::complaint_about(forcing::Ramp{.speed = 1.0, .start_up = -1.0}) ==
        "forcing::Ramp: start_up must be finite and >= 0 s, got -1");
  CHECK(test::complaint_about(forcing::Ramp{.speed = 1.0, .start_up = 2.0, .hold_from = 1.0}) ==
        "forcing::Ramp: hold_from must be >= start_up [s], got 1");
}
