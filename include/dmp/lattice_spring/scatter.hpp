#pragma once
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/lattice_spring/detail/checks.hpp>

/// How values along a line scatter: M. Kot's Delta, Delta_t and Delta_r. ChemEngineering 5 (2021) 3, doi:10.3390/chemengineering5010003.
namespace dmp::lattice_spring {

namespace detail {
inline void require_values(const char* who, std::span<const double> values) {
  if (values.empty()) throw ParameterError(std::string(who) + ": values must number 1 or more, got none");
}
}  // namespace detail

[[nodiscard]] inline double mean_of(std::span<const double> values) {
  detail::require_values("lattice_spring::mean_of", values);
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}
/// Delta_t: root mean square difference from one number, the theory's.
[[nodiscard]] inline double scatter_about(std::span<const double> values, double expected) {
  detail::require_values("lattice_spring::scatter_about", values);
  double sum = 0.0;
  for (const double value : values) sum += square(value - expected);
  return std::sqrt(sum / static_cast<double>(values.size()));
}
/// Delta: root mean square difference from their own mean.
[[nodiscard]] inline double scatter(std::span<const double> values) { return scatter_about(values, mean_of(values)); }
/// Delta_r: root mean square difference of two states, relaxed and scaled, say.
[[nodiscard]] inline double difference(std::span<const double> a, std::span<const double> b) {
  detail::require_values("lattice_spring::difference", a);
  detail::require_same_size("lattice_spring::difference", "values", b.size(), a.size());
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += square(a[k] - b[k]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace dmp::lattice_spring
