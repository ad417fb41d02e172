// Extremes of scenes: the right result, or the right error. The table of all of them: docs/stability.md.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>
#include <doctest/doctest.h>

#include "scenes.hpp"
#include "support/random.hpp"

using namespace test;
using integrator::ExtrapolatedVerlet, integrator::Leapfrog;

// ---- Gas on a line: strong shocks, vacuum -------------------------------------------------------------------------------------------

namespace {

struct Gas {};

/// A row of gas particles of density 1 at rest, with the given pressure; `support` in spacings.
template <class Pressure>
auto row_of_gas(double first, double last, double half_box, int particles, double support, const Pressure& pressure) {
  const double spacing = (last - first) / particles;
  const eos::IdealGas gas{};
  auto row = scene<ExtrapolatedVerlet>(geometry::Box<1>{.lower = {-half_box}, .upper = {half_box}, .periodic = {true}},
                                       group<Gas>("gas", Mobile{},
                                                  geometry::fill(geometry::Cubic<1>{.spacing = spacing, .origin = Vector<1>(first)},
                                                                 {.lower = Vector<1>(first), .upper = Vector<1>(last)}),
                                                  spacing),
                                       interaction<Gas, Gas>(sph::Compressible<kernel::WendlandC2<1>, viscosity::ShockCapturing>{
                                           .kernel = {.support_radius = support * spacing}, .viscosity = {.alpha = 1.0, .beta = 1.0}}),
                                       material<Gas>(gas));
  auto& g = row.template group<Gas>();
  g.template set<field::Density>([](const auto&) { return 1.0; });
  g.template set<field::SpecificEnergy>([&](const Vector<1>& x) { return gas.specific_energy(pressure(x[0]), 1.0); });
  return row;
}
/// Kinetic and internal energy [J].
double energy_of(const auto& g) {
  double sum = 0.0;
  for (std::size_t i = 0; i < g.size(); ++i)
    sum += g.mass * (0.5 * g.template get<field::Velocity>()[i].squaredNorm() + g.template get<field::SpecificEnergy>()[i]);
  return sum;
}
constexpr double gamma_ = 1.4;  // of eos::IdealGas

}  // namespace

TEST_CASE(
    "pressure ratio 1e5: a shock tube of ideal gas whose jump is one spacing wide has the exact velocity behind the shock, to 3 %, and the "
    "shock where it should be; energy is kept") {
  constexpr double high = 1.0, low = 1e-5, end = 0.1, spacing = 1.0 / 800.0;
  double least = low, most = high, velocity = 0.0;
  for (int k = 0; k < 100; ++k) {  // the pressure where fan and shock leave the same velocity
    const double p = 0.5 * (least + most);
    const double fan = 2.0 * std::sqrt(gamma_ * high) / (gamma_ - 1.0) * (1.0 - std::pow(p / high, (gamma_ - 1.0) / (2.0 * gamma_)));
    velocity = (p - low) * std::sqrt(2.0 / (gamma_ + 1.0) / (p + (gamma_ - 1.0) / (gamma_ + 1.0) * low));
    (fan > velocity ? least : most) = p;
  }
  const double shock_speed = least / velocity;  // of a density of 1: p* - low = rho s u*, and low is nothing
  const auto tube_of = [](double width) {
    return row_of_gas(-1.0, 1.0, 1.0, 1600, 3.0,
                      [width](double x) { return low + (high - low) / (1.0 + std::exp((std::fabs(x) - 0.5) / width)); });
  };
  auto tube = tube_of(spacing);
  const double before = energy_of(tube.group<Gas>());
  tube.run({.until = end});
  const auto& g = tube.group<Gas>();
  double behind = 0.0, farthest = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    const double x = g.positions()[i][0], u = g.get<field::Velocity>()[i][0];
    if (x > 0.5 + 0.4 * velocity * end && x < 0.5 + 0.9 * velocity * end) behind += u, ++count;
    if (u > 0.5 * velocity) farthest = std::max(farthest, x);
  }
  MESSAGE("velocity behind the shock ", behind / count / velocity, ", shock ", (farthest - 0.5) / (shock_speed * end), ", energy ",
          energy_of(g) / before - 1.0);
  CHECK(count > 10);
  CHECK(behind / count == doctest::Approx(velocity).epsilon(0.03));
  CHECK(farthest - 0.5 == doctest::Approx(shock_speed * end).epsilon(0.03).scale(0.0));
  CHECK(energy_of(g) == doctest::Approx(before).epsilon(1e-6));
  auto sharp = tube_of(1e-3 * spacing);  // work is shared between neighbours, and the cold one has nothing to give
  CHECK_THROWS_WITH_AS(sharp.run({.until = end}), doctest::Contains("eos::IdealGas: specific_energy must be > 0 J/kg"), SimulationError);
}

