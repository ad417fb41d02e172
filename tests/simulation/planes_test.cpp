// Planes in a scene: the bound of the step, the force on a plate, contact.
#include <cmath>
#include <string>
#include "support/threads.hpp"
#include <doctest/doctest.h>
#include <dmp/bond.hpp>
#include <dmp/core/simulation_error.hpp>
#include <dmp/forcing.hpp>
#include <dmp/integrator.hpp>
#include <dmp/simulation.hpp>

using namespace dmp;
using namespace dmp::simulation;
using forcing::Plane;
using geometry::Box, geometry::Points;
using integrator::ExtrapolatedVerlet, integrator::Leapfrog, integrator::SymplecticEuler;
using particles::Mobile;

namespace {

struct Beads {};
constexpr double mass = 0.5, strength = 200.0, weight = 2.0;  // [kg], [N/m^2], [N]

/// A bead under its weight on a plane, at `above` where the two balance.
template <class Integrator>
auto bead_on_plane(double above, forcing::Ramp motion = {.speed = 0.0}) {
  const forcing::Constant<1> gravity{.uniform_acceleration = {{-weight / mass}}};
  return scene<Integrator>(Box<1>::unbounded(),
                           group<Beads>("beads", Mobile{}, Points<1>{{Vector<1>(above - std::sqrt(weight / strength))}}, mass),
                           forced_by<Beads>(gravity, Plane<1>{.normal = {{1.0}}, .position = 0.0, .strength = strength, .motion = motion}));
}
const double largest_stable = 2.0 / std::sqrt(2.0 * strength * std::sqrt(weight / strength) / mass);  // 2/omega of small oscillations

}  // namespace

TEST_CASE("a plane bounds the step by 2/omega of what lies on it; it is stable at 0.95 of that with every integrator, and refused beyond") {
  const auto check = [&]<class Integrator>(Integrator) {
    auto rest = bead_on_plane<Integrator>(0.0);
    const auto limit = rest.step_limit();
    CHECK(limit.stable_time_step == doctest::Approx(largest_stable).epsilon(1e-12));
    CHECK(limit.stability_bound_by == "stiffness of a forcing on beads");
    auto bounces = bead_on_plane<Integrator>(1e-5);
    bounces.run({.until = 20000.0 * largest_stable, .time_step = 0.95 * largest_stable});
    CHECK(std::fabs(bounces.template group<Beads>().positions()[0][0] + std::sqrt(weight / strength)) < 1e-4);
    auto too_long = bead_on_plane<Integrator>(0.0);
    CHECK_THROWS_AS(too_long.run({.until = 1.0, .time_step = 1.05 * largest_stable}), ParameterError);
  };
  check(Leapfrog{});
  check(ExtrapolatedVerlet{});
  check(SymplecticEuler{});
}

TEST_CASE("a step beyond the bound of a plane is not stable: the bound is not needlessly low") {
  const double step = 1.05 * largest_stable;
  double x = 1e-7 - std::sqrt(weight / strength), v = 0.0, largest = 0.0;  // leapfrog by hand, since scenes refuse
  for (int n = 0; n < 2000; ++n) {
    x += step * v;
    const double d = std::fmax(0.0, -x);
    v += step * (strength * d * d - weight) / mass;
    largest = std::fmax(largest, std::fabs(x + std::sqrt(weight / strength)));
  }
  CHECK(largest > 1e-3);
}

