// Groups on rollers: held along one direction, moved by forces across it.
#include <array>
#include <cmath>
#include <string>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/bond.hpp>
#include <dmp/forcing.hpp>
#include <dmp/integrator.hpp>
#include <dmp/lattice_spring.hpp>
#include <dmp/particles.hpp>
#include <dmp/particles/clamp.hpp>
#include <dmp/simulation.hpp>
#include "support/compare.hpp"

using namespace dmp;
using namespace dmp::simulation;
using particles::Clamp, particles::Driven, particles::Frozen, particles::Mobile, particles::Roller;
using test::relative_error;

namespace {

struct Beads {};
struct Left {};
struct Right {};

constexpr double k = 3.0, l = 0.5;  // E = 2.5 k/l

/// A bar of 8 x 4 x 4 whole cells, its end layers in groups of their own.
struct Bar {
  lattice_spring::Body<3> body =
      lattice_spring::lattice_block(lattice_spring::CubicLattice{.spacing = l}, {8, 4, 4}, lattice_spring::SurfaceBonds::shared);
  std::array<geometry::Points<3>, 3> points{};  // left end, beads between, right end
  std::array<std::array<std::vector<neighbours::Bond>, 3>, 3> bonds{};

  Bar() {
    const auto& x = body.points.positions;
    const auto part = [&](std::uint32_t i) -> std::size_t { return x[i][0] < 0.5 * l ? 0 : x[i][0] > 7.5 * l ? 2 : 1; };
    std::vector<std::uint32_t> row(x.size());
    for (std::uint32_t i = 0; i < x.size(); ++i) {
      auto& there = points[part(i)].positions;
      row[i] = static_cast<std::uint32_t>(there.size());
      there.push_back(x[i]);
    }
    for (auto bond : body.bonds) {
      if (part(bond.i) > part(bond.j)) std::swap(bond.i, bond.j);
      auto& list = bonds[part(bond.i)][part(bond.j)];
      bond.i = row[bond.i], bond.j = row[bond.j];
      list.push_back(bond);
    }
  }
};

struct Elastic {
  double youngs_modulus, poisson_ratio;
};

/// What the bar shows when its ends are drawn apart by a strain of 1e-6, from rest to rest.
template <template <class> class Grip>
Elastic drawn() {
  const Bar bar;
  constexpr double strain = 1e-6, length = 8.0 * l, width = 4.0 * l;
  const bond::Harmonic spring{.stiffness = k};
  const Clamp<3> still{.direction = {{1.0, 0.0, 0.0}}};
  const Clamp<3> pull{.direction = {{1.0, 0.0, 0.0}}, .motion = {.speed = strain * length}};  // at time t by t strain * length
  auto scene = simulation::scene<integrator::Leapfrog>(
      geometry::Box<3>::unbounded(), group<Left>("left", Grip<Clamp<3>>{still}, bar.points[0], 1.0),
      group<Beads>("beads", Mobile{}, bar.points[1], 1.0), group<Right>("right", Grip<Clamp<3>>{pull}, bar.points[2], 1.0),
      bonds<Left, Left>(spring, bar.bonds[0][0]), bonds<Left, Beads>(spring, bar.bonds[0][1]),
      bonds<Beads, Beads>(spring, bar.bonds[1][1]), bonds<Beads, Right>(spring, bar.bonds[1][2]),
      bonds<Right, Right>(spring, bar.bonds[2][2]));
  relax(scene, {.force_tolerance = 1e-7 * strain * k * l, .time = 1.0});
  const double force = bond_load<Left>(scene)[0];
  CHECK(relative_error(-bond_load<Right>(scene)[0], force) < 1e-5);
  double narrower = 0.0, count = 0.0;  // the sides of the bar's inside, without the end layers
  const auto& start = bar.points[1].positions;
  for (std::size_t i = 0; i < start.size(); ++i)
    if (start[i][1] < 0.5 * l || start[i][1] > width - 0.5 * l) {
      narrower += (scene.template group<Beads>().positions()[i][1] - start[i][1]) * (start[i][1] < 0.5 * width ? 1.0 : -1.0);
      count += 1.0;
    }
  return {force / (width * width * strain), 2.0 * narrower / count / (width * strain)};
}

}  // namespace

TEST_CASE("A15: a bar drawn by grips on rollers has E = 2.5 k/l and nu = 1/4; grips that hold all of their beads make it stiffer") {
  const Elastic free = drawn<Roller>(), held = drawn<Driven>();
  CHECK(relative_error(free.youngs_modulus, 2.5 * k / l) < 1e-5);  // springs are not linear at finite strain
  CHECK(std::fabs(free.poisson_ratio - 0.25) < 1e-5);
  CHECK(held.youngs_modulus > 1.01 * 2.5 * k / l);
  CHECK(held.poisson_ratio < 0.245);
}

namespace {

/// A bead on rollers along a slope, in gravity; follows the motion along it and falls across it.
template <class Integrator>
void slide_and_fall() {
  const Clamp<2> clamp{.direction = {{{0.6, 0.8}}}, .motion = {.speed = 2.0, .start_up = 0.25, .hold_from = 0.75}};
  const Vector<2> start(1.0, -2.0), along(0.6, 0.8), across(-0.8, 0.6), g(0.0, -9.81);
  auto scene = simulation::scene<Integrator>(geometry::Box<2>::unbounded(),
                                             group<Beads>("bead", Roller{clamp}, geometry::Points<2>{{start}}, 0.1),
                                             forced_by<Beads>(forcing::Constant<2>{.uniform_acceleration = {{0.0, -9.81}}}));
  for (const double time : {0.1, 0.5, 1.0}) {
    scene.run({.until = time, .time_step = 0.01});
    const auto& bead = scene.template group<Beads>();
    const Vector<2> x = bead.positions()[0] - start, v = bead.template get<field::Velocity>()[0];
    CHECK(std::fabs(x.dot(along) - clamp.motion.displacement(time)) < 1e-13);
    CHECK(std::fabs(v.dot(along) - clamp.motion.velocity(time)) < 1e-13);
    CHECK(std::fabs(x.dot(across) - 0.5 * g.dot(across) * time * time) < 1e-12);
    CHECK(std::fabs(v.dot(across) - g.dot(across) * time) < 1e-12);
  }
}

}  // namespace