TEST_CASE("near vacuum: gas let go into empty space expands as the exact fan, its front no faster than 2 c/(gamma - 1); energy is kept") {
  constexpr double end = 0.1;
  const double c = std::sqrt(gamma_);  // pressure and density 1
  auto cloud = row_of_gas(-0.5, 0.5, 2.0, 800, 10.0, [](double) { return 1.0; });
  const double before = energy_of(cloud.group<Gas>());
  cloud.run({.until = end});
  const auto& g = cloud.group<Gas>();
  double fastest = 0.0, error = 0.0, thinnest = 1.0;
  int count = 0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    const double speed = (g.positions()[i][0] - 0.5) / end, u = g.get<field::Velocity>()[i][0];
    fastest = std::max(fastest, u);
    thinnest = std::min(thinnest, g.get<field::Density>()[i]);
    if (speed < -0.8 * c || speed > 0.4 * c) continue;  // inside the fan, from 0.85 of the density to 0.27: there are neighbours still
    error += std::fabs(u - 2.0 / (gamma_ + 1.0) * (c + speed));
    ++count;
  }
  MESSAGE("mean error of the velocity over c ", error / count / c, ", fastest over 2c/(gamma - 1) ", fastest / (2.0 * c / (gamma_ - 1.0)),
          ", thinnest ", thinnest, ", energy ", energy_of(g) / before - 1.0);
  CHECK(count > 50);
  CHECK(error / count < 0.03 * c);
  CHECK(fastest < 2.0 * c / (gamma_ - 1.0));
  CHECK(thinnest > 0.0);
  CHECK(energy_of(g) == doctest::Approx(before).epsilon(1e-4));
}

// ---- Water in a periodic square: units, neighbours, faces, denormals, one particle --------------------------------------------------

namespace {

/// Scales of length [m], time [s] and mass [kg].
struct Scales {
  double length = 1.0, time = 1.0, mass = 1.0;
};
struct Sea {
  geometry::Points<2> points = geometry::fill(geometry::Cubic<2>{.spacing = 1.0}, {.lower = {0.0, 0.0}, .upper = {16.0, 16.0}});
  double support = 2.6;
  Vector<2> size{16.0, 16.0};
  Vector<2> gravity = Vector<2>::Zero();
  Scales unit{};
};
/// Water of density 1, sound speed 1 and viscosity 0.05 in a periodic square, all of it in the units of `sea.unit`.
auto water(Sea sea) {
  const auto& [length, time, mass] = sea.unit;
  for (auto& x : sea.points.positions) x *= length;
  sea.points.spacing *= length;
  const double density = mass / (length * length), speed = length / time;
  auto result = scene<ExtrapolatedVerlet>(
      geometry::Box<2>{.lower = {0.0, 0.0}, .upper = sea.size * length, .periodic = {true, true}},
      group<Water>("water", Mobile{}, sea.points, mass),
      interaction<Water, Water>(Flow{.kernel = {.support_radius = sea.support * length}}),
      material<Water>(eos::Tait{.rest_density = density, .sound_speed_0 = speed},
                      rheology::Constant{.dynamic_viscosity = 0.05 * density * length * speed}),
      forced_by<Water>(forcing::Constant<2>{
          .uniform_acceleration = {{sea.gravity[0] * length / (time * time), sea.gravity[1] * length / (time * time)}}}));
  return result;
}
void stir(auto& scene, double speed) {
  RandomVectors random;
  scene.template group<Water>().template set<field::Velocity>(
      [&](const auto&) { return Vector<2>(random.vector(speed).template head<2>()); });
}
/// Positions and velocities after 200 steps of 0.2, in the units of the sea.
std::vector<double> after_a_while(const Sea& sea, double speed = 0.05) {
  auto scene = water(sea);
  stir(scene, speed * sea.unit.length / sea.unit.time);
  scene.run({.until = 40.0 * sea.unit.time, .time_step = 0.2 * sea.unit.time});
  const auto& g = scene.group<Water>();
  std::vector<double> result(4 * g.size());
  for (std::size_t i = 0; i < g.size(); ++i)
    for (int d = 0; d < 2; ++d) {
      result[4 * g.id[i] + static_cast<std::size_t>(d)] = g.positions()[i][d] / sea.unit.length;
      result[4 * g.id[i] + 2 + static_cast<std::size_t>(d)] = g.get<field::Velocity>()[i][d] * sea.unit.time / sea.unit.length;
    }
  return result;
}
double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::fabs(a[k] - b[k]));
  return largest;
}

}  // namespace

