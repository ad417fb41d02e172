#include <algorithm>
#include <cmath>
#include <numeric>
#include "neighbours/oracle.hpp"
#include <doctest/doctest.h>
#include <dmp/core/threads.hpp>
#include <dmp/neighbours/relative_motion.hpp>
#include <dmp/neighbours/spatial_order.hpp>

using dmp::Blocks;
using dmp::neighbours::Bounds;
using dmp::neighbours::SpatialOrder;
using Rows = std::vector<std::uint32_t>;

namespace {

template <int Dim>
bool is_permutation(const SpatialOrder<Dim>& order, std::size_t count) {
  Rows rows(order.rows().begin(), order.rows().end()), all(count);
  std::sort(rows.begin(), rows.end());
  std::iota(all.begin(), all.end(), 0u);
  return rows == all;
}

/// From 0 to the number of rows, no block empty unless there are no rows at all.
template <int Dim>
bool bounds_are_right(const SpatialOrder<Dim>& order, std::size_t count) {
  const auto bounds = order.bounds();
  if (bounds.size() < 2 || bounds.front() != 0 || bounds.back() != count) return false;
  if (count == 0) return bounds.size() == 2;
  return std::adjacent_find(bounds.begin(), bounds.end(), std::greater_equal<>()) == bounds.end();
}

template <int Dim>
std::vector<Bounds<Dim>> boxes_of(const SpatialOrder<Dim>& order, const test::Cloud<Dim>& points) {
  std::vector<Bounds<Dim>> boxes(order.bounds().size() - 1);
  for (std::size_t block = 0; block < boxes.size(); ++block)
    for (std::size_t k = order.bounds()[block]; k < order.bounds()[block + 1]; ++k) boxes[block].add(points[order.rows()[k]]);
  return boxes;
}

}  // namespace

TEST_CASE_TEMPLATE("an order holds every particle once, and its blocks follow each other without gaps", Dimension,
                   std::integral_constant<int, 1>, std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int dim = Dimension::value;
  SpatialOrder<dim> order;  // one for all: nothing stays from the one before
  for (const std::size_t count : {9000u, 100u, 1u, 7u, 0u})
    for (const auto& points : {test::scattered<dim>(count, 1.0, 1), test::clustered<dim>(count, 1.0, 2),
                               test::Cloud<dim>(count, dmp::Vector<dim>::Constant(0.2))})
      for (const double cell : {1e-4, 0.02, 5.0})
        for (const double particles_per_cell : {0.0, 3.0}) {
          CAPTURE(count);
          CAPTURE(cell);
          CAPTURE(particles_per_cell);
          order.build(points, cell, particles_per_cell);
          CHECK(is_permutation(order, count));
          CHECK(bounds_are_right(order, count));
        }
}

TEST_CASE_TEMPLATE("the blocks of an even cloud are boxes that do not overlap, compact, and about as large as blocks should be", Dimension,
                   std::integral_constant<int, 1>, std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int dim = Dimension::value;
  constexpr std::size_t count = 60000;
  const auto points = test::scattered<dim>(count, 1.0, 3);
  const double cell = std::pow(10.0 / count, 1.0 / dim);
  SpatialOrder<dim> order;
  for (const double particles_per_cell : {0.0, 10.0}) {
    order.build(points, cell, particles_per_cell);
    const auto boxes = boxes_of(order, points);
    CHECK(boxes.size() >= 7);
    CHECK(boxes.size() <= 29);
    for (std::size_t a = 0; a < boxes.size(); ++a) {
      const std::size_t rows = order.bounds()[a + 1] - order.bounds()[a];
      CHECK(rows >= Blocks::rows_wanted(count) / 3);
      CHECK(rows <= 2 * Blocks::rows_wanted(count));
      const dmp::Vector<dim> extent = boxes[a].upper - boxes[a].lower;
      CHECK(extent.maxCoeff() <= 2.0 * extent.minCoeff());
      for (std::size_t b = 0; b < a; ++b)
        CHECK((boxes[a].lower.cwiseMax(boxes[b].lower) - boxes[a].upper.cwiseMin(boxes[b].upper)).maxCoeff() >= 0.0);
    }
  }
}

TEST_CASE("a particle far away makes cells wide, but not the blocks of the others large") {
  auto points = test::scattered<3>(100000, 1.0, 4);
  points.emplace_back(20.0, 20.0, 20.0);
  SpatialOrder<3> order;
  order.build(points, 0.02, 0.8);
  CHECK(bounds_are_right(order, points.size()));
  for (std::size_t block = 0; block + 1 < order.bounds().size(); ++block)
    CHECK(order.bounds()[block + 1] - order.bounds()[block] <= 4 * Blocks::rows_wanted(points.size()));
}

