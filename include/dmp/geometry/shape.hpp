#pragma once
#include <concepts>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/detail/checks.hpp>
#include <dmp/geometry/required_vector.hpp>

/// Shapes, to be filled with particles. A shape is a plain value that says which positions lie inside; shapes combine to shapes:
///   a | b  in either      a & b  in both      a - b  in a, not in b      !a  not in a
///   const auto tube = Cylinder{...} - Cylinder{...};   const auto tank = Cuboid<2>{...} & !Ball<2>{...};
/// The combination is a type of its own, so that testing a position compiles into one expression.
namespace dmp::geometry {

/// Contract of a shape in Dim dimensions; a shape of your own needs no more than this.
///   dimension           static constexpr int
///   contains(position)  position [m]
///   validate(shape)     free function; throws ParameterError on bad parameters
template <class S, int Dim>
concept Shape = requires(const S shape, const Vector<Dim> position) {
  requires S::dimension == Dim;
  { shape.contains(position) } -> std::same_as<bool>;
  { validate(shape) };
};

/// lower <= position < upper in each direction: closed below, open above, so that neighbouring cuboids tile space without gap or
/// double points. A rectangle in 2D, an interval in 1D. Bounds may be infinite.
template <int Dim>
struct Cuboid {
  static constexpr int dimension = Dim;
  RequiredVector<Dim> lower;  ///< [m]
  RequiredVector<Dim> upper;  ///< [m], > lower

  [[nodiscard]] bool contains(const Vector<Dim>& position) const noexcept {
    for (int d = 0; d < Dim; ++d)
      if (!(position[d] >= lower[d] && position[d] < upper[d])) return false;
    return true;
  }
};
template <int Dim>
void validate(const Cuboid<Dim>& shape) {
  detail::require_ordered<Dim>("geometry::Cuboid", shape.lower, shape.upper);
}

/// |position - centre| <= radius. A disc in 2D, an interval in 1D.
template <int Dim>
struct Ball {
  static constexpr int dimension = Dim;
  RequiredVector<Dim> centre;  ///< [m]
  Required<double> radius;     ///< [m], > 0

  [[nodiscard]] bool contains(const Vector<Dim>& position) const noexcept {
    return (position - centre).squaredNorm() <= radius * radius;
  }
};
template <int Dim>
void validate(const Ball<Dim>& shape) {
  detail::require_finite<Dim>("geometry::Ball: centre", shape.centre, "m");
  require_positive("geometry::Ball: radius", shape.radius, "m");
}

/// The side of a plane (a line in 2D) that the normal points away from: (position - point) . outward_normal <= 0.
template <int Dim>
struct HalfSpace {
  static constexpr int dimension = Dim;
  RequiredVector<Dim> point;           ///< [m], on the plane
  RequiredVector<Dim> outward_normal;  ///< out of the half space, of any length other than zero

  [[nodiscard]] bool contains(const Vector<Dim>& position) const noexcept { return outward_normal.dot(position - point) <= 0.0; }
};
template <int Dim>
void validate(const HalfSpace<Dim>& shape) {
  detail::require_finite<Dim>("geometry::HalfSpace: point", shape.point, "m");
  detail::require_direction<Dim>("geometry::HalfSpace: outward_normal", shape.outward_normal);
}

/// a | b
template <class A, class B>
struct Union {
  static constexpr int dimension = A::dimension;
  A first;
  B second;
  [[nodiscard]] bool contains(const Vector<dimension>& position) const noexcept {
    return first.contains(position) || second.contains(position);
  }
};
/// a & b
template <class A, class B>
struct Intersection {
  static constexpr int dimension = A::dimension;
  A first;
  B second;
  [[nodiscard]] bool contains(const Vector<dimension>& position) const noexcept {
    return first.contains(position) && second.contains(position);
  }
};
/// a - b
template <class A, class B>
struct Difference {
  static constexpr int dimension = A::dimension;
  A first;
  B second;
  [[nodiscard]] bool contains(const Vector<dimension>& position) const noexcept {
    return first.contains(position) && !second.contains(position);
  }
};
/// !a
template <class A>
struct Complement {
  static constexpr int dimension = A::dimension;
  A shape;
  [[nodiscard]] bool contains(const Vector<dimension>& position) const noexcept { return !shape.contains(position); }
};

template <class A, class B>
void validate(const Union<A, B>& shape) {
  validate(shape.first);
  validate(shape.second);
}
template <class A, class B>
void validate(const Intersection<A, B>& shape) {
  validate(shape.first);
  validate(shape.second);
}
template <class A, class B>
void validate(const Difference<A, B>& shape) {
  validate(shape.first);
  validate(shape.second);
}
template <class A>
void validate(const Complement<A>& shape) {
  validate(shape.shape);
}

template <class A, class B>
  requires Shape<A, A::dimension> && Shape<B, A::dimension>
[[nodiscard]] Union<A, B> operator|(const A& a, const B& b) {
  return {a, b};
}
template <class A, class B>
  requires Shape<A, A::dimension> && Shape<B, A::dimension>
[[nodiscard]] Intersection<A, B> operator&(const A& a, const B& b) {
  return {a, b};
}
template <class A, class B>
  requires Shape<A, A::dimension> && Shape<B, A::dimension>
[[nodiscard]] Difference<A, B> operator-(const A& a, const B& b) {
  return {a, b};
}
template <class A>
  requires Shape<A, A::dimension>
[[nodiscard]] Complement<A> operator!(const A& a) {
  return {a};
}

}  // namespace dmp::geometry
