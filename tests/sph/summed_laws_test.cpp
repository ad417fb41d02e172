// Density and shear rate from the particles around, through scenes: lattice sums of the sheet, fields that must come out exactly.
#include <algorithm>
#include <cmath>
#include <vector>
#include <doctest/doctest.h>

#include "simulation/scenes.hpp"
#include "support/particles.hpp"

using namespace test;

namespace {

constexpr double rho = 2.0;  // [kg/m^3] of all lattices here, whose spacing is 1 m

/// The density that K's sum gives on a periodic lattice of that density, as a fraction of it: the same at every particle, else -1.
template <class K, class Lattice>
double density_sum(const Lattice& lattice, double support_radius) {
  const Vector<2> upper = 12.0 * lattice.cell();
  const K kernel{.support_radius = support_radius};
  auto result = scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>{.lower = {0.0, 0.0}, .upper = upper, .periodic = {true, true}},
      group<Water>("water", Mobile{}, geometry::fill(lattice, {.lower = {0.0, 0.0}, .upper = upper}), rho * volume_per_point(lattice)),
      interaction<Water, Water>(sph::WeaklyCompressible<K>{.kernel = kernel}), summed<Water>(sph::DensitySum<K>{.kernel = kernel}),
      material<Water>(eos::Tait{.rest_density = rho, .sound_speed_0 = 1.0}));
  (void)result.step_limit();  // evaluates
  const auto& density = result.template group<Water>().template get<field::Density>();
  const auto [least, most] = std::minmax_element(density.begin(), density.end());
  return *most - *least < 1e-13 * rho ? *most / rho : -1.0;
}

template <class K>
void check_lattice_sums(const std::vector<double>& of_square, const std::vector<double>& of_hexagonal) {
  const double supports[] = {1.3, 1.5, 2.0, 2.6, 3.0};
  for (std::size_t n = 0; n < 5; ++n) {
    CAPTURE(supports[n]);
    CHECK(std::fabs(density_sum<K>(geometry::Cubic<2>{.spacing = 1.0}, supports[n]) - of_square[n]) < 0.51e-4);  // four printed digits
    CHECK(std::fabs(density_sum<K>(geometry::Hexagonal{.spacing = 1.0}, supports[n]) - of_hexagonal[n]) < 0.51e-4);
  }
}

}  // namespace

TEST_CASE("sheet 06, 2.1: the density sum of square and hexagonal lattices, quartic and Lucy's kernel, five supports") {
  check_lattice_sums<kernel::Quartic<2>>({1.0464, 0.9773, 1.0009, 0.9982, 1.0000}, {0.9516, 0.9627, 1.0068, 0.9998, 1.0003});
  check_lattice_sums<kernel::Lucy<2>>({1.0949, 1.0238, 1.0201, 1.0000, 1.0029}, {1.0145, 1.0210, 1.0086, 1.0041, 1.0003});
}

namespace {

template <int Dim>
using Inviscid = sph::WeaklyCompressible<kernel::Lucy<Dim>>;
constexpr double support = 2.6;

/// A lattice of `side` to the power Dim particles of spacing 1, shaken by up to `shake` [m] in each direction.
template <int Dim>
geometry::Points<Dim> block(int side, double shake) {
  const Vector<Dim> upper = Vector<Dim>::Constant(side);
  auto points = geometry::fill(geometry::Cubic<Dim>{.spacing = 1.0}, {.lower = Vector<Dim>::Zero(), .upper = upper});
  ParticleSource source;
  for (auto& x : points.positions)
    for (int d = 0; d < Dim; ++d) x[d] += source.between(-shake, shake);
  return points;
}
/// An open block of fluid: free surfaces, edges and corners all round.
template <int Dim>
auto drop(int side, double shake, double support_radius = support) {
  auto result =
      scene<integrator::ExtrapolatedVerlet>(geometry::Box<Dim>::unbounded(), group<Water>("water", Mobile{}, block<Dim>(side, shake), rho),
                                            interaction<Water, Water>(Inviscid<Dim>{.kernel = {.support_radius = support_radius}}),
                                            material<Water>(eos::Tait{.rest_density = rho, .sound_speed_0 = 1.0}));
  return result;
}

}  // namespace

