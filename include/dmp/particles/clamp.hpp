#pragma once
#include <cmath>
#include <dmp/core/components.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/forcing/ramp.hpp>

namespace dmp::particles {

/// Motion of a clamp: the particles of a driven group go along a line together, and hold what is bonded to them.
///   group<Grip>("grip", Driven{particles::Clamp<3>{.direction = {{1, 0, 0}}, .motion = {.speed = 0.1, .start_up = 1e-3}}}, points, mass)
/// The force that it takes: simulation::bond_load<Grip>(scene).
template <int Dim>
struct Clamp {
  Required<Components<Dim, double>> direction;  ///< [-], of length 1
  forcing::Ramp motion = {.speed = 0.0};                 ///< along it; at rest unless given

  [[nodiscard]] Vector<Dim> position(const Vector<Dim>& start, double time) const {
    return start + motion.displacement(time) * to_vector<Dim>(direction.value);
  }
  [[nodiscard]] Vector<Dim> velocity(const Vector<Dim>&, double time) const {
    return motion.velocity(time) * to_vector<Dim>(direction.value);
  }
};

template <int Dim>
void validate(const Clamp<Dim>& clamp) {
  const double squared = dot(clamp.direction.value, clamp.direction.value);
  require(std::fabs(squared - 1.0) <= 1e-12, "particles::Clamp: direction must have length 1, its square", squared);
  check_parameters(clamp.motion);
}

}  // namespace dmp::particles
