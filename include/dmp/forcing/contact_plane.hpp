#pragma once
#include <cmath>
#include <dmp/core/components.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>
#include <dmp/forcing/ramp.hpp>

namespace dmp::forcing {

/// Rigid plane without friction that no particle gets behind: n . r >= position + displacement(t), and the plane pushes, never pulls.
/// Particles touch it one by one, without a length or a stiffness of contact, so it bounds no time step. It is no acceleration of place:
/// give it to confined_by, which says how the force is found.
template <int Dim>
struct ContactPlane {
  static constexpr int dimension = Dim;
  Required<Components<Dim, double>> normal;  ///< n [-], of length 1, to where particles may be
  Required<double> position;                 ///< n . r of the plane before it moves [m]
  Ramp motion = {.speed = 0.0};              ///< along n: towards the particles if > 0

  /// How far behind the plane a place is [m]; < 0 in front of it.
  [[nodiscard]] double behind(const Components<Dim, double>& place, double time) const noexcept {
    return position + motion.displacement(time) - dot(normal.value, place);
  }
  /// Whether a place is on the plane or behind it, to rounding.
  [[nodiscard]] bool touches(const Components<Dim, double>& place, double time) const noexcept {
    return behind(place, time) >= -rounding(place);
  }
  /// What rounding may make of `behind` [m].
  [[nodiscard]] double rounding(const Components<Dim, double>& place) const noexcept {
    return 1e-12 * (std::fabs(position) + std::sqrt(dot(place, place)));
  }
};

template <int Dim>
void validate(const ContactPlane<Dim>& plane) {
  const double squared = dot(plane.normal.value, plane.normal.value);
  require(std::fabs(squared - 1.0) <= 1e-12, "forcing::ContactPlane: normal must have length 1, its square", squared);
  require_finite("forcing::ContactPlane: position", plane.position, "m");
  check_parameters(plane.motion);
}

}  // namespace dmp::forcing
