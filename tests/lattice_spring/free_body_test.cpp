// A16: bodies of Kelvin-Voigt bonds: a free ball that spins and vibrates keeps both momenta; where energy goes, also that of plates.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>
#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <dmp/bond.hpp>
#include <dmp/forcing.hpp>
#include <dmp/integrator.hpp>
#include <dmp/lattice_spring.hpp>
#include <dmp/simulation.hpp>

using namespace dmp::lattice_spring;
using namespace dmp::simulation;
using dmp::Vector;
using dmp::bond::KelvinVoigt;

namespace {

struct Beads {};

// k = l = m = 1. The springs allow a step of 2/sqrt(12) = 0.58, springs and dashpots together 0.31.
constexpr KelvinVoigt law{.stiffness = 1.0, .damping = 0.25};

constexpr auto half_step = [](const std::vector<dmp::neighbours::Bond>& list) { return bonds<Beads, Beads>(law, list); };
constexpr auto solved_for = [](const std::vector<dmp::neighbours::Bond>& list) { return implicit_bonds<Beads, Beads>(law, list); };

struct Sums {
  Vector<3> momentum = Vector<3>::Zero(), spin = Vector<3>::Zero();
  double kinetic = 0.0, stored = 0.0, drain = 0.0;  // energies; power of the dashpots
};
Sums sums_of(const auto& scene, const std::vector<dmp::neighbours::Bond>& list) {
  const auto& x = scene.template group<Beads>().positions();
  const auto& v = scene.template group<Beads>().template get<dmp::field::Velocity>();
  Sums sums;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sums.momentum += v[i];
    sums.spin += x[i].cross(v[i]);
    sums.kinetic += 0.5 * v[i].squaredNorm();
  }
  for (const auto& bond : list) {
    const Vector<3> apart = x[bond.i] - x[bond.j];
    const double length = apart.norm();
    sums.stored += 0.5 * law.stiffness * dmp::square(length - bond.rest_length);
    sums.drain += law.damping * dmp::square(apart.dot(v[bond.i] - v[bond.j]) / length);
  }
  return sums;
}

struct Drift {
  double momentum = 0.0, spin = 0.0;  // largest change, as a fraction
  double lost = 0.0;                  // to the dashpots
  double balance = 0.0;               // kinetic + stored + lost, less that at the start, as a fraction of what was lost
};
Drift let_go(const auto& scheme, int beads_in_radius, double until, double step) {
  const double far = beads_in_radius + 1.0;
  auto body = lattice_body(CubicLattice{.spacing = 1.0}, {.lower = {-far, -far, -far}, .upper = {far, far, far}},
                           dmp::geometry::Ball<3>{.centre = {0.0, 0.0, 0.0}, .radius = beads_in_radius - 1e-6});
  measure_rest_lengths<3>(body.bonds, body.points.positions);
  auto ball = scene<dmp::integrator::Leapfrog>(dmp::geometry::Box<3>::unbounded(),
                                               group<Beads>("beads", dmp::particles::Mobile{}, body.points, 1.0), scheme(body.bonds));
  // It flies, spins about a generic axis, is drawn out along x, and sheared.
  const Vector<3> flight(0.3, -0.2, 0.1), turning = Vector<3>(0.1, -0.2, 0.3) / beads_in_radius;
  Tensor<3> vibration;
  vibration << 0.1, 0.05, 0.0, 0.0, -0.05, 0.0, 0.05, 0.0, -0.02;
  ball.template group<Beads>().template set<dmp::field::Velocity>(
      [&](const Vector<3>& x) { return Vector<3>(flight + turning.cross(x) + vibration * x / beads_in_radius); });
  Drift drift;
  Sums first, last;
  ball.every(step, [&](const auto& s) {
    const Sums now = sums_of(s, body.bonds);
    if (s.step() == 0) {
      first = last = now;
      return;
    }
    drift.lost += 0.5 * step * (last.drain + now.drain);
    drift.momentum = std::max(drift.momentum, (now.momentum - first.momentum).norm() / first.momentum.norm());
    drift.spin = std::max(drift.spin, (now.spin - first.spin).norm() / first.spin.norm());
    last = now;
  });
  ball.run({.until = until, .time_step = step});
  drift.balance = (last.kinetic + last.stored + drift.lost - first.kinetic) / drift.lost;
  return drift;
}

