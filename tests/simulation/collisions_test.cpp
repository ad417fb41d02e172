// Fast beads and thin walls: with the step that the scene chooses none passes that has not the energy to, and none loses any. The barrier
// of a wall is computed here from U = 4 eps [(sigma/r)^12 - (sigma/r)^6]; eps, sigma and the mass are 1.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>
#include <doctest/doctest.h>

#include "scenes.hpp"

using namespace test;
using integrator::ExtrapolatedVerlet, integrator::Leapfrog, integrator::SymplecticEuler;

namespace {

struct Shot {};
struct Target {};

const double cutoff = std::pow(2.0, 1.0 / 6.0);  // where the force is 0: repulsion alone

/// Energy of a bead at this distance from another one, over that out of reach.
double repulsion(double r) { return r < cutoff ? 4.0 * (std::pow(r, -12.0) - std::pow(r, -6.0)) + 1.0 : 0.0; }

/// A bead before a wall: one layer of fixed beads, a square lattice of this spacing at z = 0.
struct Attempt {
  double spacing = 1.0;
  Vector<2> aim{0.0, 0.0};  ///< where it would hit, in spacings: (0, 0) a bead of the wall, (0.5, 0.5) between four
  double speed = 1.0;
  double start = -3.0;      ///< z at the start
};
/// The most energy that it needs on its straight way through the wall.
double barrier(const Attempt& attempt) {
  double sum = 0.0;
  for (int i = -4; i <= 4; ++i)
    for (int j = -4; j <= 4; ++j) sum += repulsion(attempt.spacing * (Vector<2>(i, j) - attempt.aim).norm());
  return sum;
}
template <class Integrator = Leapfrog, class Potential = potential::LennardJones>
auto wall_and_bead(const Attempt& attempt, const Potential& law = {.energy_scale = 1.0, .diameter = 1.0, .cutoff = cutoff}) {
  geometry::Points<3> wall;
  for (int i = -4; i <= 4; ++i)
    for (int j = -4; j <= 4; ++j) wall.positions.push_back(attempt.spacing * Vector<3>(i, j, 0.0));
  const Vector<3> from(attempt.spacing * attempt.aim[0], attempt.spacing * attempt.aim[1], attempt.start);
  auto result = scene<Integrator>(geometry::Box<3>{.lower = {-50.0, -50.0, -50.0}, .upper = {50.0, 50.0, 50.0}},
                                  group<Target>("wall", Frozen<3>{}, wall, 1.0),
                                  group<Shot>("bead", Mobile{}, geometry::Points<3>{{from}}, 1.0), interaction<Shot, Target>(law));
  result.template group<Shot>().template get<field::Velocity>()[0] = {0.0, 0.0, attempt.speed};
  return result;
}
/// Velocity after the encounter, over the speed before, with the step that the scene chooses.
template <class Integrator = Leapfrog, class Potential = potential::LennardJones>
Vector<3> after(const Attempt& attempt, const Potential& law = {.energy_scale = 1.0, .diameter = 1.0, .cutoff = cutoff}) {
  auto scene = wall_and_bead<Integrator>(attempt, law);
  const auto report = scene.run({.until = 3.0 * std::fabs(attempt.start) / attempt.speed});
  if (attempt.speed > 5.0) CHECK(report.step_bound_by == "collisions of a pair potential");
  return scene.template group<Shot>().template get<field::Velocity>()[0] / attempt.speed;
}
const double phases[] = {-3.0, -3.0123, -3.0456, -3.0789, -3.1012, -3.1345};  // starts that lie differently in the pattern of steps

}  // namespace

TEST_CASE(
    "a bead shot at a bead of a thin wall, 1 to 10 000 times as fast as the wall's own motion would be, turns back with its energy, "
    "whatever the phase of its start") {
  for (const double speed : {3.0, 10.0, 100.0, 1e3, 1e4})
    for (const double start : phases) {
      CAPTURE(speed);
      CAPTURE(start);
      const Vector<3> v = after({.speed = speed, .start = start});
      CHECK(v[2] == doctest::Approx(-1.0).epsilon(0.01));
      CHECK(v.head<2>().norm() < 1e-12);
      CHECK(after<ExtrapolatedVerlet>({.speed = speed, .start = start})[2] == doctest::Approx(-1.0).epsilon(0.01));
    }
}

