#pragma once
#include <string>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>

namespace dmp::geometry::detail {

template <int Dim>
[[nodiscard]] std::string to_text(const Vector<Dim>& position) {
  std::string text = "(";
  for (int d = 0; d < Dim; ++d) text += (d == 0 ? "" : ", ") + dmp::to_text(position[d]);
  return text + ")";
}

[[nodiscard]] inline std::string direction_name(int direction) { return std::string(1, "xyz"[direction]); }

/// Infinite bounds pass, NaN does not.
template <int Dim>
void require_ordered(const char* who, const Vector<Dim>& lower, const Vector<Dim>& upper) {
  for (int d = 0; d < Dim; ++d)
    if (!(upper[d] > lower[d]))
      throw ParameterError(std::string(who) + ": upper must be > lower in direction " + direction_name(d) + ", got lower " +
                           dmp::to_text(lower[d]) + " and upper " + dmp::to_text(upper[d]) + " m");
}

template <int Dim>
void require_finite(const char* what, const Vector<Dim>& vector, const char* unit) {
  for (int d = 0; d < Dim; ++d) dmp::require_finite(what, vector[d], unit);
}

/// A direction may have any length, but it must have one: finite, and not so small that its square vanishes.
template <int Dim>
void require_direction(const char* what, const Vector<Dim>& direction) {
  const double squared_length = direction.squaredNorm();
  if (!(squared_length > 0.0 && squared_length - squared_length == 0.0))
    throw ParameterError(std::string(what) + " must be a finite vector other than zero, got " + to_text<Dim>(direction));
}

}  // namespace dmp::geometry::detail
