// What a researcher writes (sheet 06, sections 5.2 and 5.3): three laws that the library does not know, each as short as the sheet asks,
// used in a scene without touching any file of the library.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <doctest/doctest.h>

#include "scenes.hpp"

namespace user {
using namespace dmp;

// law: KelvinVoigt
struct KelvinVoigt {
  double k, c;  // [N/m], [N s/m]
  auto tension(const auto& bond) const { return k * (bond.length - bond.rest_length) + c * bond.length_rate; }
  double largest_stiffness() const { return k; }
  double largest_damping() const { return c; }
};
// end
// law: Nasg
struct Nasg {
  double gamma, p_inf, b, q, cv;  // [-], [Pa], [m^3/kg], [J/kg], [J/kg/K]
  auto theta(auto rho, auto e) const { return (e - q) - p_inf * (1.0 / rho - b); }
  auto pressure(auto rho, auto e) const { return (gamma - 1.0) * theta(rho, e) / (1.0 / rho - b) - p_inf; }
  auto temperature(auto rho, auto e) const { return theta(rho, e) / cv; }
  auto sound_speed(auto rho, auto e) const { return sqrt(gamma * (pressure(rho, e) + p_inf) / (rho * (1.0 - b * rho))); }
  auto specific_energy(auto p, auto rho) const { return q + (p + gamma * p_inf) * (1.0 / rho - b) / (gamma - 1.0); }
};
// end
// law: Arrhenius
struct Arrhenius {
  double c1, c2; auto viscosity(auto temperature) const { return c1 * exp(c2 / temperature); }  // [Pa s], [K]
};
// end
}  // namespace user

using namespace test;

namespace {

/// Lines of code between "// law: <name>" and "// end" in this file.
int lines_of(const std::string& name) {
  std::ifstream file(__FILE__);
  std::string line;
  int lines = -1;
  while (std::getline(file, line)) {
    if (line == "// law: " + name) lines = 0;
    else if (lines >= 0 && line == "// end") return lines;
    else if (lines >= 0 && !line.empty()) ++lines;
  }
  return -1;
}

struct Bead {};
struct Post {};

}  // namespace

TEST_CASE("users' laws are short: Kelvin-Voigt <= 6 lines, NASG <= 10, Arrhenius <= 3") {
  CHECK(lines_of("KelvinVoigt") >= 1);
  CHECK(lines_of("KelvinVoigt") <= 6);
  CHECK(lines_of("Nasg") >= 1);
  CHECK(lines_of("Nasg") <= 10);
  CHECK(lines_of("Arrhenius") >= 1);
  CHECK(lines_of("Arrhenius") <= 3);
}

TEST_CASE("KV-1: creep of one user-written Kelvin-Voigt bond, bead 1 held, against the exact over-, critically and under-damped solution") {
  struct Case {
    double damping, at_1, at_5;
  };
  for (const Case& c : {Case{0.2, 0.43102811, 0.90144933}, Case{2.0, 0.26424112, 0.95957232}, Case{20.0, 0.04649431, 0.21972777}}) {
    CAPTURE(c.damping);
    auto scene = simulation::scene<integrator::ExtrapolatedVerlet>(
        geometry::Box<2>::unbounded(), group<Bead>("bead", Mobile{}, geometry::Points<2>{.positions = {{1.0, 0.0}}}, 1.0),
        group<Post>("post", Frozen<2>{}, geometry::Points<2>{.positions = {{0.0, 0.0}}}, 1.0),
        bonds<Bead, Post>(user::KelvinVoigt{.k = 1.0, .c = c.damping}, {{0, 0}}),
        forced_by<Bead>(forcing::Constant<2>{.uniform_acceleration = {{{1.0, 0.0}}}}));
    scene.run({.until = 1.0, .time_step = 1e-3});
    CHECK(std::fabs(scene.group<Bead>().positions()[0][0] - 1.0 - c.at_1) <= 1e-6);
    scene.run({.until = 5.0, .time_step = 1e-3});
    CHECK(std::fabs(scene.group<Bead>().positions()[0][0] - 1.0 - c.at_5) <= 1e-6);
    CHECK(scene.group<Bead>().positions()[0][1] == 0.0);
  }
}

