#include "potential/laws.hpp"
#include <dmp/potential/lennard_jones.hpp>

namespace potential = dmp::potential;

namespace {
constexpr double sigma = 0.34, depth = 1.7;  // [m], [J]
const potential::LennardJones law{.energy_scale = depth, .diameter = sigma, .cutoff = 2.5 * sigma};
const double bottom = sigma * std::pow(2.0, 1.0 / 6.0);
}  // namespace

TEST_CASE("Lennard-Jones obeys the laws of pair potentials, whole and cut to its repulsion") {
  static_assert(sizeof(potential::LennardJones) == 3 * sizeof(double));
  check_pair_potential_laws(law, sigma);
  check_pair_potential_laws(potential::LennardJones{.energy_scale = 1e12, .diameter = sigma, .cutoff = bottom}, sigma);
  check_pair_potential_laws(potential::LennardJones{.energy_scale = 1e-3, .diameter = 1e-6, .cutoff = 3e-6}, 1e-6);
}

TEST_CASE("Lennard-Jones is deepest at 2^(1/6) sigma, where it is -eps and holds its breath") {
  CHECK(test::relative_error(law.energy(bottom * bottom), -depth) < 1e-14);
  CHECK(std::fabs(law.force_factor(bottom * bottom)) * sigma * sigma < 1e-13 * depth);
  CHECK(law.force_factor(0.99 * bottom * bottom) > 0.0);  // closer: repels
  CHECK(law.force_factor(1.01 * bottom * bottom) < 0.0);  // farther: attracts
}

TEST_CASE("Lennard-Jones is 0 at sigma, pushes there with 24 eps/sigma, and attracts hardest at (26/7)^(1/6) sigma") {
  CHECK(std::fabs(law.energy(sigma * sigma)) < 1e-14 * depth);
  CHECK(test::relative_error(law.force_factor(sigma * sigma) * sigma, 24.0 * depth / sigma) < 1e-13);
  const auto force = [](const auto& r) { return law.force_factor(r * r) * r; };
  CHECK(std::fabs(test::slope(force, sigma * std::pow(26.0 / 7.0, 1.0 / 6.0))) < 1e-12 * depth / (sigma * sigma));
}

TEST_CASE("Lennard-Jones oscillates about its bottom with the stiffness 72 eps/(2^(1/3) sigma^2), and is stiffest at contact") {
  const auto force = [](const auto& r) { return law.force_factor(r * r) * r; };
  CHECK(test::relative_error(-test::slope(force, bottom), 72.0 / std::cbrt(2.0) * depth / (sigma * sigma)) < 1e-12);
  CHECK(test::relative_error(-test::slope(force, sigma), law.largest_stiffness()) < 1e-12);
}

TEST_CASE("Lennard-Jones cut at 2^(1/6) sigma only repels") {
  const potential::LennardJones soft{.energy_scale = depth, .diameter = sigma, .cutoff = bottom};
  for (const double r : test::evenly(0.5 * sigma, 3.0 * sigma, 100)) CHECK(soft.force_factor(r * r) >= 0.0);
}

TEST_CASE("Lennard-Jones refuses parameters that are no particle") {
  using LJ = potential::LennardJones;
  CHECK(test::complaint_about(LJ{.energy_scale = -1.0, .diameter = 1.0, .cutoff = 1.0}) ==
        "potential::LennardJones: energy_scale must be finite and >= 0 J, got -1");
  CHECK(test::complaint_about(LJ{.energy_scale = 1.0, .diameter = 0.0, .cutoff = 1.0}) ==
        "potential::LennardJones: diameter must be finite and > 0 m, got 0");
  CHECK(test::complaint_about(LJ{.energy_scale = 1.0, .diameter = 1.0, .cutoff = NAN}) ==
        "potential::LennardJones: cutoff must be finite and > 0 m, got nan");
}