TEST_CASE("a bead on rollers follows its motion along them exactly, and falls freely across them") {
  slide_and_fall<integrator::Leapfrog>();
  slide_and_fall<integrator::LammpsVerlet>();
}

namespace {

/// Where a bead on rollers along x is that a Kelvin-Voigt bond ties to a fixed one: a pendulum whose end is moved sideways.
template <class Bonds>
Vector<2> swung(const Bonds& bonds, double dt) {
  const Clamp<2> clamp{.direction = {{{1.0, 0.0}}}, .motion = {.speed = 0.3, .start_up = 0.5}};
  auto scene = simulation::scene<integrator::Leapfrog>(
      geometry::Box<2>::unbounded(), group<Left>("pin", Frozen<2>{}, geometry::Points<2>{{Vector<2>(0.0, 0.0)}}, 1.0),
      group<Beads>("bead", Roller{clamp}, geometry::Points<2>{{Vector<2>(0.6, -0.8)}}, 0.1), bonds,
      forced_by<Beads>(forcing::Constant<2>{.uniform_acceleration = {{0.0, -1.0}}}));
  scene.run({.until = 1.0, .time_step = dt});
  return scene.template group<Beads>().positions()[0];
}

/// The same, y'' = -1 - ((k (L - 1) + c L')/m) y/L at a given x(t), by the classical method of Runge and Kutta.
Vector<2> swung_exactly() {
  const forcing::Ramp motion{.speed = 0.3, .start_up = 0.5};
  const auto acceleration = [&](double time, double y, double v) {
    const double x = 0.6 + motion.displacement(time), length = std::hypot(x, y), rate = (x * motion.velocity(time) + y * v) / length;
    return -1.0 - (20.0 * (length - 1.0) + 0.4 * rate) / 0.1 * y / length;
  };
  double y = -0.8, v = 0.0;
  constexpr int steps = 20000;
  constexpr double dt = 1.0 / steps;
  for (int n = 0; n < steps; ++n) {
    const double t = n * dt, v1 = v, a1 = acceleration(t, y, v), v2 = v + 0.5 * dt * a1,
                 a2 = acceleration(t + 0.5 * dt, y + 0.5 * dt * v1, v2), v3 = v + 0.5 * dt * a2,
                 a3 = acceleration(t + 0.5 * dt, y + 0.5 * dt * v2, v3), v4 = v + dt * a3, a4 = acceleration(t + dt, y + dt * v3, v4);
    y += dt / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
    v += dt / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
  }
  return {0.6 + motion.displacement(1.0), y};
}

}  // namespace

TEST_CASE("a pendulum on rollers swings as its equation says, with bonds, bonds whose dashpots are solved for, and sub-stepped bonds") {
  const bond::KelvinVoigt law{.stiffness = 20.0, .damping = 0.4};
  const std::vector<neighbours::Bond> tie{{.i = 0, .j = 0, .rest_length = 1.0}};
  const Vector<2> exact = swung_exactly();
  const auto check = [&](const auto& bonds, double order) {
    const double coarse = (swung(bonds, 4e-3) - exact).norm(), fine = (swung(bonds, 1e-3) - exact).norm();
    CAPTURE(coarse);
    CAPTURE(fine);
    CHECK(coarse < 3e-3);
    CHECK(std::log(coarse / fine) / std::log(4.0) > order - 0.1);
  };
  check(bonds<Left, Beads>(law, tie), 1.0);
  check(implicit_bonds<Left, Beads>(law, tie), 2.0);
  check(substepped_bonds<Left, Beads>(law, tie), 1.0);
}

namespace {
/// A motion of a user's own, at rest.
struct Rail {
  Required<Components<2, double>> direction;
  [[nodiscard]] Vector<2> position(const Vector<2>& start, double) const { return start; }
  [[nodiscard]] Vector<2> velocity(const Vector<2>&, double) const { return Vector<2>::Zero(); }
};
void validate(const Rail&) {}
}  // namespace

TEST_CASE("a roller needs a direction of length 1, along or across each periodic direction of the box") {
  const auto on = [](double x, double y, bool periodic) {
    return scene<integrator::Leapfrog>(geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {periodic, false}},
                                       group<Beads>("trolley", Roller{Rail{.direction = {{x, y}}}}, geometry::Points<2>{{{0.5, 0.5}}}, 1.0),
                                       forced_by<Beads>(forcing::Drag{.coefficient = 1.0}));
  };
  CHECK_THROWS_WITH_AS((void)on(2.0, 0.0, false), "group trolley: direction of a Roller must have length 1, its square, got 4",
                       ParameterError);
  CHECK_THROWS_WITH_AS((void)on(0.6, 0.8, true),
                       "group trolley: direction of a Roller must lie along or across each periodic direction, got component 0.6 along one",
                       ParameterError);
  CHECK_NOTHROW((void)on(0.6, 0.8, false));
  CHECK_NOTHROW((void)on(1.0, 0.0, true));
  CHECK_NOTHROW((void)on(0.0, 1.0, true));
}