TEST_CASE(
    "a bead shot between four beads of a thin wall passes if its energy is above the barrier of the four, and only then; in either case it "
    "keeps its energy") {
  for (const double spacing : {1.0, 0.5, 0.25})
    for (const double start : phases) {
      CAPTURE(spacing);
      CAPTURE(start);
      Attempt attempt{.spacing = spacing, .aim = {0.5, 0.5}, .start = start};
      const double needed = std::sqrt(2.0 * barrier(attempt));  // 42, 2.0e3 and 1.3e5
      CHECK(needed > 40.0);
      for (const double share : {0.3, 0.97, 1.03, 3.0}) {
        CAPTURE(share);
        attempt.speed = share * needed;
        CHECK(after(attempt)[2] == doctest::Approx(share < 1.0 ? -1.0 : 1.0).epsilon(5e-3));
      }
    }
}

TEST_CASE("a bead that hits a thin wall beside the middle of a bead is turned aside, and keeps its energy") {
  for (const double speed : {10.0, 1e3})
    for (const Vector<2>& aim : {Vector<2>(0.1, 0.0), Vector<2>(0.2, 0.15), Vector<2>(0.3, 0.45), Vector<2>(0.5, 0.1)}) {
      CAPTURE(speed);
      CAPTURE(aim);
      const Vector<3> v = after({.aim = aim, .speed = speed});
      CHECK(v.norm() == doctest::Approx(1.0).epsilon(2e-3));
      CHECK(v.head<2>().norm() > 0.01);
    }
}

TEST_CASE("a fast bead that meets a free one head-on hands over its velocity, m1 = m2; 2 m1/(m1 + m2) of it else") {
  for (const double other : {1.0, 4.0, 0.25})
    for (const double speed : {10.0, 1e3}) {
      CAPTURE(other);
      CAPTURE(speed);
      const potential::LennardJones law{.energy_scale = 1.0, .diameter = 1.0, .cutoff = cutoff};
      auto pair =
          scene<Leapfrog>(geometry::Box<1>::unbounded(), group<Shot>("bead", Mobile{}, geometry::Points<1>{{Vector<1>(-3.0)}}, 1.0),
                          group<Target>("other", Mobile{}, geometry::Points<1>{{Vector<1>(0.0)}}, other), interaction<Shot, Target>(law));
      pair.group<Shot>().get<field::Velocity>()[0] = Vector<1>(speed);
      pair.run({.until = 6.0 / speed});
      const double allowed = other < 1.0 ? 0.01 : 2e-3;  // where the other one flies off faster, the step shrinks in mid-collision
      CHECK(pair.group<Target>().get<field::Velocity>()[0][0] == doctest::Approx(2.0 * speed / (1.0 + other)).epsilon(allowed));
      CHECK(pair.group<Shot>().get<field::Velocity>()[0][0] ==
            doctest::Approx(speed * (1.0 - other) / (1.0 + other)).epsilon(allowed).scale(speed));
    }
}

TEST_CASE("two beads that start beyond each other's lists meet, with nobody in between and others far away") {
  for (const double apart : {1.3, 1.5, 2.0, 2.3, 3.1}) {
    CAPTURE(apart);
    const std::vector<double> x{-6.6, -0.5 * apart, 0.5 * apart, 5.4}, v{0.0, 0.1, -0.1, 0.0};  // lists reach 1.2, a tenth of all this
    geometry::Points<1> points;
    for (const double at : x) points.positions.push_back(Vector<1>(at));
    const potential::LennardJones law{.energy_scale = 1.0, .diameter = 0.89, .cutoff = 0.89 * cutoff};
    auto line = scene<Leapfrog>(geometry::Box<1>::unbounded(), group<Shot>("bead", Mobile{}, points, 1.0), interaction<Shot, Shot>(law));
    for (std::size_t i = 0; i < 4; ++i) line.group<Shot>().get<field::Velocity>()[i] = Vector<1>(v[i]);
    line.run({.until = 10.0 * apart, .time_step = 0.005});
    for (std::size_t i = 0; i < 4; ++i) {
      const auto bead = line.group<Shot>().id[i];
      CHECK(line.group<Shot>().get<field::Velocity>()[i][0] == doctest::Approx(-v[bead]).epsilon(1e-4));
    }
  }
}

