#include <algorithm>
#include <cmath>
#include <functional>
#include "neighbours/oracle.hpp"
#include <doctest/doctest.h>
#include <dmp/neighbours/bond_list.hpp>
#include <dmp/neighbours/relative_motion.hpp>

using dmp::Vector;
using dmp::geometry::Box;
using dmp::neighbours::Bounds;
using dmp::neighbours::RelativeMotion;
using dmp::neighbours::Run;

namespace {

/// Particles, where they were when lists were built and how far they have moved since, in runs of one cell each as a scene keeps them.
template <int Dim>
struct Motion {
  test::Cloud<Dim> points, moved;
  Box<Dim> box;
  double reach;
  RelativeMotion<Dim> motion{};
  std::vector<std::uint32_t> cell{};

  /// `longest_run`: what is longer is cut into several runs of one cell, as blocks do.
  double finish(std::size_t longest_run = 3) {
    Bounds<Dim> bounds;
    for (const auto& x : points) bounds.add(x);
    motion.build(bounds, box, reach, points.size());
    cell.clear();
    std::vector<Run<Dim>> runs;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      cell.push_back(motion.cell_of(points[i]));
      if (runs.empty() || runs.back().cell != cell.back() || i - runs.back().first >= longest_run) {
        runs.push_back({i, cell.back()});
        runs.back().displacement = Bounds<Dim>{};
      }
      runs.back().displacement.add(moved[i]);
    }
    motion.start();
    const std::span<const Run<Dim>> all(runs);  // of two groups, say
    motion.add(all.first(runs.size() / 2));
    motion.add(all.subspan(runs.size() / 2));
    return motion.finish();
  }
  /// The largest relative displacement of two that were within `distance` of each other, of particle i or (-1) of all.
  [[nodiscard]] double largest(double distance, std::int64_t of = -1) const {
    double result = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (of >= 0 && static_cast<std::size_t>(of) != i) continue;
      for (std::size_t j = 0; j < points.size(); ++j)
        if (dmp::neighbours::minimum_image<Dim>(points[i] - points[j], box).squaredNorm() <= distance * distance)
          result = std::max(result, (moved[i] - moved[j]).norm());
    }
    return result;
  }
};

/// What is found bounds the relative motion of neighbours from above, and that of all within a few reaches from below; for every particle.
template <int Dim>
void check_against_every_pair(test::Cloud<Dim> points, const std::array<bool, Dim>& periodic, const std::function<Vector<Dim>(const Vector<Dim>&)>& displacement) {
  for (const double reach : {0.04, 0.11, 0.3, 0.45}) {
    CAPTURE(reach);
    Motion<Dim> motion{.points = points, .moved = {}, .box = test::cube<Dim>(1.0, periodic), .reach = reach};
    for (const auto& x : points) motion.moved.push_back(displacement(x));
    const double found = motion.finish();
    CHECK(found >= motion.largest(reach) * (1.0 - 1e-14));
    CHECK(found <= std::sqrt(Dim) * motion.largest(std::sqrt(Dim) * 5.0 * reach) * (1.0 + 1e-14));
    double largest_used = 0.0;
    int too_small = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      largest_used = std::max(largest_used, motion.motion.used(motion.cell[i]));
      too_small += motion.motion.used(motion.cell[i]) < motion.largest(reach, static_cast<std::int64_t>(i)) * (1.0 - 1e-14);
    }
    CHECK(too_small == 0);
    CHECK(largest_used == found);
  }
}

template <int Dim>
void check_motions(const std::array<bool, Dim>& periodic) {
  test::Random random(1);
  const auto jitter = [&](const Vector<Dim>&) {
    Vector<Dim> u;
    for (int d = 0; d < Dim; ++d) u[d] = random() - 0.5;
    return u;
  };
  const auto shear = [](const Vector<Dim>& x) { return Vector<Dim>(0.3 * Vector<Dim>::Ones() * x[Dim - 1]); };
  const auto one_moves = [](const Vector<Dim>& x) { return Vector<Dim>((x - Vector<Dim>::Constant(-0.5)).norm() < 0.05 ? Vector<Dim>::Constant(-0.2) : Vector<Dim>::Zero()); };
  const auto drift_and_jitter = [&](const Vector<Dim>& x) { return Vector<Dim>(Vector<Dim>::Constant(64.0) + 0.01 * jitter(x)); };
  for (const std::function<Vector<Dim>(const Vector<Dim>&)>& displacement : {std::function<Vector<Dim>(const Vector<Dim>&)>(jitter), std::function<Vector<Dim>(const Vector<Dim>&)>(shear),
                                                                             std::function<Vector<Dim>(const Vector<Dim>&)>(one_moves), std::function<Vector<Dim>(const Vector<Dim>&)>(drift_and_jitter)})
    for (const auto& points : {test::scattered<Dim>(130, 1.0, 2), test::clustered<Dim>(130, 1.0, 3), test::lattice<Dim>(Dim == 1 ? 64 : Dim == 2 ? 12 : 6, 1.0)})
      check_against_every_pair<Dim>(points, periodic, displacement);
}

}  // namespace

