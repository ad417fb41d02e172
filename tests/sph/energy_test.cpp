// The energy equation and heat conduction: what is kept, which way it goes, and how much on a lattice.
#include <cmath>
#include <numeric>
#include <vector>
#include <doctest/doctest.h>

#include "simulation/scenes.hpp"
#include "support/particles.hpp"

using namespace test;

namespace {

template <int Dim>
geometry::Points<Dim> at_random(std::size_t count, ParticleSource& source) {
  geometry::Points<Dim> points{.positions = std::vector<Vector<Dim>>(count)};
  for (auto& x : points.positions)
    for (int d = 0; d < Dim; ++d) x[d] = source.between(0.0, 1.0);
  return points;
}

/// sum of m (v . dv/dt + de/dt) over two fluids of random particles in a periodic box, as a fraction of the sum of
/// m (|v| |dv/dt| + |de/dt|).
template <int Dim, class V>
double energy_gained(const V& viscosity) {
  ParticleSource source;
  const sph::Compressible<kernel::WendlandC2<Dim>, V> law{.kernel = {.support_radius = 0.31}, .viscosity = viscosity};
  std::array<bool, Dim> periodic;
  periodic.fill(true);
  auto scene = simulation::scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<Dim>{.lower = Vector<Dim>::Zero(), .upper = Vector<Dim>::Constant(1.0), .periodic = periodic},
      group<Water>("light", Mobile{}, at_random<Dim>(150, source), 1.0), group<Solid>("heavy", Mobile{}, at_random<Dim>(90, source), 3.7),
      interaction<Water, Water>(law), interaction<Solid, Water>(law), interaction<Solid, Solid>(law),
      material<Water>(eos::IdealGas{}, rheology::Constant{.dynamic_viscosity = 20.0}),
      material<Solid>(eos::IdealGas{.heat_capacity_ratio = 1.1}, rheology::Constant{.dynamic_viscosity = 70.0}));
  scene.engine().for_each_group([&](auto& g) {
    g.template set<field::Density>([&](const auto&) { return source.between(150.0, 400.0); });
    g.template set<field::SpecificEnergy>([&](const auto&) { return source.between(1.0, 2.0); });
    g.template set<field::Velocity>([&](const auto&) {
      Vector<Dim> v;
      for (int d = 0; d < Dim; ++d) v[d] = source.between(-1.0, 1.0);
      return v;
    });
  });
  (void)scene.step_limit();  // evaluates
  double gain = 0.0, turnover = 0.0;
  scene.engine().for_each_group([&](const auto& g) {
    for (std::size_t i = 0; i < g.size(); ++i) {
      const auto& v = g.template get<field::Velocity>()[i];
      const auto& a = g.template get<field::Acceleration>()[i];
      const double heating = g.template get<field::SpecificEnergyRate>()[i];
      gain += g.mass * (v.dot(a) + heating);
      turnover += g.mass * (v.norm() * a.norm() + std::fabs(heating));
    }
  });
  CHECK(turnover > 0.0);
  return std::fabs(gain) / turnover;
}

}  // namespace

TEST_CASE("what the motion of random particles loses their internal energy gains, under every viscosity, in 2D and 3D") {
  CHECK(energy_gained<2>(viscosity::None{}) < 1e-15);
  CHECK(energy_gained<2>(viscosity::Morris<>{}) < 1e-15);
  CHECK(energy_gained<2>(viscosity::Monaghan<2>{}) < 1e-15);
  CHECK(energy_gained<2>(viscosity::Artificial{.alpha = 1.0, .sound_speed = 2.0}) < 1e-15);
  CHECK(energy_gained<2>(viscosity::ShockCapturing{.alpha = 1.0, .beta = 2.0}) < 1e-15);
  CHECK(energy_gained<3>(viscosity::Morris<HarmonicMean>{}) < 1e-15);
  CHECK(energy_gained<3>(viscosity::Monaghan<3>{}) < 1e-15);
  CHECK(energy_gained<3>(viscosity::Artificial{.alpha = 1.0, .sound_speed = 2.0}) < 1e-15);
  CHECK(energy_gained<3>(viscosity::ShockCapturing{.alpha = 1.0, .beta = 2.0}) < 1e-15);
}

