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
  CHECK(std::fabs(height_of(thrown)) < 1e-16);
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
  CHECK(lowest > -1e-16);
  CHECK(std::fabs(height_of(scene)) < 1e-16);  // 0.45 s of fall are over
  CHECK(load_on<Beads>(scene, ground).force[0] == doctest::Approx(mass * gravity).epsilon(1e-12));
}

namespace {

/// An elastic bar of beads that flies at a wall: l = 1, k = m = 1, so c = 1 and the impedance is 1.
struct Impact {
  double contact_time, mean_force, restitution, unbalanced, deepest, lost_energy;
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
  double momentum = 0.0, energy = 0.0;
  const auto& x = bar.group<Beads>().positions();
  for (std::size_t i = 0; i < count; ++i) {
    momentum += velocity[i][0];
    energy += 0.5 * velocity[i].squaredNorm();
    if (i > 0) energy += 0.5 * square(x[i][0] - x[i - 1][0] - 1.0);
  }
  return {.contact_time = last - first,
          .mean_force = impulse / (last - first),
          .restitution = momentum / (length * approach_speed),
          .unbalanced = (momentum + length * approach_speed - impulse) / (length * approach_speed),
          .deepest = deepest,
          .lost_energy = 0.5 * length * square(approach_speed) - energy};
}

}  // namespace

TEST_CASE("an elastic bar touches a wall for 2L/c, bears (rho c A) v, rebounds, and loses the energy of one bead; momentum is balanced") {
  double last_loss = 0.0;
  for (const std::uint32_t count : {50u, 100u}) {
    CAPTURE(count);
    const double speed = 1e-3, spacing = 1.0 / count;  // of the length
    const Impact found = impact(count, speed, 0.1);
    CHECK(std::fabs(found.contact_time / (2.0 * count) - 1.0) < spacing);
    CHECK(std::fabs(found.mean_force / speed - 1.0) < 2.0 * spacing);
    CHECK(std::fabs(found.unbalanced) < 1e-13);
    CHECK(found.deepest > -1e-15);
    CHECK(found.lost_energy == doctest::Approx(0.5 * speed * speed).epsilon(0.01));
    const double loss = 1.0 - found.restitution;
    CHECK(loss > 0.0);
    CHECK(loss < 2.0 * spacing);
    if (last_loss > 0.0) CHECK(loss < last_loss / 1.5);
    last_loss = loss;
  }
}

namespace {

constexpr double k = 1.0;  // and l = 1: E = 2.5, nu = 1/4

lattice_spring::Body<3> lattice_ball(double radius) {  // in the sheet's orientation q1
  const lattice_spring::CubicLattice lattice{
      .spacing = 1.0, .orientation = Eigen::Quaterniond(-0.467424, -0.047608, 0.829916, -0.300813).normalized().toRotationMatrix()};
  const geometry::Cuboid<3> around{.lower = {-radius, -radius, -radius}, .upper = {radius, radius, radius}};
  auto body = lattice_body(lattice, around, geometry::Ball<3>{.centre = {0.0, 0.0, 0.0}, .radius = radius - 1e-6});
  lattice_spring::measure_rest_lengths<3>(body.bonds, body.points.positions);
  return body;
}
double outermost(const lattice_spring::Body<3>& body, double side) {
  double result = 0.0;
  for (const auto& x : body.points.positions) result = std::fmax(result, side * x[2]);
  return result;
}
/// The plate below (side -1) or above (+1) a body; at time t the two have approached by t.
ContactPlane<3> contact_plate(const lattice_spring::Body<3>& body, double side) {
  return {.normal = {{0.0, 0.0, -side}}, .position = -outermost(body, side), .motion = {.speed = 0.5}};
}
template <class Planes>
auto ball_between(const lattice_spring::Body<3>& body, const Planes& planes) {
  return scene<Leapfrog>(Box<3>::unbounded(), group<Beads>("ball", Mobile{}, body.points, 1.0),
                         bonds<Beads, Beads>(bond::Harmonic{.stiffness = k}, body.bonds), planes);
}
auto contact_plates(const lattice_spring::Body<3>& body) {
  return ball_between(body, confined_by<Beads>(contact_plate(body, -1.0), contact_plate(body, 1.0)));
}

}  // namespace

