#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>
#include "neighbours/oracle.hpp"
#include <doctest/doctest.h>
#include <dmp/neighbours/bond_list.hpp>
#include <dmp/neighbours/relative_motion.hpp>

using dmp::Vector;
using dmp::geometry::Box;
using dmp::neighbours::Bounds;
using dmp::neighbours::RelativeMotion;

namespace {

/// Particles, where they were when lists were built and how far they have moved since, in blocks as a scene keeps them.
template <int Dim>
struct Motion {
  test::Cloud<Dim> points, moved;
  Box<Dim> box;
  double reach;  // a fifth of it is skin
  RelativeMotion<Dim> motion{};
  std::vector<std::uint32_t> cell{};
  test::Cloud<Dim> now{};
  std::vector<typename RelativeMotion<Dim>::Followed> groups{};

  /// `block`: rows of a block; runs of one cell are cut where it ends. Rows before and after the middle are two groups.
  double used(std::size_t block = 3) {
    const auto found = wear(block);
    return std::max(found.nearby, found.afar);
  }
  typename RelativeMotion<Dim>::Wear wear(std::size_t block = 3) {
    Bounds<Dim> bounds;
    for (const auto& x : points) bounds.add(x);
    motion.build(bounds, box, 0.8 * reach, 0.2 * reach, points.size());
    cell.assign(points.size(), 0);
    groups.clear();
    now = points;
    for (std::size_t i = 0; i < points.size(); ++i) now[i] += moved[i];
    const std::size_t half = points.size() / 2;
    follow(0, half, block);
    follow(half, points.size(), block);
    motion.find_occupied();
    return motion.find_wear();
  }
  /// Whether two that are not in the lists may act on each other now.
  bool worn(double shortest) {
    const auto found = wear();
    return found.afar > 0.2 * reach || (found.nearby > 0.2 * reach && motion.have_met(groups, shortest));
  }
  void follow(std::size_t first, std::size_t last, std::size_t block) {
    std::vector<std::size_t> bounds{0};
    while (bounds.back() < last - first) bounds.push_back(std::min(bounds.back() + block, last - first));
    if (bounds.size() == 1) bounds.push_back(0);
    dmp::Blocks blocks;
    blocks.set_bounds(bounds);
    std::vector<std::size_t> first_run;
    const auto then = std::span<const Vector<Dim>>(points).subspan(first, last - first);
    motion.follow(blocks, then, first_run);
    groups.push_back({first_run.front(), then, std::span<const Vector<Dim>>(now).subspan(first, last - first)});
    for (std::size_t b = 0; b < blocks.size(); ++b)
      motion.for_each_run(first_run, b, [&](std::size_t number, const dmp::neighbours::Run& run) {
        Bounds<Dim> displacement;
        for (std::size_t i = run.first; i < run.end; ++i) {
          displacement.add(moved[first + i]);
          cell[first + i] = run.cell;
        }
        motion.set_displacement(number, displacement);
      });
  }
  /// The largest relative displacement of two that were within `distance` of each other.
  [[nodiscard]] double largest_relative(double distance) const {
    double result = 0.0;
    for_each_pair(-1, [&](const Vector<Dim>& before, const Vector<Dim>& relative) {
      if (before.squaredNorm() <= distance * distance) result = std::max(result, relative.norm());
    });
    return result;
  }
  /// By how much the distance of two that were within the reach of each other has become less, at most, of particle i or (-1) of all.
  [[nodiscard]] double largest_approach(std::int64_t of = -1) const {
    double result = 0.0;
    for_each_pair(of, [&](const Vector<Dim>& before, const Vector<Dim>& relative) {
      if (before.norm() <= reach) result = std::max(result, before.norm() - (before + relative).norm());
    });
    return result;
  }
  /// How much nearer than the reach two have come that were farther apart.
  [[nodiscard]] double come_near() const {
    double result = 0.0;
    for_each_pair(-1, [&](const Vector<Dim>& before, const Vector<Dim>& relative) {
      if (before.norm() > reach) result = std::max(result, reach - (before + relative).norm());
    });
    return result;
  }

