// Scenes of the library's own fluids at and beyond the ends of their ranges: what stops, where, and which step the laws ask for.
#include <cmath>
#include <string>
#include <type_traits>
#include <doctest/doctest.h>
#include <dmp/dmp.hpp>

namespace {

using namespace dmp;
using namespace dmp::simulation;
using particles::Mobile, particles::Stationary;

struct Fluid {};
constexpr double spacing = 0.1;

geometry::Points<2> lattice() {
  return geometry::fill(geometry::Cubic<2>{.spacing = spacing}, geometry::Cuboid<2>{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}});
}
geometry::Box<2> periodic() { return {.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {true, true}}; }

/// A periodic square of one fluid at rest.
template <class Eos>
auto square_of(const Eos& eos, double density, double specific_energy) {
  const sph::Compressible<kernel::Lucy<2>, viscosity::ShockCapturing> law{.kernel = {.support_radius = 2.6 * spacing}, .viscosity = {.alpha = 1.0}};
  auto result = scene<integrator::ExtrapolatedVerlet>(periodic(), group<Fluid>("fluid", Mobile{}, lattice(), density * spacing * spacing),
                                                      interaction<Fluid, Fluid>(law), material<Fluid>(eos));
  result.template group<Fluid>().template set<field::Density>([=](const auto&) { return density; });
  result.template group<Fluid>().template set<field::SpecificEnergy>([=](const auto&) { return specific_energy; });
  return result;
}

template <class Scene>
std::string complaint(Scene& scene) {
  try {
    scene.run({.until = 1e-3});
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("NASG: water whose theta is not positive is refused at the start, with particle, density and energy; at 1000 kg/m^3 below -939538.8 J/kg") {
  auto good = square_of(eos::liquid_water, 1000.0, -939538.0);
  CHECK(complaint(good).empty());
  auto bad = square_of(eos::liquid_water, 1000.0, 314585.143);
  bad.group<Fluid>().get<field::SpecificEnergy>()[18] = -939539.6;
  const std::string text = complaint(bad);
  CHECK(text.find("scene: group fluid, particle 18: eos::NobleAbelStiffenedGas: theta") == 0);
  CHECK(text.find("density 1000 kg/m^3, specific_energy -939539.6 J/kg") != std::string::npos);
}

TEST_CASE("NASG: a density within 1e-6 of 1/b is refused") {
  auto dense = square_of(eos::liquid_water, 1512.858, 1e6);
  CHECK(complaint(dense).find("particle 0: eos::NobleAbelStiffenedGas") != std::string::npos);
}

TEST_CASE("the ideal gas refuses an energy of zero, and one below") {
  for (const double e : {0.0, -1.0}) {
    auto cold = square_of(eos::IdealGas{}, 1.2, e);
    CHECK(complaint(cold).find("scene: group fluid, particle 0: eos::IdealGas") == 0);
  }
}

TEST_CASE("NASG: the step follows the local sound speed, 1571 m/s at 1000 kg/m^3 and 1 bar, 8100 at 1500") {
  const auto step = [](double density) {
    return square_of(eos::liquid_water, density, eos::liquid_water.specific_energy(1e5, density)).step_limit().stable_time_step;
  };
  CHECK(step(1000.0) / step(1500.0) == doctest::Approx(8100.0 / 1571.0).epsilon(1e-3));  // sheet 06, section 6
}

TEST_CASE("a liquid that is torn apart stops with the particle and the rule, not with a number that is none") {
  auto torn = square_of(eos::liquid_water, 1000.0, 314585.143);
  torn.group<Fluid>().set<field::Velocity>([](const auto& x) { return Vector<2>(4e4 * (x[0] < 0.5 ? -1.0 : 1.0), 0.0); });
  bool caught = false;
  try {
    torn.run({.until = 1e-3});
  } catch (const SimulationError& error) {
    caught = true;
    CHECK(error.where.particle >= 0);
    CHECK(error.where.group == "fluid");
    CHECK(std::isfinite(error.where.value));
  }
  CHECK(caught);
}

TEST_CASE("Arrhenius: the step follows the largest viscosity, and a temperature outside the range stops with law and range") {
  constexpr rheology::Arrhenius oil{.pre_exponential_factor = 1.83e-4, .activation_temperature = 1879.9, .temperature_range = {.lowest = 250.0, .highest = 400.0}};
  const sph::WeaklyCompressible<kernel::Lucy<2>, viscosity::Morris<>> law{.kernel = {.support_radius = 2.6 * spacing}};
  const auto at = [&](double temperature) {
    auto result = scene<integrator::ExtrapolatedVerlet>(periodic(), group<Fluid>("fluid", Mobile{}, lattice(), 10.0), interaction<Fluid, Fluid>(law),
                                                        material<Fluid>(eos::Tait{.rest_density = 1000.0, .sound_speed_0 = 1e-4}, oil));
    result.template group<Fluid>().template set<field::Temperature>([](const auto&) { return 350.0; });
    result.template group<Fluid>().template get<field::Temperature>()[7] = temperature;
    return result;
  };
  auto warm = at(300.0), cold = at(295.0), frozen = at(249.0);
  CHECK(warm.step_limit().stability_bound_by == "viscosity");
  CHECK(warm.step_limit().stable_time_step / cold.step_limit().stable_time_step == doctest::Approx(0.107154664 / 0.0963574).epsilon(1e-5));
  CHECK(complaint(frozen).find("scene: group fluid, particle 7: rheology::Arrhenius: temperature must be in [250, 400] K, got temperature 249 K") == 0);
}

namespace {
struct Push {  // makes waves of shear
  double strength;
  [[nodiscard]] auto acceleration(const auto& subject) const noexcept {
    return Components<2, double>{0.0, strength * std::sin(6.283185307179586 * subject.position[0])};
  }
};
}  // namespace

TEST_CASE("a fluid that thickens from rest: the step follows; one that was given is refused at the step where it is too long") {
  constexpr double h = 2.6 * spacing;
  const sph::WeaklyCompressible<kernel::Lucy<2>, viscosity::Morris<>> law{.kernel = {.support_radius = h}};
  const rheology::PowerLaw thickening{.consistency_index = 1.0, .power_law_index = 1.5, .lowest_shear_rate = 0.01, .lowest_viscosity = 1e-3, .highest_viscosity = 1e3};
  const auto at_rest = [&] {
    return scene<integrator::ExtrapolatedVerlet>(periodic(), group<Fluid>("fluid", Mobile{}, lattice(), spacing * spacing), interaction<Fluid, Fluid>(law),
                                                 summed<Fluid>(sph::ShearRate<kernel::Lucy<2>>{.kernel = {.support_radius = h}}),
                                                 material<Fluid>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 10.0}, thickening), forced_by<Fluid>(Push{100.0}));
  };
  auto free = at_rest();
  const double first = free.step_limit().stable_time_step;
  const auto report = free.run({.until = 0.5});
  CHECK(report.limit.stable_time_step < 0.5 * first);
  for (const auto& v : free.group<Fluid>().get<field::Velocity>()) CHECK(v.norm() < 0.5 * 100.0);  // what the push alone would have made of it

  auto given = at_rest();
  bool caught = false;
  try {
    given.run({.until = 0.5, .time_step = 0.9 * first});
  } catch (const SimulationError& error) {
    caught = true;
    CHECK(std::string(error.what()).find("the given time step is longer than") != std::string::npos);
    CHECK(error.where.step < 100);
  }
  CHECK(caught);
}