TEST_CASE(
    "a plane that moves in on a bead stops the run when its stiffness no longer allows the given step, and shortens an automatic one") {
  const forcing::Ramp blow{.speed = 3.0};
  auto given = bead_on_plane<Leapfrog>(0.0, blow);
  CHECK_THROWS_WITH_AS(given.run({.until = 10.0, .time_step = 0.95 * largest_stable, .check_every = 1}),
                       doctest::Contains("by now the bound of stiffness of a forcing"), SimulationError);
  auto automatic = bead_on_plane<Leapfrog>(0.0, blow);  // the bead flies off: then nothing bounds the step
  CHECK_THROWS_WITH_AS(automatic.run({.until = 10.0}), doctest::Contains("bounds the time step any more; give one"), SimulationError);
  auto held = scene<Leapfrog>(Box<1>::unbounded(), group<Beads>("beads", Mobile{}, Points<1>{{Vector<1>(0.0), Vector<1>(1.0)}}, mass),
                              bonds<Beads, Beads>(bond::Harmonic{.stiffness = 1.0}, {{0, 1}}),
                              forced_by<Beads>(Plane<1>{.normal = {{1.0}}, .position = -0.01, .strength = 1e3, .motion = {.speed = 0.1}}));
  const double free_step = held.step_limit().stable_time_step;
  const auto report = held.run({.until = 5.0, .safety = 0.02});
  CHECK(report.limit.stable_time_step < 0.5 * free_step);
  CHECK(held.group<Beads>().positions()[0][0] > 0.48);
}

TEST_CASE("bonds and a plane bound the step together, by the larger share, and where a bead does not touch the bonds alone") {
  const auto pair = [](double plane) {
    return scene<Leapfrog>(Box<1>::unbounded(), group<Beads>("beads", Mobile{}, Points<1>{{Vector<1>(0.0), Vector<1>(1.0)}}, mass),
                           bonds<Beads, Beads>(bond::Harmonic{.stiffness = 10.0}, {{0, 1}}),
                           forced_by<Beads>(Plane<1>{.normal = {{1.0}}, .position = plane, .strength = strength}));
  };
  auto apart = pair(-0.1);
  CHECK(apart.step_limit().stable_time_step == doctest::Approx(2.0 / std::sqrt(2.0 * 10.0 / mass)).epsilon(1e-12));
  auto touching = pair(0.01);
  CHECK(touching.step_limit().stable_time_step == doctest::Approx(2.0 / std::sqrt((2.0 * 10.0 + 4.0) / mass)).epsilon(1e-12));
  CHECK(touching.step_limit().stability_bound_by == "bond stiffness of beads - beads");
  auto pressed = pair(0.5);
  CHECK(pressed.step_limit().stable_time_step == doctest::Approx(2.0 / std::sqrt((2.0 * 10.0 + 200.0) / mass)).epsilon(1e-12));
  CHECK(pressed.step_limit().stability_bound_by == "stiffness of a forcing on beads");
}

TEST_CASE("load_on: force on a plane, whom it presses, and how wide the contact is; the same bits for 1 to 4 threads") {
  Points<3> points;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j)
      for (int k = 0; k < 10; ++k) points.positions.emplace_back(0.1 * i, 0.1 * j, 0.1 * k);
  auto scene = simulation::scene<Leapfrog>(Box<3>::unbounded(), group<Beads>("beads", Mobile{}, points, mass));
  const Plane<3> floor{.normal = {{0.0, 0.0, 1.0}}, .position = 0.15, .strength = 10.0};
  const auto load = load_on<Beads>(scene, floor);
  CHECK(load.particles == 3200);
  CHECK(load.force[0] == 0.0);
  CHECK(load.force[2] == doctest::Approx(1600.0 * 10.0 * (0.15 * 0.15 + 0.05 * 0.05)).epsilon(1e-12));
  CHECK(load.centre[0] == doctest::Approx(1.95).epsilon(1e-12));
  CHECK(load.radius == doctest::Approx(1.95 * std::sqrt(2.0)).epsilon(1e-12));
  for (const int count : {1, 2, 3, 4}) {
    const test::Threads threads(count);
    auto again = simulation::scene<Leapfrog>(Box<3>::unbounded(), group<Beads>("beads", Mobile{}, points, mass));
    CHECK(load_on<Beads>(again, floor).force[2] == load.force[2]);
  }
  Plane<3> press = floor;
  press.position = -1.0;
  press.motion = {.speed = 1.0};
  CHECK(load_on<Beads>(scene, press).particles == 0);
  CHECK(load_on<Beads>(scene, press).radius == 0.0);
  CHECK(load_on<Beads>(scene, press, 1.15).particles == 3200);
}