namespace {

constexpr double rho = 2.0, support = 2.6, second_moment = 1.0061;  // of the square lattice of spacing 1: sheet 06, 2.1

/// A square lattice of spacing 1, 11 x 11, whose middle particle (60) has all its neighbours.
template <class Law, class... Material>
auto lattice(const Law& law, const Material&... laws) {
  return scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>::unbounded(),
      group<Water>("water", Mobile{}, geometry::fill(geometry::Cubic<2>{.spacing = 1.0}, {.lower = {0.0, 0.0}, .upper = {11.0, 11.0}}),
                   rho),
      interaction<Water, Water>(law), material<Water>(laws...));
}

}  // namespace

TEST_CASE("compression heats and expansion cools: de/dt = p/rho^2 drho/dt, with the divergence of the lattice") {
  auto scene =
      lattice(sph::Compressible<kernel::Lucy<2>>{.kernel = {.support_radius = support}}, eos::IdealGas{.heat_capacity_ratio = 1.4});
  auto& gas = scene.group<Water>();
  gas.set<field::Density>([](const auto&) { return rho; });
  gas.set<field::SpecificEnergy>([](const auto&) { return 5.0; });  // p = 0.4 rho e = 4 Pa, p/rho = 2
  for (const double rate : {-0.3, 0.3}) {                           // v = rate x: the divergence is 2 rate
    auto fresh = scene;
    auto& group = fresh.group<Water>();
    group.set<field::Velocity>([&](const Vector<2>& x) { return Vector<2>(rate * x); });
    (void)fresh.step_limit();
    CHECK(group.get<field::DensityRate>()[60] == doctest::Approx(-rho * 2.0 * rate * second_moment).epsilon(1e-4));
    CHECK(group.get<field::SpecificEnergyRate>()[60] == doctest::Approx(-2.0 * 2.0 * rate * second_moment).epsilon(1e-4));
  }
}

TEST_CASE("friction of a shear flow heats by nu gamma^2, whichever way it shears") {
  constexpr double mu = 0.7;
  for (const double gamma : {-0.5, 0.5}) {
    auto scene = lattice(sph::Compressible<kernel::Lucy<2>, viscosity::Morris<>>{.kernel = {.support_radius = support}},
                         eos::Tait{.rest_density = rho, .sound_speed_0 = 10.0},
                         rheology::Constant{.dynamic_viscosity = mu});  // p = 0 at rest density
    auto& water = scene.group<Water>();
    water.set<field::Velocity>([&](const Vector<2>& x) { return Vector<2>(gamma * x[1], 0.0); });
    (void)scene.step_limit();
    CHECK(water.get<field::SpecificEnergyRate>()[60] == doctest::Approx(mu / rho * gamma * gamma * second_moment).epsilon(1e-4));
    for (const double heating : water.get<field::SpecificEnergyRate>()) CHECK(heating > 0.0);
  }
}

TEST_CASE("a shock's viscosity heats where particles meet and does nothing where they part; the quadratic term adds heat") {
  const auto heating = [](double rate, double alpha, double beta) {
    auto scene = lattice(sph::Compressible<kernel::Lucy<2>, viscosity::ShockCapturing>{.kernel = {.support_radius = support},
                                                                                       .viscosity = {.alpha = alpha, .beta = beta}},
                         eos::Tait{.rest_density = rho, .sound_speed_0 = 10.0});
    auto& water = scene.template group<Water>();
    water.template set<field::Velocity>([&](const Vector<2>& x) { return Vector<2>(rate * x); });
    (void)scene.step_limit();
    return water.template get<field::SpecificEnergyRate>()[60];
  };
  CHECK(heating(0.3, 1.0, 2.0) == 0.0);
  CHECK(heating(-0.3, 1.0, 0.0) > 0.0);
  CHECK(heating(-0.3, 0.0, 1.0) > 0.0);
  CHECK(heating(-0.3, 1.0, 1.0) == doctest::Approx(heating(-0.3, 1.0, 0.0) + heating(-0.3, 0.0, 1.0)).epsilon(1e-12));
  CHECK(heating(-0.6, 1.0, 0.0) == doctest::Approx(4.0 * heating(-0.3, 1.0, 0.0)).epsilon(1e-12));  // force times speed: second order
  CHECK(heating(-0.6, 0.0, 1.0) == doctest::Approx(8.0 * heating(-0.3, 0.0, 1.0)).epsilon(1e-12));  // third
}