void check(int beads_in_radius, double until) {
  const auto keeps = [](const Drift& drift) {
    CHECK(drift.momentum <= 1e-12);
    CHECK(drift.spin <= 1e-12);
    CHECK(drift.lost > 0.0);
    return std::fabs(drift.balance);
  };
  const double coarse = keeps(let_go(solved_for, beads_in_radius, until, 0.16)),
               fine = keeps(let_go(solved_for, beads_in_radius, until, 0.08));
  CHECK(coarse <= 1e-3);
  CHECK(std::log2(coarse / fine) == doctest::Approx(2.0).epsilon(0.05));
  const double explicit_coarse = keeps(let_go(half_step, beads_in_radius, until, 0.04)),
               explicit_fine = keeps(let_go(half_step, beads_in_radius, until, 0.02));
  CHECK(explicit_fine <= 1e-3);
  CHECK(std::log2(explicit_coarse / explicit_fine) == doctest::Approx(1.0).epsilon(0.05));
}

/// Kinetic and stored energy and what dashpots took, less the work of two plates that approach, as a fraction of this work.
double balance_of_plates(const auto& scheme, double step) {
  auto body = lattice_block(CubicLattice{.spacing = 1.0}, {4, 4, 4});
  measure_rest_lengths<3>(body.bonds, body.points.positions);
  const dmp::forcing::Plane<3> below{.normal = {{0.0, 0.0, 1.0}}, .position = 0.0, .strength = 10.0},
      above{.normal = {{0.0, 0.0, -1.0}}, .position = -4.0, .strength = 10.0, .motion = {.speed = 0.02}};
  auto block = scene<dmp::integrator::Leapfrog>(dmp::geometry::Box<3>::unbounded(),
                                                group<Beads>("beads", dmp::particles::Mobile{}, body.points, 1.0), scheme(body.bonds),
                                                forced_by<Beads>(below, above));
  double work = 0.0, lost = 0.0, power_before = 0.0;
  Sums last;
  block.every(step, [&](const auto& s) {
    const Sums now = sums_of(s, body.bonds);
    double power = 0.0;
    for (std::size_t i = 0; i < body.points.positions.size(); ++i) {
      const Vector<3>&x = s.template group<Beads>().positions()[i], &v = s.template group<Beads>().template get<dmp::field::Velocity>()[i];
      const dmp::forcing::Subject<3> bead{
          .position = {{x[0], x[1], x[2]}}, .velocity = {{v[0], v[1], v[2]}}, .mass = 1.0, .time = s.time()};
      power += (below.acceleration(bead).component[2] + above.acceleration(bead).component[2]) * v[2];
    }
    if (s.step() > 0) {
      work += 0.5 * step * (power_before + power);
      lost += 0.5 * step * (last.drain + now.drain);
    }
    power_before = power;
    last = now;
  });
  block.run({.until = 19.2, .time_step = step});
  CHECK(lost > 0.01 * work);
  return (last.kinetic + last.stored + lost - work) / work;
}

}  // namespace

TEST_CASE(
    "A16: a free ball, R = 8 l, that spins and vibrates keeps both momenta to 1e-12; dashpots take what is lost to 1e-3, to second order "
    "if solved for") {
  check(8, 24.0);  // it turns by 1.1 rad
}
TEST_CASE("slow: A16: the free ball with R = 16 l") { check(16, 48.0); }

TEST_CASE("A16: the work of plates on a block goes into motion, springs and dashpots to 1e-3, to second order if these are solved for") {
  const double coarse = balance_of_plates(solved_for, 0.08), fine = balance_of_plates(solved_for, 0.04);
  CHECK(std::fabs(coarse) <= 1e-3);
  CHECK(std::log2(coarse / fine) == doctest::Approx(2.0).epsilon(0.05));
  CHECK(std::fabs(balance_of_plates(half_step, 0.04)) <= 1e-3);
}