TEST_CASE("relax: a ball between contact planes fulfils the conditions of Karush, Kuhn and Tucker, and both planes bear the same") {
  const auto body = lattice_ball(6.0);
  auto ball = contact_plates(body);
  constexpr double tolerance = 1e-9, time = 0.6;
  for (const double t : {0.2, 0.4, time}) {
    const auto report = relax(ball, {.force_tolerance = tolerance, .time = t, .without_rotation = true});
    CHECK(report.largest_force <= tolerance);
  }
  const auto below = contact_plate(body, -1.0), above = contact_plate(body, 1.0);
  const auto low = load_on<Beads>(ball, below, time), high = load_on<Beads>(ball, above, time);
  CHECK(low.force[2] > 0.1);
  CHECK(low.force[0] == 0.0);
  CHECK(low.particles > 3);
  const auto& g = ball.group<Beads>();
  CHECK(std::fabs(low.force[2] + high.force[2]) < tolerance * static_cast<double>(g.size()));
  double sum = 0.0;
  std::size_t borne = 0;
  for (std::size_t i = 0; i < g.size(); ++i)
    for (const auto& plane : {below, above}) {
      const Vector<3> normal = to_vector<3>(plane.normal);
      const double gap = -plane.behind(to_components<3>(g.positions()[i]), time), reaction = normal.dot(g.get<ContactForce>()[i]);
      const bool of_this_plane = gap < 1.0;  // the other one's is opposite
      CHECK(gap >= -1e-13);
      if (!of_this_plane) continue;
      CHECK(reaction >= 0.0);
      CHECK(std::fabs(gap) * reaction < 1e-13);
      sum += reaction;
      if (reaction > 0.0) ++borne;
    }
  CHECK(sum == doctest::Approx(low.force[2] - high.force[2]).epsilon(1e-12));
  CHECK(borne == low.particles + high.particles);
}

TEST_CASE("planes of a penalty S approach the contact planes as 1/sqrt(S), by the penetration alone") {
  const auto body = lattice_ball(6.0);
  constexpr double tolerance = 1e-8;
  const std::array<double, 3> times{0.2, 0.4, 0.6};
  auto exact = contact_plates(body);
  double force = 0.0;
  for (const double t : times) {
    relax(exact, {.force_tolerance = tolerance, .time = t, .without_rotation = true});
    force = load_on<Beads>(exact, contact_plate(body, -1.0), t).force[2];
  }
  relax(exact, {.force_tolerance = tolerance, .time = 0.601, .without_rotation = true});
  const auto beyond = load_on<Beads>(exact, contact_plate(body, -1.0), 0.601);
  const double slope = (beyond.force[2] - force) / 0.001;
  double last = 0.0;
  for (const double strength : {1e3, 4e3, 16e3}) {
    const auto plate = [&](double side) {
      const auto plane = contact_plate(body, side);
      return Plane<3>{.normal = plane.normal, .position = plane.position, .strength = strength, .motion = plane.motion};
    };
    auto ball = ball_between(body, forced_by<Beads>(plate(-1.0), plate(1.0)));
    for (const double t : times) relax(ball, {.force_tolerance = tolerance, .time = t, .without_rotation = true});
    const auto load = load_on<Beads>(ball, plate(-1.0), times.back());
    const double lacking = force - load.force[2];
    const double penetration = 2.0 * std::sqrt(load.force[2] / (static_cast<double>(load.particles) * strength));
    CHECK(lacking > 0.0);
    if (last > 0.0) CHECK(last / lacking == doctest::Approx(2.0).epsilon(0.05));
    CHECK(slope * penetration == doctest::Approx(lacking).epsilon(0.1));
    last = lacking;
  }
}

TEST_CASE("A15: a cube between contact planes bears E times its strain, without a correction of the displacement") {
  constexpr int cells = 4;
  constexpr double strain = 1e-6;
  auto body = lattice_block(lattice_spring::CubicLattice{.spacing = 1.0}, {cells, cells, cells}, lattice_spring::SurfaceBonds::shared);
  lattice_spring::measure_rest_lengths<3>(body.bonds, body.points.positions);
  const ContactPlane<3> below{.normal = {{0.0, 0.0, 1.0}}, .position = 0.0},
      above{.normal = {{0.0, 0.0, -1.0}}, .position = -cells, .motion = {.speed = strain * cells}};
  auto cube = ball_between(body, confined_by<Beads>(below, above));
  relax(cube, {.force_tolerance = 1e-13, .time = 1.0});
  const double expected = 2.5 * k * strain * cells * cells;
  CHECK(load_on<Beads>(cube, below).force[2] == doctest::Approx(expected).epsilon(3.0 * strain));
  CHECK(load_on<Beads>(cube, above).force[2] == doctest::Approx(-expected).epsilon(3.0 * strain));
  CHECK(load_on<Beads>(cube, below).particles == (cells + 1) * (cells + 1));
  CHECK(load_on<Beads>(cube, below).radius == doctest::Approx(0.5 * cells * std::numbers::sqrt2).epsilon(1e-4));
}

