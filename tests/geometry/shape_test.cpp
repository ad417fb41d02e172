#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <type_traits>
#include "support/compare.hpp"
#include <doctest/doctest.h>
#include <dmp/core/math.hpp>
#include <dmp/geometry/cylinder.hpp>
#include <dmp/geometry/fill.hpp>
#include <dmp/geometry/shape.hpp>

using namespace dmp::geometry;
using dmp::Vector;

namespace outside {
/// A shape of a user, in a namespace of the user.
struct Stripes {
  static constexpr int dimension = 2;
  [[nodiscard]] bool contains(const Vector<2>& x) const noexcept { return std::fmod(std::abs(x[0]), 1.0) < 0.5; }
};
void validate(const Stripes&) {}
}  // namespace outside

namespace {

struct Unchecked {
  static constexpr int dimension = 2;
  [[nodiscard]] bool contains(const Vector<2>&) const noexcept { return true; }
};
template <class A, class B>
concept Unites = requires(const A a, const B b) { a | b; };

static_assert(Shape<Ball<1>, 1> && Shape<Cuboid<2>, 2> && Shape<Cylinder, 3> && Shape<outside::Stripes, 2>);
static_assert(!Shape<Ball<2>, 3>, "a disc is no body");
static_assert(!Shape<Unchecked, 2>, "a shape must be able to check its parameters");
static_assert(Unites<Ball<2>, Cuboid<2>> && !Unites<Ball<2>, Ball<3>> && !Unites<Ball<2>, double>);
static_assert(std::is_aggregate_v<Ball<3>> && std::is_aggregate_v<Cylinder> && std::is_aggregate_v<HalfSpace<2>>);

/// Root mean square, over 64 shifts of the lattice, of the error of count * volume, relative to the exact volume. The shifts are the
/// multiples of the powers of the generalised golden ratio, which fill the cell evenly.
template <int Dim, class S>
double counting_error(const S& shape, const Cuboid<Dim>& within, double exact_volume, double spacing) {
  constexpr int shifts = 64;
  constexpr double ratio = Dim == 1 ? 1.618033988749895 : Dim == 2 ? 1.324717957244746 : 1.2207440846057596;
  double sum = 0.0;
  for (int n = 0; n < shifts; ++n) {
    Vector<Dim> origin;
    for (int d = 0; d < Dim; ++d) origin[d] = spacing * std::fmod(n * std::pow(ratio, -d - 1), 1.0);
    const auto points = fill(Cubic<Dim>{.spacing = spacing, .origin = origin}, within, shape);
    const double error = static_cast<double>(points.positions.size()) * points.volume / exact_volume - 1.0;
    sum += error * error;
  }
  return std::sqrt(sum / shifts);
}

}  // namespace

// For a smooth convex body, N points of a lattice that is shifted at random count its volume with a root mean square error of
// order h^((Dim + 1)/2): D. G. Kendall, Q. J. Math. 19 (1948) 1-26, doi:10.1093/qmath/os-19.1.1.
TEST_CASE("ball: counted lattice points give 2R, pi R^2 and 4/3 pi R^3, the error falling as h^((Dim + 1)/2)") {
  const auto error = [](auto dim, double spacing) {  // over eight radii: the constant before h^((Dim + 1)/2) swings with radius/h
    constexpr int Dim = decltype(dim)::value;
    const Cuboid<Dim> within{.lower = Vector<Dim>::Constant(-0.5), .upper = Vector<Dim>::Constant(0.5)};
    double sum = 0.0;
    for (int n = 0; n < 8; ++n) {
      const double radius = 0.38 + 0.0137 * n;
      const double disc = std::numbers::pi * dmp::square(radius);
      const double volume = Dim == 1 ? 2.0 * radius : Dim == 2 ? disc : 4.0 / 3.0 * disc * radius;
      sum += dmp::square(counting_error<Dim>(Ball<Dim>{.centre = Vector<Dim>::Zero(), .radius = radius}, within, volume, spacing));
    }
    return std::sqrt(sum / 8.0);
  };
  const auto check = [&](auto dim, double coarse, double largest_error) {
    constexpr int Dim = decltype(dim)::value;
    const double first = error(dim, coarse), second = error(dim, coarse / 4.0);
    const double order = std::log(first / second) / std::log(4.0);
    CAPTURE(Dim);
    CAPTURE(order);
    CHECK(first < largest_error);
    CHECK(std::abs(order - 0.5 * (Dim + 1)) < 0.15);
  };
  check(std::integral_constant<int, 1>{}, 0.05, 0.05);
  check(std::integral_constant<int, 2>{}, 0.05, 0.02);
  check(std::integral_constant<int, 3>{}, 0.1, 0.02);
}

