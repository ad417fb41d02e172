#include <doctest/doctest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>
#include <dmp/geometry/fill.hpp>

using namespace dmp::geometry;
using dmp::ParameterError;
using dmp::Vector;

namespace {

/// A lattice of a user, with its site anywhere in the cell.
struct OneSite {
  static constexpr int dimension = 1;
  double spacing, fraction;
  Vector<1> origin = Vector<1>::Zero();
  [[nodiscard]] Vector<1> cell() const { return Vector<1>{spacing}; }
  [[nodiscard]] std::array<Vector<1>, 1> sites() const { return {Vector<1>{fraction}}; }
  [[nodiscard]] double nearest_distance() const { return spacing; }
};
void validate(const OneSite&) {}

template <int Dim>
std::vector<Vector<Dim>> sorted(std::vector<Vector<Dim>> x) {
  const auto before = [](const auto& a, const auto& b) { return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end()); };
  std::sort(x.begin(), x.end(), before);
  return x;
}

}  // namespace

TEST_CASE("fill: shapes that tile a cuboid hold together its points, none missing, none double, bit for bit") {
  const auto check = [](const auto& lattice, const auto& whole, const auto& cutter) {
    constexpr int dim = std::decay_t<decltype(lattice)>::dimension;
    const auto all = fill(lattice, whole), inside = fill(lattice, whole, cutter), outside = fill(lattice, whole, !cutter);
    CHECK(inside.positions.size() > 10);
    CHECK(outside.positions.size() > 10);
    const auto both = sorted<dim>(merge(inside, outside).positions);
    CHECK(both == sorted<dim>(all.positions));
    CHECK(std::adjacent_find(both.begin(), both.end()) == both.end());
  };
  const Cuboid<2> square{.lower = {-0.5, 0.1}, .upper = {0.9, 1.3}};
  const Cuboid<3> cube{.lower = {0, 0, 0}, .upper = {1, 1, 1}};
  check(Cubic<2>{.spacing = 0.05}, square, Ball<2>{.centre = {0.2, 0.7}, .radius = 0.4});
  check(Hexagonal{.spacing = 0.05}, square, HalfSpace<2>{.point = {0.2, 0.7}, .outward_normal = {1, 1}});
  check(FaceCentredCubic{.lattice_constant = 0.2}, cube, Ball<3>{.centre = {0.2, 0.7, 0.5}, .radius = 0.4});
}

TEST_CASE("fill: cuboids side by side are filled side by side, also when lattice points lie exactly on the common face") {
  for (const double shift : {0.0, 0.05}) {  // with 0.05 points lie on x = 0.3
    CAPTURE(shift);
    const Cubic<2> lattice{.spacing = 0.1, .origin = {shift, shift}};
    const auto all = fill(lattice, {.lower = {0, 0}, .upper = {1, 1}});
    const auto left = fill(lattice, {.lower = {0, 0}, .upper = {0.3, 1}}), right = fill(lattice, {.lower = {0.3, 0}, .upper = {1, 1}});
    CHECK(sorted<2>(merge(left, right).positions) == sorted<2>(all.positions));
  }
}

TEST_CASE("fill: a box of whole cells holds exactly its share of points for a thousand spacings that binary numbers cannot hold") {
  for (int n = 1; n <= 1000; ++n) {
    const double spacing = 1.0 / n;
    CAPTURE(n);
    CHECK(fill(Cubic<1>{.spacing = spacing}, {.lower = {0.0}, .upper = {1.0}}).positions.size() == static_cast<std::size_t>(n));
  }
}

TEST_CASE("fill: no point is lost to rounding, not even one that fills its cuboid, with its site next to either face of the cell") {
  for (const double fraction : {0.0, 1.0 - std::ldexp(1.0, -33)})
    for (int k = 1; k <= 500; ++k) {
      const double spacing = 1.0 / (2 * k + 1), point = std::fma(std::ldexp(1.0, 19) + k + fraction, spacing, 0.0);
      CAPTURE(fraction);
      CAPTURE(k);
      const Cuboid<1> within{.lower = {point}, .upper = {std::nextafter(point, 2.0 * point)}};
      CHECK(fill(OneSite{.spacing = spacing, .fraction = fraction}, within).positions == std::vector<Vector<1>>{Vector<1>{point}});
    }
}

TEST_CASE("fill: the order is fixed, x running fastest, and spacing and volume are those of the lattice") {
  const Ball<3> around_all{.centre = {1.5, 1, 1}, .radius = 10.0};
  const auto points = fill(Cubic<3>{.spacing = 1.0}, {.lower = {0, 0, 0}, .upper = {3, 2, 2}}, around_all);
  REQUIRE(points.positions.size() == 12);
  const auto rank = [](const Vector<3>& x) { return std::tuple(x[2], x[1], x[0]); };
  CHECK(std::is_sorted(points.positions.begin(), points.positions.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); }));
  CHECK(points.spacing == 1.0);
  CHECK(points.volume == 1.0);
}

