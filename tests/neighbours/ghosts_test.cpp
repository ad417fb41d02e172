#include <algorithm>
#include <cmath>
#include "neighbours/oracle.hpp"
#include <doctest/doctest.h>
#include <dmp/neighbours/ghosts.hpp>

using dmp::Vector;
using dmp::neighbours::Ghosts;

namespace {

/// The ghosts, as images in order.
template <int Dim>
std::vector<test::Image<Dim>> images(const Ghosts<Dim>& ghosts, const dmp::geometry::Box<Dim>& box) {
  std::vector<test::Image<Dim>> result;
  for (std::size_t k = 0; k < ghosts.size(); ++k) {
    std::array<int, Dim> boxes;
    for (int d = 0; d < Dim; ++d)
      boxes[static_cast<std::size_t>(d)] = static_cast<int>(std::lround(ghosts.shift[k][d] / (box.upper[d] - box.lower[d])));
    result.push_back({ghosts.owner[k], boxes});
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// All images but the originals within `reach` of the box.
template <int Dim>
std::vector<test::Image<Dim>> expected(const test::Cloud<Dim>& points, const dmp::geometry::Box<Dim>& box, double reach) {
  std::vector<test::Image<Dim>> result;
  for (std::uint32_t row = 0; row < points.size(); ++row)
    test::for_each_image<Dim>(row, box, [&](const test::Image<Dim>& image) {
      if (image.second == std::array<int, Dim>{}) return;
      const Vector<Dim> x = test::position_of<Dim>(image, points, box);
      for (int d = 0; d < Dim; ++d)
        if (!(x[d] >= box.lower[d] - reach && x[d] < box.upper[d] + reach)) return;
      result.push_back(image);
    });
  std::sort(result.begin(), result.end());
  return result;
}

template <int Dim>
void check_against_every_image(const std::array<bool, Dim>& periodic) {
  const auto box = test::cube<Dim>(1.0, periodic);
  Ghosts<Dim> ghosts;
  for (const double reach : {0.0, 0.1, 0.25, 0.6, 0.99})  // beyond half a box a particle may have images on both sides
    for (const auto& points : {test::scattered<Dim>(200, 1.0, 1), test::lattice<Dim>(4, 1.0), test::Cloud<Dim>{}}) {
      CAPTURE(reach);
      ghosts.build(points, box, reach);
      CHECK(images(ghosts, box) == expected<Dim>(points, box, reach));
    }
}

}  // namespace

TEST_CASE("ghosts are the images within reach of a periodic face, those of edges and corners among them") {
  check_against_every_image<1>({true});
  check_against_every_image<1>({false});
  check_against_every_image<2>({true, true});
  check_against_every_image<2>({true, false});
  check_against_every_image<2>({false, true});
  check_against_every_image<3>({true, true, true});
  check_against_every_image<3>({true, false, true});
  check_against_every_image<3>({false, false, false});
}

TEST_CASE("a particle in a corner has 3 ghosts in the plane and 7 in space, one in the middle has none") {
  Ghosts<2> plane;
  plane.build(test::Cloud<2>{{-0.49, 0.49}}, test::cube<2>(1.0, {true, true}), 0.1);
  CHECK(plane.size() == 3);
  Ghosts<3> space;
  space.build(test::Cloud<3>{{-0.49, 0.49, 0.49}}, test::cube<3>(1.0, {true, true, true}), 0.1);
  CHECK(space.size() == 7);
  space.build(test::Cloud<3>{{0.3, 0.0, -0.3}}, test::cube<3>(1.0, {true, true, true}), 0.1);
  CHECK(space.size() == 0);
}

TEST_CASE("a particle on the lower face has its image exactly one box further; the upper face belongs to the next box") {
  const dmp::geometry::Box<1> box{.lower = {0.25}, .upper = {1.75}, .periodic = {true}};
  Ghosts<1> ghosts;
  ghosts.build(test::Cloud<1>{Vector<1>(0.25)}, box, 0.125);
  REQUIRE(ghosts.size() == 1);
  CHECK(ghosts.owner[0] == 0);
  CHECK(ghosts.shift[0][0] == 1.5);
  ghosts.build(test::Cloud<1>{Vector<1>(std::nextafter(1.75, 0.0))}, box, 0.125);
  REQUIRE(ghosts.size() == 1);
  CHECK(ghosts.shift[0][0] == -1.5);
  ghosts.build(test::Cloud<1>{Vector<1>(0.375), Vector<1>(1.625)}, box, 0.125);  // exactly `reach` from a face: half-open on either side
  REQUIRE(ghosts.size() == 1);
  CHECK(ghosts.owner[0] == 1);
}
