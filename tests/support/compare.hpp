#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>
#include <dmp/core/pack.hpp>
#include <dmp/core/require.hpp>

namespace test {

/// |a - b| as a fraction of the larger; 0 if they are equal, infinite if one is NaN.
[[nodiscard]] inline double relative_error(double a, double b) {
  if (a == b) return 0.0;
  const double error = std::fabs(a - b) / std::max(std::fabs(a), std::fabs(b));
  return std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
}

/// Text of the Error that f() throws; empty if it throws none.
template <class Error = dmp::ParameterError>
[[nodiscard]] std::string complaint(const auto& f) {
  try {
    static_cast<void>(f());
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}
/// The same of validate(law).
template <class Law>
[[nodiscard]] std::string complaint_about(const Law& law) {
  return complaint([&law] { validate(law); });
}

/// Parameters are public, copies are copies of bytes: what lets a law live in a register and be set by name.
template <class Law>
inline constexpr bool is_plain = std::is_aggregate_v<Law>&& std::is_trivially_copyable_v<Law>;

/// Largest difference between f on SIMD packs and f on double, at the numbers x, as a fraction of the largest |f|. The x are rounded
/// to `Real` first, so that both see the same numbers.
template <class Real, int Width, class Function>
[[nodiscard]] double lane_error(const Function& f, const std::vector<double>& x) {
  double difference = 0.0, largest = 0.0;
  for (std::size_t first = 0; first + Width <= x.size(); first += Width) {
    dmp::Pack<Real, Width> pack = 0.0;
    for (int lane = 0; lane < Width; ++lane) pack.raw[lane] = static_cast<Real>(x[first + static_cast<std::size_t>(lane)]);
    const dmp::Pack<Real, Width> result = f(pack);
    for (int lane = 0; lane < Width; ++lane) {
      const double expected = f(static_cast<double>(pack[lane]));
      largest = std::max(largest, std::fabs(expected));
      const double error = std::fabs(static_cast<double>(result[lane]) - expected);
      difference = std::isnan(error) ? std::numeric_limits<double>::infinity() : std::max(difference, error);
    }
  }
  return difference == 0.0 ? 0.0 : difference / largest;
}

/// `count` numbers that fill [from, to] evenly, both ends among them.
[[nodiscard]] inline std::vector<double> evenly(double from, double to, int count) {
  std::vector<double> result;
  for (int n = 0; n < count; ++n) result.push_back(from + (to - from) * n / (count - 1));
  return result;
}

}  // namespace test
