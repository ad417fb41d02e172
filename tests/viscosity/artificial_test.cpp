#include "viscosity/laws.hpp"
#include <dmp/viscosity/artificial.hpp>
#include <dmp/viscosity/monaghan.hpp>

namespace viscosity = dmp::viscosity;

TEST_CASE("artificial viscosity obeys the laws of viscosity in 1D, 2D and 3D, acting on half the pairs") {
  static_assert(sizeof(viscosity::Artificial) == 2 * sizeof(double));
  check_viscosity_laws<1>(viscosity::Artificial{.alpha = 0.1, .sound_speed = 16.0}, 0.5);
  check_viscosity_laws<2>(viscosity::Artificial{.alpha = 0.1, .sound_speed = 16.0}, 0.5);
  check_viscosity_laws<3>(viscosity::Artificial{.alpha = 0.1, .sound_speed = 16.0}, 0.5);
  check_viscosity_laws<3>(viscosity::Artificial{.alpha = 1.0, .sound_speed = 1e9}, 0.5);
}

TEST_CASE("artificial viscosity of shear is half of nu = alpha h c/(2(d + 2)), because half the pairs approach") {
  const viscosity::Artificial artificial{.alpha = 0.2, .sound_speed = 30.0};
  constexpr double h = 2.6;
  const auto parabola = [](const auto& x) {
    auto velocity = x;
    for (auto& component : velocity.component) component = 0.0;
    velocity[0] = x[1] * x[1];
    return velocity;
  };
  const auto one_sided = test::lattice_acceleration<2>(artificial, h, 0.0, parabola)[0];
  const auto two_sided = test::lattice_acceleration<2>(viscosity::Monaghan<2>{}, h, 0.2 * h * 30.0 / 8.0, parabola)[0];
  CHECK(one_sided / two_sided == doctest::Approx(0.5).epsilon(1e-12));
  const auto one_sided_3d = test::lattice_acceleration<3>(artificial, h, 0.0, parabola)[0];
  const auto two_sided_3d = test::lattice_acceleration<3>(viscosity::Monaghan<3>{}, h, 0.2 * h * 30.0 / 10.0, parabola)[0];
  CHECK(one_sided_3d / two_sided_3d == doctest::Approx(0.5).epsilon(1e-12));
}

TEST_CASE("artificial viscosity lets separating particles go and repels approaching ones") {
  const viscosity::Artificial law{.alpha = 1.0, .sound_speed = 10.0};
  test::Particle<1> left{}, right{};
  left.mass = right.mass = left.density = right.density = 1.0;
  right.position[0] = 1.0;
  const dmp::kernel::Lucy<1> kernel{.support_radius = 2.0};
  right.velocity[0] = 1.0;
  CHECK(test::viscous_acceleration<1>(law, right, left, kernel)[0] == 0.0);
  right.velocity[0] = -1.0;
  CHECK(test::viscous_acceleration<1>(law, right, left, kernel)[0] > 0.0);
  CHECK(test::viscous_acceleration<1>(law, left, right, kernel)[0] < 0.0);
}

TEST_CASE("artificial viscosity refuses parameters that would feed energy or are no number") {
  CHECK(test::complaint_about(viscosity::Artificial{.alpha = -0.1, .sound_speed = 1.0}) ==
        "viscosity::Artificial: alpha must be finite and >= 0 [-], got -0.1");
  CHECK(test::complaint_about(viscosity::Artificial{.alpha = 0.1, .sound_speed = 0.0}) ==
        "viscosity::Artificial: sound_speed must be finite and > 0 m/s, got 0");
  CHECK(test::complaint_about(viscosity::Artificial{.alpha = NAN, .sound_speed = 1.0}) ==
        "viscosity::Artificial: alpha must be finite and >= 0 [-], got nan");
}