TEST_CASE("huge and tiny units: a flow in micrometres and nanograms, and one in astronomical units, is the same flow") {
  const auto plain = after_a_while({});
  const auto same = [&](const Scales& unit) { return largest_difference(after_a_while({.unit = unit}), plain); };
  CHECK(same({.length = 0x1p-20, .time = 0x1p-30, .mass = 0x1p-60}) == 0.0);  // powers of two: every bit
  CHECK(same({.length = 0x1p60, .time = 0x1p20, .mass = 0x1p100}) == 0.0);
  CHECK(same({.length = 1e-6, .time = 1e-6, .mass = 1e-12}) < 1e-11);
  CHECK(same({.length = 1.496e11, .time = 3.156e7, .mass = 1.989e30}) < 1e-11);
}

TEST_CASE("zero gravity is no gravity, to the bit; denormal velocities move nothing and stay finite") {
  const auto plain = after_a_while({});
  CHECK(largest_difference(after_a_while({.gravity = Vector<2>(0.0, -0.0)}), plain) == 0.0);
  CHECK(largest_difference(after_a_while({.gravity = Vector<2>(1e-3, 0.0)}), plain) > 0.5);  // it falls, g t^2/2 = 0.8
  const auto still = after_a_while({}, 0.0), nearly = after_a_while({}, 1e-310);
  CHECK(largest_difference(still, nearly) < 1e-15);
  for (const double value : nearly) CHECK(std::isfinite(value));
}

TEST_CASE("supports with 3 neighbours, 4 and 300: the flow keeps its momentum, loses energy, and a lattice at rest stays at rest") {
  const double width = std::sqrt(3.0);
  Sea honeycomb{
      .points = {.positions = {}, .spacing = 1.0}, .support = 1.05, .size = {8.0 * width, 15.0}};  // three neighbours at a distance of 1
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 8; ++column)
      for (const Vector<2>& at :
           {Vector<2>(0.25 * width, 0.25), Vector<2>(0.25 * width, 1.25), Vector<2>(0.75 * width, 1.75), Vector<2>(0.75 * width, 2.75)})
        honeycomb.points.positions.push_back(Vector<2>(column * width, 3.0 * row) + at);
  const auto square = geometry::fill(geometry::Cubic<2>{.spacing = 1.0}, {.lower = {0.0, 0.0}, .upper = {24.0, 24.0}});
  for (const auto& dense : {std::pair{honeycomb, 3}, std::pair{Sea{.points = square, .support = 1.05, .size = {24.0, 24.0}}, 4},
                            std::pair{Sea{.points = square, .support = 9.86, .size = {24.0, 24.0}}, 300}}) {
    const Sea& sea = dense.first;
    const int neighbours = dense.second;
    CAPTURE(neighbours);
    int found = 0;
    const geometry::Box<2> box{.lower = {0.0, 0.0}, .upper = sea.size, .periodic = {true, true}};
    for (const auto& x : sea.points.positions)
      found += dmp::neighbours::minimum_image<2>(x - sea.points.positions[0], box).norm() < sea.support ? 1 : 0;
    CHECK(found - 1 == neighbours);
    auto scene = water(sea);
    scene.run({.until = 10.0});
    const auto& v = scene.group<Water>().get<field::Velocity>();
    for (const auto& one : v) CHECK(one.norm() < 1e-12);
    stir(scene, 0.02);
    const auto sums = [&] {
      Vector<2> momentum = Vector<2>::Zero();
      double energy = 0.0;
      for (const auto& one : v) momentum += one, energy += one.squaredNorm();
      return std::pair{momentum, energy};
    };
    const auto before = sums();
    scene.run({.until = 30.0});
    const auto after = sums();
    CHECK((after.first - before.first).norm() < 1e-12);
    CHECK(after.second < before.second);
  }
}

