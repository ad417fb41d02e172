// A8b with inertia: a Kelvin-Voigt ball between plates that approach within a few relaxation times tau, each of 20 transits of sound.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/bond.hpp>
#include <dmp/core/math.hpp>
#include <dmp/forcing.hpp>
#include <dmp/integrator.hpp>
#include <dmp/lattice_spring.hpp>
#include <dmp/simulation.hpp>

using namespace dmp::lattice_spring;
using namespace dmp::simulation;
using dmp::Vector;

namespace {

struct Beads {};

struct Errors {
  double ramp;  // relative L2 of F(t) from F_el + tau dF_el/dt
  double hold;  // largest of |F/F_el - 1| after 4 tau of hold
};

/// k = l = m = 1. The ball is pressed by 6 % of its diameter within `ramp_in_tau` tau; its layers lie along the plates.
Errors pressed(int beads_in_radius, double ramp_in_tau) {
  const double radius = beads_in_radius, transit = 2.0 * radius / std::sqrt(3.0), tau = 20.0 * transit, ramp = ramp_in_tau * tau;
  const double approach = 0.06 * 2.0 * radius, margin = radius + 1.0;
  auto body = lattice_body(CubicLattice{.spacing = 1.0},
                           dmp::geometry::Cuboid<3>{.lower = {-margin, -margin, -margin}, .upper = {margin, margin, margin}},
                           dmp::geometry::Ball<3>{.centre = {0.0, 0.0, 0.0}, .radius = radius - 1e-6});
  measure_rest_lengths<3>(body.bonds, body.points.positions);
  double outermost = 0.0;
  for (const auto& x : body.points.positions) outermost = std::max(outermost, x[2]);
  const double start_up = 0.25 * ramp, speed = 0.5 * approach / (ramp - 0.5 * start_up);
  const dmp::forcing::Ramp motion{.speed = speed, .start_up = start_up, .hold_from = ramp};
  const auto plate = [&](double side) {
    return dmp::forcing::Plane<3>{.normal = {{0.0, 0.0, -side}}, .position = -outermost, .strength = 625.0, .motion = motion};
  };
  const auto below = plate(-1.0), above = plate(1.0);
  const auto ball = [&](const auto& bonds) {
    return scene<dmp::integrator::Leapfrog>(dmp::geometry::Box<3>::unbounded(),
                                            group<Beads>("ball", dmp::particles::Mobile{}, body.points, 1.0), bonds,
                                            forced_by<Beads>(below, above));
  };
  const auto load = [&](const auto& s, double time) {
    return 0.5 * (load_on<Beads>(s, below, time).force[2] - load_on<Beads>(s, above, time).force[2]);
  };

  constexpr int samples = 40;  // of the ramp
  std::vector<double> elastic{0.0};
  auto at_rest = ball(bonds<Beads, Beads>(dmp::bond::Harmonic{.stiffness = 1.0}, body.bonds));
  for (int n = 1; n <= samples; ++n) {
    const double time = ramp * n / samples;
    relax(at_rest, {.force_tolerance = 1e-7, .time = time, .without_rotation = true});
    elastic.push_back(load(at_rest, time));
  }
  auto moving = ball(implicit_bonds<Beads, Beads>(dmp::bond::KelvinVoigt{.stiffness = 1.0, .damping = tau}, body.bonds));
  double difference = 0.0, all = 0.0;
  for (int n = 1; n < samples; ++n) {  // central differences of the elastic force
    const double time = ramp * n / samples;
    moving.run({.until = time});
    const auto k = static_cast<std::size_t>(n);
    const double expected = elastic[k] + tau * (elastic[k + 1] - elastic[k - 1]) / (2.0 * ramp / samples);
    difference += dmp::square(load(moving, time) - expected);
    all += dmp::square(expected);
  }
  Errors errors{.ramp = std::sqrt(difference / all), .hold = 0.0};
  for (const double hold : {4.0, 4.5, 5.0}) {
    moving.run({.until = ramp + hold * tau});
    errors.hold = std::max(errors.hold, std::fabs(load(moving, moving.time()) / elastic.back() - 1.0));
  }
  return errors;
}

void check(int beads_in_radius, double ramp_in_tau, double bound) {
  const Errors errors = pressed(beads_in_radius, ramp_in_tau);
  CHECK(errors.ramp <= bound);
  CHECK(errors.hold <= 0.005);
}

}  // namespace

TEST_CASE("A8b with inertia, R = 6 l: on a ramp of 2 tau the force is F_el + tau dF_el/dt to 6 %, and F_el to 0.5 % when it is over") {
  check(6, 2.0, 0.06);
}
TEST_CASE("slow: A8b with inertia: a ramp of 10 tau to 2 %, R = 4 l; one of 2 tau to 6 %, R = 10 l") {
  check(4, 10.0, 0.02);
  check(10, 2.0, 0.06);
}