namespace {

/// U = eps (1 - (r/r_c)^2)^2: a hill of height eps, which does not turn back what has more. Its U'' jumps at r_c: there a step of
/// omega dt = 0.9 wins or loses up to 2 % of the speed, which a smaller one does not.
struct Hill {
  double height, cutoff;
  template <class T>
  T force_factor(const T& squared) const {
    return (4.0 * height / (cutoff * cutoff)) * rest(squared);
  }
  template <class T>
  T energy(const T& squared) const {
    return height * square(rest(squared));
  }
  double largest_stiffness() const { return 8.0 * height / (cutoff * cutoff); }

 private:
  template <class T>
  T rest(const T& squared) const {
    return select(squared < cutoff * cutoff, 1.0 - squared * (1.0 / (cutoff * cutoff)), 0.0);
  }
};
void validate(const Hill&) {}

}  // namespace

TEST_CASE("a potential of finite height turns back what has less energy than that and lets the rest pass, at any speed, with its energy") {
  const Hill hill{.height = 50.0, .cutoff = 1.0};  // 10 m/s
  for (const double start : phases) {
    CAPTURE(start);
    for (const double speed : {3.0, 9.7}) CHECK(after({.speed = speed, .start = start}, hill)[2] == doctest::Approx(-1.0).epsilon(0.03));
    for (const double speed : {10.3, 30.0, 1e4})
      CHECK(after({.speed = speed, .start = start}, hill)[2] == doctest::Approx(1.0).epsilon(speed < 20.0 ? 0.03 : 3e-3));
  }
}

TEST_CASE(
    "a given step longer than a collision is not refused; the bounds before the run, and the report after it, say that it resolves none: "
    "the bead is through") {
  auto scene = wall_and_bead({.speed = 1e3});
  const auto limit = scene.step_limit();
  CHECK(limit.bound_by == "collisions of a pair potential");
  CHECK(limit.time_step < 0.25 * cutoff / 1e3);
  CHECK(limit.stability_bound_by == "pair potential");
  CHECK(limit.stable_time_step > 0.02);
  const auto report = scene.run({.until = 0.04, .time_step = 0.02});
  CHECK(scene.group<Shot>().positions()[0][2] == doctest::Approx(37.0));
  CHECK(report.limit.time_step == limit.time_step);
  CHECK(report.step_bound_by == "given, 74 % of the bound of pair potential, " + to_text(std::round(100.0 * 0.02 / limit.time_step)) +
                                    " % of what resolves collisions of a pair potential");
}

TEST_CASE("beads at rest, beads of no energy, and walls that move towards each other: no bound is made of collisions that there are not") {
  auto rest = wall_and_bead({.speed = 0.0});
  CHECK(rest.step_limit().bound_by == "pair potential");
  auto nothing = wall_and_bead({.speed = 1e3}, potential::LennardJones{.energy_scale = 0.0, .diameter = 1.0, .cutoff = cutoff});
  CHECK(nothing.step_limit().bound_by == "nothing");
  auto walls =
      scene<Leapfrog>(geometry::Box<1>::unbounded(), group<Shot>("one", Stationary{}, geometry::Points<1>{{Vector<1>(-3.0)}}, 1.0),
                      group<Target>("other", Frozen<1>{.wall_velocity = Vector<1>(1.0)}, geometry::Points<1>{{Vector<1>(0.0)}}, 1.0),
                      interaction<Shot, Target>(potential::LennardJones{.energy_scale = 1.0, .diameter = 1.0, .cutoff = cutoff}));
  CHECK(walls.step_limit().bound_by == "nothing");
}

TEST_CASE("a particle of a liquid, however fast, moves at most a quarter of its support in a step; a larger step is refused") {
  const double support = 2.6;
  for (const double speed : {1.0, 1e3, 1e6}) {
    auto sea = scene<ExtrapolatedVerlet>(
        geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {8.0, 8.0}, .periodic = {true, true}},
        group<Water>("water", Mobile{}, geometry::fill(geometry::Cubic<2>{.spacing = 1.0}, {.lower = {0.0, 0.0}, .upper = {8.0, 8.0}}),
                     1.0),
        interaction<Water, Water>(Flow{.kernel = {.support_radius = support}}),
        material<Water>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 1.0}, rheology::Constant{.dynamic_viscosity = 0.0}));
    sea.group<Water>().get<field::Velocity>()[9] = {speed, 0.0};
    const auto limit = sea.step_limit();
    CHECK(limit.stable_time_step * speed < 0.25 * support);
    CHECK(limit.stable_time_step * (speed + 1.0) == doctest::Approx(0.25 * support).epsilon(1e-9));
    CHECK_THROWS_WITH_AS(sea.run({.until = 1.0, .time_step = 0.25 * support / speed}), doctest::Contains("the bound of sound, got "),
                         ParameterError);
  }
}

