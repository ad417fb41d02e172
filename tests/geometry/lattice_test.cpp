#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>
#include <dmp/geometry/fill.hpp>
#include <dmp/geometry/lattice.hpp>
#include "support/compare.hpp"

using namespace dmp::geometry;
using dmp::Vector;

namespace {

/// Distance from the point nearest to `centre` to its nearest neighbour, and how many points lie that near, by looking at all.
template <int Dim>
std::pair<double, int> nearest_neighbours(const std::vector<Vector<Dim>>& x, const Vector<Dim>& centre) {
  const auto nearer = [&](const auto& a, const auto& b) { return (a - centre).norm() < (b - centre).norm(); };
  const auto middle = std::min_element(x.begin(), x.end(), nearer);
  double nearest = 1e300;
  for (const auto& other : x)
    if (&other != &*middle) nearest = std::min(nearest, (other - *middle).norm());
  const auto near = [&](const auto& other) { return (other - *middle).norm() < nearest * (1.0 + 1e-9); };
  const auto count = std::count_if(x.begin(), x.end(), near);
  return {nearest, static_cast<int>(count) - 1};
}

template <class L>
void check_lattice(const L& lattice, double volume, int neighbours) {
  constexpr int dim = L::dimension;
  CHECK(volume_per_point(lattice) == doctest::Approx(volume).epsilon(1e-14));
  const Vector<dim> edges = lattice.cell();
  const Vector<dim> lower = lattice.origin, upper = lower + 6.0 * edges;
  const auto points = fill(lattice, {.lower = lower, .upper = upper});
  CHECK(points.positions.size() == lattice.sites().size() * static_cast<std::size_t>(std::pow(6, dim)));
  CHECK(static_cast<double>(points.positions.size()) * volume == doctest::Approx((upper - lower).prod()).epsilon(1e-12));
  const auto [nearest, count] = nearest_neighbours<dim>(points.positions, 0.5 * (lower + upper));
  CHECK(nearest == doctest::Approx(lattice.nearest_distance()).epsilon(1e-12));
  CHECK(count == neighbours);

  Vector<dim> centre = Vector<dim>::Zero();  // whole cells are filled alike from all walls
  for (const auto& x : points.positions) centre += x / static_cast<double>(points.positions.size());
  CHECK((centre - 0.5 * (lower + upper)).norm() < 1e-12 * edges.norm());
}

}  // namespace

static_assert(Lattice<Cubic<1>> && Lattice<Cubic<3>> && Lattice<Hexagonal> && Lattice<FaceCentredCubic> && !Lattice<Vector<2>>);

TEST_CASE("lattices: stated volume per point, points per cell, nearest distance and number of neighbours are those of the points") {
  const double s = 0.3;
  check_lattice(Cubic<1>{.spacing = s, .origin = Vector<1>{-0.1}}, s, 2);
  check_lattice(Cubic<2>{.spacing = s, .origin = {0.05, -0.2}}, s * s, 4);
  check_lattice(Cubic<3>{.spacing = s}, s * s * s, 6);
  check_lattice(Hexagonal{.spacing = s, .origin = {0.01, 0.02}}, std::sqrt(3.0) / 2.0 * s * s, 6);
  check_lattice(FaceCentredCubic{.lattice_constant = s, .origin = {1.0, 2.0, 3.0}}, s * s * s / 4.0, 12);
}

TEST_CASE("lattices: FCC has 4 points per cell and packs balls to pi / sqrt(18), hexagonal discs to pi / sqrt(12)") {
  const FaceCentredCubic fcc{.lattice_constant = 2.0};
  CHECK(fill(fcc, {.lower = {0, 0, 0}, .upper = {2, 2, 2}}).positions.size() == 4);
  const double ball = std::numbers::pi / 6.0 * std::pow(fcc.nearest_distance(), 3);
  CHECK(ball / volume_per_point(fcc) == doctest::Approx(std::numbers::pi / std::sqrt(18.0)).epsilon(1e-12));
  const Hexagonal hexagonal{.spacing = 0.7};
  const double disc = std::numbers::pi / 4.0 * std::pow(hexagonal.nearest_distance(), 2);
  CHECK(disc / volume_per_point(hexagonal) == doctest::Approx(std::numbers::pi / std::sqrt(12.0)).epsilon(1e-12));
}

TEST_CASE("lattices: the points of a cubic lattice lie at origin + (i + 1/2) spacing") {
  const auto points = fill(Cubic<2>{.spacing = 0.5, .origin = {1.0, 2.0}}, {.lower = {1, 2}, .upper = {2, 3}});
  const std::vector<Vector<2>> expected{{1.25, 2.25}, {1.75, 2.25}, {1.25, 2.75}, {1.75, 2.75}};
  CHECK(points.positions == expected);
}

TEST_CASE("lattices: bad parameters are refused by name") {
  const double nan = std::nan("");
  CHECK(test::complaint_about(Cubic<2>{.spacing = 0.0}) == "geometry::Cubic: spacing must be finite and > 0 m, got 0");
  CHECK(test::complaint_about(Cubic<2>{.spacing = 1.0, .origin = {nan, 0}}) == "geometry::Cubic: origin must be finite [m], got nan");
  CHECK(test::complaint_about(Hexagonal{.spacing = -1.0}) == "geometry::Hexagonal: spacing must be finite and > 0 m, got -1");
  CHECK(test::complaint_about(Hexagonal{.spacing = 1.0, .origin = {0, nan}}) == "geometry::Hexagonal: origin must be finite [m], got nan");
  CHECK(test::complaint_about(FaceCentredCubic{.lattice_constant = nan}) ==
        "geometry::FaceCentredCubic: lattice_constant must be finite and > 0 m, got nan");
  CHECK(test::complaint_about(FaceCentredCubic{.lattice_constant = 1.0, .origin = {0, 0, nan}}) ==
        "geometry::FaceCentredCubic: origin must be finite [m], got nan");
}
