// Planes that nothing gets behind: in a run, at rest, and against planes that push back what is behind them.
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>
#include "support/threads.hpp"
#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <dmp/bond.hpp>
#include <dmp/core/simulation_error.hpp>
#include <dmp/forcing.hpp>
#include <dmp/integrator.hpp>
#include <dmp/lattice_spring.hpp>
#include <dmp/simulation.hpp>

using namespace dmp;
using namespace dmp::simulation;
using forcing::ContactPlane, forcing::Plane, forcing::Ramp;
using geometry::Box, geometry::Points;
using integrator::Leapfrog;
using particles::Mobile;

namespace {

struct Beads {};
constexpr double mass = 0.5, gravity = 9.81;
const forcing::Constant<1> weight{.uniform_acceleration = {{-gravity}}};
const ContactPlane<1> ground{.normal = {{1.0}}, .position = 0.0};

template <class Integrator>
auto bead_above(const ContactPlane<1>& plane, double height, double velocity = 0.0) {
  auto result = scene<Integrator>(Box<1>::unbounded(), group<Beads>("beads", Mobile{}, Points<1>{{Vector<1>(height)}}, mass),
                                  forced_by<Beads>(weight), confined_by<Beads>(plane));
  result.template group<Beads>().template get<field::Velocity>()[0][0] = velocity;
  return result;
}
template <class Scene>
double height_of(const Scene& scene) {
  return scene.template group<Beads>().positions()[0][0];
}
template <class Function>
void with_each_integrator(const Function& function) {
  function(Leapfrog{});
  function(integrator::ExtrapolatedVerlet{});
  function(integrator::LammpsVerlet{});
  function(integrator::SymplecticEuler{});
}

}  // namespace

TEST_CASE("a bead that lies on a plane is borne with its weight, exactly, from the second step on, with every integrator") {
  with_each_integrator([]<class Integrator>(Integrator) {
    auto rest = bead_above<Integrator>(ground, 0.0);
    std::vector<double> forces, heights, speeds;
    constexpr double step = 1.0 / 1024.0;
    rest.every(step, [&](const auto& s) {
      forces.push_back(load_on<Beads>(s, ground).force[0]);
      heights.push_back(height_of(s));
      speeds.push_back(s.template group<Beads>().template get<field::Velocity>()[0][0]);
    });
    rest.run({.until = 10.0 * step, .time_step = step});
    REQUIRE(forces.size() == 11);
    for (std::size_t n = 1; n < forces.size(); ++n) {
      CHECK(heights[n] == 0.0);
      CHECK(std::fabs(speeds[n]) < 1e-17);
      if (n > 1) CHECK(forces[n] == doctest::Approx(mass * gravity).epsilon(1e-15));
    }
  });
}

TEST_CASE("a bead thrown up from a plane flies its parabola, as if there were no plane, and is stopped when it comes down") {
  constexpr double step = 1e-3, speed = 4.905;  // one second of flight
  auto thrown = bead_above<Leapfrog>(ground, 0.0, speed);
  thrown.run({.until = 0.5, .time_step = step});
  CHECK(height_of(thrown) == doctest::Approx(0.5 * speed - 0.125 * gravity).epsilon(1e-12));
  CHECK(load_on<Beads>(thrown, ground).particles == 0);
  CHECK(load_on<Beads>(thrown, ground).force[0] == 0.0);
  thrown.run({.until = 1.1, .time_step = step});
  CHECK(height_of(thrown) == 0.0);
  CHECK(load_on<Beads>(thrown, ground).force[0] == doctest::Approx(mass * gravity).epsilon(1e-12));
}

