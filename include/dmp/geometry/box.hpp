#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/detail/checks.hpp>
#include <dmp/geometry/required_vector.hpp>

namespace dmp::geometry {

/// The domain of a scene: lower <= position < upper [m] in each direction, which may be periodic.
///   const Box<2> channel{.lower = {0.0, 0.0}, .upper = {4.0, 1.0}, .periodic = {true, false}};
template <int Dim>
struct Box {
  static constexpr int dimension = Dim;
  RequiredVector<Dim> lower;         ///< [m], finite, or -infinity where not periodic
  RequiredVector<Dim> upper;         ///< [m], > lower, finite, or +infinity where not periodic
  std::array<bool, Dim> periodic{};  ///< per direction; none by default

  /// All of space.
  [[nodiscard]] static Box unbounded() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {.lower = Vector<Dim>::Constant(-infinity), .upper = Vector<Dim>::Constant(infinity)};
  }

  /// upper - lower [m]; +infinity where the box is not bounded.
  [[nodiscard]] Vector<Dim> extent() const { return upper - lower; }

  [[nodiscard]] bool contains(const Vector<Dim>& position) const noexcept {
    for (int d = 0; d < Dim; ++d)
      if (!(position[d] >= lower[d] && position[d] < upper[d])) return false;
    return true;
  }

  /// The image of `position` that lies in the box, as far as the periodic directions go; the other components stay as they are.
  /// A component that lies in the box already keeps every bit.
  [[nodiscard]] Vector<Dim> wrap(Vector<Dim> position) const noexcept {
    for (int d = 0; d < Dim; ++d) {
      double& x = position[d];
      if (!periodic[static_cast<std::size_t>(d)] || (x >= lower[d] && x < upper[d])) continue;
      const double length = upper[d] - lower[d];
      x -= length * std::floor((x - lower[d]) / length);
      if (x < lower[d] || x >= upper[d]) x = lower[d];  // the exact image lies less than one rounding from this face
    }
    return position;
  }
};

template <int Dim>
void validate(const Box<Dim>& box) {
  detail::require_ordered<Dim>("geometry::Box", box.lower, box.upper);
  for (int d = 0; d < Dim; ++d) {
    const double length = box.upper[d] - box.lower[d];
    if (box.periodic[static_cast<std::size_t>(d)] && !(length <= std::numeric_limits<double>::max()))
      throw ParameterError("geometry::Box: a periodic direction must be finite, got lower " + to_text(box.lower[d]) + " and upper " +
                           to_text(box.upper[d]) + " m in direction " + detail::direction_name(d));
  }
}

}  // namespace dmp::geometry