TEST_CASE("particles exactly on a periodic face, the lower or the upper one, feel what they feel inside") {
  const auto accelerations = [](double shift) {
    Sea sea;
    RandomVectors random;
    for (auto& x : sea.points.positions) {
      const Vector<2> jitter = random.vector(0.1).head<2>();
      if (x[0] > 1.0 && x[0] < 15.0) x += jitter;  // the first and the last column stay straight
      x[0] += shift;
    }
    auto scene = water(sea);
    stir(scene, 0.05);
    (void)scene.step_limit();
    const auto& g = scene.group<Water>();
    std::vector<double> result(2 * g.size());
    for (std::size_t i = 0; i < g.size(); ++i)
      for (int d = 0; d < 2; ++d) result[2 * g.id[i] + static_cast<std::size_t>(d)] = g.get<field::Acceleration>()[i][d];
    return result;
  };
  const auto inside = accelerations(0.0);
  CHECK(largest_difference(inside, std::vector<double>(inside.size())) > 1e-3);
  CHECK(largest_difference(accelerations(-0.5), inside) < 1e-13);  // the first column at x = 0
  CHECK(largest_difference(accelerations(0.5), inside) < 1e-13);   // the last one at x = 16, where the box ends
}

TEST_CASE("one particle: it falls freely and keeps its density") {
  auto drop = water({.points = {.positions = {{8.0, 8.0}}, .spacing = 1.0}, .gravity = {0.0, -0.01}});
  drop.run({.until = 20.0, .time_step = 0.5});
  const auto& g = drop.group<Water>();
  CHECK(g.positions()[0][1] == doctest::Approx(8.0 - 0.5 * 0.01 * 400.0).epsilon(1e-14));
  CHECK(g.get<field::Velocity>()[0][1] == doctest::Approx(-0.2).epsilon(1e-14));
  CHECK(g.get<field::Density>()[0] == 1.0);
}

// ---- Two liquids of unequal density -------------------------------------------------------------------------------------------------

namespace {

/// The lower half of a periodic square is 1000 times as dense as the upper one; both have the pressure `pressure`.
auto two_liquids(double pressure) {
  const geometry::Cubic<2> lattice{.spacing = 1.0};
  const sph::WeaklyCompressible<kernel::WendlandC2<2>> law{.kernel = {.support_radius = 2.6}};
  auto result = scene<ExtrapolatedVerlet>(
      geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {12.0, 24.0}, .periodic = {true, true}},
      group<Water>("heavy", Mobile{}, geometry::fill(lattice, {.lower = {0.0, 0.0}, .upper = {12.0, 12.0}}), 1000.0),
      group<Solid>("light", Mobile{}, geometry::fill(lattice, {.lower = {0.0, 12.0}, .upper = {12.0, 24.0}}), 1.0),
      interaction<Water, Water>(law), interaction<Water, Solid>(law), interaction<Solid, Solid>(law),
      material<Water>(eos::Linear{.rest_density = 1000.0, .sound_speed_0 = 1.0, .background_pressure = pressure}),
      material<Solid>(eos::Linear{.rest_density = 1.0, .sound_speed_0 = 1.0, .background_pressure = pressure}));
  return result;
}
double largest_speed(const auto& scene) {
  double largest = 0.0;
  scene.engine().for_each_group([&](const auto& g) {
    for (const auto& v : g.template get<field::Velocity>()) largest = std::max(largest, v.norm());
  });
  return largest;
}

}  // namespace