TEST_CASE("a bead follows a plane that accelerates and then holds: weight and inertia while it does, free flight when it is thrown off") {
  constexpr double step = 1e-3, start_up = 1.0, speed = 1.0;
  const Ramp lift{.speed = speed, .start_up = start_up, .hold_from = 2.0};
  ContactPlane<1> lifted = ground;
  lifted.motion = lift;
  auto scene = bead_above<Leapfrog>(lifted, 0.0);
  double lowest = 1.0, worst = 0.0;
  scene.every(step, [&](const auto& s) {
    const double t = s.time();
    lowest = std::fmin(lowest, height_of(s) - lift.displacement(t));
    if (t < 2.5 * step || t > 2.0 - 1.5 * step) return;
    const double inertia =
        t < start_up ? 0.5 * speed * std::numbers::pi / start_up * std::sin(std::numbers::pi * t / start_up) : 0.0;
    worst = std::fmax(worst, std::fabs(load_on<Beads>(s, lifted).force[0] - mass * (gravity + inertia)));
  });
  scene.run({.until = 2.0, .time_step = step});
  CHECK(worst < 2.0 * mass * speed * step);  // the velocity of the ramp has a kink at its end, worth half a step
  scene.run({.until = 2.05, .time_step = step});
  const double flight = 0.05;
  CHECK(height_of(scene) - lift.displacement(2.0) == doctest::Approx(speed * flight - 0.5 * gravity * flight * flight).epsilon(0.05));
  scene.run({.until = 2.5, .time_step = step});
  CHECK(std::fabs(height_of(scene) - lift.displacement(2.0)) < 1e-15);
  CHECK(lowest > -1e-15);

  ContactPlane<1> lowered = ground;  // slower than free fall: the bead stays on it
  lowered.motion = {.speed = -1.0, .start_up = 1.0};
  auto sinks = bead_above<Leapfrog>(lowered, 0.0);
  sinks.run({.until = 0.7, .time_step = step});
  CHECK(height_of(sinks) == doctest::Approx(lowered.motion.displacement(0.7)).epsilon(1e-12));
  const double inertia = -0.5 * std::numbers::pi * std::sin(0.7 * std::numbers::pi);
  CHECK(load_on<Beads>(sinks, lowered).force[0] == doctest::Approx(mass * (gravity + inertia)).epsilon(1e-4));
}

TEST_CASE("a change of the step lets no bead get behind a plane, and takes no impulse away") {
  auto scene = bead_above<Leapfrog>(ground, 1.0);
  double lowest = 1.0;
  for (const double step : {3e-3, 1e-3, 7e-3, 2e-3, 5e-3, 1e-2, 1e-4}) {
    scene.run({.until = scene.time() + 50.0 * step, .time_step = step, .check_every = 1});
    lowest = std::fmin(lowest, height_of(scene));
  }
  CHECK(lowest >= 0.0);
  CHECK(height_of(scene) == 0.0);  // 0.45 s of fall are over
  CHECK(load_on<Beads>(scene, ground).force[0] == doctest::Approx(mass * gravity).epsilon(1e-12));
}

namespace {

/// An elastic bar of beads that flies at a wall: l = 1, k = m = 1, so c = 1 and the impedance is 1.
struct Impact {
  double contact_time, mean_force, restitution, unbalanced, deepest;
};
Impact impact(std::uint32_t count, double approach_speed, double step) {
  Points<1> points;
  std::vector<neighbours::Bond> chain;
  for (std::uint32_t i = 0; i < count; ++i) {
    points.positions.emplace_back(0.05 + i);
    if (i > 0) chain.push_back({i - 1, i});
  }
  auto bar = scene<Leapfrog>(Box<1>::unbounded(), group<Beads>("bar", Mobile{}, points, 1.0),
                             bonds<Beads, Beads>(bond::Harmonic{.stiffness = 1.0}, chain), confined_by<Beads>(ground));
  auto& velocity = bar.group<Beads>().get<field::Velocity>();
  for (auto& v : velocity) v[0] = -approach_speed;
  double impulse = 0.0, first = -1.0, last = 0.0, deepest = 0.0;
  bar.every(step, [&](const auto& s) {
    const double force = load_on<Beads>(s, ground).force[0];
    impulse += step * force;
    deepest = std::fmin(deepest, s.template group<Beads>().positions()[0][0]);
    if (force > 0.0) {
      last = s.time();
      if (first < 0.0) first = s.time();
    }
  });
  const double length = count;
  bar.run({.until = 3.0 * length, .time_step = step});
  double momentum = 0.0;
  for (const auto& v : velocity) momentum += v[0];
  return {.contact_time = last - first,
          .mean_force = impulse / (last - first),
          .restitution = momentum / (length * approach_speed),
          .unbalanced = (momentum + length * approach_speed - impulse) / (length * approach_speed),
          .deepest = deepest};
}

}  // namespace

TEST_CASE("an elastic bar is in contact with a wall for 2L/c, bears (rho c A) v, and rebounds; momentum is balanced to rounding") {
  for (const std::uint32_t count : {50u, 100u, 200u, 400u}) {
    const Impact found = impact(count, 1e-3, 0.1);
    MESSAGE(count, ' ', found.contact_time / (2.0 * count), ' ', found.mean_force / 1e-3, ' ', found.restitution, ' ', found.unbalanced, ' ',
            found.deepest);
  }
}
