#pragma once
#include <cmath>
#include <dmp/core/components.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::forcing {

/// A steady drive with an oscillation on top, the same everywhere: pulsating flow, a shaken box.
///   a(t) = mean + amplitude sin(w t + phase)  [m/s^2]
/// J. R. Womersley, J. Physiol. 127 (1955) 553-563, doi:10.1113/jphysiol.1955.sp005276, solves the pipe flow that it drives.
template <int Dim>
struct Sinusoidal {
  Required<Components<Dim, double>> mean;       ///< [m/s^2]
  Required<Components<Dim, double>> amplitude;  ///< [m/s^2]
  Required<double> angular_frequency;           ///< w [rad/s], > 0; 2 pi/period
  double phase = 0.0;                           ///< [rad]

  [[nodiscard]] Components<Dim, double> acceleration(const auto& subject) const noexcept {
    return mean.value + std::sin(angular_frequency * subject.time + phase) * amplitude.value;
  }
};

template <int Dim>
void validate(const Sinusoidal<Dim>& law) {
  for (const double a : law.mean.value.component) require_finite("forcing::Sinusoidal: mean", a, "m/s^2");
  for (const double a : law.amplitude.value.component) require_finite("forcing::Sinusoidal: amplitude", a, "m/s^2");
  require_positive("forcing::Sinusoidal: angular_frequency", law.angular_frequency, "rad/s");
  require_finite("forcing::Sinusoidal: phase", law.phase, "rad");
}

}  // namespace dmp::forcing
