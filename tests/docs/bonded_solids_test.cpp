// docs/bonded-solids.md: bodies of lattice and of random networks, their elastic constants, plates, viscoelastic steps, stresses.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>
#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <dmp/dmp.hpp>

namespace bonded_solids_program {

// doc: solid-names
using namespace dmp;
using namespace dmp::simulation;
using namespace dmp::lattice_spring;

struct Solid {};
// end

constexpr double radius = 0.4e-3;

Body<3> ball_of_lattice(const CubicLattice& lattice) {
  // doc: solid-lattice
  const geometry::Ball<3> ball{.centre = {0.0, 0.0, 0.0}, .radius = (1.0 - 1e-6) * radius};  // no bead on the very surface
  const geometry::Cuboid<3> around{.lower = {-radius, -radius, -radius}, .upper = {radius, radius, radius}};
  Body<3> body = lattice_body(lattice, around, ball);  // points and bonds
  measure_rest_lengths<3>(body.bonds, body.points.positions);  // as the scene would at its start
  // end
  return body;
}

}  // namespace bonded_solids_program

TEST_CASE("docs/bonded-solids.md: a ball of lattice between plates shows most of its Young's modulus, and its stress is finite") {
  using namespace bonded_solids_program;
  // doc: solid-constants
  const double spacing = radius / 8.0, density = 1000.0, youngs_modulus = 40e6;  // [m], [kg/m^3], [Pa]
  const CubicLattice lattice{.spacing = spacing,
                             .orientation = Eigen::Quaterniond(-0.467, -0.048, 0.830, -0.301).normalized().toRotationMatrix()};
  const double stiffness = stiffness_for(lattice, youngs_modulus);  // k = E l/2.5 [N/m]; nu = 1/4
  // end
  const Body<3> body = ball_of_lattice(lattice);

  // doc: solid-plates
  double highest = 0.0;
  for (const Vector<3>& x : body.points.positions) highest = std::max(highest, std::fabs(x[2]));
  const forcing::Ramp approach{.speed = 0.5};  // each at 0.5 m/s: at time t they have approached by t [m]
  const forcing::Plane<3> below{.normal = {{0.0, 0.0, 1.0}}, .position = -highest, .strength = 1e10, .motion = approach};
  const forcing::Plane<3> above{.normal = {{0.0, 0.0, -1.0}}, .position = -highest, .strength = 1e10, .motion = approach};

  auto pressed = scene<integrator::Leapfrog>(
      geometry::Box<3>::unbounded(),
      group<Solid>("ball", particles::Mobile{}, body.points, density * body.points.volume),
      bonds<Solid, Solid>(bond::Harmonic{.stiffness = stiffness}, body.bonds),
      forced_by<Solid>(below, above));
  std::vector<double> approaches, forces;
  for (int n = 1; n <= 8; ++n) {
    const double time = 0.1 * 2.0 * radius * n / 8.0;  // up to 10 % of the diameter
    relax(pressed, {.force_tolerance = 1e-5 * stiffness * spacing, .time = time, .without_rotation = true});
    approaches.push_back(time);
    forces.push_back(load_on<Solid>(pressed, below, time).force[2]);
  }
  const HertzFit fit = fit_hertz(approaches, forces, radius, 0.25);  // E, with a free zero of the approach
  // end
  CHECK(std::fabs(fit.youngs_modulus / youngs_modulus - 1.0) <= 3.2 / 8.0);  // first order, from 0.80 at 16 spacings
  CHECK(-load_on<Solid>(pressed, above, approaches.back()).force[2] == doctest::Approx(forces.back()).epsilon(0.01));

  // doc: solid-stress
  const auto& now = pressed.group<Solid>().positions();
  const std::vector<Vector<3>> positions(now.begin(), now.end());
  const auto tension = tensions<3>(bond::Harmonic{.stiffness = stiffness}, body.bonds, positions);
  const auto stress = virial_stress<3>(body.bonds, tension, positions, body.points.volume);
  const double shear = largest_shear_stress<3>(stress[0]);  // of bead 0 [Pa]
  // end
  CHECK(shear > 0.0);
  Vector<3> mean = Vector<3>::Zero();  // over the ball: the plates' forces times their lever arms
  for (const auto& one : stress) mean += one.diagonal() * body.points.volume;
  CHECK(mean[2] == doctest::Approx(-forces.back() * (2.0 * highest - approaches.back())).epsilon(0.02).scale(0.0));
}

