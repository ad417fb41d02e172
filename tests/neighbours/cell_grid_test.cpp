#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include "neighbours/oracle.hpp"
#include <doctest/doctest.h>
#include <dmp/neighbours/cell_grid.hpp>

using dmp::Vector;
using dmp::neighbours::CellGrid;
using Rows = std::vector<std::uint32_t>;

namespace {

template <int Dim>
Rows found(const CellGrid<Dim>& grid, const Vector<Dim>& x, double radius, std::uint32_t self = CellGrid<Dim>::nobody) {
  Rows rows;
  grid.find(x, radius, self, rows);
  std::sort(rows.begin(), rows.end());
  return rows;
}

template <int Dim>
Rows expected(const test::Cloud<Dim>& points, const Vector<Dim>& x, double radius, std::int64_t self = -1) {
  Rows rows;
  for (const auto& image : test::all_near<Dim>(x, radius, self, points, test::cube<Dim>(1.0))) rows.push_back(image.first);
  return rows;
}

/// Whether all that are near are found, and nobody that is farther than the radius by more than the margin that the grid admits to.
template <int Dim>
bool all_found(const CellGrid<Dim>& grid, const test::Cloud<Dim>& points, const Vector<Dim>& x, double radius, std::int64_t self = -1) {
  const Rows rows = found(grid, x, radius, static_cast<std::uint32_t>(self)), near = expected(points, x, radius, self),
             around = expected(points, x, radius + grid.margin(), self);
  return std::adjacent_find(rows.begin(), rows.end()) == rows.end() && std::includes(rows.begin(), rows.end(), near.begin(), near.end()) &&
         std::includes(around.begin(), around.end(), rows.begin(), rows.end());
}

/// Every particle looks around itself, and so do points inside and far outside the cloud; radii from almost nothing to everything.
template <int Dim>
void check_against_every_pair(const test::Cloud<Dim>& points, unsigned seed) {
  const auto probes = test::scattered<Dim>(20, 4.0, seed);
  CellGrid<Dim> grid;
  for (const double radius : {0.02, 0.125, 0.3, 5.0})
    for (const double cell_width : {1e-5, 0.5 * radius, radius, 3.0 * radius}) {
      CAPTURE(radius);
      CAPTURE(cell_width);
      grid.build(points, cell_width);
      std::size_t different = 0;
      for (std::uint32_t i = 0; i < points.size(); ++i) different += !all_found(grid, points, points[i], radius, i);
      for (const auto& x : probes) different += !all_found(grid, points, x, radius);
      CHECK(different == 0);
    }
}

}  // namespace

TEST_CASE_TEMPLATE("searching by cells finds whom looking at every particle finds", Dimension, std::integral_constant<int, 1>,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int dim = Dimension::value;
  SUBCASE("scattered particles") { check_against_every_pair(test::scattered<dim>(300, 1.0, 1), 2); }
  SUBCASE("clusters and empty cells") { check_against_every_pair(test::clustered<dim>(300, 1.0, 3), 4); }
  SUBCASE("particles on the boundaries of cells, and pairs exactly at the radius") {
    check_against_every_pair(test::lattice<dim>(dim == 1 ? 64 : 8, 1.0), 5);
  }
  SUBCASE("fewer particles than one vector register holds") {
    for (const std::size_t count : {1u, 2u, 3u, 7u, 11u, 15u}) check_against_every_pair(test::scattered<dim>(count, 1.0, 6), 7);
  }
  SUBCASE("all particles in one place") { check_against_every_pair(test::Cloud<dim>(20, Vector<dim>::Constant(0.1)), 8); }
  SUBCASE("particles on a line along the last direction") {
    auto points = test::scattered<dim>(100, 1.0, 9);
    for (auto& x : points) x.template head<dim - 1>().setConstant(0.25);
    check_against_every_pair(points, 10);
  }
}

TEST_CASE(
    "a particle a rounding closer than the radius is near, one farther by more than the margin is not; the margin is a small part of the "
    "extent") {
  CellGrid<2> grid;
  grid.build(test::Cloud<2>{{0.0, 0.0}, {0.25, 0.0}, {0.0, -0.25}, {-0.75, 1.0}}, 0.125);
  CHECK(grid.margin() <= 5e-7 * 1.25);
  const double beyond = 1.0 - 1e-5;
  CHECK(found<2>(grid, {0.0, 0.0}, beyond * 0.25, 0).empty());
  CHECK(found<2>(grid, {0.0, 0.0}, std::nextafter(0.25, 1.0), 0) == Rows{1, 2});
  CHECK(found<2>(grid, {0.0, 0.0}, beyond * 1.25, 0) == Rows{1, 2});  // 0.75^2 + 1^2 = 1.25^2
  CHECK(found<2>(grid, {0.0, 0.0}, std::nextafter(1.25, 2.0), 0) == Rows{1, 2, 3});
}

