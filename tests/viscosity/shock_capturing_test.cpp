#include "viscosity/laws.hpp"
#include <dmp/viscosity/artificial.hpp>
#include <dmp/viscosity/shock_capturing.hpp>

namespace viscosity = dmp::viscosity;

TEST_CASE("shock-capturing viscosity obeys the laws of viscosity in 1D, 2D and 3D, acting on half the pairs; with a quadratic term too") {
  static_assert(sizeof(viscosity::ShockCapturing) == 2 * sizeof(double));
  check_viscosity_laws<1>(viscosity::ShockCapturing{.alpha = 0.1}, 0.5);
  check_viscosity_laws<2>(viscosity::ShockCapturing{.alpha = 0.1}, 0.5);
  check_viscosity_laws<3>(viscosity::ShockCapturing{.alpha = 0.1}, 0.5);
  check_viscosity_laws<1>(viscosity::ShockCapturing{.alpha = 2.0, .beta = 4.0}, 0.5);
  check_viscosity_laws<2>(viscosity::ShockCapturing{.alpha = 2.0, .beta = 4.0}, 0.5);
  check_viscosity_laws<3>(viscosity::ShockCapturing{.alpha = 2.0, .beta = 4.0}, 0.5);
}

TEST_CASE(
    "shock-capturing viscosity where sound is equally fast everywhere is artificial viscosity; else the mean of the two sound speeds "
    "counts") {
  const viscosity::ShockCapturing local{.alpha = 0.3};
  test::ParticleSource source;
  for (int n = 0; n < 100; ++n) {
    auto i = source.next<3>(), j = source.next<3>();
    const auto pair = test::pair_of<3>(i, j);
    i.sound_speed = j.sound_speed = 17.0;
    const double of_both = local.along_separation(pair, i, j, 2.6);
    CHECK(of_both ==
          doctest::Approx(viscosity::Artificial{.alpha = 0.3, .sound_speed = 17.0}.along_separation(pair, i, j, 2.6)).epsilon(1e-14));
    i.sound_speed = 4.0;
    j.sound_speed = 30.0;
    CHECK(local.along_separation(pair, i, j, 2.6) == doctest::Approx(of_both).epsilon(1e-14));
    CHECK(local.along_separation(pair, j, i, 2.6) == doctest::Approx(of_both).epsilon(1e-14));
  }
}

TEST_CASE(
    "the quadratic term of shock-capturing viscosity repels as the square of the approach, whatever the sound speed; parting particles are "
    "free") {
  const viscosity::ShockCapturing quadratic{.alpha = 0.0, .beta = 1.5};
  test::Particle<1> left{}, right{};
  left.mass = right.mass = left.density = right.density = 1.0;
  right.position[0] = 0.8;
  const auto pressure = [&](double speed, double sound_speed) {
    right.velocity[0] = -speed;
    left.sound_speed = right.sound_speed = sound_speed;
    return quadratic.along_separation(test::pair_of<1>(left, right), left, right, 2.0);
  };
  CHECK(pressure(1.0, 0.0) > 0.0);
  CHECK(pressure(1.0, 0.0) == pressure(1.0, 1e3));
  CHECK(pressure(3.0, 0.0) == doctest::Approx(9.0 * pressure(1.0, 0.0)).epsilon(1e-14));
  CHECK(pressure(-1.0, 1e3) == 0.0);
  // The two terms are equal where s* = -alpha c/beta: there both together are twice one of them.
  const double h = 2.0, c = 5.0, approach = -0.8 * 2.0, convergence = -h * approach / (0.64 + 0.01 * h * h);
  const viscosity::ShockCapturing both{.alpha = 1.5 * convergence / c, .beta = 1.5};
  (void)pressure(2.0, c);
  const auto pair = test::pair_of<1>(left, right);
  CHECK(both.along_separation(pair, left, right, h) ==
        doctest::Approx(2.0 * quadratic.along_separation(pair, left, right, h)).epsilon(1e-14));
}

TEST_CASE("shock-capturing viscosity refuses parameters that would feed energy or are no number") {
  CHECK(test::complaint_about(viscosity::ShockCapturing{.alpha = -0.1}) ==
        "viscosity::ShockCapturing: alpha must be finite and >= 0 -, got -0.1");
  CHECK(test::complaint_about(viscosity::ShockCapturing{.alpha = 0.1, .beta = NAN}) ==
        "viscosity::ShockCapturing: beta must be finite and >= 0 -, got nan");
}