TEST_CASE("Shepard's density keeps a constant density, at free surfaces, edges and corners too, where the sum falls short by up to 3/4") {
  auto scene = drop<2>(9, 0.2);
  scene.group<Water>().set<field::Density>([](const auto&) { return 1234.5; });
  double error = 0.0, least_sum = INFINITY;
  for (const auto& at : scene.find_sums<Water>(sph::ShepardDensity<kernel::Quartic<2>>{.kernel = {.support_radius = support}}))
    error = std::max(error, std::fabs(at.density / 1234.5 - 1.0));
  for (const auto& at : scene.find_sums<Water>(sph::DensitySum<kernel::Quartic<2>>{.kernel = {.support_radius = support}}))
    least_sum = std::min(least_sum, at.density);
  CHECK(error < 1e-15);
  CHECK(least_sum < 0.6 * rho);
  auto in_space = drop<3>(5, 0.2);
  in_space.group<Water>().set<field::Density>([](const auto&) { return 1234.5; });
  for (const auto& at : in_space.find_sums<Water>(sph::ShepardDensity<kernel::Lucy<3>>{.kernel = {.support_radius = support}}))
    error = std::max(error, std::fabs(at.density / 1234.5 - 1.0));
  CHECK(error < 1e-15);
}

TEST_CASE("Shepard's density wipes out a checkerboard of densities, and keeps a density that varies slowly") {
  const auto make = [](const auto& density) {
    auto result = scene<integrator::ExtrapolatedVerlet>(
        geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {40.0, 8.0}, .periodic = {true, true}},
        group<Water>("water", Mobile{}, geometry::fill(geometry::Cubic<2>{.spacing = 1.0}, {.lower = {0.0, 0.0}, .upper = {40.0, 8.0}}),
                     rho),
        interaction<Water, Water>(Inviscid<2>{.kernel = {.support_radius = support}}),
        summed<Water>(sph::ShepardDensity<kernel::Lucy<2>>{.kernel = {.support_radius = support}}),
        material<Water>(eos::Tait{.rest_density = rho, .sound_speed_0 = 1.0}));
    result.template group<Water>().template set<field::Density>(density);
    (void)result.step_limit();  // evaluates
    return result;
  };
  const auto checkerboard =
      make([](const Vector<2>& x) { return (static_cast<int>(x[0]) + static_cast<int>(x[1])) % 2 == 0 ? 1.05 * rho : 0.95 * rho; });
  const auto& density = checkerboard.group<Water>().get<field::Density>();
  const auto [least, most] = std::minmax_element(density.begin(), density.end());
  CHECK(*most - *least < 0.03 * 0.1 * rho);
  CHECK(*most == doctest::Approx(rho).epsilon(0.005));  // the sums weigh with the volumes: the harmonic mean

  const auto wave = [](double x) { return rho * (1.0 + 0.05 * std::cos(2.0 * std::numbers::pi * x / 40.0)); };
  const auto slow = make([&](const Vector<2>& x) { return wave(x[0]); });
  double error = 0.0;
  const auto& group = slow.group<Water>();
  for (std::size_t i = 0; i < group.size(); ++i)
    error = std::max(error, std::fabs(group.get<field::Density>()[i] - wave(group.positions()[i][0])));
  CHECK(error < 0.03 * 0.05 * rho);
}

namespace {

template <int Dim>
using Gradient = Eigen::Matrix<double, Dim, Dim>;

/// Largest error of the shear rate in an open block of fluid whose velocity is `gradient` times the place, as a fraction of |gradient|.
template <int Dim>
double shear_rate_error(const Gradient<Dim>& gradient, double expected, double shake, double support_radius = support) {
  auto scene = drop<Dim>(Dim == 2 ? 9 : 6, shake, support_radius);
  auto& water = scene.template group<Water>();
  water.template set<field::Density>([](const Vector<Dim>& x) { return rho * (1.0 + 0.01 * x[0]); });  // volumes may differ
  water.template set<field::Velocity>([&](const Vector<Dim>& x) { return Vector<Dim>(gradient * x + Vector<Dim>::Constant(7.0)); });
  double error = 0.0;
  for (const auto& at : scene.template find_sums<Water>(sph::ShearRate<kernel::Lucy<Dim>>{.kernel = {.support_radius = support_radius}})) {
    const double one = std::fabs(at.shear_rate - expected);
    error = std::isnan(one) ? INFINITY : std::max(error, one);
  }
  return error / gradient.norm();
}

}  // namespace