TEST_CASE("docs/bonded-solids.md: a bar of random network has the elastic constants asked for to 5 %") {
  using namespace bonded_solids_program;
  // doc: solid-network
  const geometry::Cuboid<3> bar{.lower = {0.0, 0.0, 0.0}, .upper = {12.0, 5.0, 5.0}};
  const auto points = random_points<3>({.least_distance = 0.46, .most_points = 2130, .seed = 1}, bar);
  Body<3> body = network(points, 0.885, StiffnessRule::uniform_tension);  // bonds between all closer than 0.885
  const Springs springs = springs_for(body, ElasticConstants<3>::from_young(1.0, 0.3));  // any -1 < nu < 1/2
  const BarElasticity found = measure_bar<3>(body, springs, {.outline = bar, .grip = 0.46, .solver = {.mechanisms = Mechanisms::leave}});
  std::printf("E = %.3f of what was asked for, nu = %.3f\n", found.youngs_modulus, found.poisson_ratio);
  // end
  CHECK(found.youngs_modulus == doctest::Approx(1.0).epsilon(0.05));
  CHECK(found.poisson_ratio == doctest::Approx(0.3).epsilon(0.05));

  // doc: solid-dispersive
  const bond::Dispersive any_ratio{.stiffness = springs.stiffness, .dispersive_share = springs.dispersive_share};
  auto free_bar = scene<integrator::Leapfrog>(
      geometry::Box<3>::unbounded(),
      group<Solid>("bar", particles::Mobile{}, body.points, 1.0),
      bonds<Solid, Solid>(any_ratio, body.bonds));
  // end
  for (Vector<3>& x : free_bar.group<Solid>().positions()) x *= 1.0 + 1e-4;  // E/(3 (1 - 2 nu)) = 0.83 resists that
  double work = 0.0;  // of the forces, were the bar to go back
  (void)free_bar.step_limit();
  for (std::size_t i = 0; i < free_bar.group<Solid>().size(); ++i)
    work -= 1e-4 * body.points.positions[i].dot(free_bar.group<Solid>().get<field::Acceleration>()[i]);
  CHECK(0.5 * work / (12.0 * 5.0 * 5.0) == doctest::Approx(0.5 * 9.0 * 1e-8 * 1.0 / (3.0 * (1.0 - 0.6))).epsilon(0.01));
}

TEST_CASE("docs/bonded-solids.md: viscoelastic bonds in time, and a slow creep of them without inertia") {
  using namespace bonded_solids_program;
  const double stiffness = 1.0, mass = 1.0;
  Body<3> body = lattice_block(CubicLattice{.spacing = 1.0}, {2, 2, 2}, SurfaceBonds::shared);
  measure_rest_lengths<3>(body.bonds, body.points.positions);

  // doc: solid-dynamics
  const bond::KelvinVoigt law{.stiffness = stiffness, .damping = 10.0};
  auto damped = scene<integrator::Leapfrog>(
      geometry::Box<3>::unbounded(),
      group<Solid>("block", particles::Mobile{}, body.points, mass),
      implicit_bonds<Solid, Solid>(law, body.bonds));  // or bonds<Solid, Solid>(law, ...), whose step the dashpots limit
  damped.group<Solid>().set<field::Velocity>([](const Vector<3>& x) { return Vector<3>(0.01 * x[0], 0.0, 0.0); });
  damped.run({.until = 100.0});
  // end
  double kinetic = 0.0;
  for (const Vector<3>& v : damped.group<Solid>().get<field::Velocity>()) kinetic += 0.5 * (v - Vector<3>(0.01, 0.0, 0.0)).squaredNorm();
  CHECK(kinetic < 1e-6);

  // doc: solid-slow
  const double dt = 0.5;  // [s]
  const forcing::Plane<3> floor{.normal = {{0.0, 0.0, 1.0}}, .position = 0.0, .strength = 1e4};
  const forcing::Constant<3> weight{.uniform_acceleration = {{{0.0, 0.0, -1e-4}}}};
  InertiaFreeStep<3> step(law, dt, body.bonds, body.points.positions);  // backward Euler
  auto points = body.points;
  for (int n = 0; n < 200; ++n) {
    auto at_rest = scene<integrator::Leapfrog>(
        geometry::Box<3>::unbounded(),
        group<Solid>("block", particles::Mobile{}, points, mass),
        bonds<Solid, Solid>(step.law(), step.bonds()),
        forced_by<Solid>(floor, weight));
    relax(at_rest, {.force_tolerance = 1e-8, .without_rotation = true});
    const auto& now = at_rest.group<Solid>().positions();
    points.positions.assign(now.begin(), now.end());
    step.advance(points.positions);
  }
  // end
  // Ten relaxation times later it is as short as an elastic one.
  auto elastic = scene<integrator::Leapfrog>(
      geometry::Box<3>::unbounded(), group<Solid>("block", particles::Mobile{}, body.points, mass),
      bonds<Solid, Solid>(bond::Harmonic{.stiffness = stiffness}, body.bonds), forced_by<Solid>(floor, weight));
  relax(elastic, {.force_tolerance = 1e-8, .without_rotation = true});
  const auto height = [](const auto& x) { return x.back()[2] - x.front()[2]; };
  CHECK(2.0 - height(elastic.group<Solid>().positions()) > 1e-4);
  CHECK(2.0 - height(points.positions) == doctest::Approx(2.0 - height(elastic.group<Solid>().positions())).epsilon(1e-3).scale(0.0));
}
