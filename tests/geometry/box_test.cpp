#include <doctest/doctest.h>
#include <cmath>
#include <limits>
#include <type_traits>
#include <dmp/geometry/box.hpp>
#include "support/compare.hpp"

using dmp::Vector;
using dmp::geometry::Box;
using dmp::geometry::RequiredVector;

static_assert(!std::is_default_constructible_v<RequiredVector<2>>, "a bound that is left out must not compile");
static_assert(!std::is_constructible_v<RequiredVector<2>, double> && !std::is_constructible_v<RequiredVector<2>, double, double, double>);
static_assert(std::is_aggregate_v<Box<1>> && std::is_aggregate_v<Box<2>> && std::is_aggregate_v<Box<3>>);

TEST_CASE("box: a position wrapped into a periodic box differs from it by whole periods, and only in periodic directions") {
  const Box<3> box{.lower = {-1.0, 0.0, 2.0}, .upper = {3.0, 0.5, 4.0}, .periodic = {true, true, false}};
  validate(box);
  for (int n = -50; n <= 50; ++n) {
    const Vector<3> position{0.37 * n, 0.11 * n, 1.7 * n};
    CAPTURE(n);
    const Vector<3> image = box.wrap(position);
    for (int d = 0; d < 2; ++d) {
      CHECK(image[d] >= box.lower[d]);
      CHECK(image[d] < box.upper[d]);
      const double periods = (position[d] - image[d]) / box.extent()[d];
      CHECK(std::abs(periods - std::round(periods)) < 1e-12);
    }
    CHECK(image[2] == position[2]);
    CHECK(box.wrap(image) == image);
  }
}

TEST_CASE("box: wrap keeps the bits of what is inside, and never returns the upper face, however small the step across") {
  const Box<1> box{.lower = {0.1}, .upper = {0.7}, .periodic = {true}};
  for (const double x : {0.1, 0.3, std::nextafter(0.7, 0.0)}) CHECK(box.wrap(Vector<1>{x})[0] == x);
  CHECK(box.wrap(Vector<1>{0.7})[0] == 0.1);
  const Box<1> from_zero{.lower = {0.0}, .upper = {1.0}, .periodic = {true}};
  for (double step = 1e-3; step > 1e-300; step *= 1e-9) {  // 1 - 1e-30 rounds to 1
    CAPTURE(step);
    CHECK(from_zero.contains(from_zero.wrap(Vector<1>{-step})));
  }
  const Box<1> almost_to_zero{.lower = {-1.0}, .upper = {1e-20}, .periodic = {true}};  // its length rounds to 1
  CHECK(almost_to_zero.wrap(Vector<1>{0.0})[0] == 0.0);
  CHECK(std::isnan(box.wrap(Vector<1>{std::numeric_limits<double>::quiet_NaN()})[0]));
  CHECK_FALSE(std::isfinite(box.wrap(Vector<1>{std::numeric_limits<double>::infinity()})[0]));
}

TEST_CASE("box: closed below, open above; extent is upper - lower") {
  const Box<2> box{.lower = {0, -1}, .upper = {2, 1}};
  CHECK(box.contains({0.0, -1.0}));
  CHECK_FALSE(box.contains({2.0, 0.0}));
  CHECK_FALSE(box.contains({1.0, 1.0}));
  CHECK_FALSE(box.contains({std::numeric_limits<double>::quiet_NaN(), 0.0}));
  CHECK(box.extent() == Vector<2>(2.0, 2.0));
  CHECK(box.periodic == std::array<bool, 2>{false, false});
}

TEST_CASE("box: an unbounded box is valid, holds every finite position and moves none") {
  const auto box = Box<3>::unbounded();
  CHECK(test::complaint_about(box).empty());
  const Vector<3> far{1e300, -1e300, 0.0};
  CHECK(box.contains(far));
  CHECK(box.wrap(far) == far);
  CHECK(std::isinf(box.extent()[1]));
}

TEST_CASE("box: bad bounds are refused with direction and values") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  CHECK(test::complaint_about(Box<2>{.lower = {0, 1}, .upper = {1, 0.5}}) ==
        "geometry::Box: upper must be > lower in direction y, got lower 1 and upper 0.5 m");
  CHECK(test::complaint_about(Box<1>{.lower = {2.0}, .upper = {2.0}}) ==
        "geometry::Box: upper must be > lower in direction x, got lower 2 and upper 2 m");
  CHECK(test::complaint_about(Box<3>{.lower = {0, 0, std::nan("")}, .upper = {1, 1, 1}}) ==
        "geometry::Box: upper must be > lower in direction z, got lower nan and upper 1 m");
  CHECK(test::complaint_about(Box<2>{.lower = {0, -infinity}, .upper = {1, 1}, .periodic = {true, true}}) ==
        "geometry::Box: a periodic direction must be finite, got lower -inf and upper 1 m in direction y");
  CHECK(test::complaint_about(Box<2>{.lower = {0, -infinity}, .upper = {1, 1}, .periodic = {true, false}}).empty());
}
