#pragma once
#include <concepts>
#include <dmp/core/components.hpp>

namespace dmp::forcing {

/// What a forcing sees of a particle.
template <int Dim>
struct Subject {
  Components<Dim, double> position;  ///< [m]
  Components<Dim, double> velocity;  ///< [m/s], the one that the integrator shows to laws
  double mass;                       ///< [kg]
  double time;                       ///< [s], at the end of the step
};

/// Contract of a forcing: an acceleration of place, velocity and time.
///   acceleration(subject)  [m/s^2], Components<Dim, double>
///   damping_rate(mass)     [1/s], only if it damps velocities: bounds the time step
///   stiffness(subject)     [N/m], only if its force changes over short distances: how much force it opposes to a displacement, per metre,
///                          where the particle is now; bounds the time step
template <class F, int Dim>
concept Forcing = requires(const F law, const Subject<Dim> subject) {
  { law.acceleration(subject) } -> std::same_as<Components<Dim, double>>;
};

template <class F, int Dim>
consteval bool explain_forcing() {
  static_assert(
      requires(const F law, const Subject<Dim> s) {
        { law.acceleration(s) } -> std::same_as<Components<Dim, double>>;
      },
      "dmp: not a Forcing: no `Components<Dim, double> acceleration(const Subject& subject) const` [m/s^2] for the dimension of this "
      "scene");
  return Forcing<F, Dim>;
}

}  // namespace dmp::forcing