 private:
  /// Calls function(separation, change of it) for pairs, by all images where the box is periodic.
  template <class Function>
  void for_each_pair(std::int64_t of, const Function& function) const {
    for (std::uint32_t j = 0; j < points.size(); ++j)
      test::for_each_image<Dim>(j, box, [&](const test::Image<Dim>& image) {
        Vector<Dim> there = points[j];
        for (int d = 0; d < Dim; ++d)
          if (box.periodic[static_cast<std::size_t>(d)]) there[d] += image.second[static_cast<std::size_t>(d)] * box.extent()[d];
        const std::size_t first = of < 0 ? 0 : static_cast<std::size_t>(of), end = of < 0 ? points.size() : first + 1;
        for (std::size_t i = first; i < end; ++i) function(points[i] - there, moved[i] - moved[j]);
      });
  }
};

/// What is found bounds from above the relative motion of neighbours, for every particle too, and how near others have come.
template <int Dim>
void check_against_every_pair(test::Cloud<Dim> points, const std::array<bool, Dim>& periodic,
                              const std::function<Vector<Dim>(const Vector<Dim>&)>& displacement) {
  for (const double reach : {0.04, 0.11, 0.3, 0.45}) {
    CAPTURE(reach);
    Motion<Dim> motion{.points = points, .moved = {}, .box = test::cube<Dim>(1.0, periodic), .reach = reach};
    for (const auto& x : points) motion.moved.push_back(displacement(x));
    const double found = motion.used();
    CHECK(found >= motion.largest_approach() - 1e-14);
    CHECK(found >= motion.come_near() - 1e-14);
    CHECK(found <= std::sqrt(Dim) * motion.largest_relative(INFINITY) * (1.0 + 1e-14));
    CHECK_FALSE((motion.come_near() > 0.2 * reach && !motion.worn(0.8 * reach)));
    double largest_used = 0.0;
    int too_small = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      largest_used = std::max(largest_used, motion.motion.used(motion.cell[i]));
      too_small += motion.motion.used(motion.cell[i]) < motion.largest_approach(static_cast<std::int64_t>(i)) - 1e-14;
    }
    CHECK(too_small == 0);
    CHECK(largest_used <= found);
    CHECK(largest_used <= std::sqrt(Dim) * motion.largest_relative(std::sqrt(Dim) * 5.2 * reach) * (1.0 + 1e-14));
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
  const auto one_moves = [](const Vector<Dim>& x) {
    return Vector<Dim>((x - Vector<Dim>::Constant(-0.5)).norm() < 0.05 ? Vector<Dim>::Constant(-0.2) : Vector<Dim>::Zero());
  };
  const auto drift_and_jitter = [&](const Vector<Dim>& x) { return Vector<Dim>(Vector<Dim>::Constant(64.0) + 0.01 * jitter(x)); };
  const std::vector<std::function<Vector<Dim>(const Vector<Dim>&)>> displacements{jitter, shear, one_moves, drift_and_jitter};
  constexpr int per_side = Dim == 1 ? 64 : Dim == 2 ? 12 : 6;
  for (const auto& displacement : displacements)
    for (const auto& points : {test::scattered<Dim>(130, 1.0, 2), test::clustered<Dim>(130, 1.0, 3), test::lattice<Dim>(per_side, 1.0)})
      check_against_every_pair<Dim>(points, periodic, displacement);
}

}  // namespace

TEST_CASE("no two neighbours have approached each other by more than is found, nor have others come nearer, on the line") {
  check_motions<1>({false});
  check_motions<1>({true});
}
TEST_CASE("no two neighbours have approached each other by more than is found, nor have others come nearer, in the plane") {
  check_motions<2>({false, false});
  check_motions<2>({true, true});
  check_motions<2>({false, true});
}
TEST_CASE("no two neighbours have approached each other by more than is found, nor have others come nearer, in space") {
  check_motions<3>({false, false, false});
  check_motions<3>({true, true, true});
  check_motions<3>({true, false, true});
}

TEST_CASE_TEMPLATE("what moves along together wears no lists: exactly 0, however far it has gone", Dimension,
                   std::integral_constant<int, 1>, std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int dim = Dimension::value;
  for (const double far : {0.0, 0.1, 1.0, 1e6, 1e200}) {
    const auto points = test::scattered<dim>(300, 1.0, 1);
    std::array<bool, dim> periodic;
    periodic.fill(true);
    const auto moved = test::Cloud<dim>(300, Vector<dim>::Constant(-far));
    Motion<dim> motion{.points = points, .moved = moved, .box = test::cube<dim>(1.0, periodic), .reach = 0.2};
    CHECK(motion.used() == 0.0);
  }
}

