#include "viscosity/laws.hpp"
#include <dmp/core/mean.hpp>
#include <dmp/viscosity/morris.hpp>

namespace viscosity = dmp::viscosity;

TEST_CASE("Morris' viscosity obeys the laws of viscosity in 1D, 2D and 3D") {
  static_assert(std::is_empty_v<viscosity::Morris<>>);
  check_viscosity_laws<1>(viscosity::Morris<>{});
  check_viscosity_laws<2>(viscosity::Morris<>{});
  check_viscosity_laws<3>(viscosity::Morris<>{});
  check_viscosity_laws<2>(viscosity::Morris<dmp::HarmonicMean>{});
}

TEST_CASE("Morris' viscosity of a parabolic profile is nu d^2u/dy^2, times the lattice's second moment") {
  struct Row {
    double support, moment;  // sheet 06, section 2.1
  };
  const auto parabola = [](const dmp::Components<2, double>& x) { return dmp::Components<2, double>{x[1] * x[1], 0.0}; };
  for (const Row row : {Row{1.3, 0.7122}, Row{1.5, 0.8877}, Row{2.0, 1.0064}, Row{2.6, 1.0061}, Row{3.0, 1.0008}}) {
    CAPTURE(row.support);
    constexpr double nu = 0.5;
    const auto acceleration = test::lattice_acceleration<2>(viscosity::Morris<>{}, row.support, nu, parabola);
    CHECK(std::fabs(acceleration[0] / (2.0 * nu) - row.moment) <= 0.5001e-4);
    CHECK(std::fabs(acceleration[1]) <= 1e-13);
  }
}

TEST_CASE("Morris' viscosity damps at 20 nu/h^2 in 2D and 21 nu/h^2 in 3D with Lucy's kernel") {
  const double two = dmp::kernel::radial_factor_integral(dmp::kernel::Lucy<2>{.support_radius = 2.0});
  const double three = dmp::kernel::radial_factor_integral(dmp::kernel::Lucy<3>{.support_radius = 2.0});
  CHECK(viscosity::Morris<>{}.damping_rate(0.1, 2.0, two, 2) == doctest::Approx(20.0 * 0.1 / 4.0).epsilon(1e-5));
  CHECK(viscosity::Morris<>{}.damping_rate(0.1, 2.0, three, 3) == doctest::Approx(21.0 * 0.1 / 4.0).epsilon(1e-5));
}

TEST_CASE("Morris' viscosity does not keep angular momentum: a spinning pair feels a torque") {
  test::Particle<2> i{}, j{};
  i.mass = j.mass = i.density = j.density = i.dynamic_viscosity = j.dynamic_viscosity = 1.0;
  i.position[0] = 0.5;
  j.position[0] = -0.5;
  i.velocity[1] = 0.5;
  j.velocity[1] = -0.5;
  const auto pair = test::pair_of<2>(i, j);
  const auto acceleration = test::viscous_acceleration<2>(viscosity::Morris<>{}, i, j, dmp::kernel::Lucy<2>{.support_radius = 2.0});
  CHECK(test::cross_length(pair.separation, acceleration) > 0.1);
  CHECK(acceleration[1] < 0.0);
}
