// The bound of the time step that heat conduction states, against the step at which a run in fact begins to grow.
#include <cmath>
#include <doctest/doctest.h>

#include "scenes.hpp"
#include "support/particles.hpp"

using namespace test;

namespace {

struct Caloric {  // T = e/c
  double c;       // [J/(kg K)]
  [[nodiscard]] auto temperature(const auto& e) const { return e * (1.0 / c); }
  [[nodiscard]] auto specific_energy(const auto& temperature) const { return temperature * c; }
  [[nodiscard]] double specific_heat() const { return c; }
};
void validate(const Caloric&) {}
struct Conductor {
  using reads = Fields<>;
  using writes = Fields<field::ThermalConductivity, field::Density>;
  double kappa, rho;  // [W/(m K)], [kg/m^3]
  void apply(auto& particle) const {
    particle.thermal_conductivity = kappa;
    particle.density = rho;
  }
};
void validate(const Conductor&) {}

constexpr int side = 12;
const geometry::Box<2> box{.lower = {0.0, 0.0}, .upper = {side, side}, .periodic = {true, true}};
const geometry::Cubic<2> lattice{.spacing = 1.0};
double sign_at(const Vector<2>& x) { return (static_cast<int>(x[0]) + static_cast<int>(x[1])) % 2 == 0 ? 1.0 : -1.0; }

/// A lattice in which warm and cold particles alternate, 300 K +- 1 K.
template <class Integrator>
auto checkerboard(double support) {
  auto result = scene<Integrator>(
      box, group<Solid>("plate", Stationary{}, geometry::fill(lattice, {.lower = {0.0, 0.0}, .upper = {side, side}}), 2.0),
      interaction<Solid, Solid>(sph::HeatConduction<kernel::Lucy<2>>{.kernel = {.support_radius = support}}),
      material<Solid>(Caloric{3.0}, Conductor{0.7, 2.0}));
  result.template group<Solid>().template set<field::SpecificEnergy>([](const Vector<2>& x) { return 3.0 * (300.0 + sign_at(x)); });
  return result;
}
/// Largest |T - 300 K| in the end, of 1 K at the start.
template <class Scene>
double amplitude(const Scene& scene) {
  double largest = 0.0;
  for (const double e : scene.template group<Solid>().template get<field::SpecificEnergy>())
    largest = std::max(largest, std::fabs(e / 3.0 - 300.0));
  return std::isfinite(largest) ? largest : INFINITY;
}
/// The same after 300 steps that nobody has checked.
template <class Scene>
double amplitude_after(Scene scene, double time_step) {
  auto& engine = scene.engine();
  engine.evaluate(0.0, 0);
  for (std::uint64_t step = 1; step <= 300; ++step) {
    (void)engine.begin_step(time_step, static_cast<double>(step) * time_step);
    engine.prepare_forces(time_step, step, false);
    engine.forces(time_step, static_cast<double>(step) * time_step);
    engine.end_step(time_step);
  }
  return amplitude(scene);
}

/// The largest stable step of a checkerboard as a multiple of the one that the scene states.
template <class Integrator>
double sharpness(double support) {
  CAPTURE(Integrator::name);
  CAPTURE(support);
  auto scene = checkerboard<Integrator>(support);
  const auto limit = scene.step_limit();
  CHECK(limit.stability_bound_by == "heat conduction");
  const double stated = limit.stable_time_step;
  auto run = scene;
  run.run({.until = 300.0 * stated, .time_step = 0.95 * stated});
  CHECK(amplitude(run) < 1e-3);
  CHECK_THROWS_WITH_AS(scene.run({.until = 300.0 * stated, .time_step = 1.01 * stated}),
                       doctest::Contains("the bound of heat conduction, got"), ParameterError);
  double stable = 0.95, unstable = 4.0;
  CHECK(amplitude_after(scene, unstable * stated) > 1e3);
  for (int n = 0; n < 12; ++n) {
    const double middle = 0.5 * (stable + unstable);
    (amplitude_after(scene, middle * stated) < 1.0 ? stable : unstable) = middle;
  }
  CHECK(amplitude_after(scene, 1.05 * unstable * stated) > 10.0);
  return stable;
}

}  // namespace

TEST_CASE(
    "the bound of heat conduction: a checkerboard of temperatures decays at 0.95 of it and grows beyond less than 1.5 times it, under "
    "every integrator") {
  for (const double support : {1.5, 2.0, 2.6}) {
    const double ratios[] = {sharpness<integrator::ExtrapolatedVerlet>(support), sharpness<integrator::LammpsVerlet>(support),
                             sharpness<integrator::Leapfrog>(support), sharpness<integrator::SymplecticEuler>(support)};
    MESSAGE("largest stable step/stated bound, support ", support, ": ", ratios[0], " ", ratios[1], " ", ratios[2], " ", ratios[3]);
    for (const double ratio : ratios) {
      CHECK(ratio >= 1.0);
      CHECK(ratio <= 1.5);
    }
  }
}

namespace {

/// Layers of liquid and of gas, 600 times lighter for heat, of random temperatures from 300 to 400 K; the range of temperatures after 1000
/// steps at 0.95 of the bound.
template <class Mean, class OfLiquid>
std::pair<double, double> range_of_layers(const OfLiquid& mobility) {
  const sph::HeatConduction<kernel::Lucy<2>, Mean> law{.kernel = {.support_radius = 2.6}};
  const double half = 0.5 * side;
  auto scene = simulation::scene<integrator::ExtrapolatedVerlet>(
      box, group<Water>("liquid", mobility, geometry::fill(lattice, {.lower = {0.0, 0.0}, .upper = {side, half}}), 1000.0),
      group<Solid>("gas", Stationary{}, geometry::fill(lattice, {.lower = {0.0, half}, .upper = {side, side}}), 1.0),
      interaction<Water, Water>(law), interaction<Water, Solid>(law), interaction<Solid, Solid>(law),
      material<Water>(Caloric{4000.0}, Conductor{0.6, 1000.0}), material<Solid>(Caloric{6000.0}, Conductor{0.025, 1.0}));
  ParticleSource source;
  scene.template group<Water>().template set<field::SpecificEnergy>([&](const auto&) { return 4000.0 * source.between(300.0, 400.0); });
  scene.template group<Solid>().template set<field::SpecificEnergy>([&](const auto&) { return 6000.0 * source.between(300.0, 400.0); });
  const double step = 0.95 * scene.step_limit().stable_time_step;
  scene.run({.until = 1000.0 * step, .time_step = step});
  double coldest = INFINITY, hottest = 0.0;
  for (const double e : scene.template group<Water>().template get<field::SpecificEnergy>())
    coldest = std::min(coldest, e / 4000.0), hottest = std::max(hottest, e / 4000.0);
  for (const double e : scene.template group<Solid>().template get<field::SpecificEnergy>())
    coldest = std::min(coldest, e / 6000.0), hottest = std::max(hottest, e / 6000.0);
  return {coldest, hottest};
}

}  // namespace

TEST_CASE(
    "the bound of heat conduction holds where a light gas lies beside a liquid, or beside a frozen one, with either mean: no temperature "
    "leaves its range") {
  const std::pair<double, double> ranges[] = {range_of_layers<HarmonicMean>(Stationary{}), range_of_layers<ArithmeticMean>(Stationary{}),
                                              range_of_layers<HarmonicMean>(Frozen<2>{}), range_of_layers<ArithmeticMean>(Frozen<2>{})};
  for (const auto& [coldest, hottest] : ranges) {
    CHECK(coldest >= 300.0);
    CHECK(hottest <= 400.0);
  }
}