TEST_CASE("how far the farthest has gone along an axis, whoever goes with it") {
  Motion<2> motion{.points = test::scattered<2>(300, 1.0, 1),
                   .moved = test::Cloud<2>(300, Vector<2>(0.25, -3.0)),
                   .box = test::cube<2>(1.0, {true, true}),
                   .reach = 0.2};
  CHECK(motion.used() == 0.0);
  CHECK(motion.wear().farthest == 3.0);
  motion.moved[17] = Vector<2>(5.0, 0.0);
  CHECK(motion.used() > 0.0);
  CHECK(motion.wear().farthest == 5.0);
}

TEST_CASE("how two move is none of each other's affair unless they were neighbours, also through a periodic face") {
  const auto used = [](double a, double b, double way, bool periodic) {
    Motion<1> motion{.points = {Vector<1>(a), Vector<1>(b), Vector<1>(-0.5), Vector<1>(0.49)},
                     .moved = {Vector<1>(way), Vector<1>(-way)},
                     .box = test::cube<1>(1.0, {periodic}),
                     .reach = 0.1};
    motion.moved.push_back(motion.points[0][0] < -0.3 ? motion.moved[0] : motion.moved[1]);  // those at the ends go with their neighbours
    motion.moved.push_back(motion.points[0][0] > 0.3 ? motion.moved[0] : motion.moved[1]);
    return motion.used();
  };
  CHECK(used(0.0, 0.05, 0.05, false) == doctest::Approx(0.1).epsilon(1e-14));
  CHECK(used(-0.45, 0.45, -0.05, false) == 0.0);
  CHECK(used(-0.45, 0.45, -0.05, true) == doctest::Approx(0.1).epsilon(1e-14));
  CHECK(used(-0.45, 0.45, 0.05, true) == 0.0);  // away from each other
}

TEST_CASE("two that come from afar have used up the skin before they meet, whatever lies between them, also through a periodic face") {
  // Reach 0.1, cut-off 0.08, cells of 0.11 in a box of 9 of them: the two begin 0.101 to 0.45 apart, with nobody in between.
  for (const bool periodic : {false, true})
    for (const double apart : {0.101, 0.109, 0.12, 0.15, 0.2, 0.25, 0.3, 0.45})
      for (const double share : {0.5, 1.0, 0.2}) {  // of the way that the first one goes
        CAPTURE(apart);
        CAPTURE(share);
        const double first = periodic ? 0.49 - 0.5 * apart : -0.5 * apart, second = periodic ? -0.51 + 0.5 * apart : 0.5 * apart;
        Motion<1> motion{.points = {Vector<1>(first), Vector<1>(second), Vector<1>(-0.2), Vector<1>(0.3)},
                         .moved = test::Cloud<1>(4, Vector<1>(0.0)), .box = test::cube<1>(1.0, {periodic}), .reach = 0.1};
        const double way = apart - 0.079;  // inside the cut-off
        motion.moved[0] = Vector<1>(share * way);
        motion.moved[1] = Vector<1>((share - 1.0) * way);
        const auto wear = motion.wear();
        CHECK((std::max(wear.nearby, wear.afar) > 0.02 || wear.farthest > 0.08));
        CHECK((motion.worn(0.08) || wear.farthest > 0.08));
      }
}

TEST_CASE("two streams that pass each other at a distance of three cells use up nothing, until they might have met") {
  const auto used = [](double way) {
    test::Cloud<2> points = test::lattice<2>(40, 1.0), moved;
    std::erase_if(points, [](const Vector<2>& x) { return std::fabs(x[1]) < 0.2; });
    for (const auto& x : points) moved.push_back(Vector<2>(x[1] > 0.0 ? 0.5 * way : -0.5 * way, 0.0));
    return Motion<2>{.points = points, .moved = moved, .box = test::cube<2>(1.0, {true, false}), .reach = 0.1}.used();
  };
  CHECK(used(0.12) == 0.0);
  CHECK(used(0.2) > 0.02);
}

