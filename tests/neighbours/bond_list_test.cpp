#include <algorithm>
#include <cmath>
#include <limits>
#include "neighbours/oracle.hpp"
#include <doctest/doctest.h>
#include <dmp/neighbours/bond_list.hpp>

using dmp::Vector;
using dmp::geometry::Box;
using dmp::neighbours::Bond;
using dmp::neighbours::BondList;
using dmp::neighbours::complete_bonds;

namespace {

const test::Cloud<2> corners{{0.1, 0.1}, {0.9, 0.1}, {0.1, 0.9}, {0.1, 0.9}};  // the last two in one place
const Box<2> open{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}};
const Box<2> periodic{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {true, true}};

/// What is said of bonds within the corners.
std::string complaint(std::vector<Bond> bonds, const Box<2>& box = open) {
  try {
    complete_bonds<2>(bonds, corners, corners, true, box, "net");
  } catch (const dmp::ParameterError& error) {
    return error.what();
  }
  return {};
}

std::vector<std::pair<std::uint32_t, double>> bonds_of(const BondList& list, std::size_t i) {
  std::vector<std::pair<std::uint32_t, double>> result;
  for (std::size_t k = 0; k < list.partners(i).size(); ++k) result.emplace_back(list.partners(i)[k], list.rest_lengths(i)[k]);
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

TEST_CASE("the shortest way leads through a periodic face where that is nearer, and by no face of an open box") {
  for (const std::array<bool, 3> faces : {std::array{false, false, false}, std::array{true, false, true}, std::array{true, true, true}}) {
    const auto box = test::cube<3>(2.0, faces);
    const auto points = test::scattered<3>(60, 2.0, 1);
    for (std::uint32_t a = 0; a < points.size(); ++a) {
      const std::uint32_t b = (7 * a + 3) % 60;
      double shortest = std::numeric_limits<double>::infinity();
      test::for_each_image<3>(a, box, [&](const auto& image) { shortest = std::min(shortest, (test::position_of<3>(image, points, box) - points[b]).norm()); });
      const Vector<3> way = dmp::neighbours::minimum_image<3>(points[a] - points[b], box);
      CHECK(way.norm() == doctest::Approx(shortest).epsilon(1e-14));
      const Vector<3> boxes = (way - (points[a] - points[b])) / 2.0;
      CHECK((boxes - boxes.array().round().matrix()).norm() < 1e-15);
    }
  }
}

TEST_CASE("a rest length left open is the distance at the start, through periodic faces and corners; a given one stays") {
  std::vector<Bond> bonds{{0, 1}, {0, 2}, {1, 2}, {1, 3, 0.3}};
  complete_bonds<2>(bonds, corners, corners, true, open, "net");
  CHECK(bonds[0].rest_length == doctest::Approx(0.8).epsilon(1e-15));
  CHECK(bonds[1].rest_length == doctest::Approx(0.8).epsilon(1e-15));
  CHECK(bonds[2].rest_length == doctest::Approx(std::sqrt(1.28)).epsilon(1e-15));
  CHECK(bonds[3].rest_length == 0.3);
  for (Bond& bond : bonds) bond.rest_length = -1.0;
  complete_bonds<2>(bonds, corners, corners, true, periodic, "net");
  CHECK(bonds[0].rest_length == doctest::Approx(0.2).epsilon(1e-15));
  CHECK(bonds[1].rest_length == doctest::Approx(0.2).epsilon(1e-15));
  CHECK(bonds[2].rest_length == doctest::Approx(std::sqrt(0.08)).epsilon(1e-15));  // across the corner
}

TEST_CASE("a bond is refused with its ends and the reason: itself, nobody there, length zero, twice") {
  CHECK(complaint({{0, 1}, {2, 2}}) == "bonds of net: a particle cannot be bonded to itself, got bond (2, 2)");
  CHECK(complaint({{0, 4}}) == "bonds of net: both ends must exist (4 and 4 particles), got bond (0, 4)");
  CHECK(complaint({{4, 0}}) == "bonds of net: both ends must exist (4 and 4 particles), got bond (4, 0)");
  CHECK(complaint({{2, 3}}) == "bonds of net: length must be > 0 m (the two ends coincide; give a rest_length if that is meant), got bond (2, 3)");
  CHECK(complaint({{0, 1}, {1, 2}, {0, 1}}) == "bonds of net: the same two particles must not be bonded twice, got bond (0, 1)");
  CHECK(complaint({{0, 1}, {1, 2}, {1, 0}}) == "bonds of net: the same two particles must not be bonded twice, got bond (0, 1)");
}

TEST_CASE("a bond is refused when its rest length is no number, or it is longer than 0.45 of a periodic box") {
  CHECK(complaint({{0, 1, NAN}}) == "bonds of net: rest_length must be finite, got bond (0, 1)");
  CHECK(complaint({{0, 1, INFINITY}}) == "bonds of net: rest_length must be finite, got bond (0, 1)");
  CHECK(complaint({{0, 1, 0.5}}, periodic) == "bonds of net: length must be <= 0.45 of the periodic box, got bond (0, 1)");
  CHECK(complaint({{0, 1, 0.449}}, periodic).empty());
  CHECK(complaint({{0, 1, 0.5}}, {.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {false, true}}) ==
        "bonds of net: length must be <= 0.45 of the periodic box, got bond (0, 1)");
  CHECK(complaint({{0, 1, 7.0}}).empty());  // no box to be longer than
  std::vector<Bond> half{{0, 1}};
  const test::Cloud<1> points{Vector<1>(0.0), Vector<1>(0.5)};
  CHECK_THROWS_AS((complete_bonds<1>(half, points, points, true, {.lower = {0.0}, .upper = {1.0}, .periodic = {true}}, "line")), dmp::ParameterError);
}

TEST_CASE("ends in one place are a bond if a rest length is given, also zero") {
  CHECK(complaint({{2, 3, 0.0}}).empty());
  CHECK(complaint({{2, 3, 0.1}}).empty());
  CHECK(complaint({{2, 3, 0.1}}, periodic).empty());
}

TEST_CASE("bonds between two groups: rows 1 and 1 are two particles, and (0, 1) is not (1, 0)") {
  const test::Cloud<2> anchors{{0.5, 0.5}, {0.6, 0.6}};
  std::vector<Bond> bonds{{1, 1}, {0, 1}, {1, 0}};
  complete_bonds<2>(bonds, corners, anchors, false, open, "net and anchors");
  CHECK(bonds[0].rest_length == doctest::Approx(std::hypot(0.3, 0.5)).epsilon(1e-15));
  CHECK(bonds[2].rest_length == doctest::Approx(std::hypot(0.4, 0.4)).epsilon(1e-15));
  std::vector<Bond> nobody{{3, 1}, {1, 3}};
  CHECK_THROWS_WITH_AS((complete_bonds<2>(nobody, corners, anchors, false, open, "net and anchors")),
                       "bonds of net and anchors: both ends must exist (4 and 2 particles), got bond (1, 3)", dmp::ParameterError);
  bonds.push_back({0, 1, 0.2});
  CHECK_THROWS_WITH_AS((complete_bonds<2>(bonds, corners, anchors, false, open, "net and anchors")),
                       "bonds of net and anchors: the same two particles must not be bonded twice, got bond (0, 1)", dmp::ParameterError);
}

TEST_CASE("each particle knows its bonds: every bond stands once at each end that moves") {
  const std::vector<Bond> bonds{{0, 1, 0.1}, {3, 1, 0.2}, {1, 2, 0.3}};
  using Expected = std::vector<std::pair<std::uint32_t, double>>;
  BondList both, first, second;
  both.build(5, bonds, true, false, 4);
  CHECK(bonds_of(both, 0) == Expected{{1, 0.1}});
  CHECK(bonds_of(both, 1) == Expected{{0, 0.1}, {2, 0.3}, {3, 0.2}});
  CHECK(bonds_of(both, 2) == Expected{{1, 0.3}});
  CHECK(bonds_of(both, 3) == Expected{{1, 0.2}});
  CHECK(bonds_of(both, 4).empty());
  first.build(4, bonds, false, false, 4);  // of two groups: the ends i ...
  CHECK(bonds_of(first, 0) == Expected{{1, 0.1}});
  CHECK(bonds_of(first, 1) == Expected{{2, 0.3}});
  CHECK(bonds_of(first, 2).empty());
  CHECK(bonds_of(first, 3) == Expected{{1, 0.2}});
  second.build(3, bonds, false, true, 4);  // ... and the ends j
  CHECK(bonds_of(second, 0).empty());
  CHECK(bonds_of(second, 1) == Expected{{0, 0.1}, {3, 0.2}});
  CHECK(bonds_of(second, 2) == Expected{{1, 0.3}});
}

TEST_CASE("the bonds of a particle fill whole packs, with entries that say they are none and can be loaded like the others") {
  std::vector<Bond> star;
  for (std::uint32_t j = 1; j <= 9; ++j) star.push_back({0, j, 0.1 * j});
  for (const std::size_t pack : {1u, 2u, 4u, 8u})
    for (std::size_t bonds = 0; bonds <= star.size(); ++bonds) {
      CAPTURE(pack);
      CAPTURE(bonds);
      BondList list;
      list.build(10, std::span(star).first(bonds), true, false, pack);
      CHECK(list.packs(0).size() == (bonds + pack - 1) / pack * pack);
      CHECK(list.partners(0).size() == bonds);
      for (std::size_t k = 0; k < list.packs(0).size(); ++k) {
        CHECK((list.rest_lengths(0)[k] >= 0.0) == (k < bonds));
        CHECK(list.packs(0)[k] < 10);
      }
    }
}

TEST_CASE("no bonds: empty lists") {
  BondList list;
  CHECK(list.empty());
  list.build(3, {}, true, false, 4);
  CHECK(list.empty());
  for (std::size_t i = 0; i < 3; ++i) CHECK(list.partners(i).empty());
  list.build(0, {}, true, false, 4);
  CHECK(list.empty());
  std::vector<Bond> none;
  complete_bonds<2>(none, corners, corners, true, periodic, "net");
  CHECK(none.empty());
}
