#include <algorithm>
#include <cmath>
#include <limits>
#include "neighbours/oracle.hpp"
#include <doctest/doctest.h>
#include <dmp/core/threads.hpp>
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

using Ends = std::vector<std::pair<std::uint32_t, double>>;

/// Partners and rest lengths that are listed at particle i, without what fills the packs.
Ends bonds_of(const BondList& list, std::size_t i) {
  Ends result;
  const auto entries = list.of(i);
  for (std::size_t k = 0; k < entries.size; ++k)
    if (entries.rest_length[k] >= 0.0) result.emplace_back(entries.partner[k], entries.rest_length[k]);
  std::sort(result.begin(), result.end());
  return result;
}

dmp::Blocks blocks_of(const std::vector<std::size_t>& bounds) {
  dmp::Blocks blocks;
  blocks.set_bounds(bounds);
  return blocks;
}

}  // namespace

TEST_CASE("the shortest way leads through a periodic face where that is nearer, and by no face of an open box") {
  for (const std::array<bool, 3> faces : {std::array{false, false, false}, std::array{true, false, true}, std::array{true, true, true}}) {
    const auto box = test::cube<3>(2.0, faces);
    const auto points = test::scattered<3>(60, 2.0, 1);
    for (std::uint32_t a = 0; a < points.size(); ++a) {
      const std::uint32_t b = (7 * a + 3) % 60;
      double shortest = std::numeric_limits<double>::infinity();
      test::for_each_image<3>(
          a, box, [&](const auto& image) { shortest = std::min(shortest, (test::position_of<3>(image, points, box) - points[b]).norm()); });
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
  CHECK(complaint({{2, 3}}) ==
        "bonds of net: length must be > 0 m (the two ends coincide; give a rest_length if that is meant), got bond (2, 3)");
  CHECK(complaint({{0, 1}, {1, 2}, {0, 1}}) == "bonds of net: the same two particles must not be bonded twice, got bond (0, 1)");
  CHECK(complaint({{0, 1}, {1, 2}, {1, 0}}) == "bonds of net: the same two particles must not be bonded twice, got bond (0, 1)");
}

TEST_CASE("a bond is refused when its rest length or weight is no number, or it is longer than 0.45 of a periodic box") {
  CHECK(complaint({{0, 1, NAN}}) == "bonds of net: rest_length must be finite, got bond (0, 1)");
  CHECK(complaint({{0, 1, INFINITY}}) == "bonds of net: rest_length must be finite, got bond (0, 1)");
  CHECK(complaint({{0, 1, 0.5, -1.0}}) == "bonds of net: weight must be >= 0 and finite, got bond (0, 1)");
  CHECK(complaint({{0, 1, 0.5, NAN}}) == "bonds of net: weight must be >= 0 and finite, got bond (0, 1)");
  CHECK(complaint({{0, 1, 0.5}}, periodic) == "bonds of net: length must be <= 0.45 of the periodic box, got bond (0, 1)");
  CHECK(complaint({{0, 1, 0.449}}, periodic).empty());
  CHECK(complaint({{0, 1, 0.5}}, {.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {false, true}}) ==
        "bonds of net: length must be <= 0.45 of the periodic box, got bond (0, 1)");
  CHECK(complaint({{0, 1, 7.0}}).empty());  // no box to be longer than
  std::vector<Bond> half{{0, 1}};
  const test::Cloud<1> points{Vector<1>(0.0), Vector<1>(0.5)};
  CHECK_THROWS_AS((complete_bonds<1>(half, points, points, true, {.lower = {0.0}, .upper = {1.0}, .periodic = {true}}, "line")),
                  dmp::ParameterError);
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

TEST_CASE("a bond within a block is listed once, at one of its ends, one between two blocks at both ends") {
  const std::vector<Bond> bonds{{0, 1, 0.1}, {3, 1, 0.2}, {1, 2, 0.3}};
  BondList list;
  list.build(blocks_of({0, 5}), bonds, true, false, 4, {});
  std::size_t listed = 0;
  for (std::uint32_t i = 0; i < 5; ++i) listed += bonds_of(list, i).size();
  CHECK(listed == 3);
  for (const Bond& bond : bonds) {
    const auto at = [&](std::uint32_t own, std::uint32_t other) { return list.find(own, other) < list.of(own).size; };
    CHECK(at(bond.i, bond.j) != at(bond.j, bond.i));
  }
  list.build(blocks_of({0, 2, 5}), bonds, true, false, 1, {});
  CHECK(bonds_of(list, 0) == Ends{{1, 0.1}});
  CHECK(bonds_of(list, 1) == Ends{{2, 0.3}, {3, 0.2}});
  CHECK(bonds_of(list, 2) == Ends{{1, 0.3}});
  CHECK(bonds_of(list, 3) == Ends{{1, 0.2}});
  CHECK(bonds_of(list, 4).empty());
}

TEST_CASE("bonds of a lattice are listed where they fill packs: hardly an entry is none") {
  constexpr std::uint32_t n = 12;
  const auto row = [](std::uint32_t i, std::uint32_t j, std::uint32_t k) { return (k * n + j) * n + i; };
  std::vector<Bond> bonds;  // 6 nearest and 12 next-nearest neighbours: 9 bonds for each bead, 12 entries if all were at the first end
  for (std::uint32_t k = 0; k < n; ++k)
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t i = 0; i < n; ++i)
        for (const std::array<std::uint32_t, 3> step :
             {std::array{1u, 0u, 0u}, {0u, 1u, 0u}, {0u, 0u, 1u}, {1u, 1u, 0u}, {1u, n - 1, 0u},
              {1u, 0u, 1u}, {1u, 0u, n - 1}, {0u, 1u, 1u}, {0u, 1u, n - 1}})
          bonds.push_back({row(i, j, k), row((i + step[0]) % n, (j + step[1]) % n, (k + step[2]) % n), 1.0});
  for (const std::size_t pack : {2u, 4u, 8u}) {
    BondList list;
    list.build(blocks_of({0, n * n * n}), bonds, true, false, pack, {});
    std::size_t entries = 0;
    for (std::size_t i = 0; i < n * n * n; ++i) entries += list.of(i).size;
    CAPTURE(pack);
    CHECK(entries >= bonds.size());
    CHECK(static_cast<double>(entries) < 1.02 * static_cast<double>(bonds.size()));
  }
}

TEST_CASE("a bond of two groups is listed once in the list of either, at the end that lies there, whatever the blocks") {
  const std::vector<Bond> bonds{{0, 1, 0.1}, {3, 1, 0.2}, {1, 2, 0.3}};
  for (const std::size_t middle : {1u, 2u}) {
    BondList first, second;
    first.build(blocks_of({0, middle, 4}), bonds, false, false, 4, {});  // the ends i ...
    CHECK(bonds_of(first, 0) == Ends{{1, 0.1}});
    CHECK(bonds_of(first, 1) == Ends{{2, 0.3}});
    CHECK(bonds_of(first, 2).empty());
    CHECK(bonds_of(first, 3) == Ends{{1, 0.2}});
    second.build(blocks_of({0, middle, 3}), bonds, false, true, 4, {});  // ... and the ends j
    CHECK(bonds_of(second, 0).empty());
    CHECK(bonds_of(second, 1) == Ends{{0, 0.1}, {3, 0.2}});
    CHECK(bonds_of(second, 2) == Ends{{1, 0.3}});
  }
}

TEST_CASE(
    "a net at random: with its reactions every bond acts once on either end; what is in vain goes to rows of the block that nobody reads") {
  constexpr std::uint32_t beads = 50;
  test::Random random(1);
  std::vector<std::vector<double>> between(beads, std::vector<double>(beads, 0.0));
  std::vector<Bond> bonds;
  for (int n = 0; n < 150; ++n) {
    const auto i = static_cast<std::uint32_t>(beads * random()), j = static_cast<std::uint32_t>(beads * random());
    if (i == j || between[i][j] > 0.0) continue;
    between[i][j] = between[j][i] = random() + 0.1;
    bonds.push_back({i, j, between[i][j]});
  }
  for (const std::vector<std::size_t>& bounds : {std::vector<std::size_t>{0, 50}, {0, 1, 2, 25, 50}, {0, 13, 49, 50}})
    for (const std::size_t pack : {1u, 2u, 4u, 8u}) {
      CAPTURE(pack);
      const auto blocks = blocks_of(bounds);
      BondList list;
      list.build(blocks, bonds, true, false, pack, {});
      std::vector<std::vector<double>> acting(beads, std::vector<double>(beads, 0.0));
      double entries = 0.0;
      std::size_t astray = 0;
      for (std::size_t block = 0; block < blocks.size(); ++block) {
        entries += list.entries(blocks, block);
        for (std::size_t i = blocks.begin(block); i < blocks.end(block); ++i) {
          const auto of = list.of(i);
          entries -= static_cast<double>(of.size);
          for (std::size_t k = 0; k < of.size; ++k) {
            if (of.rest_length[k] >= 0.0) acting[i][of.partner[k]] += of.rest_length[k];
            if (of.reaction[k] < beads) {
              acting.at(of.reaction[k])[i] += of.rest_length[k];
              astray += of.reaction[k] != of.partner[k] || of.reaction[k] < blocks.begin(block) || of.reaction[k] >= blocks.end(block);
            } else {
              astray += of.reaction[k] < blocks.far_row(block) || of.reaction[k] >= blocks.far_row(block + 1);
            }
          }
        }
      }
      CHECK(acting == between);
      CHECK(astray == 0);
      CHECK(entries == 0.0);
    }
}

TEST_CASE("every bond brings its weight, at whatever end it is listed; where all are one, one pack is read again and again") {
  std::vector<Bond> bonds{{0, 1, 0.1, 0.5}, {3, 1, 0.2}, {1, 2, 0.3, 0.25}};
  for (const bool weighted : {true, false})
    for (const std::size_t middle : {1u, 2u, 3u}) {
      if (!weighted)
        for (Bond& bond : bonds) bond.weight = 1.0;
      BondList list;
      list.build(blocks_of({0, middle, 4}), bonds, true, false, 4, {});
      for (std::size_t i = 0; i < 4; ++i) {
        const auto of = list.of(i);
        for (std::size_t k = 0; k < of.size; ++k)
          for (const Bond& bond : bonds)
            if (bond.rest_length == of.rest_length[k]) CHECK(of.weight[weighted ? k : k % 4] == bond.weight);
        CHECK(of.weight_step == (weighted ? 1 : 0));
      }
    }
}

TEST_CASE("the bonds of a particle fill whole packs, with entries that say they are none and can be loaded like the others") {
  std::vector<Bond> star;
  for (std::uint32_t j = 1; j <= 9; ++j) star.push_back({0, j, 0.1 * j});
  for (const bool same_group : {true, false})
    for (const std::size_t pack : {1u, 2u, 4u, 8u})
      for (std::size_t bonds = 0; bonds <= star.size(); ++bonds) {
        CAPTURE(same_group);
        CAPTURE(pack);
        CAPTURE(bonds);
        BondList list;
        list.build(dmp::Blocks(same_group ? 10 : 1), std::span(star).first(bonds), same_group, false, pack, {});
        const auto of = list.of(0);
        CHECK(of.size == (bonds + pack - 1) / pack * pack);
        CHECK(bonds_of(list, 0).size() == bonds);
        for (std::size_t k = 0; k < of.size; ++k) {
          CHECK((of.rest_length[k] >= 0.0) == (k < bonds));
          CHECK(of.partner[k] == (k < bonds ? k + 1 : same_group ? 0 : bonds));  // what fills: itself, or once more the last partner
        }
      }
}

TEST_CASE("bonds through periodic faces are told from those inside, at each particle that lists one") {
  const test::Cloud<1> beads{Vector<1>(0.05), Vector<1>(0.3), Vector<1>(0.6), Vector<1>(0.95)};
  const Box<1> box{.lower = {0.0}, .upper = {1.0}, .periodic = {true}};
  BondList list;
  list.build(blocks_of({0, 1, 4}), std::vector<Bond>{{0, 1, 0.2}, {1, 2, 0.2}, {2, 3, 0.2}, {3, 0, 0.2}}, true, false, 4, {});
  list.mark_crossing<1>(beads, beads, box);
  CHECK(list.crosses(0));
  CHECK_FALSE(list.crosses(1));
  CHECK_FALSE(list.crosses(2));
  CHECK(list.crosses(3));
  list.mark_crossing<1>(beads, beads, {.lower = {0.0}, .upper = {1.0}});
  for (std::size_t i = 0; i < 4; ++i) CHECK_FALSE(list.crosses(i));
}

TEST_CASE("no bonds: empty lists") {
  BondList list;
  CHECK(list.empty());
  for (const std::size_t particles : {3u, 0u}) {
    const dmp::Blocks blocks(particles);
    list.build(blocks, {}, true, false, 4, {});
    CHECK(list.empty());
    CHECK(list.entries(blocks, 0) == 0.0);
    for (std::size_t i = 0; i < particles; ++i) {
      CHECK(list.of(i).size == 0);
    }
  }
  std::vector<Bond> none;
  complete_bonds<2>(none, corners, corners, true, periodic, "net");
  CHECK(none.empty());
}
