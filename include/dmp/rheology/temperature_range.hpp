#pragma once
#include <limits>
#include <string>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::rheology {

/// The temperatures that a fit mu(T) was made for, both ends among them. Every law of the temperature asks for it, because a fit that
/// is extrapolated soon gives 0, infinity or the wrong sign.
struct TemperatureRange {
  Required<double> lowest;   ///< [K], > 0
  Required<double> highest;  ///< [K], > lowest

  [[nodiscard]] bool contains(double temperature) const noexcept { return temperature >= lowest && temperature <= highest; }
  template <class T>
  [[nodiscard]] T nearest(const T& temperature) const noexcept {
    const double low = lowest, high = highest;
    return min(max(temperature, low), high);
  }
};

/// What the law called `type` demands of the temperature, for a message.
[[nodiscard]] inline std::string demand_of(const std::string& type, const TemperatureRange& range) {
  return type + ": temperature must be in [" + to_text(range.lowest) + ", " + to_text(range.highest) + "] K";
}

/// Throws ParameterError unless the `temperature_range` of a law is one, and mu is finite and > 0 at both of its ends.
template <class Law>
void require_viscosity_over_range(const std::string& type, const Law& law) {
  const double low = law.temperature_range.lowest, high = law.temperature_range.highest;
  require_positive((type + ": temperature_range.lowest").c_str(), low, "K");
  require(high > low && high <= std::numeric_limits<double>::max(),
          (type + ": temperature_range.highest must be finite and > temperature_range.lowest = " + to_text(low) + " K").c_str(), high);
  for (const double temperature : {low, high})
    require_positive((type + ": viscosity at " + to_text(temperature) + " K, an end of temperature_range,").c_str(),
                     law.viscosity(temperature), "Pa s");
}

}  // namespace dmp::rheology
