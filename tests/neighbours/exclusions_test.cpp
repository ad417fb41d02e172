#include <algorithm>
#include "neighbours/oracle.hpp"
#include <doctest/doctest.h>
#include <dmp/neighbours/exclusions.hpp>

using dmp::neighbours::BondGraph;
using dmp::neighbours::Exclusions;
using Rows = std::vector<std::uint32_t>;

namespace {

BondGraph graph_of(std::size_t nodes, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& bonds) {
  BondGraph graph(nodes);
  for (const auto& [i, j] : bonds) {
    graph[i].push_back(j);
    graph[j].push_back(i);
  }
  return graph;
}

/// Number of bonds between any two nodes, by Floyd and Warshall.
std::vector<std::vector<int>> distances(const BondGraph& graph) {
  const std::size_t n = graph.size();
  std::vector<std::vector<int>> apart(n, std::vector<int>(n, 1000));
  for (std::size_t i = 0; i < n; ++i) {
    apart[i][i] = 0;
    for (const std::uint32_t j : graph[i]) apart[i][j] = 1;
  }
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) apart[i][j] = std::min(apart[i][j], apart[i][k] + apart[k][j]);
  return apart;
}

/// The rows 0 .. count - 1 that particle i does not skip.
Rows left_of(const Exclusions& excluded, std::uint32_t i, std::uint32_t count) {
  Rows rows;
  for (std::uint32_t row = 0; row < count; ++row)
    if (!excluded.holds(i, row)) rows.push_back(row);
  CHECK(excluded.any(i) == (rows.size() < count));
  return rows;
}

}  // namespace

TEST_CASE("pairs joined by 1, 2 or 3 bonds are left out, and no others: chain, ring, branches, net at random") {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> chain, ring, tree, net;
  for (std::uint32_t k = 0; k + 1 < 20; ++k) chain.emplace_back(k, k + 1);
  ring = chain;
  ring.emplace_back(19, 0);
  for (std::uint32_t k = 1; k < 20; ++k) tree.emplace_back(k, (k - 1) / 3);
  test::Random random(1);
  for (int k = 0; k < 25; ++k) net.emplace_back(static_cast<std::uint32_t>(20 * random()), static_cast<std::uint32_t>(20 * random()));
  for (const auto& bonds : {chain, ring, tree, net}) {
    const BondGraph graph = graph_of(20, bonds);
    const auto apart = distances(graph);
    for (const int reach : {1, 2, 3, 7}) {
      CAPTURE(reach);
      Exclusions excluded;
      excluded.build(graph, {0, 20}, {0, 20}, reach);
      for (std::uint32_t i = 0; i < 20; ++i) {
        Rows expected;
        for (std::uint32_t j = 0; j < 20; ++j)
          if (j == i || apart[i][j] > reach) expected.push_back(j);  // that i is no neighbour of its own is the list's affair
        CHECK(left_of(excluded, i, 20) == expected);
      }
    }
  }
}

TEST_CASE("exclusions reach from group to group, through particles of either") {
  // Beads 0 .. 3 are nodes 0 .. 3, anchors 0 .. 2 are nodes 4 .. 6: anchor 0 - bead 0 - bead 1 - bead 2 - anchor 2,
  // bead 3 and anchor 1 free.
  const BondGraph graph = graph_of(7, {{4, 0}, {0, 1}, {1, 2}, {2, 6}});
  Exclusions beads, anchors;
  beads.build(graph, {0, 4}, {4, 3}, 2);
  CHECK(left_of(beads, 0, 3) == Rows{1, 2});
  CHECK(left_of(beads, 1, 3) == Rows{1});
  CHECK(left_of(beads, 2, 3) == Rows{0, 1});
  CHECK(left_of(beads, 3, 3) == Rows{0, 1, 2});
  anchors.build(graph, {4, 3}, {0, 4}, 2);
  CHECK(left_of(anchors, 0, 4) == Rows{2, 3});
  CHECK(left_of(anchors, 1, 4) == Rows{0, 1, 2, 3});
  CHECK(left_of(anchors, 2, 4) == Rows{0, 3});
}

TEST_CASE("without bonds nothing is excluded") {
  Exclusions never_built, without_bonds;
  without_bonds.build(BondGraph(5), {0, 5}, {0, 5}, 3);
  for (std::uint32_t i = 0; i < 5; ++i) {
    CHECK(left_of(never_built, i, 5) == Rows{0, 1, 2, 3, 4});
    CHECK(left_of(without_bonds, i, 5) == Rows{0, 1, 2, 3, 4});
  }
}