TEST_CASE("cylinder: counted lattice points give pi R^2 L, along any axis and whatever its length") {
  for (const Vector<3>& axis : {Vector<3>{1, 0, 0}, Vector<3>{0, -3, 0}, Vector<3>{1, 2, -0.5}}) {
    CAPTURE(axis.transpose());
    const double radius = 0.2, length = 0.5;
    const Cylinder tube{.base_centre = -0.5 * length * axis.normalized(), .axis = axis, .radius = radius, .length = length};
    const Cuboid<3> within{.lower = {-0.5, -0.5, -0.5}, .upper = {0.5, 0.5, 0.5}};
    CHECK(counting_error<3>(tube, within, std::numbers::pi * radius * radius * length, 0.02) < 0.02);
  }
}

TEST_CASE("cylinder: begins at its base, ends at its length, and two laid end to end share no position") {
  const Cylinder first{.base_centre = {0, 0, 0}, .axis = {0, 0, 2}, .radius = 1.0, .length = 1.5};
  const Cylinder second{.base_centre = {0, 0, 1.5}, .axis = {0, 0, 2}, .radius = 1.0, .length = 1.5};
  CHECK(first.contains({1.0, 0.0, 0.0}));
  CHECK_FALSE(first.contains({1.0 + 1e-12, 0.0, 0.5}));
  CHECK_FALSE(first.contains({0.0, 0.0, -1e-12}));
  CHECK_FALSE(first.contains({0.0, 0.0, 1.5}));
  CHECK(second.contains({0.0, 0.0, 1.5}));
}

TEST_CASE("half space: cuts a ball through its centre in two equal halves; the normal points out of it") {
  const Ball<2> disc{.centre = {0.5, 0.5}, .radius = 0.4};
  const HalfSpace<2> half{.point = {0.5, 0.5}, .outward_normal = {3.0, 4.0}};
  CHECK(half.contains({0.0, 0.0}));
  CHECK_FALSE(half.contains({1.0, 1.0}));
  const Cuboid<2> unit{.lower = {0, 0}, .upper = {1, 1}};
  CHECK(counting_error<2>(disc & half, unit, 0.08 * std::numbers::pi, 0.01) < 0.005);
}

TEST_CASE("cuboid: eight neighbours tile a cuboid, each position in exactly one, even where positions lie on the common faces") {
  const std::array<double, 3> edges{0.0, 0.3, 1.0};
  const auto cut = [&](std::size_t x, std::size_t y, std::size_t z) {
    return Cuboid<3>{.lower = {edges[x], edges[y], edges[z]}, .upper = {edges[x + 1], edges[y + 1], edges[z + 1]}};
  };
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j)
      for (int k = 0; k < 10; ++k) {
        const Vector<3> position{i / 10.0, j / 10.0, k / 10.0};  // 3/10 lies on a face
        int owners = 0;
        for (std::size_t x : {0u, 1u})
          for (std::size_t y : {0u, 1u})
            for (std::size_t z : {0u, 1u}) owners += cut(x, y, z).contains(position);
        CHECK(owners == 1);
      }
}

TEST_CASE("shapes: |, &, - and ! are the union, intersection, difference and complement of sets") {
  const Ball<2> a{.centre = {0, 0}, .radius = 1.0};
  const Cuboid<2> b{.lower = {0, 0}, .upper = {2, 2}};
  const outside::Stripes c;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> anywhere(-2.0, 2.0);
  int inside_all = 0;
  for (int n = 0; n < 2000; ++n) {
    const Vector<2> x{anywhere(random), anywhere(random)};
    const bool in_a = x.norm() <= 1.0, in_b = x.minCoeff() >= 0.0 && x.maxCoeff() < 2.0, in_c = c.contains(x);
    CHECK((a | b).contains(x) == (in_a || in_b));
    CHECK((a & b).contains(x) == (in_a && in_b));
    CHECK((a - b).contains(x) == (in_a && !in_b));
    CHECK((!a).contains(x) == !in_a);
    CHECK((!(a | b)).contains(x) == ((!a) & (!b)).contains(x));  // De Morgan
    CHECK((!(a & b)).contains(x) == ((!a) | (!b)).contains(x));
    CHECK(((a | b) & c).contains(x) == ((in_a || in_b) && in_c));
    inside_all += (a & b & c).contains(x);
  }
  CHECK(inside_all > 50);
}

