#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>
#include <dmp/dmp.hpp>

/// A ball of beads and springs, and two rigid plates without friction that press it.
namespace example {

struct Beads {};

constexpr double ball_radius = 0.4e-3;  // R [m]
[[nodiscard]] inline dmp::geometry::Ball<3> ball(double radius = ball_radius) { return {.centre = {0.0, 0.0, 0.0}, .radius = radius}; }
[[nodiscard]] inline dmp::geometry::Cuboid<3> around_ball() {
  constexpr double far = 1.1 * ball_radius;
  return {.lower = {-far, -far, -far}, .upper = {far, far, far}};
}
/// The ball as a random network, nearly jammed, of about 17.5 bonds per bead.
[[nodiscard]] inline dmp::lattice_spring::Body<3> network_ball(std::size_t beads, std::uint64_t seed) {
  const double least_distance = ball_radius / 12.5 * std::cbrt(5921.0 / static_cast<double>(beads));
  const auto points =
      dmp::lattice_spring::random_points<3>({.least_distance = least_distance, .most_points = beads, .seed = seed}, around_ball(), ball(),
                                            4.0 / 3.0 * std::numbers::pi * ball_radius * ball_radius * ball_radius);
  return dmp::lattice_spring::network(points, 1.924 * least_distance);
}

constexpr double plate_strength = 1e10;  // S [N/m^2]

/// The plate below (side -1) or above (+1) a body. Both start where the body does and move at 0.5 m/s: at time t [s] they have approached
/// each other by t [m].
[[nodiscard]] inline dmp::forcing::Plane<3> plate(const std::vector<dmp::Vector<3>>& body, double side) {
  double outermost = -std::numeric_limits<double>::infinity();
  for (const auto& x : body) outermost = std::max(outermost, side * x[2]);
  return {.normal = {{0.0, 0.0, -side}}, .position = -outermost, .strength = plate_strength, .motion = {.speed = 0.5}};
}

/// One state of the body at rest between the plates.
struct Pressed {
  double approach;        // delta of the plates since first touch [m]
  double force;           // mean of both plates [N]
  double difference;      // of their forces, as a fraction
  double contact_radius;  // mean of both [m]
  double penetration;     // sqrt(force per bead/S), of one plate: by so much the beads approach less [m]; 0 of contact planes
  std::size_t touching;   // beads, both plates
  std::size_t halvings;   // of the step to this state, to keep layers from folding
  std::size_t folded;     // beads, in spite of that
};

struct PressOptions {
  double approach;         ///< [m] to be reached
  double largest_step;     ///< [m] of the plates between two states of rest: beyond about a bond length layers fold
  double force_tolerance;  ///< [N]
};

/// Presses a scene of Beads, this body, between its plates in equal steps, halved where layers would fold, from one state of rest to the
/// next; looked_at(pressed) after each.
template <class Scene, class Plate, class Look>
std::vector<Pressed> press(Scene& scene, const dmp::lattice_spring::Body<3>& body, const Plate& below, const Plate& above,
                           const PressOptions& options, std::uint64_t& evaluations, const Look& looked_at) {
  std::vector<Pressed> curve;
  const int steps = static_cast<int>(std::ceil(options.approach / options.largest_step - 1e-9));
  const double height = -below.position - above.position, step = options.approach / steps;
  auto& x = scene.template group<Beads>().positions();
  for (int n = 1; n <= steps; ++n) {
    const double approach = n * step;
    const auto report = dmp::simulation::relax_in_steps(
        scene,
        {.until = approach,
         .largest_step = step,
         .from = (n - 1) * step,
         .relax = {.force_tolerance = options.force_tolerance, .without_rotation = true}},
        [&] { return dmp::lattice_spring::folded_beads<3>(body.bonds, body.points.positions, x).size(); },
        [&](double from, double to) {
          for (auto& at : x) at[2] *= (height - to) / (height - from);
        });
    evaluations += report.evaluations;
    const auto low = dmp::simulation::load_on<Beads>(scene, below, approach),
               high = dmp::simulation::load_on<Beads>(scene, above, approach);
    const double force = 0.5 * (low.force[2] - high.force[2]);
    const std::size_t touching = low.particles + high.particles;
    constexpr bool is_penalty = requires { below.strength; };
    curve.push_back({.approach = approach,
                     .force = force,
                     .difference = (low.force[2] + high.force[2]) / force,
                     .contact_radius = 0.5 * (low.radius + high.radius),
                     .penetration = is_penalty ? std::sqrt(2.0 * force / (static_cast<double>(touching) * plate_strength)) : 0.0,
                     .touching = touching,
                     .halvings = report.halvings,
                     .folded = report.folded});
    looked_at(curve.back());
  }
  return curve;
}

}  // namespace example