TEST_CASE("NASG-0: the user-written Noble-Abel stiffened gas of liquid water gives the states of the sheet's table 4.2") {
  static_assert(eos::ThermalEquationOfState<user::Nasg>);
  const user::Nasg water{.gamma = 1.19, .p_inf = 7.028e8, .b = 6.61e-4, .q = -1177788.0, .cv = 3610.0};
  struct State {
    double pressure, density, energy, temperature, sound_speed;
  };
  for (const State& s :
       {State{101325.0, 1000.0, 314585.143, 347.40275, 1570.7997}, State{1e9, 1000.0, 2098614.884, 841.59382, 2444.8682},
        State{101325.0, 1100.0, -85622.18951, 254.24031, 1669.2545}, State{5e6, 1050.731727, 109528.4114, 300.0, 1619.9483}}) {
    CAPTURE(s.pressure);
    const double energy = water.specific_energy(s.pressure, s.density);
    CHECK(std::fabs(energy - s.energy) <= 3e-3);  // [J/kg]: the printed digits of the density leave 2e-3
    CHECK(water.temperature(s.density, energy) == doctest::Approx(s.temperature).epsilon(2e-8));
    CHECK(water.sound_speed(s.density, energy) == doctest::Approx(s.sound_speed).epsilon(3e-8));
    CHECK(std::fabs(water.pressure(s.density, energy) - s.pressure) <= 1e-9 * water.p_inf);
  }
}

TEST_CASE("a gas at uniform pressure under a user-written thermal equation of state stays at rest") {
  const double spacing = 0.05;
  using Law = sph::WeaklyCompressible<kernel::Lucy<2>>;
  auto scene = simulation::scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {0.5, 0.5}, .periodic = {true, true}},
      group<Water>("gas", Mobile{}, geometry::fill(geometry::Cubic<2>{.spacing = spacing}, {.lower = {0.0, 0.0}, .upper = {0.5, 0.5}}),
                   spacing * spacing),
      interaction<Water, Water>(Law{.kernel = {.support_radius = 2.6 * spacing}}),
      material<Water>(user::Nasg{.gamma = 1.4, .p_inf = 0.0, .b = 0.0, .q = 0.0, .cv = 1.0}));
  auto& gas = scene.group<Water>();
  gas.set<field::Density>([](const auto&) { return 1.0; });
  gas.set<field::SpecificEnergy>([](const auto&) { return 2.5; });  // p = 1, c = sqrt(1.4)
  CHECK(scene.step_limit().stable_time_step == doctest::Approx(0.25 * 2.6 * spacing / std::sqrt(1.4)));
  scene.run({.until = 0.2});
  double fastest = 0.0;
  for (const auto& v : gas.get<field::Velocity>()) fastest = std::max(fastest, v.norm());
  CHECK(fastest < 1e-10);
}

TEST_CASE("VISC-0: the user-written Arrhenius law; in a scene the viscosity of a pair follows the temperatures of its particles") {
  const user::Arrhenius law{.c1 = 1.83e-4, .c2 = 1879.9};
  CHECK(law.viscosity(295.0) == doctest::Approx(0.107154664).epsilon(1e-5));
  CHECK(law.viscosity(331.0036) == doctest::Approx(0.0535773).epsilon(1e-5));
  const double spacing = 0.1;
  auto scene = simulation::scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {true, true}},
      group<Water>("water", Mobile{}, geometry::fill(geometry::Cubic<2>{.spacing = spacing}, {.lower = {0.0, 0.0}, .upper = {1.0, 1.0}}),
                   spacing * spacing),
      interaction<Water, Water>(Flow{.kernel = {.support_radius = 2.6 * spacing}}),
      material<Water>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 1.0}, law));
  auto& water = scene.group<Water>();
  water.set<field::Density>([](const auto&) { return 1.0; });
  water.set<field::Temperature>([](const Vector<2>& x) { return x[0] < 0.5 ? 295.0 : 331.0036; });
  CHECK(scene.engine().prepared(water, 0, 0.0).dynamic_viscosity == doctest::Approx(0.107154664).epsilon(1e-5));
  CHECK(scene.engine().prepared(water, 9, 0.0).dynamic_viscosity == doctest::Approx(0.0535773).epsilon(1e-5));
}