TEST_CASE("shapes: a combination has the volume that inclusion and exclusion give") {
  const Cuboid<2> a{.lower = {0, 0}, .upper = {0.5, 0.4}}, b{.lower = {0.3, 0.2}, .upper = {1, 1}}, unit{.lower = {0, 0}, .upper = {1, 1}};
  const auto area = [&](const auto& shape) {
    const auto points = fill(Cubic<2>{.spacing = 0.02}, unit, shape);
    return static_cast<double>(points.positions.size()) * points.volume;
  };
  CHECK(area(a | b) == doctest::Approx(0.2 + 0.56 - 0.04).epsilon(1e-12));
  CHECK(area(a & b) == doctest::Approx(0.04).epsilon(1e-12));
  CHECK(area(a - b) == doctest::Approx(0.16).epsilon(1e-12));
  CHECK(area(!b) == doctest::Approx(0.44).epsilon(1e-12));
}

TEST_CASE("shapes: bad parameters are refused by name, also inside combinations") {
  const double nan = std::nan("");
  CHECK(test::complaint_about(Ball<2>{.centre = {0, 0}, .radius = 0.0}) == "geometry::Ball: radius must be finite and > 0 m, got 0");
  CHECK(test::complaint_about(Ball<2>{.centre = {0, nan}, .radius = 1.0}) == "geometry::Ball: centre must be finite [m], got nan");
  CHECK(test::complaint_about(Cuboid<2>{.lower = {0, 0}, .upper = {-1, 1}}) ==
        "geometry::Cuboid: upper must be > lower in direction x, got lower 0 and upper -1 m");
  CHECK(test::complaint_about(HalfSpace<2>{.point = {0, 0}, .outward_normal = {0, 0}}) ==
        "geometry::HalfSpace: outward_normal must be a finite vector other than zero, got (0, 0)");
  CHECK(test::complaint_about(HalfSpace<2>{.point = {nan, 0}, .outward_normal = {0, 1}}) ==
        "geometry::HalfSpace: point must be finite [m], got nan");
  CHECK(test::complaint_about(Cylinder{.base_centre = {0, 0, 0}, .axis = {0, 0, 0}, .radius = 1.0, .length = 1.0}) ==
        "geometry::Cylinder: axis must be a finite vector other than zero, got (0, 0, 0)");
  CHECK(test::complaint_about(Cylinder{.base_centre = {0, nan, 0}, .axis = {0, 0, 1}, .radius = 1.0, .length = 1.0}) ==
        "geometry::Cylinder: base_centre must be finite [m], got nan");
  CHECK(test::complaint_about(Cylinder{.base_centre = {0, 0, 0}, .axis = {0, 0, 1}, .radius = -1.0, .length = 1.0}) ==
        "geometry::Cylinder: radius must be finite and > 0 m, got -1");
  CHECK(test::complaint_about(Cylinder{.base_centre = {0, 0, 0}, .axis = {0, 0, 1}, .radius = 1.0, .length = 0.0}) ==
        "geometry::Cylinder: length must be finite and > 0 m, got 0");

  const Ball<2> good{.centre = {0, 0}, .radius = 1.0}, bad{.centre = {0, 0}, .radius = -2.0};
  const std::string complaint = "geometry::Ball: radius must be finite and > 0 m, got -2";
  CHECK(test::complaint_about(good | bad) == complaint);
  CHECK(test::complaint_about(bad | good) == complaint);
  CHECK(test::complaint_about(good & bad) == complaint);
  CHECK(test::complaint_about(bad & good) == complaint);
  CHECK(test::complaint_about(good - bad) == complaint);
  CHECK(test::complaint_about(bad - good) == complaint);
  CHECK(test::complaint_about(!bad) == complaint);
  CHECK(test::complaint_about((good | good) & !good).empty());
}