namespace {

/// T = e/c.
struct Caloric {
  double c;  // [J/(kg K)]
  [[nodiscard]] auto temperature(const auto& e) const { return e * (1.0 / c); }
  [[nodiscard]] auto specific_energy(const auto& temperature) const { return temperature * c; }
  [[nodiscard]] double specific_heat() const { return c; }
};
void validate(const Caloric&) {}
struct Conductor {
  using reads = Fields<>;
  using writes = Fields<field::ThermalConductivity>;
  double kappa;  // [W/(m K)]
  void apply(auto& particle) const { particle.thermal_conductivity = kappa; }
};
void validate(const Conductor&) {}
struct Solidity {
  using reads = Fields<>;
  using writes = Fields<field::Density>;
  double rho;  // [kg/m^3]
  void apply(auto& particle) const { particle.density = rho; }
};
void validate(const Solidity&) {}
static_assert(thermal::ThermalLaw<Caloric>);

struct Hot {};
struct Cold {};
template <class Mean>
struct Exchange {
  double of_hot, of_cold;  // [W]
};
/// Two particles at rest, one of 1/2 kg and one of 2 kg, a metre apart.
template <class Mean>
Exchange<Mean> exchange(double hot, double cold, double kappa_hot, double kappa_cold) {
  auto pair = scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>::unbounded(), group<Hot>("hot", Stationary{}, geometry::Points<2>{.positions = {{0.0, 0.0}}}, 0.5),
      group<Cold>("cold", Stationary{}, geometry::Points<2>{.positions = {{0.6, 0.8}}}, 2.0),
      interaction<Hot, Cold>(sph::HeatConduction<kernel::Lucy<2>, Mean>{.kernel = {.support_radius = support}}),
      material<Hot>(Caloric{3.0}, Conductor{kappa_hot}, Solidity{1.3}), material<Cold>(Caloric{7.0}, Conductor{kappa_cold}, Solidity{0.7}));
  pair.template group<Hot>().template set<field::SpecificEnergy>([&](const auto&) { return 3.0 * hot; });
  pair.template group<Cold>().template set<field::SpecificEnergy>([&](const auto&) { return 7.0 * cold; });
  (void)pair.step_limit();
  return {0.5 * pair.template group<Hot>().template get<field::SpecificEnergyRate>()[0],
          2.0 * pair.template group<Cold>().template get<field::SpecificEnergyRate>()[0]};
}

}  // namespace

TEST_CASE("HX-0: one pair: what one gains the other loses, to the last bit; heat goes to the cold; nothing at equal temperature") {
  const auto flow = exchange<HarmonicMean>(400.0, 300.0, 0.6, 0.0255);
  CHECK(flow.of_hot < 0.0);
  CHECK(flow.of_cold == -flow.of_hot);
  CHECK(exchange<ArithmeticMean>(300.0, 400.0, 0.6, 0.0255).of_hot > 0.0);
  CHECK(exchange<HarmonicMean>(512.0, 512.0, 0.6, 0.0255).of_hot == 0.0);
  CHECK(exchange<ArithmeticMean>(512.0, 512.0, 0.6, 0.0255).of_cold == 0.0);
}

TEST_CASE(
    "HX-0: the means of two conductivities: alike for equal ones; else theirs stand as 4ab/(a + b)^2; an insulator passes nothing through "
    "the harmonic one") {
  const auto harmonic = [](double a, double b) { return exchange<HarmonicMean>(400.0, 300.0, a, b).of_cold; };
  const auto arithmetic = [](double a, double b) { return exchange<ArithmeticMean>(400.0, 300.0, a, b).of_cold; };
  CHECK(harmonic(0.6, 0.6) == doctest::Approx(arithmetic(0.6, 0.6)).epsilon(1e-14));
  CHECK(harmonic(3.0, 1.0) == doctest::Approx(0.75 * arithmetic(3.0, 1.0)).epsilon(1e-14));
  CHECK(harmonic(3.0, 1.0) == doctest::Approx(harmonic(1.0, 3.0)).epsilon(1e-14));
  CHECK(harmonic(1e9, 1.0) == doctest::Approx(2.0 * harmonic(1.0, 1.0)).epsilon(1e-8));  // the weaker decides
  CHECK(harmonic(3.0, 0.0) == 0.0);
  CHECK(arithmetic(3.0, 0.0) == doctest::Approx(0.5 * arithmetic(3.0, 3.0)).epsilon(1e-14));
}

