#pragma once
#include <cmath>
#include <limits>
#include <numbers>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::forcing {

/// Motion along a line that starts smoothly, goes on at constant speed, and holds; for planes, plates, prescribed ends.
///   velocity(t) = (V/2)(1 - cos(pi t/T)) for 0 <= t < T, V until `hold_from`, 0 from then on  [m/s];  displacement(t): its integral [m]
/// T = 0 is an abrupt start, which sends a wave through a body; the stop always is. T of five transits of sound makes a slow start.
struct Ramp {
  Required<double> speed;                                      ///< V [m/s], of either sign
  double start_up = 0.0;                                       ///< T [s], >= 0
  double hold_from = std::numeric_limits<double>::infinity();  ///< [s], >= T; infinite: never

  [[nodiscard]] friend bool operator==(const Ramp& a, const Ramp& b) noexcept {
    return a.speed == b.speed && a.start_up == b.start_up && a.hold_from == b.hold_from;
  }
  [[nodiscard]] double displacement(double time) const noexcept {
    const double t = std::fmax(0.0, std::fmin(time, hold_from));
    if (t < start_up) return 0.5 * speed * (t - start_up / std::numbers::pi * std::sin(std::numbers::pi * t / start_up));
    return speed * (t - 0.5 * start_up);
  }
  [[nodiscard]] double velocity(double time) const noexcept {
    if (time < 0.0 || time >= hold_from) return 0.0;
    return time < start_up ? 0.5 * speed * (1.0 - std::cos(std::numbers::pi * time / start_up)) : double{speed};
  }
};

inline void validate(const Ramp& motion) {
  require_finite("forcing::Ramp: speed", motion.speed, "m/s");
  require_not_negative("forcing::Ramp: start_up", motion.start_up, "s");
  require(motion.hold_from >= motion.start_up, "forcing::Ramp: hold_from must be >= start_up [s]", motion.hold_from);
}

}  // namespace dmp::forcing