TEST_CASE(
    "density ratio 1000: two liquids at rest stay at rest while the pressure is that of rest; with another one their faces are pushed "
    "apart") {
  auto rest = two_liquids(0.0);
  rest.run({.until = 50.0});
  CHECK(largest_speed(rest) == 0.0);
  auto pressed = two_liquids(0.01);
  (void)pressed.step_limit();
  double largest = 0.0, sum = 0.0;
  for (const auto& a : pressed.group<Solid>().get<field::Acceleration>()) largest = std::max(largest, a.norm());
  pressed.engine().for_each_group([&](const auto& g) {
    for (const auto& a : g.template get<field::Acceleration>()) sum += g.mass * a[1];
  });
  MESSAGE("acceleration of the light face ", largest, " of p/(rho spacing) = 0.01");
  CHECK(std::fabs(sum) < 1e-10);  // action = reaction
  CHECK(largest > 1.0);           // hundreds of times p/(rho spacing): p_i/rho_i^2 + p_j/rho_j^2 is no form for such a jump
}

// ---- Beads: coincidence, speed, masses, springs of nothing --------------------------------------------------------------------------

namespace {

struct Beads {};
struct Others {};

auto gas_of_beads(std::vector<Vector<2>> positions, bool periodic) {
  return scene<Leapfrog>(
      geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {8.0, 8.0}, .periodic = {periodic, periodic}},
      group<Beads>("beads", Mobile{}, geometry::Points<2>{.positions = std::move(positions)}, 1.0),
      interaction<Beads, Beads>(potential::LennardJones{.energy_scale = 1.0, .diameter = 1.0, .cutoff = 1.1224620483093730}));
}
template <class Scene>
SimulationError::Where where_it_stops(Scene& scene, const RunOptions& options) {
  try {
    scene.run(options);
  } catch (const SimulationError& error) {
    CHECK(std::string(error.what()).starts_with("dmp: a value must "));
    return error.where;
  }
  return {};
}

}  // namespace

TEST_CASE("beads that come to coincide in a run stop it, with bead and field; particles of water that do are finite and go on") {
  auto beads = gas_of_beads({{2.0, 2.0}, {5.0, 5.0}}, true);
  beads.every(0.05, [](auto& scene) {
    if (scene.time() > 0.04) scene.template group<Beads>().positions()[1] = scene.template group<Beads>().positions()[0];
  });
  const auto where = where_it_stops(beads, {.until = 1.0, .time_step = 0.01, .check_every = 1});
  CHECK(where.group == "beads");
  CHECK(where.particle >= 0);
  CHECK(where.time > 0.04);
  CHECK_FALSE(std::isfinite(where.value));
  auto sea = water({});
  stir(sea, 0.01);
  sea.every(1.0, [](auto& scene) {
    auto& x = scene.template group<Water>().positions();
    if (scene.step() == 10) x[1] = x[0];
  });
  CHECK_NOTHROW(sea.run({.until = 20.0, .time_step = 0.1}));
}