TEST_CASE("a particle far away makes given cells wide, and the order neither slow nor large") {
  for (const double far : {1e2, 1e3, 2e4, 1e6}) {
    CAPTURE(far);
    auto points = test::lattice<3>(20, 1.0);
    points.back() = dmp::Vector<3>::Constant(far);
    Bounds<3> bounds;
    for (const auto& x : points) bounds.add(x);
    dmp::neighbours::RelativeMotion<3> motion;
    motion.build(bounds, test::cube<3>(4.0 * far), 0.13, 0.026, points.size());
    SpatialOrder<3> order;
    order.build(points, motion.cells(), motion.cells().width.prod() * 8000.0, 2);
    CHECK(is_permutation(order, points.size()));
    CHECK(bounds_are_right(order, points.size()));
    CHECK(order.bytes() < 40'000'000);
  }
}

TEST_CASE_TEMPLATE("within a block, those near in memory are near in space", Dimension, std::integral_constant<int, 1>,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int dim = Dimension::value;
  const auto points = test::scattered<dim>(20000, 1.0, 4);
  const double cell = std::pow(10.0 / 20000.0, 1.0 / dim);
  SpatialOrder<dim> order;
  order.build(points, cell, 10.0);
  double apart = 0.0;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) apart += (points[order.rows()[k]] - points[order.rows()[k + 1]]).norm();
  CHECK(apart / 20000.0 < 2.0 * cell);
}

TEST_CASE_TEMPLATE("particles of a given cell come one after the other, in blocks of a particle's own surroundings", Dimension,
                   std::integral_constant<int, 1>, std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int dim = Dimension::value;
  constexpr std::size_t count = 60000;
  const auto points = test::scattered<dim>(count, 1.0, 7);
  auto with_others = points;  // far away: the cells reach there, the blocks must not
  with_others.push_back(dmp::Vector<dim>::Constant(-1.3));
  with_others.push_back(dmp::Vector<dim>::Constant(2.1));
  const double cell = std::pow(10.0 / count, 1.0 / dim);
  const dmp::neighbours::Cells<dim> cells(with_others.size(), dmp::neighbours::Positions<dim>{with_others}, cell);
  SpatialOrder<dim> order;
  for (const int parts : {1, 2, 3}) {
    order.build(points, cells, 10.0, parts);
    CHECK(is_permutation(order, count));
    CHECK(bounds_are_right(order, count));
    Rows cell_of;
    for (const std::uint32_t row : order.rows()) cell_of.push_back(static_cast<std::uint32_t>(cells.index(points[row])));
    cell_of.erase(std::unique(cell_of.begin(), cell_of.end()), cell_of.end());
    const std::size_t runs = cell_of.size();
    std::sort(cell_of.begin(), cell_of.end());
    CHECK(std::adjacent_find(cell_of.begin(), cell_of.end()) == cell_of.end());
    CHECK(runs > count / 20);
    for (const auto& box : boxes_of(order, points)) {
      const dmp::Vector<dim> extent = box.upper - box.lower;
      CHECK(extent.maxCoeff() <= 2.0 * extent.minCoeff());
    }
    CHECK(order.bounds().size() - 1 >= 7);
    CHECK(order.bounds().size() - 1 <= 29);
  }
}

TEST_CASE("the order does not depend on the number of threads, and rows of one cell keep theirs") {
  const auto points = test::clustered<2>(30000, 1.0, 5);
  Rows first;
  std::vector<std::size_t> bounds;
  for (const int count : {1, 2, 3, 4}) {
    const test::Threads threads(count);
    SpatialOrder<2> order;
    order.build(points, 0.01, 4.0);
    if (first.empty()) {
      first.assign(order.rows().begin(), order.rows().end());
      bounds.assign(order.bounds().begin(), order.bounds().end());
    }
    CHECK(std::equal(first.begin(), first.end(), order.rows().begin(), order.rows().end()));
    CHECK(std::equal(bounds.begin(), bounds.end(), order.bounds().begin(), order.bounds().end()));
  }
  SpatialOrder<2> order;
  order.build(test::Cloud<2>(100, dmp::Vector<2>(0.3, 0.4)), 0.1, 1.0);
  CHECK(std::is_sorted(order.rows().begin(), order.rows().end()));
}

TEST_CASE("an order taken a second time changes nothing") {
  const auto points = test::scattered<3>(20000, 1.0, 6);
  SpatialOrder<3> order;
  order.build(points, 0.05, 2.5);
  test::Cloud<3> sorted;
  for (const std::uint32_t row : order.rows()) sorted.push_back(points[row]);
  const std::vector<std::size_t> bounds(order.bounds().begin(), order.bounds().end());
  order.build(sorted, 0.05, 2.5);
  CHECK(std::is_sorted(order.rows().begin(), order.rows().end()));
  CHECK(std::equal(bounds.begin(), bounds.end(), order.bounds().begin(), order.bounds().end()));
}
