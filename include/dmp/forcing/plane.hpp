#pragma once
#include <cmath>
#include <dmp/core/components.hpp>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>
#include <dmp/forcing/ramp.hpp>

namespace dmp::forcing {

/// Rigid plane that pushes back what is behind it, without friction.
///   force S d^2 n  [N],  d = max(0, position + displacement(t) - n . r) [m], how far behind
/// n points to where particles may be. S is a penalty: a particle that bears a force f lies sqrt(f/S) behind the plane, and feels the
/// stiffness 2 S d, which bounds the time step while it does.
/// M. Sahputra, A. Alexiadis, M. J. Adams, ChemEngineering 4 (2020) 30, doi:10.3390/chemengineering4020030 (S = 1e10 N/m^2 there).
template <int Dim>
struct Plane {
  static constexpr int dimension = Dim;
  Required<Components<Dim, double>> normal;  ///< n [-], of length 1
  Required<double> position;                 ///< n . r of the plane before it moves [m]
  Required<double> strength;                 ///< S [N/m^2], > 0
  Ramp motion = {.speed = 0.0};              ///< along n: towards the particles if > 0

  [[nodiscard]] double penetration(const auto& subject) const noexcept {  // [m]
    return max(0.0, position + motion.displacement(subject.time) - dot(normal.value, subject.position));
  }
  [[nodiscard]] Components<Dim, double> acceleration(const auto& subject) const noexcept {
    return (strength * square(penetration(subject)) / subject.mass) * normal.value;
  }
  [[nodiscard]] double stiffness(const auto& subject) const noexcept { return 2.0 * strength * penetration(subject); }
};

template <int Dim>
void validate(const Plane<Dim>& plane) {
  const double squared = dot(plane.normal.value, plane.normal.value);
  require(std::fabs(squared - 1.0) <= 1e-12, "forcing::Plane: normal must have length 1, its square", squared);
  require_finite("forcing::Plane: position", plane.position, "m");
  require_positive("forcing::Plane: strength", plane.strength, "N/m^2");
  check_parameters(plane.motion);
}

}  // namespace dmp::forcing