TEST_CASE("a ball pressed in time: never behind a plane, momentum balanced, the same bits for 1 to 4 threads and after a restart") {
  const auto body = lattice_ball(10.5);
  REQUIRE(body.points.positions.size() > 4 * 1024);  // enough for four threads
  const auto press = [&body] {
    const auto plate = [&body](double side) {
      auto plane = contact_plate(body, side);
      plane.motion = {.speed = 0.02, .start_up = 5.0, .hold_from = 15.0};
      return plane;
    };
    return std::array{plate(-1.0), plate(1.0)};
  }();
  const auto make = [&] { return ball_between(body, confined_by<Beads>(press[0], press[1])); };
  const auto state = [](const auto& scene) {
    std::vector<double> numbers;
    const auto& g = scene.template group<Beads>();
    for (std::size_t i = 0; i < g.size(); ++i)
      for (int d = 0; d < 3; ++d)
        for (const double x : {g.positions()[i][d], g.template get<field::Velocity>()[i][d], g.template get<ContactForce>()[i][d]})
          numbers.push_back(x);
    return numbers;
  };
  constexpr double step = 0.25;
  auto whole = make();
  double lowest = 0.0, impulse = 0.0, largest = 0.0;
  whole.every(step, [&](const auto& s) {
    for (const auto& plane : press) {
      for (const auto& x : s.template group<Beads>().positions()) lowest = std::fmin(lowest, -plane.behind(to_components<3>(x), s.time()));
      const double force = load_on<Beads>(s, plane).force[2];
      impulse += step * force;
      largest = std::fmax(largest, force);
    }
  });
  whole.run({.until = 12.0, .time_step = step});
  const auto path = (std::filesystem::temp_directory_path() / "dmp_contact_planes_test.checkpoint").string();
  whole.checkpoint(path);
  whole.run({.until = 24.0, .time_step = step});
  CHECK(lowest > -1e-14);
  CHECK(largest > 0.1);
  double momentum = 0.0, last_forces = 0.0;  // of the forces that are there now a half is still to act
  for (const auto& v : whole.group<Beads>().get<field::Velocity>()) momentum += v[2];
  for (const auto& plane : press) last_forces += load_on<Beads>(whole, plane).force[2];
  CHECK(std::fabs(momentum - impulse + 0.5 * step * last_forces) < 1e-11);

  auto restarted = make();
  restarted.restart(path);
  restarted.run({.until = 24.0, .time_step = step});
  CHECK(state(restarted) == state(whole));
  std::filesystem::remove(path);
  std::vector<double> rest;
  for (const int count : {1, 2, 4}) {
    const test::Threads threads(count);
    auto again = make();
    again.run({.until = 12.0, .time_step = step});
    again.run({.until = 24.0, .time_step = step});
    CHECK(state(again) == state(whole));
    auto at_rest = make();
    relax(at_rest, {.force_tolerance = 1e-4, .time = 14.0, .without_rotation = true});
    if (count == 1) rest = state(at_rest);
    CHECK(state(at_rest) == rest);
  }
}

TEST_CASE("two planes at right angles bear a bead in their corner, each with its part of the weight") {
  const double c = std::cos(0.3), s = std::sin(0.3);
  const ContactPlane<2> left{.normal = {{c, s}}, .position = 0.2}, right{.normal = {{-s, c}}, .position = -0.1};
  const Vector<2> corner = 0.2 * Vector<2>(c, s) - 0.1 * Vector<2>(-s, c);
  const auto beads = [&](const Vector<2>& place) {
    return scene<Leapfrog>(Box<2>::unbounded(), group<Beads>("beads", Mobile{}, Points<2>{{place}}, mass),
                           forced_by<Beads>(forcing::Constant<2>{.uniform_acceleration = {{{0.0, -gravity}}}}),
                           confined_by<Beads>(left, right));
  };
  auto falls = beads(corner + Vector<2>(0.05, 0.3));
  falls.run({.until = 5.0, .time_step = 1e-3});
  CHECK((falls.group<Beads>().positions()[0] - corner).norm() < 1e-14);
  const Vector<2> by_left = load_on<Beads>(falls, left).force, by_right = load_on<Beads>(falls, right).force;
  CHECK((by_left - mass * gravity * s * Vector<2>(c, s)).norm() < 1e-9);
  CHECK((by_right - mass * gravity * c * Vector<2>(-s, c)).norm() < 1e-9);
}

