#pragma once
#include <cmath>
#include <dmp/core/components.hpp>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::forcing {

/// Pulse of a heart: a short push and a weak backward pull, the same everywhere.
///   a(t) = G0 sin^n(w t) cos(w t - phi)  [m/s^2]
/// For odd n one beat lasts pi/w, not 2 pi/w: w = pi f for f beats per second (the source prints w = 2 pi f, a misprint), and the mean
/// is G0 sin(phi) n!!/(n+1)!!. For even n every second beat is reversed and the mean is 0.
/// A. M. Mohammed, M. Ariane, A. Alexiadis, ChemEngineering 4 (2020) 48, doi:10.3390/chemengineering4030048.
template <int Dim>
struct Pulsed {
  Required<Components<Dim, double>> amplitude;  ///< G0 [m/s^2], along the push
  Required<double> angular_frequency;           ///< w [rad/s], > 0
  int exponent = 13;                            ///< n [-], 1 to 1000: the larger, the shorter the push; 13 in the source
  double phase = 0.31415926535897932;           ///< phi [rad], sets the backward pull; pi/10 in the source

  [[nodiscard]] Components<Dim, double> acceleration(const auto& subject) const noexcept {
    const double angle = angular_frequency * subject.time;
    return (power(std::sin(angle), exponent) * std::cos(angle - phase)) * amplitude.value;
  }
};

template <int Dim>
void validate(const Pulsed<Dim>& law) {
  for (const double a : law.amplitude.value.component) require_finite("forcing::Pulsed: amplitude", a, "m/s^2");
  require_positive("forcing::Pulsed: angular_frequency", law.angular_frequency, "rad/s");
  require(law.exponent >= 1 && law.exponent <= 1000, "forcing::Pulsed: exponent must be 1 to 1000", law.exponent);
  require_finite("forcing::Pulsed: phase", law.phase, "rad");
}

}  // namespace dmp::forcing