TEST_CASE("a place where nobody moves uses up nothing, though others elsewhere do") {
  Motion<2> motion{.points = test::lattice<2>(20, 1.0), .moved = {}, .box = test::cube<2>(1.0, {true, true}), .reach = 0.1};
  for (const auto& x : motion.points) motion.moved.push_back(x.norm() < 0.1 ? 0.3 * x : Vector<2>(Vector<2>::Zero()));
  CHECK(motion.used() > 0.0);
  for (std::size_t i = 0; i < motion.points.size(); ++i)
    if (motion.points[i].norm() > 0.1 + 2.0 * 0.2 * std::sqrt(2.0)) CHECK(motion.motion.used(motion.cell[i]) == 0.0);
}

TEST_CASE("what is found depends neither on the number of threads nor on the blocks; it is nothing before anybody has moved") {
  double first = -1.0;
  for (const int count : {1, 2, 4}) {
    const test::Threads threads(count);
    Motion<2> motion{.points = test::scattered<2>(3000, 1.0, 1),
                     .moved = test::scattered<2>(3000, 0.1, 2),
                     .box = test::cube<2>(1.0, {true, false}),
                     .reach = 0.02};
    const double found = motion.used(static_cast<std::size_t>(1000 / count));
    if (first < 0.0) first = found;
    CHECK(found == first);
    motion.moved.assign(motion.points.size(), Vector<2>::Zero());
    CHECK(motion.used() == 0.0);
    CHECK(motion.motion.used(motion.cell[0]) == 0.0);
  }
}

TEST_CASE("particles that have got lost do not hide that others have moved; without any particle nothing has moved") {
  Motion<2> lost{.points = {{0.0, 0.0}, {0.05, 0.0}, {0.4, 0.4}},
                 .moved = {{0.0, 0.0}, {0.3, 0.0}, {NAN, NAN}},
                 .box = test::cube<2>(1.0),
                 .reach = 0.1};
  CHECK_FALSE(lost.used() <= 0.2);
  Motion<2> nobody{.points = {}, .moved = {}, .box = test::cube<2>(1.0, {true, true}), .reach = 0.1};
  CHECK(nobody.used() == 0.0);
}

TEST_CASE("a few particles, however far apart, are followed with little memory") {
  Motion<3> few{.points = {{0.0, 0.0, 0.0}, {0.05, 0.0, 0.0}, {1e5, 1e5, 1e5}},
                .moved = test::Cloud<3>(3, Vector<3>::Zero()),
                .box = test::cube<3>(1e6),
                .reach = 0.1};
  few.moved[1] = {0.3, 0.0, 0.0};
  CHECK(few.used() >= 0.3);
  CHECK(few.motion.bytes() < 20000);
}

TEST_CASE_TEMPLATE("two that come near each other across a cell where nobody is are seen, along every axis", Dimension,
                   std::integral_constant<int, 1>, std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int dim = Dimension::value;
  const double reach = 0.1;
  int unseen = 0, near = 0;
  for (int axis = 0; axis < dim; ++axis)
    for (double gap = 1.01 * reach; gap < 2.4 * reach; gap += 0.07 * reach)
      for (double middle = 0.3; middle < 0.7; middle += 0.031) {
        const Vector<dim> apart = 0.5 * gap * Vector<dim>::Unit(axis), approach = (0.5 * gap - 0.2 * reach) * Vector<dim>::Unit(axis);
        const Vector<dim> centre = Vector<dim>::Constant(middle), corner = Vector<dim>::Ones();
        Motion<dim> motion{.points = {centre - apart, centre + apart, Vector<dim>::Zero(), corner},  // the corners keep the cells small
                           .moved = {approach, -approach, Vector<dim>::Zero(), Vector<dim>::Zero()},
                           .box = test::cube<dim>(1.0, {}),
                           .reach = reach};
        near += motion.come_near() > 0.5 * reach ? 1 : 0;
        unseen += motion.used() < motion.come_near() - 1e-14 ? 1 : 0;
      }
  CHECK(unseen == 0);
  CHECK(near >= 100);
}

TEST_CASE_TEMPLATE("in a flow that widens the lists wear half as fast as in one that narrows", Dimension, std::integral_constant<int, 1>,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int dim = Dimension::value;
  const auto used = [](double strain) {
    Motion<dim> motion{.points = test::lattice<dim>(16, 1.0), .moved = {}, .box = test::cube<dim>(1.0, {}), .reach = 0.15};
    for (const auto& x : motion.points) motion.moved.push_back(strain * x);
    return motion.used();
  };
  CHECK(used(0.01) > 0.0);
  CHECK(used(0.01) <= 0.5 * used(-0.01) * (1.0 + 1e-12));
}

