#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <numbers>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/shape.hpp>

namespace dmp::lattice_spring {

/// How deep a point lies below the surface of a body [m], negative outside, and the volume [m^Dim] of what lies deeper than `depth`: 0 if
/// the body is too thin. A shape of your own: two functions like these in its namespace.
template <int Dim>
[[nodiscard]] double depth_in(const geometry::Cuboid<Dim>& shape, const Vector<Dim>& x) noexcept {
  return std::min((x - shape.lower).minCoeff(), (shape.upper - x).minCoeff());
}
template <int Dim>
[[nodiscard]] double volume_deeper(const geometry::Cuboid<Dim>& shape, double depth) noexcept {
  return (shape.upper - shape.lower - Vector<Dim>::Constant(2.0 * depth)).cwiseMax(0.0).prod();
}
template <int Dim>
[[nodiscard]] double depth_in(const geometry::Ball<Dim>& shape, const Vector<Dim>& x) noexcept {
  return shape.radius - (x - shape.centre).norm();
}
template <int Dim>
[[nodiscard]] double volume_deeper(const geometry::Ball<Dim>& shape, double depth) noexcept {
  const double r = std::max(0.0, shape.radius - depth);
  return Dim == 3 ? 4.0 / 3.0 * std::numbers::pi * cube(r) : Dim == 2 ? std::numbers::pi * square(r) : 2.0 * r;
}

/// A shape that knows how deep a point lies.
template <class S>
concept SolidShape = geometry::Shape<S, S::dimension> && requires(const S shape, const Vector<S::dimension> x) {
  { depth_in(shape, x) } -> std::convertible_to<double>;
  { volume_deeper(shape, 1.0) } -> std::convertible_to<double>;
};

/// What of a body lies at least `depth` [m] below its surface: a shape. One bond length below it no bond is missing.
template <SolidShape S>
struct Interior {
  static constexpr int dimension = S::dimension;
  S shape;
  double depth = 0.0;

  [[nodiscard]] bool contains(const Vector<dimension>& x) const noexcept { return depth_in(shape, x) >= depth; }
  [[nodiscard]] double volume() const noexcept { return volume_deeper(shape, depth); }  ///< [m^Dim], 0: there is none
};
template <class S>
void validate(const Interior<S>& interior) {
  validate(interior.shape);
  require_not_negative("lattice_spring::Interior: depth", interior.depth, "m");
}

}  // namespace dmp::lattice_spring
