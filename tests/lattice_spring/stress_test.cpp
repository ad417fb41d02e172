// Stress of strained bodies: virial per bead (sheet 01, section 2), Hardy's probe (sheet 04, section 2), principal stresses.
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>
#include <doctest/doctest.h>
#include <Eigen/Geometry>
#include <dmp/bond.hpp>
#include <dmp/integrator.hpp>
#include <dmp/lattice_spring.hpp>
#include <dmp/simulation.hpp>
#include "support/compare.hpp"
#include "support/quadrature.hpp"

using namespace dmp::lattice_spring;
using dmp::Vector;
using dmp::geometry::Box, dmp::geometry::Cuboid;
using dmp::neighbours::Bond;
using test::relative_error;
using test::complaint;

namespace {

struct Beads {};

/// A body of springs of stiffness k after a uniform small strain, and what is stressed in it.
struct Strained {
  Body<3> body;
  std::vector<Vector<3>> x;
  std::vector<double> tension;

  Strained(Body<3> of, const Tensor<3>& gradient, double k) : body(std::move(of)), x(body.points.positions) {
    measure_rest_lengths<3>(body.bonds, x);
    for (auto& at : x) at = (at + gradient * at).eval();
    tension = tensions<3>(dmp::bond::Harmonic{.stiffness = k}, body.bonds, x);
  }
};

const Tensor<3> small =
    (Tensor<3>{} << 3e-7, 1e-7, -2e-7, 0.5e-7, -1e-7, 1.5e-7, 1e-7, 0.5e-7, 2e-7).finished();  // a displacement gradient

/// C : e for lambda = mu.
Tensor<3> isotropic(double mu, const Tensor<3>& gradient) {
  const Tensor<3> e = 0.5 * (gradient + gradient.transpose());
  return mu * e.trace() * Tensor<3>::Identity() + 2.0 * mu * e;
}

}  // namespace

TEST_CASE(
    "the virial stress of a uniformly strained cubic lattice is C : e in every bead inside, whatever its orientation, tension positive") {
  const double l = 0.2, k = 5.0;
  for (const Tensor<3>& turn :
       {Tensor<3>(Tensor<3>::Identity()), Eigen::Quaterniond(0.8, 0.3, -0.4, 0.1).normalized().toRotationMatrix()}) {
    const Strained s(lattice_block(CubicLattice{.spacing = l, .orientation = turn}, {5, 5, 5}, SurfaceBonds::shared), small, k);
    const auto stress = virial_stress<3>(s.body.bonds, s.tension, s.x, l * l * l);
    const Tensor<3> expected = isotropic(k / l, small);
    const auto count = bonds_per_bead(s.body);
    int inside = 0;
    Tensor<3> sum = Tensor<3>::Zero();
    for (std::size_t i = 0; i < stress.size(); ++i) {
      sum += stress[i] * (l * l * l);
      if (count[i] < 18) continue;
      ++inside;
      CHECK((stress[i] - expected).norm() < 1e-6 * expected.norm());
    }
    CHECK(inside == 64);
    CHECK((sum / s.body.volume - expected).norm() < 1e-6 * expected.norm());  // with shared bonds in the surface the whole body has it
  }
}

TEST_CASE("2D: the virial stress of triangular and square lattices under tension along x is E e there and nothing across") {
  const auto check = [](const auto& lattice, std::size_t neighbours) {
    auto body = lattice_block(lattice, {6, 6}, SurfaceBonds::shared);
    measure_rest_lengths<2>(body.bonds, body.points.positions);
    const auto constants = elastic_constants(lattice, 3.0);
    const double strain = 1e-7;
    auto x = body.points.positions;
    for (auto& at : x) at = Vector<2>(at[0] * (1.0 + strain), at[1] * (1.0 - constants.poisson_ratio * strain));
    const auto tension = tensions<2>(dmp::bond::Harmonic{.stiffness = 3.0}, body.bonds, x);
    const auto stress = virial_stress<2>(body.bonds, tension, x, lattice.basis().determinant());
    const auto count = bonds_per_bead(body);
    for (std::size_t i = 0; i < stress.size(); ++i) {
      if (count[i] < neighbours) continue;
      const double pull = constants.youngs_modulus * strain;
      CHECK(relative_error(stress[i](0, 0), pull) < 1e-6);
      CHECK(std::fabs(stress[i](1, 1)) + std::fabs(stress[i](0, 1)) < 1e-6 * pull);
      CHECK(largest_shear_stress<2>(stress[i]) == doctest::Approx(0.5 * pull).epsilon(1e-6).scale(0.0));
    }
  };
  check(TriangularLattice{.spacing = 0.3}, 6);
  check(SquareLattice{.spacing = 0.3}, 8);
}

