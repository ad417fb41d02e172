#include "forcing/laws.hpp"
#include "support/quadrature.hpp"
#include <dmp/forcing/sinusoidal.hpp>

namespace forcing = dmp::forcing;

namespace {
constexpr double pi = 3.14159265358979323846;
const forcing::Sinusoidal<3> artery{
    .mean = {{4.71380, 0.0, 0.0}}, .amplitude = {{0.47138, 0.0, 0.0}}, .angular_frequency = 2.0 * pi};  // sheet 09
double drive(double time) { return artery.acceleration(forcing::Subject<3>{{}, {}, 1.0, time})[0]; }
}  // namespace

TEST_CASE("the sinusoidal drive obeys the laws of forcings in 1D, 2D and 3D") {
  check_forcing_laws<1>(forcing::Sinusoidal<1>{.mean = {{1.0}}, .amplitude = {{2.0}}, .angular_frequency = 3.0, .phase = 0.5});
  check_forcing_laws<2>(forcing::Sinusoidal<2>{.mean = {{1.0, 2.0}}, .amplitude = {{2.0, 0.0}}, .angular_frequency = 1e6});
  check_forcing_laws<3>(artery);
}

TEST_CASE("the artery's drive of period 1 s swings 10 % about 4.71380 m/s^2: largest at T/4, smallest at 3T/4") {
  CHECK(drive(0.25) == doctest::Approx(5.18518).epsilon(1e-12));
  CHECK(drive(0.75) == doctest::Approx(4.24242).epsilon(1e-12));
  CHECK(drive(1.25) == doctest::Approx(drive(0.25)).epsilon(1e-12));
  CHECK(test::integral(drive, 0.0, 1.0) == doctest::Approx(4.71380).epsilon(1e-12));
  const double fluctuation = test::integral([](double t) { return (drive(t) - 4.71380) * (drive(t) - 4.71380); }, 0.0, 1.0);
  CHECK(fluctuation == doctest::Approx(0.5 * 0.47138 * 0.47138).epsilon(1e-12));
}

TEST_CASE("a phase of a quarter turn starts the sinusoidal drive at its largest") {
  const forcing::Sinusoidal<2> shaker{.mean = {{0.0, -9.81}}, .amplitude = {{3.0, 0.0}}, .angular_frequency = 5.0, .phase = pi / 2.0};
  const auto start = shaker.acceleration(forcing::Subject<2>{{}, {}, 1.0, 0.0});
  CHECK(start[0] == doctest::Approx(3.0).epsilon(1e-12));
  CHECK(start[1] == -9.81);
}

TEST_CASE("the sinusoidal drive refuses parameters that are no oscillation") {
  using Drive = forcing::Sinusoidal<1>;
  CHECK(test::complaint_about(Drive{.mean = {{NAN}}, .amplitude = {{1.0}}, .angular_frequency = 1.0}) ==
        "forcing::Sinusoidal: mean must be finite [m/s^2], got nan");
  CHECK(test::complaint_about(Drive{.mean = {{0.0}}, .amplitude = {{INFINITY}}, .angular_frequency = 1.0}) ==
        "forcing::Sinusoidal: amplitude must be finite [m/s^2], got inf");
  CHECK(test::complaint_about(Drive{.mean = {{0.0}}, .amplitude = {{1.0}}, .angular_frequency = -2.0}) ==
        "forcing::Sinusoidal: angular_frequency must be finite and > 0 rad/s, got -2");
}