TEST_CASE(
    "very fast: a bead that crosses the periodic box twice in a step comes out where it should; out of a bounded box it stops the run") {
  auto beads = gas_of_beads({{2.0, 2.0}, {5.0, 5.0}}, true);
  beads.group<Beads>().get<field::Velocity>()[0] = {1703.0, 0.0};
  beads.run({.until = 1.0, .time_step = 0.01});
  CHECK(beads.group<Beads>().get<field::Velocity>()[0][0] == 1703.0);
  const double x = beads.group<Beads>().positions()[0][0];
  CHECK(std::remainder(x - 2.0 - 1703.0, 8.0) == doctest::Approx(0.0).epsilon(1e-9));
  auto bounded = gas_of_beads({{2.0, 2.0}, {5.0, 5.0}}, false);
  bounded.group<Beads>().get<field::Velocity>()[0] = {1703.0, 0.0};
  const auto where = where_it_stops(bounded, {.until = 1.0, .time_step = 0.01});
  CHECK(where.group == "beads");
  CHECK(where.particle == 0);
  CHECK(where.field == "position");
  CHECK(where.value > 8.0);
}

namespace {

auto two_beads(double mass, double other_mass, const bond::KelvinVoigt& law) {
  return scene<Leapfrog>(geometry::Box<1>::unbounded(), group<Beads>("bead", Mobile{}, geometry::Points<1>{{Vector<1>(0.0)}}, mass),
                         group<Others>("other", Mobile{}, geometry::Points<1>{{Vector<1>(1.0)}}, other_mass),
                         bonds<Beads, Others>(law, {{0, 0}}));
}

}  // namespace

TEST_CASE("mass ratio 1e6: two bonded beads swing with sqrt(k/m), m their reduced mass, at a step that the lighter one bounds") {
  const double reduced = 1.0 / (1.0 + 1e-6);
  auto pair = two_beads(1.0, 1e6, {.stiffness = 1.0, .damping = 0.0});
  pair.group<Beads>().get<field::Velocity>()[0] = Vector<1>(1e-3);
  CHECK(pair.step_limit().stable_time_step == doctest::Approx(2.0 / std::sqrt(2.0)).epsilon(1e-12));
  const double period = 2.0 * std::numbers::pi * std::sqrt(reduced), step = period / 4000.0;
  pair.run({.until = 10.25 * period, .time_step = step});
  const double stretch = pair.group<Others>().positions()[0][0] - pair.group<Beads>().positions()[0][0] - 1.0;
  CHECK(stretch == doctest::Approx(-1e-3 * std::sqrt(reduced)).epsilon(1e-6).scale(0.0));  // sin at a quarter of a period
  const double momentum = pair.group<Beads>().get<field::Velocity>()[0][0] + 1e6 * pair.group<Others>().get<field::Velocity>()[0][0];
  CHECK(momentum == doctest::Approx(1e-3).epsilon(1e-9).scale(0.0));
}

TEST_CASE("sub-stepped bonds resonate: of the steps that slow springs allow, a share of (omega_slow dt)^2/(pi omega_fast dt) blows up") {
  constexpr double fast = 10.0;  // [rad/s], and 1 rad/s of the slow spring: its bound is 2 s
  const double first = 1.6, range = std::numbers::pi / fast;  // steps in which the fast spring goes through half a period more
  int unstable = 0;
  constexpr int trials = 200;
  for (int trial = 0; trial < trials; ++trial) {
    const double step = first + range * trial / trials;
    auto pair = scene<Leapfrog>(geometry::Box<1>::unbounded(), group<Beads>("bead", Mobile{}, geometry::Points<1>{{Vector<1>(0.0)}}, 1.0),
                                group<Others>("other", Mobile{}, geometry::Points<1>{{Vector<1>(1.0)}}, 1.0),
                                substepped_bonds<Beads, Others>(bond::Harmonic{.stiffness = 0.5 * fast * fast}, {{0, 0}}, 40),
                                bonds<Beads, Others>(bond::Harmonic{.stiffness = 0.5}, {{0, 0}}));
    pair.group<Beads>().get<field::Velocity>()[0] = Vector<1>(1e-6);
    pair.run({.until = 1000.0 * step, .time_step = step});
    if (!(std::fabs(pair.group<Beads>().get<field::Velocity>()[0][0]) < 1e-3)) ++unstable;
  }
  const double step = first + 0.5 * range, share = step * step / (std::numbers::pi * fast * step);
  MESSAGE("unstable: ", unstable, " of ", trials, " steps; expected ", share * trials);
  CHECK(unstable == doctest::Approx(share * trials).epsilon(0.2));
}