TEST_CASE(
    "principal stresses are ordered, invariant under rotation, and half the difference of the outer two is the largest shear stress") {
  const Vector<3> s(7.0, 2.0, -4.0);
  const Tensor<3> turn = Eigen::Quaterniond(0.5, -0.1, 0.7, 0.2).normalized().toRotationMatrix();
  const Tensor<3> stress = turn * s.asDiagonal() * turn.transpose();
  CHECK((principal_stresses<3>(stress) - s).norm() < 1e-14);
  CHECK(largest_shear_stress<3>(stress) == doctest::Approx(5.5).epsilon(1e-14));
  double largest = 0.0;  // by looking at many planes: shear = |sigma n - (n sigma n) n|
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 20000; ++k) {
    const Vector<3> n = Vector<3>(normal(random), normal(random), normal(random)).normalized();
    const Vector<3> traction = stress * n;
    largest = std::max(largest, (traction - n.dot(traction) * n).norm());
  }
  CHECK(largest <= 5.5 + 1e-12);
  CHECK(largest > 5.49);
}

TEST_CASE("tensions: weights multiply, dashpots see the rate of length, periodic faces are crossed by the shortest way") {
  const std::vector<Bond> bonds{{0, 1, 1.0, 0.5}};
  const std::vector<Vector<3>> x{{0, 0, 0}, {0, 3, 0}}, v{{1, 2, 3}, {1, 4, -8}};
  CHECK(tensions<3>(dmp::bond::Harmonic{.stiffness = 10.0}, bonds, x)[0] == 10.0);
  CHECK(tensions<3>(dmp::bond::KelvinVoigt{.stiffness = 10.0, .damping = 3.0}, bonds, x, v)[0] == 0.5 * (20.0 + 3.0 * 2.0));
  const Box<3> box{.lower = {0, 0, 0}, .upper = {4, 4, 4}, .periodic = {true, true, true}};
  CHECK(tensions<3>(dmp::bond::Harmonic{.stiffness = 10.0}, std::vector<Bond>{{0, 1, 0.5}}, x, {}, box)[0] == 5.0);
  std::vector<Bond> open{{0, 1}};
  measure_rest_lengths<3>(open, x, box);
  CHECK(open[0].rest_length == 1.0);

  CHECK(complaint([&] { return tensions<3>(dmp::bond::KelvinVoigt{.stiffness = 1.0, .damping = 1.0}, bonds, x); }) ==
        "lattice_spring::tensions: velocities, which this law needs, must number 2, got 0");
  CHECK(complaint([&] { return tensions<3>(dmp::bond::Harmonic{.stiffness = 1.0}, std::vector<Bond>{{0, 1}}, x); }) ==
        "lattice_spring::tensions: rest_length must be known (measure_rest_lengths before the run), got -1 m of bond (0, 1)");
  const std::vector<double> none;
  CHECK(complaint([&] { return virial_stress<3>(bonds, none, x, 1.0); }) == "lattice_spring::virial_stress: tensions must number 1, got 0");
  CHECK(complaint([&] { return virial_stress<3>(bonds, std::vector{1.0}, x, 0.0); }) ==
        "lattice_spring::virial_stress: volume_per_bead must be finite and > 0 m^Dim, got 0");
}

TEST_CASE("the motion's part of the stress is -m v v/V of what differs from the velocity around; a body that moves as a whole has none") {
  const auto block = lattice_block(CubicLattice{.spacing = 1.0}, {2, 2, 2});
  std::vector<Vector<3>> v(27, Vector<3>(3.0, -1.0, 2.0));
  for (const auto& stress : kinetic_stress<3>(block.bonds, v, 2.0, 0.5)) CHECK(stress.norm() < 1e-28);
  v[13] += Vector<3>(0.0, 1.9, 0.0);  // the middle one, with 18 neighbours: 1.8 against their mean
  const Tensor<3> stress = kinetic_stress<3>(block.bonds, v, 2.0, 0.5)[13];
  CHECK(stress(1, 1) == doctest::Approx(-4.0 * 1.8 * 1.8).epsilon(1e-13));
  CHECK((stress - stress(1, 1) * Vector<3>::UnitY() * Vector<3>::UnitY().transpose()).norm() < 1e-13);
}

TEST_CASE("the virial stress of a scene's beads after some steps is that of its positions") {
  Body<3> body = lattice_block(CubicLattice{.spacing = 1.0}, {3, 3, 3});
  measure_rest_lengths<3>(body.bonds, body.points.positions);
  for (auto& bond : body.bonds) bond.rest_length *= 1.01;  // compressed by 1 %
  const dmp::bond::Harmonic law{.stiffness = 1.0};
  auto scene = dmp::simulation::scene<dmp::integrator::Leapfrog>(
      Box<3>::unbounded(), dmp::simulation::group<Beads>("beads", dmp::particles::Mobile{}, body.points, 1.0),
      dmp::simulation::bonds<Beads, Beads>(law, body.bonds));
  const auto pressure = [&] {
    const auto x = scene.group<Beads>().positions();
    const auto stress = virial_stress<3>(body.bonds, tensions<3>(law, body.bonds, x), x, 1.0);
    Tensor<3> sum = Tensor<3>::Zero();
    for (const auto& one : stress) sum += one;
    return -sum.trace() / 3.0;
  };
  const double before = pressure();
  CHECK(before > 0.0);
  scene.run({.until = 2.0, .time_step = 0.05});
  CHECK(pressure() < 0.5 * before);  // it has expanded
}