TEST_CASE("where a layer slides on another, lists are worn when two have met that were not listed, no sooner and no later") {
  for (const std::size_t along : {std::size_t{0}, std::size_t{1}})
    for (const bool periodic : {true, false}) {  // the latter in all of space
      CAPTURE(along);
      CAPTURE(periodic);
      const auto x = static_cast<int>(along), y = 1 - x;
      std::array<bool, 2> faces{};
      faces[along] = periodic;
      const Box<2> box = periodic ? test::cube<2>(1.0, faces) : Box<2>::unbounded();
      Motion<2> motion{.points = test::lattice<2>(60, 1.0), .moved = {}, .box = box, .reach = 0.06};
      int bounds_exceed = 0, have_met = 0;
      for (double way = 0.6e-2; way < 1.7e-2; way += 0.1e-2) {
        motion.moved.assign(motion.points.size(), Vector<2>::Zero());
        for (std::size_t i = 0; i < motion.points.size(); ++i)
          if (motion.points[i][y] > 0.1) motion.moved[i][x] = way;
        const bool met = motion.come_near() > 0.2 * motion.reach;
        CHECK(motion.worn(0.8 * motion.reach) == met);
        bounds_exceed += motion.used() > 0.2 * motion.reach && !met ? 1 : 0;
        have_met += met ? 1 : 0;
      }
      CHECK(bounds_exceed > 0);
      CHECK(have_met > 0);
    }
}

TEST_CASE("in a crowd of more than fit at once everybody is looked at") {
  const double reach = 0.1;
  test::Random random(3);
  test::Cloud<2> points;
  for (int k = 0; k < 200; ++k)  // two heaps, a little more than the reach apart
    points.emplace_back((k < 90 ? 0.0 : 1.05 * reach) + 1e-6 * random(), 1e-6 * random());
  for (const auto& x : test::lattice<2>(75, 1.0)) points.push_back(x + Vector<2>(1.2, 0.0));  // others, who make it worth while
  Motion<2> crowd{.points = points, .moved = {}, .box = test::cube<2>(4.0, {}), .reach = reach};
  int overlooked = 0, mistaken = 0;
  for (std::size_t one = 0; one < 90; one += 11)
    for (std::size_t other = 90; other < 200; other += 13) {
      crowd.moved.assign(points.size(), Vector<2>::Zero());
      crowd.moved[one] = {0.126 * reach, 0.0};
      crowd.moved[other] = {-0.126 * reach, 0.0};
      overlooked += crowd.worn(0.8 * reach) ? 0 : 1;
      crowd.moved[other] = {-0.122 * reach, 0.0};
      CHECK(crowd.used() > 0.2 * reach);
      mistaken += crowd.worn(0.8 * reach) ? 1 : 0;
    }
  CHECK(overlooked == 0);
  CHECK(mistaken == 0);
}

TEST_CASE("two cut-offs: lists of the shorter one lack pairs that those of the longer one hold") {
  Motion<1> motion{.points = {Vector<1>(0.0), Vector<1>(0.08), Vector<1>(0.9)},
                   .moved = test::Cloud<1>(3, Vector<1>(0.0)),
                   .box = test::cube<1>(2.0),
                   .reach = 0.1};
  motion.points.insert(motion.points.end(), 60, Vector<1>(0.9));  // others, who make it worth while
  motion.moved.insert(motion.moved.end(), 60, Vector<1>(0.0));
  motion.moved[0] = Vector<1>(0.021);  // 0.059 apart; the skin is 0.02
  CHECK_FALSE(motion.worn(0.08));
  CHECK_FALSE(motion.worn(0.0601));  // listed by both
  CHECK(motion.worn(0.0599));
  CHECK(motion.worn(0.04));
  motion.moved[0] = Vector<1>(0.019);
  CHECK_FALSE(motion.worn(0.04));
}

TEST_CASE("where all move about, new lists are worth more than to look at every pair") {
  Motion<2> motion{.points = test::lattice<2>(30, 1.0), .moved = {}, .box = test::cube<2>(1.0, {true, true}), .reach = 0.2};
  for (const auto& x : motion.points) motion.moved.push_back(Vector<2>(-0.15 * x[1], 0.15 * x[0]));  // a rotation: nobody meets
  CHECK(motion.used() > 0.2 * motion.reach);
  CHECK(motion.worn(0.8 * motion.reach));
}