TEST_CASE("how far those are that are found: squared distances, as a fraction of that of the search") {
  const auto points = test::scattered<3>(300, 1.0, 1);
  CellGrid<3> grid;
  grid.build(points, 0.15);
  for (std::size_t i = 0; i < 20; ++i) {
    dmp::neighbours::Found near;
    grid.find(points[i], 0.3, near);
    CHECK(near.size > 1);
    for (std::size_t k = 0; k < near.size; ++k)
      CHECK(static_cast<double>(near.fraction[k]) ==
            doctest::Approx((points[near.rows[k]] - points[i]).squaredNorm() / 0.09).epsilon(1e-5));
  }
}

TEST_CASE("no particle: nobody is near") {
  CellGrid<3> grid;
  CHECK(found<3>(grid, {0.0, 0.0, 0.0}, 1.0).empty());  // before any build
  grid.build(test::Cloud<3>{}, 0.1);
  CHECK(found<3>(grid, {0.0, 0.0, 0.0}, 1.0).empty());
  CHECK(grid.order().empty());
  grid.build(test::scattered<3>(50, 1.0, 1), 0.1);
  grid.build(test::Cloud<3>{}, 0.1);  // what was there before is forgotten
  CHECK(found<3>(grid, {0.0, 0.0, 0.0}, 9.0).empty());
}

TEST_CASE("a particle is not near itself, but near another one in its place") {
  CellGrid<2> grid;
  grid.build(test::Cloud<2>{{0.5, 0.5}}, 0.1);
  CHECK(found<2>(grid, {0.5, 0.5}, 0.1, 0).empty());
  CHECK(found<2>(grid, {0.5, 0.5}, 0.1) == Rows{0});
  grid.build(test::Cloud<2>{{0.5, 0.5}, {0.5, 0.5}}, 0.1);
  CHECK(found<2>(grid, {0.5, 0.5}, 0.1, 0) == Rows{1});
}

TEST_CASE("what is found is appended") {
  CellGrid<1> grid;
  grid.build(test::Cloud<1>{Vector<1>(0.0), Vector<1>(1.0)}, 0.5);
  Rows rows{77};
  grid.find(Vector<1>(0.9), 0.2, CellGrid<1>::nobody, rows);
  CHECK(rows == Rows{77, 1});
}

TEST_CASE("two clusters a million radii apart take no more cells than particles ask for") {
  test::Cloud<3> points = test::scattered<3>(100, 1.0, 1);
  for (std::size_t k = 50; k < 100; ++k) points[k] += Vector<3>::Constant(1e6);
  CellGrid<3> grid;
  grid.build(points, 0.1);  // 1e21 cells of this width
  CHECK(grid.bytes() < 100 * 200);
  for (std::uint32_t i = 0; i < 100; ++i) CHECK(all_found(grid, points, points[i], 0.3, i));
}

TEST_CASE_TEMPLATE("the order of the cells holds every particle once, and brings those near in space near in memory", Dimension,
                   std::integral_constant<int, 1>, std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int dim = Dimension::value;
  const auto points = test::scattered<dim>(1000, 1.0, 1);
  CellGrid<dim> grid;
  grid.build(points, 0.1);
  Rows order(grid.order().begin(), grid.order().end());
  double apart_before = 0.0, apart_after = 0.0;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    apart_before += (points[k] - points[k + 1]).norm();
    apart_after += (points[order[k]] - points[order[k + 1]]).norm();
  }
  CHECK(apart_after < 0.6 * apart_before);
  std::sort(order.begin(), order.end());
  Rows all(points.size());
  std::iota(all.begin(), all.end(), 0u);
  CHECK(order == all);
}

TEST_CASE("particles whose position is lost are near nobody, and hide nobody") {
  constexpr double infinity = std::numeric_limits<double>::infinity(), none = std::numeric_limits<double>::quiet_NaN();
  for (const double lost : {none, infinity, -infinity, 1e300})
    for (const std::size_t where : {0u, 20u, 39u}) {
      CAPTURE(lost);
      CAPTURE(where);
      auto points = test::scattered<2>(40, 1.0, 1);
      points[where] = {0.1, lost};
      CellGrid<2> grid;
      grid.build(points, 0.1);
      for (std::uint32_t i = 0; i < points.size(); ++i) CHECK(found(grid, points[i], 0.3, i) == expected(points, points[i], 0.3, i));
    }
}
