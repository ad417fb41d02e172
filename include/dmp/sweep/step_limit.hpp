#pragma once
#include <cmath>
#include <limits>
#include <string>
#include <dmp/core/require.hpp>

namespace dmp::sweep {

/// What a law needs to state its own stability bound: extremes over the particles it acts on, and what the integrator can stand.
struct StepState {
  double speed = 0.0;                                     ///< largest |v| [m/s]
  double acceleration = 0.0;                              ///< largest |a| [m/s^2]
  double sound_speed = 0.0;                               ///< largest c [m/s]
  double kinematic_viscosity = 0.0;                       ///< largest mu/rho [m^2/s]
  double thermal_conductivity = 0.0;                      ///< largest kappa [W/(m K)]
  double heat_capacity = std::numeric_limits<double>::infinity();  ///< smallest rho c [J/(m^3 K)]; infinite where nothing evolves
  double mass = std::numeric_limits<double>::infinity();  ///< smallest particle mass [kg]; infinite where nothing moves
  double oscillation_limit = 2.0;                         ///< stable for omega dt < this
  double damping_limit = 1.0;                             ///< stable for lambda dt < this (velocities)
  double state_damping_limit = 1.0;                       ///< stable for lambda dt < this (density and other states)
};

/// The smallest bound found so far, and the law that set it.
struct StepLimit {
  double time_step = std::numeric_limits<double>::infinity();  ///< [s], stability and resolution
  std::string bound_by = "nothing";
  double stable_time_step = std::numeric_limits<double>::infinity();  ///< [s], stability alone: a larger step is refused
  std::string stability_bound_by = "nothing";
  double damping = 0.0;      ///< lambda [1/s], at which laws damp velocities, all together
  double oscillation = 0.0;  ///< omega^2 [1/s^2], with which laws make positions oscillate, all together
  double sound = 0.0;        ///< 1/the bound of sound [1/s]

  /// Beyond `bound` the law is unstable. ParameterError if that is no bound: not a number, or negative.
  void require_below(double bound, const std::string& law) {
    resolve(bound, law);
    if (bound < stable_time_step) {
      stable_time_step = bound;
      stability_bound_by = law;
    }
  }
  /// A law that damps velocities at `rate` [1/s]: stable for rate dt < `most`, less what others damp.
  void damp(double rate, double most, const std::string& law) {
    require_rate(rate, "1/s", law);
    damping += rate;
    if (rate > 0.0) require_below(most / rate, law);
  }
  /// A law that makes positions oscillate with omega^2 = `rate` [1/s^2]: stable for omega dt < `most`, less what others add.
  void oscillate(double rate, double most, const std::string& law) {
    require_rate(rate, "1/s^2", law);
    oscillation += rate;
    if (rate > 0.0) require_below(most / std::sqrt(rate), law);
  }
  /// Beyond `bound` the law is badly resolved, though not unstable: steps chosen by the scene respect it, a user's own may exceed it.
  void resolve(double bound, const std::string& law) {
    if (!(bound >= 0.0)) throw ParameterError("bound of the time step by " + law + " must be >= 0 s, got " + to_text(bound));
    if (bound < time_step) {
      time_step = bound;
      bound_by = law;
    }
  }
  /// The smaller of these and the other's bounds, whatever made them.
  void include(const StepLimit& other) {
    resolve(other.time_step, other.bound_by);
    require_below(other.stable_time_step, other.stability_bound_by);
  }

 private:
  static void require_rate(double rate, const char* unit, const std::string& law) {
    if (!(rate >= 0.0))
      throw ParameterError("rate by which " + law + " bounds the time step must be >= 0 " + unit + ", got " + to_text(rate));
  }
};

}  // namespace dmp::sweep
