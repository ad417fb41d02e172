#include "viscosity/laws.hpp"
#include <dmp/core/mean.hpp>
#include <dmp/viscosity/monaghan.hpp>

namespace viscosity = dmp::viscosity;

/// The stated rate is that of the fastest motion of all; a particle that moves alone is damped as much more slowly.
template <int Dim>
constexpr double one_of_many = 1.0 / (2.0 - 1.0 / Dim);

TEST_CASE("Monaghan's viscosity obeys the laws of viscosity in 1D, 2D and 3D") {
  static_assert(std::is_empty_v<viscosity::Monaghan<3>>);
  check_viscosity_laws<1>(viscosity::Monaghan<1>{}, one_of_many<1>);
  check_viscosity_laws<2>(viscosity::Monaghan<2>{}, one_of_many<2>);
  check_viscosity_laws<3>(viscosity::Monaghan<3>{}, one_of_many<3>);
  check_viscosity_laws<3>(viscosity::Monaghan<3, dmp::HarmonicMean>{}, one_of_many<3>);
}

TEST_CASE("Monaghan's viscosity of a parabolic profile is nu d^2u/dy^2, less 4.4 % in 2D and 3.3 % in 3D for the softening") {
  constexpr double nu = 0.5;  // sheet 06, section 2.3; a lattice so fine that it is a continuum
  const auto parabola = [](const auto& x) {
    auto velocity = x;
    for (auto& component : velocity.component) component = 0.0;
    velocity[0] = x[1] * x[1];
    return velocity;
  };
  CHECK(std::fabs(test::lattice_acceleration<2>(viscosity::Monaghan<2>{}, 40.0, nu, parabola)[0] / (2.0 * nu) - (1.0 - 0.044)) <= 0.5e-3);
  CHECK(std::fabs(test::lattice_acceleration<3>(viscosity::Monaghan<3>{}, 20.0, nu, parabola)[0] / (2.0 * nu) - (1.0 - 0.033)) <= 0.5e-3);
}

TEST_CASE("Monaghan's viscosity on a square lattice gives a channel 14 % too fast at h = 2.6 spacings") {
  const auto parabola = [](const dmp::Components<2, double>& x) { return dmp::Components<2, double>{x[1] * x[1], 0.0}; };
  CHECK(std::fabs(2.0 / test::lattice_acceleration<2>(viscosity::Monaghan<2>{}, 2.6, 1.0, parabola)[0] - 1.14) <= 0.005);
}

TEST_CASE("Monaghan's viscosity damps at up to 60 nu/h^2 in 2D and 58 nu/h^2 in 3D with Lucy's kernel") {
  const double two = dmp::kernel::radial_factor_integral(dmp::kernel::Lucy<2>{.support_radius = 2.0});
  const double three = dmp::kernel::radial_factor_integral(dmp::kernel::Lucy<3>{.support_radius = 2.0});
  CHECK(viscosity::Monaghan<2>{}.damping_rate(0.1, 2.0, two, 2) == doctest::Approx(60.0 * 0.1 / 4.0).epsilon(1e-5));
  CHECK(viscosity::Monaghan<3>{}.damping_rate(0.1, 2.0, three, 3) == doctest::Approx(175.0 / 3.0 * 0.1 / 4.0).epsilon(1e-5));
}

TEST_CASE("Monaghan's viscosity leaves rigid rotation alone, pair by pair") {
  const dmp::kernel::Lucy<2> kernel{.support_radius = 4.0};
  test::ParticleSource source;
  for (int n = 0; n < 100; ++n) {
    auto i = source.next<2>(), j = source.next<2>();
    i.velocity = {-i.position[1], i.position[0]};
    j.velocity = {-j.position[1], j.position[0]};
    CHECK(test::length(test::viscous_acceleration<2>(viscosity::Monaghan<2>{}, i, j, kernel)) <= 1e-15);
  }
}

TEST_CASE("Monaghan's viscosity repels approaching particles and holds separating ones") {
  test::Particle<1> left{}, right{};
  left.mass = right.mass = left.density = right.density = left.dynamic_viscosity = right.dynamic_viscosity = 1.0;
  right.position[0] = 1.0;
  const dmp::kernel::Lucy<1> kernel{.support_radius = 2.0};
  right.velocity[0] = -1.0;
  CHECK(test::viscous_acceleration<1>(viscosity::Monaghan<1>{}, right, left, kernel)[0] > 0.0);
  right.velocity[0] = 1.0;
  CHECK(test::viscous_acceleration<1>(viscosity::Monaghan<1>{}, right, left, kernel)[0] < 0.0);
}