TEST_CASE("no two neighbours have moved relative to each other by more than is found, on the line") {
  check_motions<1>({false});
  check_motions<1>({true});
}
TEST_CASE("no two neighbours have moved relative to each other by more than is found, in the plane") {
  check_motions<2>({false, false});
  check_motions<2>({true, true});
  check_motions<2>({false, true});
}
TEST_CASE("no two neighbours have moved relative to each other by more than is found, in space") {
  check_motions<3>({false, false, false});
  check_motions<3>({true, true, true});
  check_motions<3>({true, false, true});
}

TEST_CASE_TEMPLATE("what moves along together wears no lists: exactly 0, however far it has gone", Dimension, std::integral_constant<int, 1>,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int dim = Dimension::value;
  for (const double far : {0.0, 0.1, 1.0, 1e6, 1e200}) {
    const auto points = test::scattered<dim>(300, 1.0, 1);
    std::array<bool, dim> periodic;
    periodic.fill(true);
    Motion<dim> motion{.points = points, .moved = test::Cloud<dim>(300, Vector<dim>::Constant(-far)), .box = test::cube<dim>(1.0, periodic), .reach = 0.2};
    CHECK(motion.finish() == 0.0);
  }
}

TEST_CASE("how far the farthest has gone along an axis, whoever goes with it") {
  Motion<2> motion{.points = test::scattered<2>(300, 1.0, 1), .moved = test::Cloud<2>(300, Vector<2>(0.25, -3.0)), .box = test::cube<2>(1.0, {true, true}), .reach = 0.2};
  CHECK(motion.finish() == 0.0);
  CHECK(motion.motion.farthest() == 3.0);
  motion.moved[17] = Vector<2>(5.0, 0.0);
  CHECK(motion.finish() > 0.0);
  CHECK(motion.motion.farthest() == 5.0);
  motion.motion.start();
  CHECK(motion.motion.farthest() == 0.0);
}

TEST_CASE("two that fly apart are none of each other's affair unless they were neighbours, also through a periodic face") {
  const auto apart = [](double a, double b, bool periodic) {
    Motion<1> motion{.points = {Vector<1>(a), Vector<1>(b), Vector<1>(-0.5), Vector<1>(0.49)}, .moved = {Vector<1>(1.0), Vector<1>(-1.0)}, .box = test::cube<1>(1.0, {periodic}), .reach = 0.1};
    motion.moved.push_back(motion.points[0][0] < -0.3 ? motion.moved[0] : motion.moved[1]);  // those at the ends go with their neighbours
    motion.moved.push_back(motion.points[0][0] > 0.3 ? motion.moved[0] : motion.moved[1]);
    return motion.finish();
  };
  CHECK(apart(0.0, 0.05, false) == 2.0);
  CHECK(apart(-0.45, 0.45, false) == 0.0);
  CHECK(apart(-0.45, 0.45, true) == 2.0);
}

TEST_CASE("a place where nobody moves uses up nothing, though others elsewhere do") {
  Motion<2> motion{.points = test::lattice<2>(20, 1.0), .moved = {}, .box = test::cube<2>(1.0, {true, true}), .reach = 0.1};
  for (const auto& x : motion.points) motion.moved.push_back(x.norm() < 0.1 ? 0.3 * x : Vector<2>(Vector<2>::Zero()));
  CHECK(motion.finish() > 0.0);
  for (std::size_t i = 0; i < motion.points.size(); ++i)
    if (motion.points[i].norm() > 0.1 + 2.0 * 0.2 * std::sqrt(2.0)) CHECK(motion.motion.used(motion.cell[i]) == 0.0);
}

TEST_CASE("a start forgets what was added; what is found does not depend on the number of threads") {
  double first = -1.0;
  for (const int count : {1, 2, 4}) {
    const test::Threads threads(count);
    Motion<2> motion{.points = test::scattered<2>(3000, 1.0, 1), .moved = test::scattered<2>(3000, 0.1, 2), .box = test::cube<2>(1.0, {true, false}), .reach = 0.02};
    const double found = motion.finish();
    if (first < 0.0) first = found;
    CHECK(found == first);
    motion.motion.start();
    CHECK(motion.motion.finish() == 0.0);
    CHECK(motion.motion.used(motion.cell[0]) == 0.0);
  }
}

TEST_CASE("particles that have got lost do not hide that others have moved; without any particle nothing has moved") {
  Motion<2> lost{.points = {{0.0, 0.0}, {0.05, 0.0}, {0.4, 0.4}}, .moved = {{0.0, 0.0}, {0.3, 0.0}, {NAN, NAN}}, .box = test::cube<2>(1.0), .reach = 0.1};
  CHECK_FALSE(lost.finish() <= 0.2);
  Motion<2> nobody{.points = {}, .moved = {}, .box = test::cube<2>(1.0, {true, true}), .reach = 0.1};
  CHECK(nobody.finish() == 0.0);
}

TEST_CASE("a few particles, however far apart, are followed with little memory") {
  Motion<3> few{.points = {{0.0, 0.0, 0.0}, {0.05, 0.0, 0.0}, {1e5, 1e5, 1e5}}, .moved = test::Cloud<3>(3, Vector<3>::Zero()), .box = test::cube<3>(1e6), .reach = 0.1};
  few.moved[1] = {0.3, 0.0, 0.0};
  CHECK(few.finish() >= 0.3);
  CHECK(few.motion.bytes() < 10000);
}