TEST_CASE("fill: what cannot be filled is refused: nothing inside, no bounds, far too many or far too remote cells, bad parameters") {
  const Cuboid<2> unit{.lower = {0, 0}, .upper = {1, 1}};
  const Ball<2> ball{.centre = {0.5, 0.5}, .radius = 0.3};
  const double infinity = std::numeric_limits<double>::infinity();
  const auto fill_with = [](const Cubic<2>& lattice, const Cuboid<2>& within, const Ball<2>& shape) {
    static_cast<void>(fill(lattice, within, shape));
  };
  CHECK_THROWS_WITH_AS(fill_with(Cubic<2>{.spacing = 0.1}, unit, Ball<2>{.centre = {3, 3}, .radius = 0.5}),
                       "geometry::fill: no lattice point lies inside the shape, got a lattice with points 0.1 m apart "
                       "and a bounding cuboid from (0, 0) to (1, 1) m",
                       ParameterError);
  CHECK_THROWS_WITH_AS(fill_with(Cubic<2>{.spacing = 0.1}, {.lower = {0, 0}, .upper = {infinity, 1}}, ball),
                       "geometry::fill: upper bound of the cuboid must be finite [m], got inf", ParameterError);
  CHECK_THROWS_WITH_AS(fill_with(Cubic<2>{.spacing = 0.1}, {.lower = {-infinity, 0}, .upper = {1, 1}}, ball),
                       "geometry::fill: lower bound of the cuboid must be finite [m], got -inf", ParameterError);
  CHECK_THROWS_WITH_AS(fill_with(Cubic<2>{.spacing = 9.5367431640625e-07}, unit, ball),  // 2^-20
                       "geometry::fill: the bounding cuboid must hold at most 2^32 lattice cells, got 1099513724929", ParameterError);
  CHECK_THROWS_WITH_AS(fill_with(Cubic<2>{.spacing = 0.5}, {.lower = {1e300, 0}, .upper = {2e300, 1}}, ball),
                       "geometry::fill: the bounding cuboid must lie within 2^52 cells of the lattice's origin, got 4e+300",
                       ParameterError);
  CHECK_THROWS_WITH_AS(fill_with(Cubic<2>{.spacing = -1.0}, unit, ball), "geometry::Cubic: spacing must be finite and > 0 m, got -1",
                       ParameterError);
  CHECK_THROWS_WITH_AS(fill_with(Cubic<2>{.spacing = 0.1}, {.lower = {0, 1}, .upper = {1, 0}}, ball),
                       "geometry::Cuboid: upper must be > lower in direction y, got lower 1 and upper 0 m", ParameterError);
  CHECK_THROWS_WITH_AS(fill_with(Cubic<2>{.spacing = 0.1}, unit, Ball<2>{.centre = {0, 0}, .radius = 0.0}),
                       "geometry::Ball: radius must be finite and > 0 m, got 0", ParameterError);
}

TEST_CASE("line: both ends are included exactly, the points between lie evenly") {
  const Vector<2> from{0.1, 0.2}, to{3.1, 4.2};  // 5 m
  const auto points = line<2>(from, to, 0.1);
  REQUIRE(points.positions.size() == 51);
  CHECK(points.positions.front() == from);
  CHECK(points.positions.back() == to);
  for (std::size_t i = 0; i + 1 < points.positions.size(); ++i)
    CHECK((points.positions[i + 1] - points.positions[i]).norm() == doctest::Approx(0.1).epsilon(1e-12));
  CHECK(points.spacing == doctest::Approx(0.1).epsilon(1e-12));
  CHECK(points.volume == doctest::Approx(0.01).epsilon(1e-12));
  CHECK(line<1>(Vector<1>{1.0}, Vector<1>{0.0}, 1.0).positions.size() == 2);
}

TEST_CASE("line: a length that is no whole number of spacings is refused, to a millionth of a spacing") {
  const auto make = [](double length, double spacing) { return line<2>({0, 0}, {0, length}, spacing).positions.size(); };
  CHECK(make(1.0 + 0.9e-7, 0.1) == 11);
  CHECK_THROWS_WITH_AS(make(1.0 + 1.1e-7, 0.1),
                       "geometry::line: the length must be a whole number of spacings, from 1 to 2^32, "
                       "got length 1.00000011 m and spacing 0.1 m",
                       ParameterError);
  CHECK_THROWS_WITH_AS(make(0.0, 0.1),
                       "geometry::line: the length must be a whole number of spacings, from 1 to 2^32, got length 0 m and spacing 0.1 m",
                       ParameterError);
  CHECK_THROWS_AS(make(1.0, 2.0), ParameterError);
  CHECK_THROWS_AS(make(1.0, 1e-12), ParameterError);
  CHECK_THROWS_WITH_AS(make(1.0, 0.0), "geometry::line: spacing must be finite and > 0 m, got 0", ParameterError);
  CHECK_THROWS_WITH_AS(make(std::nan(""), 0.1), "geometry::line: to must be finite [m], got nan", ParameterError);
  CHECK_THROWS_WITH_AS(static_cast<void>(line<1>(Vector<1>{std::nan("")}, Vector<1>{0.0}, 0.1)),
                       "geometry::line: from must be finite [m], got nan", ParameterError);
}

TEST_CASE("merge: the points of both in order; a spacing that differs becomes unknown; volumes that differ are refused") {
  const Points<2> a{.positions = {{0, 0}, {1, 0}}, .spacing = 1.0, .volume = 0.5};
  const Points<2> b{.positions = {{0, 1}}, .spacing = 1.0 + 1e-9, .volume = 0.5};
  const auto both = merge(a, b);
  CHECK(both.positions == std::vector<Vector<2>>{{0, 0}, {1, 0}, {0, 1}});
  CHECK(both.spacing == 1.0);
  CHECK(both.volume == 0.5);
  CHECK(merge(a, Points<2>{.positions = {{5, 5}}, .spacing = 0.9, .volume = 0.5}).spacing == 0.0);
  CHECK_THROWS_WITH_AS(static_cast<void>(merge(a, Points<2>{.positions = {{5, 5}}, .spacing = 1.0, .volume = 0.25})),
                       "geometry::merge: both sets must have the same volume per point, got 0.5 and 0.25 m^2", ParameterError);
  CHECK_THROWS_AS(static_cast<void>(merge(a, Points<2>{.positions = {{5, 5}}})), ParameterError);
}
