#pragma once
#include <charconv>
#include <limits>
#include <stdexcept>
#include <string>

namespace dmp {

/// Bad input, found before anything is computed. The text names the parameter, the value and what is allowed.
struct ParameterError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Shortest text that reads back as the same number: "0.1", "-16", "nan".
[[nodiscard]] inline std::string to_text(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

/// Throws ParameterError "<rule>, got <value>" unless `holds`.
///   require(law.stiffness >= 0.0, "bond::Harmonic: stiffness must be >= 0 N/m", law.stiffness);
inline void require(bool holds, const char* rule, double value) {
  if (!holds) throw ParameterError(std::string(rule) + ", got " + to_text(value));
}

/// The commonest rules. `what` is "<type>: <parameter>", `unit` the unit of the value. NaN and infinity never pass.
inline void require_positive(const char* what, double value, const char* unit) {
  if (!(value > 0.0 && value <= std::numeric_limits<double>::max()))
    throw ParameterError(std::string(what) + " must be finite and > 0 " + unit + ", got " + to_text(value));
}
inline void require_not_negative(const char* what, double value, const char* unit) {
  if (!(value >= 0.0 && value <= std::numeric_limits<double>::max()))
    throw ParameterError(std::string(what) + " must be finite and >= 0 " + unit + ", got " + to_text(value));
}
inline void require_finite(const char* what, double value, const char* unit) {
  if (!(value - value == 0.0)) throw ParameterError(std::string(what) + " must be finite [" + unit + "], got " + to_text(value));
}

/// Checks the parameters of a law by the `void validate(const Law&)` beside it, which throws ParameterError. Every law of the library
/// has one; a user's law may do without.
template <class Law>
void check_parameters(const Law& law) {
  if constexpr (requires { validate(law); }) validate(law);
}

}  // namespace dmp