TEST_CASE("a bead that is pulled from rest onto a bead of a wall bounces there and keeps its energy, however hard it is pulled") {
  for (const double pull : {1.0, 10.0, 100.0})
    for (const double start : {-1.5, -2.0, -3.0}) {
      CAPTURE(pull);
      CAPTURE(start);
      geometry::Points<3> wall;
      for (int i = -4; i <= 4; ++i)
        for (int j = -4; j <= 4; ++j) wall.positions.emplace_back(i, j, 0.0);
      auto scene = simulation::scene<Leapfrog>(
          geometry::Box<3>{.lower = {-50.0, -50.0, -50.0}, .upper = {50.0, 50.0, 50.0}}, group<Target>("wall", Frozen<3>{}, wall, 1.0),
          group<Shot>("bead", Mobile{}, geometry::Points<3>{{Vector<3>(0.0, 0.0, start)}}, 1.0),
          interaction<Shot, Target>(potential::LennardJones{.energy_scale = 1.0, .diameter = 1.0, .cutoff = cutoff}),
          forced_by<Shot>(forcing::Constant<3>{.uniform_acceleration = {{0.0, 0.0, pull}}}));
      scene.run({.until = 4.0 * std::sqrt(2.0 * (-start - 1.0) / pull)});  // two bounces, and about as high as at the start
      const Vector<3> x = scene.group<Shot>().positions()[0], v = scene.group<Shot>().get<field::Velocity>()[0];
      double energy = 0.5 * v.squaredNorm() - pull * x[2];
      for (const Vector<3>& bead : wall.positions) energy += repulsion((x - bead).norm());
      CHECK(energy == doctest::Approx(-pull * start).epsilon(0.01));
    }
}

TEST_CASE("a run that is followed by another one, in which a bead is much faster, chooses its step anew") {
  auto scene = wall_and_bead({.speed = 1.0, .start = -3.0});
  scene.run({.until = 0.1});
  scene.group<Shot>().get<field::Velocity>()[0] = {0.0, 0.0, 1e3};
  scene.run({.until = scene.time() + 0.01});
  CHECK(scene.group<Shot>().get<field::Velocity>()[0][2] == doctest::Approx(-1e3).epsilon(2e-3));
}

TEST_CASE(
    "two beads with an attractive well meet head-on and hand over their velocities, slower and faster than what the well gives them") {
  for (const double range : {2.5, 4.0})
    for (const double speed : {0.3, 0.5, 1.0, 2.0, 5.0, 50.0, 1500.0})  // the well gives 2 m/s
      for (const double start : phases) {
        CAPTURE(range);
        CAPTURE(speed);
        CAPTURE(start);
        auto pair = scene<Leapfrog>(
            geometry::Box<1>::unbounded(), group<Shot>("bead", Mobile{}, geometry::Points<1>{{Vector<1>(start - 2.0)}}, 1.0),
            group<Target>("other", Mobile{}, geometry::Points<1>{{Vector<1>(0.0)}}, 1.0),
            interaction<Shot, Target>(potential::LennardJones{.energy_scale = 1.0, .diameter = 1.0, .cutoff = range}));
        pair.group<Shot>().get<field::Velocity>()[0] = Vector<1>(speed);
        pair.run({.until = 14.0 / speed});
        const double v = pair.group<Shot>().get<field::Velocity>()[0][0], w = pair.group<Target>().get<field::Velocity>()[0][0];
        CHECK(v + w == doctest::Approx(speed).epsilon(1e-12));
        const double energy = 0.25 * speed * speed;  // of the relative motion, which gains 1 in the well
        CHECK(std::fabs(0.25 * (w - v) * (w - v) - energy) < 0.02 * (energy + 1.0));  // the speed to 1 %, where it is largest
        CHECK(w > v);
      }
}