TEST_CASE("conduction on a lattice is Fourier's: nothing in a linear temperature, kappa/rho T'' in a parabola") {
  const auto rate = [](const auto& temperature) {
    auto scene =
        lattice(sph::HeatConduction<kernel::Lucy<2>>{.kernel = {.support_radius = support}}, Caloric{3.0}, Conductor{0.8}, Solidity{rho});
    scene.template group<Water>().template set<field::SpecificEnergy>([&](const Vector<2>& x) { return 3.0 * temperature(x[0] - 5.5); });
    (void)scene.step_limit();
    return scene.template group<Water>().template get<field::SpecificEnergyRate>()[60];
  };
  CHECK(std::fabs(rate([](double x) { return 300.0 + 5.0 * x; })) < 1e-12);
  CHECK(rate([](double x) { return 300.0 + 5.0 * x * x; }) == doctest::Approx(0.8 / rho * 10.0 * second_moment).epsilon(1e-4));
}

TEST_CASE("two halves of a periodic bar: heat is kept, goes from hot to cold only, and no temperature leaves the range it started in") {
  const geometry::Cubic<2> lattice{.spacing = 1.0};
  const sph::HeatConduction<kernel::Lucy<2>> law{.kernel = {.support_radius = support}};
  auto bar = scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {20.0, 6.0}, .periodic = {true, true}},
      group<Hot>("hot", Stationary{}, geometry::fill(lattice, {.lower = {0.0, 0.0}, .upper = {10.0, 6.0}}), 2.0),
      group<Cold>("cold", Stationary{}, geometry::fill(lattice, {.lower = {10.0, 0.0}, .upper = {20.0, 6.0}}), 0.3),
      interaction<Hot, Hot>(law), interaction<Hot, Cold>(law), interaction<Cold, Cold>(law),
      material<Hot>(Caloric{3.0}, Conductor{0.6}, Solidity{2.0}), material<Cold>(Caloric{7.0}, Conductor{0.05}, Solidity{0.3}));
  bar.group<Hot>().set<field::SpecificEnergy>([](const auto&) { return 3.0 * 400.0; });
  bar.group<Cold>().set<field::SpecificEnergy>([](const auto&) { return 7.0 * 300.0; });
  const auto heat = [&](const auto& group) {
    const auto& e = group.template get<field::SpecificEnergy>();
    return group.mass * std::accumulate(e.begin(), e.end(), 0.0);
  };
  const double before = heat(bar.group<Hot>()) + heat(bar.group<Cold>());
  double of_hot = heat(bar.group<Hot>()), rises = 0.0, coldest = 1e30, hottest = 0.0;
  bar.every(1.0, [&](const auto& scene) {
    rises = std::max(rises, heat(scene.template group<Hot>()) - of_hot);
    of_hot = heat(scene.template group<Hot>());
    for (const double e : scene.template group<Hot>().template get<field::SpecificEnergy>())
      hottest = std::max(hottest, e / 3.0), coldest = std::min(coldest, e / 3.0);
    for (const double e : scene.template group<Cold>().template get<field::SpecificEnergy>())
      hottest = std::max(hottest, e / 7.0), coldest = std::min(coldest, e / 7.0);
  });
  bar.run({.until = 400.0});
  CHECK(bar.step() > 50);
  CHECK(heat(bar.group<Hot>()) + heat(bar.group<Cold>()) == doctest::Approx(before).epsilon(1e-13));
  CHECK(rises <= 0.0);
  CHECK(hottest <= 400.0 * (1.0 + 1e-12));
  CHECK(coldest >= 300.0 * (1.0 - 1e-12));
  CHECK(of_hot < 0.97 * 120.0 * 3.0 * 400.0);
}