TEST_CASE("Hardy: the overlap of two balls is the integral of their common discs, and has its limits") {
  const double pi = std::numbers::pi;
  for (const auto& balls :
       {std::array{1.0, 0.5, 0.8}, {0.5, 1.0, 0.8}, {1.0, 1.0, 1.5}, {1.0, 0.34, 1.3}, {1.02, 0.3, 0.75}, {1.0, 1.0, 0.2}}) {
    const double R = balls[0], r = balls[1], d = balls[2];
    const double joint = (d * d + R * R - r * r) / (2.0 * d);  // the plane of the common circle, from the centre of the first
    const double expected = test::integral([&](double x) { return pi * (r * r - (x - d) * (x - d)); }, d - r, joint) +
                            test::integral([&](double x) { return pi * (R * R - x * x); }, joint, R);
    CHECK(relative_error(ball_overlap(R, r, d), expected) < 1e-12);
    CHECK(ball_overlap(R, r, d) == doctest::Approx(ball_overlap(r, R, d)).epsilon(1e-14));
  }
  CHECK(ball_overlap(1.0, 0.5, 1.5) == 0.0);
  CHECK(ball_overlap(1.0, 0.5, 2.0) == 0.0);
  CHECK(ball_overlap(1.0, 0.5, 0.5) == doctest::Approx(pi / 6.0).epsilon(1e-14));
  CHECK(ball_overlap(0.5, 1.0, 0.0) == doctest::Approx(pi / 6.0).epsilon(1e-14));
  CHECK(ball_overlap(1.0, 0.5, 0.5 + 1e-9) == doctest::Approx(pi / 6.0).epsilon(1e-8));
  CHECK(ball_overlap(1.0, 0.5, 1.5 - 1e-6) < 1e-11);

  std::mt19937_64 random(3);  // Monte Carlo in the cube around the smaller ball
  std::uniform_real_distribution<double> side(-0.6, 0.6);
  int hits = 0;
  const int trials = 400000;
  for (int k = 0; k < trials; ++k) {
    const Vector<3> x(side(random), side(random), side(random));
    hits += x.norm() < 0.6 && (x - Vector<3>(0.7, 0, 0)).norm() < 0.9 ? 1 : 0;
  }
  CHECK(relative_error(ball_overlap(0.9, 0.6, 0.7), 1.728 * hits / trials) < 0.01);
}

TEST_CASE("Hardy: a probe around the whole body has its mean virial stress, one far away none") {
  const auto points = random_points<3>({.least_distance = 0.46, .most_points = 200}, {.lower = {0, 0, 0}, .upper = {3, 3, 3}});
  const Strained s(network(points, 0.885), 1e5 * small, 2.0);
  const HardyStress probe(s.body.bonds, s.tension, s.x);
  const double radius = 4.0, volume = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  Tensor<3> sum = Tensor<3>::Zero();
  for (const auto& stress : virial_stress<3>(s.body.bonds, s.tension, s.x, 1.0)) sum += stress;
  CHECK((probe.at({1.5, 1.5, 1.5}, radius) * volume - sum).norm() < 1e-12 * sum.norm());
  CHECK(probe.at({30, 0, 0}).norm() == 0.0);
}

TEST_CASE("Hardy: in a strained lattice the mean over probes in one cell is C : e; each of the usual radius is within a few per cent") {
  const double l = 0.5, k = 3.0;
  const Strained s(lattice_block(CubicLattice{.spacing = l}, {10, 10, 10}), small, k);
  const HardyStress probe(s.body.bonds, s.tension, s.x);
  CHECK(probe.mean_length() > l);
  const Tensor<3> expected = isotropic(k / l, small);
  Tensor<3> mean = Tensor<3>::Zero();
  const int n = 6;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b)
      for (int c = 0; c < n; ++c) {
        const Vector<3> x = Vector<3>::Constant(5 * l) + l / n * Vector<3>(a + 0.5, b + 0.5, c + 0.5);
        const Tensor<3> stress = probe.at(x);
        CHECK((stress - expected).norm() < 0.06 * expected.norm());
        mean += stress / (n * n * n);
      }
  CHECK((mean - expected).norm() < 1e-4 * expected.norm());
}

TEST_CASE("Hardy: what cannot be probed is told") {
  const std::vector<Vector<3>> x{{0, 0, 0}, {0, 0, 0}};
  const std::vector<Bond> bonds{{0, 1}};
  CHECK(complaint([&] { return HardyStress(bonds, std::vector{1.0}, x); }) ==
        "lattice_spring::HardyStress: bonds must number 1 or more with a length > 0 m, got none");
  CHECK(complaint([&] { return HardyStress(bonds, std::vector<double>{}, x); }) ==
        "lattice_spring::HardyStress: tensions must number 1, got 0");
  CHECK(complaint([] { return ball_overlap(-1.0, 1.0, 1.0); }) == "lattice_spring::ball_overlap: radius must be finite and >= 0 m, got -1");
}
