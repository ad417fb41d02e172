#include "forcing/laws.hpp"
#include "support/quadrature.hpp"
#include <dmp/forcing/pulsed.hpp>

namespace forcing = dmp::forcing;

namespace {

constexpr double pi = 3.14159265358979323846, beats_per_second = 1.167, beat = 1.0 / beats_per_second;
constexpr double strength = 400.0;  // G0 [m/s^2]; sheet 02, section 2
const forcing::Pulsed<3> heart{.amplitude = {{strength, 0.0, 0.0}}, .angular_frequency = pi * beats_per_second};

double push(double time) { return heart.acceleration(forcing::Subject<3>{{}, {}, 1.0, time})[0]; }

/// Where f is largest between a and b, if it has one hill there.
template <class Function>
double summit(const Function& f, double a, double b) {
  for (int n = 0; n < 200; ++n) {
    const double left = a + (b - a) / 3.0, right = b - (b - a) / 3.0;
    (f(left) < f(right) ? a : b) = f(left) < f(right) ? left : right;
  }
  return 0.5 * (a + b);
}

}  // namespace

TEST_CASE("the pulse obeys the laws of forcings in 1D, 2D and 3D") {
  check_forcing_laws<1>(forcing::Pulsed<1>{.amplitude = {{400.0}}, .angular_frequency = 3.7});
  check_forcing_laws<2>(forcing::Pulsed<2>{.amplitude = {{3.0, 4.0}}, .angular_frequency = 3.7, .exponent = 1});
  check_forcing_laws<3>(heart);
  check_forcing_laws<3>(forcing::Pulsed<3>{.amplitude = {{0.0, 0.0, 1e12}}, .angular_frequency = 1e3, .exponent = 1000});
}

TEST_CASE("the heart pushes hardest at 0.38705 s with 154.62 m/s^2, and pulls hardest at 0.55554 s with 13.97 m/s^2") {
  const double systole = summit(push, 0.2, 0.5), diastole = summit([](double t) { return -push(t); }, 0.5, 0.7);
  CHECK(std::fabs(systole - 0.38705) <= 1e-5);
  CHECK(std::fabs(push(systole) / strength - 0.386560) <= 1e-6);
  CHECK(std::fabs(diastole - 0.55554) <= 1e-5);
  CHECK(std::fabs(push(diastole) / strength + 0.034926) <= 1e-6);
}

TEST_CASE("the heart turns from pushing to pulling at 0.51414 s") {
  CHECK(push(0.51413) > 0.0);
  CHECK(push(0.51415) < 0.0);
}

TEST_CASE("one beat gives 22.187 m/s: 23.335 forwards, 1.148 back, 0.064731 of the strength on average") {
  const double turn = (pi / 2.0 + pi / 10.0) / (pi * beats_per_second);
  CHECK(std::fabs(test::integral(push, 0.0, turn) - 23.335) <= 0.6e-3);
  CHECK(std::fabs(test::integral(push, turn, beat) + 1.148) <= 0.6e-3);
  CHECK(std::fabs(test::integral(push, 0.0, beat) - 22.187) <= 0.6e-3);
  CHECK(std::fabs(test::integral(push, 0.0, beat) / beat / strength - 0.064731) <= 0.6e-6);
}

TEST_CASE("the heart repeats after 0.85690 s, not after half of that, and rests below 1 % of its peak until 0.195 s") {
  CHECK(beat == doctest::Approx(0.85690).epsilon(1e-5));
  for (const double t : {0.1, 0.3, 0.38705, 0.55}) {
    CHECK(std::fabs(push(t + beat) - push(t)) <= 1e-11 * strength);
    CHECK(std::fabs(push(t + 0.5 * beat)) <= 0.4 * std::fabs(push(0.38705)));
  }
  for (const double t : test::evenly(0.0, 0.195, 50)) CHECK(std::fabs(push(t)) < 0.01 * 154.7);
}

TEST_CASE("the pulse acts along its amplitude") {
  const forcing::Pulsed<2> oblique{.amplitude = {{30.0, -40.0}}, .angular_frequency = pi * beats_per_second};
  const auto a = oblique.acceleration(forcing::Subject<2>{{}, {}, 1.0, 0.38705});
  CHECK(a[0] == doctest::Approx(30.0 * 0.386560).epsilon(1e-5));
  CHECK(a[1] == doctest::Approx(-40.0 * 0.386560).epsilon(1e-5));
}

TEST_CASE("the pulse refuses parameters that are no beat") {
  using Pulse = forcing::Pulsed<1>;
  CHECK(test::complaint_about(Pulse{.amplitude = {{INFINITY}}, .angular_frequency = 1.0}) ==
        "forcing::Pulsed: amplitude must be finite [m/s^2], got inf");
  CHECK(test::complaint_about(Pulse{.amplitude = {{1.0}}, .angular_frequency = 0.0}) ==
        "forcing::Pulsed: angular_frequency must be finite and > 0 rad/s, got 0");
  CHECK(test::complaint_about(Pulse{.amplitude = {{1.0}}, .angular_frequency = 1.0, .exponent = 0}) ==
        "forcing::Pulsed: exponent must be 1 to 1000, got 0");
  CHECK(test::complaint_about(Pulse{.amplitude = {{1.0}}, .angular_frequency = 1.0, .phase = NAN}) ==
        "forcing::Pulsed: phase must be finite [rad], got nan");
}
