#pragma once
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/detail/checks.hpp>
#include <dmp/geometry/required_vector.hpp>

namespace dmp::geometry {

/// A shape (geometry/shape.hpp): a straight circular cylinder in 3D, the disc around `base_centre` drawn out by `length` along `axis`.
/// Closed on its mantle and base, open at its far end, so that cylinders laid end to end tile a pipe. In 2D take a Ball.
struct Cylinder {
  static constexpr int dimension = 3;
  RequiredVector<3> base_centre;  ///< [m]
  RequiredVector<3> axis;         ///< direction from the base to the far end, of any length other than zero
  Required<double> radius;        ///< [m], > 0
  Required<double> length;        ///< [m], > 0

  [[nodiscard]] bool contains(const Vector<3>& position) const noexcept {
    const Vector<3> along = axis / axis.norm(), from_base = position - base_centre;
    const double height = along.dot(from_base);
    return height >= 0.0 && height < length && (from_base - height * along).squaredNorm() <= radius * radius;
  }
};
inline void validate(const Cylinder& shape) {
  detail::require_finite<3>("geometry::Cylinder: base_centre", shape.base_centre, "m");
  detail::require_direction<3>("geometry::Cylinder: axis", shape.axis);
  require_positive("geometry::Cylinder: radius", shape.radius, "m");
  require_positive("geometry::Cylinder: length", shape.length, "m");
}

}  // namespace dmp::geometry
