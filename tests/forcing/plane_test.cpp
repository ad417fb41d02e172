#include "forcing/laws.hpp"
#include <dmp/forcing/plane.hpp>

namespace forcing = dmp::forcing;

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
/// A floor at y = 0.2 m of 50 N/m^2.
const forcing::Plane<2> floor_plane{.normal = {{0.0, 1.0}}, .position = 0.2, .strength = 50.0};
forcing::Subject<2> bead(double y, double time = 0.0, double mass = 2.0) { return {{7.0, y}, {}, mass, time}; }
}  // namespace

TEST_CASE("planes obey the laws of forcings in 1D, 2D and 3D") {
  check_forcing_laws<1>(forcing::Plane<1>{.normal = {{-1.0}}, .position = 0.5, .strength = 1e10});
  check_forcing_laws<2>(floor_plane);
  check_forcing_laws<3>(forcing::Plane<3>{
      .normal = {{0.0, 0.6, 0.8}}, .position = 1.0, .strength = 1.0, .motion = {.speed = 0.1, .start_up = 2.0, .hold_from = 5.0}});
}

TEST_CASE("A.6: a plane pushes with S d^2 what is d behind it, along its normal, and leaves alone what is not") {
  const auto a = floor_plane.acceleration(bead(0.1));
  CHECK(a[0] == 0.0);
  CHECK(a[1] == doctest::Approx(50.0 * 0.01 / 2.0).epsilon(1e-14));
  CHECK(floor_plane.acceleration(bead(0.2))[1] == 0.0);
  CHECK(floor_plane.acceleration(bead(0.3))[1] == 0.0);
  CHECK(floor_plane.acceleration(bead(0.1, 0.0, 4.0))[1] == doctest::Approx(0.5 * a[1]).epsilon(1e-14));
  CHECK(floor_plane.penetration(bead(-0.3)) == doctest::Approx(0.5).epsilon(1e-14));
}

TEST_CASE("the stiffness of a plane is the slope of its force") {
  for (const double y : {0.25, 0.15, -1.0}) {
    const double h = 1e-6, slope = -2.0 * (floor_plane.acceleration(bead(y + h))[1] - floor_plane.acceleration(bead(y - h))[1]) / (2.0 * h);
    CHECK(floor_plane.stiffness(bead(y)) == doctest::Approx(slope).epsilon(1e-8));
  }
}

TEST_CASE("a moving plane is where its motion has it") {
  forcing::Plane<2> press = floor_plane;
  press.motion = {.speed = 0.5, .start_up = 0.2, .hold_from = 1.0};
  CHECK(press.penetration(bead(0.3, 0.0)) == 0.0);
  CHECK(press.penetration(bead(0.3, 0.7)) == doctest::Approx(0.2 + 0.5 * 0.6 - 0.3).epsilon(1e-14));
  CHECK(press.penetration(bead(0.3, 5.0)) == press.penetration(bead(0.3, 1.0)));
}

TEST_CASE("planes refuse a normal that is none, and to be soft or nowhere") {
  using Plane = forcing::Plane<2>;
  CHECK(test::complaint_about(Plane{.normal = {{0.0, 2.0}}, .position = 0.0, .strength = 1.0}) ==
        "forcing::Plane: normal must have length 1, its square, got 4");
  CHECK(test::complaint_about(Plane{.normal = {{0.0, NAN}}, .position = 0.0, .strength = 1.0}) ==
        "forcing::Plane: normal must have length 1, its square, got nan");
  CHECK(test::complaint_about(Plane{.normal = {{0.0, 1.0}}, .position = infinity, .strength = 1.0}) ==
        "forcing::Plane: position must be finite [m], got inf");
  CHECK(test::complaint_about(Plane{.normal = {{0.0, 1.0}}, .position = 0.0, .strength = 0.0}) ==
        "forcing::Plane: strength must be finite and > 0 N/m^2, got 0");
  CHECK(test::complaint_about(Plane{.normal = {{0.0, 1.0}}, .position = 0.0, .strength = 1.0, .motion = {.speed = NAN}}) ==
        "forcing::Ramp: speed must be finite [m/s], got nan");
}