TEST_CASE(
    "the shear rate of a linear velocity field is exact at every particle, on free surfaces, edges and corners too: simple shear, "
    "rotation, stretching") {
  Gradient<2> shear, rotation, stretching;
  shear << 0.0, -3.0, 0.0, 0.0;
  rotation << 0.0, -2.0, 2.0, 0.0;
  stretching << 1.5, 0.0, 0.0, -1.5;
  for (const double shake : {0.0, 0.2}) {
    CAPTURE(shake);
    CHECK(shear_rate_error<2>(shear, 3.0, shake) < 1e-12);  // |gamma|
    CHECK(shear_rate_error<2>(rotation, 0.0, shake) < 1e-12);
    CHECK(shear_rate_error<2>(stretching, 3.0, shake) < 1e-12);  // 2 |e|
    CHECK(shear_rate_error<2>(shear + rotation, 3.0, shake) < 1e-12);
  }
  Gradient<3> shear_3d = Gradient<3>::Zero(), rotation_3d, stretching_3d = Gradient<3>::Zero();
  shear_3d(0, 2) = 3.0;
  rotation_3d << 0.0, -1.0, 2.0, 1.0, 0.0, -3.0, -2.0, 3.0, 0.0;
  stretching_3d.diagonal() << 2.0, -1.0, -1.0;
  for (const double shake : {0.0, 0.2}) {
    CAPTURE(shake);
    CHECK(shear_rate_error<3>(shear_3d, 3.0, shake) < 1e-12);
    CHECK(shear_rate_error<3>(rotation_3d, 0.0, shake) < 1e-12);
    CHECK(shear_rate_error<3>(stretching_3d, std::sqrt(12.0), shake) < 1e-12);  // sqrt(2 (4 + 1 + 1))
    CHECK(shear_rate_error<3>(shear_3d + rotation_3d, 3.0, shake) < 1e-12);
    CHECK(shear_rate_error<3>(shear_3d, 3.0, shake, 5.0) <
          1e-12);  // many neighbours: the moment at a corner is near 1/8 of the unit matrix
  }
}

TEST_CASE(
    "the shear rate next to a frozen wall that slides is exact: the wall's velocity counts; a few particles in a row give a finite one") {
  const geometry::Cubic<2> lattice{.spacing = 1.0};
  const Inviscid<2> law{.kernel = {.support_radius = support}};
  auto scene = simulation::scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>{.lower = {0.0, -1.0}, .upper = {10.0, 7.0}, .periodic = {true, false}},
      group<Water>("water", Mobile{}, geometry::fill(lattice, {.lower = {0.0, 0.0}, .upper = {10.0, 6.0}}), rho),
      group<Wall>("wall", Frozen<2>{.wall_velocity = {-0.5 * 3.0, 0.0}},
                  geometry::fill(lattice, {.lower = {0.0, -1.0}, .upper = {10.0, 0.0}}), rho),
      interaction<Water, Water>(law), interaction<Water, Wall>(law),
      summed<Water>(sph::ShearRate<kernel::Lucy<2>>{.kernel = {.support_radius = support}}),
      material<Water, Wall>(eos::Tait{.rest_density = rho, .sound_speed_0 = 1.0}));
  auto& water = scene.group<Water>();
  water.set<field::Velocity>([](const Vector<2>& x) { return Vector<2>(3.0 * x[1], 0.0); });
  (void)scene.step_limit();
  double error = 0.0;
  for (const double rate : water.get<field::ShearRate>()) error = std::max(error, std::fabs(rate - 3.0));
  CHECK(error < 3e-12);

  auto row = simulation::scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<3>::unbounded(),
      group<Water>("water", Mobile{},
                   geometry::Points<3>{.positions = {{0.0, 0.0, 0.0}, {1.0, 0.5, 0.0}, {2.0, 1.0, 0.0}, {90.0, 0.0, 0.0}}}, rho),
      interaction<Water, Water>(Inviscid<3>{.kernel = {.support_radius = support}}),
      material<Water>(eos::Tait{.rest_density = rho, .sound_speed_0 = 1.0}));
  row.group<Water>().set<field::Velocity>([](const Vector<3>& x) { return Vector<3>(x[1], x[0], 0.0); });
  const auto rates = row.find_sums<Water>(sph::ShearRate<kernel::Lucy<3>>{.kernel = {.support_radius = support}});
  for (std::size_t i = 0; i < 3; ++i) CHECK((rates[i].shear_rate > 0.0 && rates[i].shear_rate < 10.0));
  CHECK(rates[3].shear_rate == 0.0);  // alone
}
