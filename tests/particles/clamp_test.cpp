#include "support/compare.hpp"
#include <doctest/doctest.h>
#include <dmp/particles/clamp.hpp>

using dmp::particles::Clamp;

TEST_CASE("a clamp carries its particles along a line, all alike, and checks the line and the motion") {
  const Clamp<3> clamp{.direction = {{{0.6, 0.0, -0.8}}}, .motion = {.speed = 2.0, .start_up = 1.0, .hold_from = 3.0}};
  const dmp::Vector<3> start(1.0, 2.0, 3.0);
  CHECK(clamp.position(start, 0.0) == start);
  CHECK((clamp.position(start, 2.0) - dmp::Vector<3>(1.0 + 0.6 * 3.0, 2.0, 3.0 - 0.8 * 3.0)).norm() <
        1e-14);  // 2 m/s for 2 s less half the start-up
  CHECK((clamp.velocity(start, 2.0) - dmp::Vector<3>(1.2, 0.0, -1.6)).norm() < 1e-15);
  CHECK(clamp.velocity(start, 3.0).norm() == 0.0);
  CHECK(Clamp<1>{.direction = {{{1.0}}}}.position(dmp::Vector<1>(0.5), 7.0)[0] == 0.5);
  CHECK(test::complaint_about(Clamp<2>{.direction = {{{1.0, 1.0}}}}) ==
        "particles::Clamp: direction must have length 1, its square, got 2");
  CHECK(test::complaint_about(Clamp<1>{.direction = {{{1.0}}}, .motion = {.speed = 1.0, .start_up = -1.0}}) ==
        "forcing::Ramp: start_up must be finite and >= 0 s, got -1");
}