TEST_CASE("inertia-free steps: a Kelvin-Voigt bond that a plane shortens bears k e + c e/dt, and k e once the plane stands") {
  constexpr double shortening = 5e-4, damping = 1.0, dt = 0.1;
  const bond::KelvinVoigt law{.stiffness = k, .damping = damping};
  Points<1> points{{Vector<1>(0.0), Vector<1>(1.0)}};
  lattice_spring::InertiaFreeStep<1> step(law, dt, {{.i = 0, .j = 1, .rest_length = 1.0}}, points.positions);
  const ContactPlane<1> ceiling{.normal = {{-1.0}}, .position = -1.0 + shortening};  // relax puts the upper bead on it
  for (int n = 0; n < 4; ++n) {
    auto pair = scene<Leapfrog>(Box<1>::unbounded(), group<Beads>("beads", Mobile{}, points, 1.0),
                                bonds<Beads, Beads>(step.law(), step.bonds()), confined_by<Beads>(ground, ceiling));
    relax(pair, {.force_tolerance = 1e-12});
    const auto& now = pair.group<Beads>().positions();
    points.positions.assign(now.begin(), now.end());
    step.advance(points.positions);
    const double expected = (n == 0 ? k + damping / dt : k) * shortening;
    CHECK(load_on<Beads>(pair, ground).force[0] == doctest::Approx(expected).epsilon(1e-8));
    CHECK(load_on<Beads>(pair, ceiling).force[0] == doctest::Approx(-expected).epsilon(1e-8));
  }
}

TEST_CASE("contact planes refuse what they cannot do, and name it") {
  const auto complaint = [](const auto& function) -> std::string {
    try {
      function();
    } catch (const ParameterError& error) {
      return error.what();
    }
    return "nothing";
  };
  const ContactPlane<2> floor_plane{.normal = {{0.0, 1.0}}, .position = 0.2};
  CHECK(complaint([&] { validate(ContactPlane<2>{.normal = {{0.0, 2.0}}, .position = 0.2}); }) ==
        "forcing::ContactPlane: normal must have length 1, its square, got 4");
  CHECK(complaint([&] { validate(ContactPlane<2>{.normal = {{0.0, 1.0}}, .position = NAN}); }) ==
        "forcing::ContactPlane: position must be finite [m], got nan");
  CHECK(complaint([&] { (void)confined_by<Beads>(floor_plane, ContactPlane<2>{.normal = {{0.6, 0.8}}, .position = 0.0}); }) ==
        "confined_by: planes must be opposite or at right angles, the product of two normals -1 or 0, got 0.8");
  CHECK(complaint([&] { (void)confined_by<Beads>(floor_plane, floor_plane); }) ==
        "confined_by: planes must be opposite or at right angles, the product of two normals -1 or 0, got 1");

  const auto on = [&](const Box<2>& box, const auto& planes) {
    return scene<Leapfrog>(box, group<Beads>("beads", Mobile{}, Points<2>{{Vector<2>(0.0, 0.5), Vector<2>(0.5, 0.1)}}, mass), planes);
  };
  auto behind = on(Box<2>::unbounded(), confined_by<Beads>(floor_plane));
  CHECK(
      complaint([&] { behind.run({.until = 1.0, .time_step = 0.1}); }) ==
      "scene: group beads, particle 1: normal . position must be >= that of a contact plane, 0.2 m, got 0.1 (relax puts it on the plane)");
  behind.group<Beads>().positions()[1][1] = 0.2;
  CHECK(complaint([&] { behind.run({.until = 1.0, .time_step = 0.1}); }) == "nothing");
  CHECK(complaint([&] { (void)load_on<Beads>(behind, ContactPlane<2>{.normal = {{0.0, -1.0}}, .position = 0.2}); }) ==
        "load_on: a contact plane must be one of the scene's, with its normal, motion and position [m], got 0.2");
  auto moving = floor_plane;
  moving.motion.speed = 0.1;
  CHECK_THROWS_AS((void)load_on<Beads>(behind, moving), ParameterError);
  auto across = on({.lower = {-1.0, -1.0}, .upper = {1.0, 1.0}, .periodic = {false, true}}, confined_by<Beads>(floor_plane));
  CHECK(complaint([&] { across.run({.until = 1.0, .time_step = 0.1}); }) ==
        "scene: a contact plane must lie along periodic directions, the component of its normal there be 0, got 1");
  const ContactPlane<2> lid{.normal = {{0.0, -1.0}}, .position = -1.0, .motion = {.speed = 1.0}};
  auto crushed = on(Box<2>::unbounded(), confined_by<Beads>(ContactPlane<2>{.normal = {{0.0, 1.0}}, .position = 0.0}, lid));
  CHECK_THROWS_WITH_AS(crushed.run({.until = 2.0, .time_step = 0.01}),
                       doctest::Contains("is behind a contact plane: planes leave it no room"), SimulationError);
}