TEST_CASE("two beads that are bound in their well keep their energy over many encounters, near its bottom and near its rim") {
  for (const double apart : {1.0, 1.2, 1.5, 2.0}) {
    CAPTURE(apart);
    const potential::LennardJones law{.energy_scale = 1.0, .diameter = 1.0, .cutoff = 4.0};
    auto pair =
        scene<Leapfrog>(geometry::Box<1>::unbounded(), group<Shot>("bead", Mobile{}, geometry::Points<1>{{Vector<1>(-apart)}}, 1.0),
                        group<Target>("other", Mobile{}, geometry::Points<1>{{Vector<1>(0.0)}}, 1.0), interaction<Shot, Target>(law));
    const double start = law.energy(apart * apart);
    std::vector<double> error;
    for (int n = 1; n <= 400; ++n) {
      pair.run({.until = 0.25 * n});
      const double r = pair.group<Target>().positions()[0][0] - pair.group<Shot>().positions()[0][0];
      const double v = pair.group<Shot>().get<field::Velocity>()[0][0], w = pair.group<Target>().get<field::Velocity>()[0][0];
      CHECK(std::fabs(v + w) < 1e-12);
      error.push_back(0.5 * (v * v + w * w) + law.energy(r * r) - start);
    }
    const double most =
        std::fabs(*std::max_element(error.begin(), error.end(), [](double a, double b) { return std::fabs(a) < std::fabs(b); }));
    const double drift =
        (std::accumulate(error.end() - 100, error.end(), 0.0) - std::accumulate(error.begin(), error.begin() + 100, 0.0)) / 100.0;
    CHECK(most < square(0.9 * 2.0 / std::sqrt(6.0)) / 8.0);  // what leapfrog's energy oscillates by, (omega dt)^2/8
    CHECK(std::fabs(drift) < 0.01);
  }
}

namespace {

/// A hard core inside of a hill: three distances at which the force is 0. U = 4 eps [(s/r)^12 - (s/r)^6] + eps below 2^(1/6) s, and
/// B (1 - ((r - 1)/w)^2)^3 within w of r = 1.
struct Caged {
  double core = 0.4, barrier = 50.0, half_width = 0.3, cutoff = 2.0;  // B, w
  template <class T>
  T force_factor(const T& squared) const {
    const T r = sqrt(squared), y = (r - 1.0) * (1.0 / half_width), rest = max(1.0 - y * y, 0.0);
    const T s6 = cube(core * core / squared);
    return select(squared < core_range(), 24.0 / squared * s6 * (2.0 * s6 - 1.0), 0.0) +
           (6.0 * barrier / half_width) * y * square(rest) / r;
  }
  template <class T>
  T energy(const T& squared) const {
    const T y = (sqrt(squared) - 1.0) * (1.0 / half_width), rest = max(1.0 - y * y, 0.0), s6 = cube(core * core / squared);
    return select(squared < core_range(), 4.0 * s6 * (s6 - 1.0) + 1.0, 0.0) + barrier * cube(rest);
  }
  double largest_stiffness() const {  // at r = s; of the hill
    return std::max(456.0 / (core * core), 6.0 * barrier / (half_width * half_width));
  }

 private:
  double core_range() const { return core * core * std::cbrt(2.0); }
};
void validate(const Caged&) {}

}  // namespace

TEST_CASE(
    "a bead between a hard core and a hill, two places where a force ends, bounces to and fro and keeps its energy at any speed below the "
    "hill") {
  const Caged law;
  for (const double speed : {1.0, 4.0, 9.0, 9.9}) {
    CAPTURE(speed);
    auto cage =
        scene<Leapfrog>(geometry::Box<1>::unbounded(), group<Shot>("bead", Mobile{}, geometry::Points<1>{{Vector<1>(-0.6)}}, 1.0),
                        group<Target>("core", Frozen<1>{}, geometry::Points<1>{{Vector<1>(0.0)}}, 1.0), interaction<Shot, Target>(law));
    cage.group<Shot>().get<field::Velocity>()[0] = Vector<1>(speed);
    for (int n = 1; n <= 20; ++n) {
      cage.run({.until = 0.5 * n / speed});
      const double r = cage.group<Shot>().positions()[0][0], v = cage.group<Shot>().get<field::Velocity>()[0][0];
      CHECK(0.5 * v * v + law.energy(r * r) == doctest::Approx(0.5 * speed * speed).epsilon(0.07));  // leapfrog's oscillates
    }
  }
}