TEST_CASE("huge and tiny units: beads on bonds that bounce off each other, with the step that the scene chooses, are the same beads") {
  const auto after = [](const Scales& unit) {
    const double stiffness = unit.mass / (unit.time * unit.time), energy = stiffness * unit.length * unit.length;
    std::vector<Vector<1>> positions, speeds;
    for (const double x : {0.0, 1.0, 2.0, 4.0, 5.0, 6.0}) positions.push_back(Vector<1>(x * unit.length));
    for (const double v : {0.0, 0.2, 0.1, -2.0, -1.9, -2.1}) speeds.push_back(Vector<1>(v * unit.length / unit.time));
    auto pieces =
        scene<Leapfrog>(geometry::Box<1>{.lower = {-50.0 * unit.length}, .upper = {50.0 * unit.length}},
                        group<Beads>("beads", Mobile{}, geometry::Points<1>{.positions = positions}, unit.mass),
                        bonds<Beads, Beads>(bond::KelvinVoigt{.stiffness = 30.0 * stiffness, .damping = 0.1 * stiffness * unit.time},
                                            {{0, 1}, {1, 2}, {3, 4}, {4, 5}}),
                        interaction<Beads, Beads>(
                            potential::LennardJones{.energy_scale = energy, .diameter = 0.8 * unit.length, .cutoff = 0.89 * unit.length})
                            .excluding_bonded(1));
    pieces.template group<Beads>().template get<field::Velocity>() = {speeds.begin(), speeds.end()};
    const auto report = pieces.run({.until = 4.0 * unit.time});
    CHECK(report.limit.bound_by == "collisions of a pair potential");
    std::vector<double> result;
    for (const auto& x : pieces.template group<Beads>().positions()) result.push_back(x[0] / unit.length);
    for (const auto& v : pieces.template group<Beads>().template get<field::Velocity>()) result.push_back(v[0] * unit.time / unit.length);
    return result;
  };
  const auto plain = after({});
  double momentum = 0.0;
  for (std::size_t k = 6; k < 12; ++k) momentum += plain[k];
  CHECK(momentum == doctest::Approx(0.3 - 6.0).epsilon(1e-12).scale(1.0));
  CHECK(plain[6] < -0.5);  // it has been hit
  const auto same = [&](const Scales& unit) { return largest_difference(after(unit), plain); };
  CHECK(same({.length = 0x1p-20, .time = 0x1p-30, .mass = 0x1p-60}) == 0.0);  // powers of two: every bit
  CHECK(same({.length = 0x1p60, .time = 0x1p20, .mass = 0x1p100}) == 0.0);
  CHECK(same({.length = 1e-6, .time = 1e-6, .mass = 1e-12}) < 1e-9);
  CHECK(same({.length = 1.496e11, .time = 3.156e7, .mass = 1.989e30}) < 1e-9);
}

TEST_CASE("springs and dashpots of nothing: the beads fly on as if there were none, and no bound is made of them") {
  auto pair = two_beads(1.0, 2.0, {.stiffness = 0.0, .damping = 0.0});
  pair.group<Beads>().get<field::Velocity>()[0] = Vector<1>(0.25);
  CHECK(pair.step_limit().stable_time_step == std::numeric_limits<double>::infinity());
  CHECK_THROWS_WITH_AS(pair.run({.until = 1.0}), doctest::Contains("no law of this scene bounds the time step; give one"), ParameterError);
  pair.run({.until = 16.0, .time_step = 0.5});
  CHECK(pair.group<Beads>().positions()[0][0] == 4.0);
  CHECK(pair.group<Beads>().get<field::Velocity>()[0][0] == 0.25);
  CHECK(pair.group<Others>().positions()[0][0] == 1.0);
}
