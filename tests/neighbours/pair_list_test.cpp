#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include "neighbours/oracle.hpp"
#include <doctest/doctest.h>
#include <dmp/core/pack.hpp>
#include <dmp/neighbours/ghosts.hpp>
#include <dmp/neighbours/pair_list.hpp>

using dmp::Vector;
using dmp::neighbours::CellGrid;
using dmp::neighbours::Exclusions;
using dmp::neighbours::Ghosts;
using dmp::neighbours::PairList;

namespace {

constexpr std::size_t pack = 4;

/// Lists of the particles `of` among `sources` and their images, as a scene makes them.
template <int Dim>
struct Search {
  test::Cloud<Dim> of, sources;
  dmp::geometry::Box<Dim> box;
  double radius;
  bool same_group;
  dmp::Ranges ranges{};
  Ghosts<Dim> ghosts{};
  PairList list{};

  void run(const Exclusions& excluded = {}) {
    ghosts.build(sources, box, radius);
    auto all = sources;
    for (std::size_t k = 0; k < ghosts.size(); ++k) all.push_back(sources[ghosts.owner[k]] + ghosts.shift[k]);
    CellGrid<Dim> grid;
    grid.build(all, 0.5 * radius);
    ranges = dmp::Ranges(of.size(), 1);
    list.template build<Dim>(ranges, of, grid, radius, {same_group, owned(), ghosts.owner}, excluded, pack);
  }
  [[nodiscard]] std::uint32_t owned() const { return static_cast<std::uint32_t>(sources.size()); }
  [[nodiscard]] std::uint32_t filler() const { return static_cast<std::uint32_t>(sources.size() + ghosts.size()); }

  template <class Function>
  void for_each_particle(const Function& f) const {
    for (std::size_t range = 0; range < ranges.size(); ++range)
      for (std::size_t i = ranges.begin(range); i < ranges.end(range); ++i) f(i, list.of(range, i));
  }
  /// What a list says, without the filler, as images in order.
  [[nodiscard]] std::vector<test::Image<Dim>> images(std::span<const std::uint32_t> rows) const {
    std::vector<test::Image<Dim>> result;
    for (const std::uint32_t row : rows) {
      if (row >= filler()) continue;
      std::array<int, Dim> boxes{};
      if (row >= owned())
        for (int d = 0; d < Dim; ++d)
          boxes[static_cast<std::size_t>(d)] = static_cast<int>(std::lround(ghosts.shift[row - owned()][d] / (box.upper[d] - box.lower[d])));
      result.push_back({row < owned() ? row : ghosts.owner[row - owned()], boxes});
    }
    std::sort(result.begin(), result.end());
    return result;
  }
  /// Particles whose list is not what looking at every pair gives, or not filled as it should be.
  [[nodiscard]] int wrong_lists() const {
    int wrong = 0;
    for_each_particle([&](std::size_t i, std::span<const std::uint32_t> rows) {
      const auto near = test::all_near<Dim>(of[i], radius, same_group ? static_cast<std::int64_t>(i) : -1, sources, box);
      const bool whole_packs = rows.size() == (near.size() + pack - 1) / pack * pack;
      const auto first_filler = std::find(rows.begin(), rows.end(), filler());
      const bool fillers_last = std::all_of(first_filler, rows.end(), [this](std::uint32_t row) { return row == filler(); });
      wrong += !(images(rows) == near && whole_packs && fillers_last);
    });
    return wrong;
  }
};

template <int Dim>
void check_against_every_pair(const std::array<bool, Dim>& periodic) {
  const test::Threads threads(4);
  const auto box = test::cube<Dim>(1.0, periodic);
  for (const double radius : {0.08, 0.25, 0.7}) {  // 0.7: longer than half the box, so a neighbour may be near twice
    CAPTURE(radius);
    const test::Cloud<Dim> clouds[] = {test::scattered<Dim>(150, 1.0, 1), test::clustered<Dim>(150, 1.0, 2), test::lattice<Dim>(Dim == 1 ? 16 : 4, 1.0),
                                       test::scattered<Dim>(1, 1.0, 3)};
    for (std::size_t cloud = 0; cloud < std::size(clouds); ++cloud) {
      CAPTURE(cloud);
      Search<Dim> among_themselves{.of = clouds[cloud], .sources = clouds[cloud], .box = box, .radius = radius, .same_group = true};
      among_themselves.run();
      CHECK(among_themselves.wrong_lists() == 0);
      Search<Dim> other_group{.of = test::scattered<Dim>(70, 1.0, 4), .sources = clouds[cloud], .box = box, .radius = radius, .same_group = false};
      other_group.of.push_back(clouds[cloud][0]);  // in one place with a source: a neighbour
      other_group.run();
      CHECK(other_group.wrong_lists() == 0);
    }
  }
}

}  // namespace

TEST_CASE("lists hold whom looking at every pair finds, on the line") {
  check_against_every_pair<1>({false});
  check_against_every_pair<1>({true});
}
TEST_CASE("lists hold whom looking at every pair finds, in the plane") {
  check_against_every_pair<2>({false, false});
  check_against_every_pair<2>({true, false});
  check_against_every_pair<2>({true, true});
}
TEST_CASE("lists hold whom looking at every pair finds, in space") {
  check_against_every_pair<3>({false, false, false});
  check_against_every_pair<3>({false, true, false});
  check_against_every_pair<3>({true, true, true});
}

TEST_CASE("neighbours exactly at the cut-off are not listed, directly or through a periodic face") {
  Search<2> search{.of = test::lattice<2>(8, 1.0), .sources = test::lattice<2>(8, 1.0), .box = test::cube<2>(1.0, {true, true}), .radius = 0.125, .same_group = true};
  search.run();
  search.for_each_particle([&](std::size_t, auto rows) { CHECK(rows.empty()); });
  search.radius = std::nextafter(0.125, 1.0);
  search.run();
  search.for_each_particle([&](std::size_t, auto rows) { CHECK(search.images(rows).size() == 4); });
}

TEST_CASE("every neighbour sees back: full lists of one group are symmetric") {
  const test::Threads threads(3);
  Search<2> search{.of = test::clustered<2>(300, 1.0, 5), .sources = test::clustered<2>(300, 1.0, 5), .box = test::cube<2>(1.0, {true, true}), .radius = 0.15, .same_group = true};
  search.run();
  std::vector<std::vector<std::uint32_t>> seen(search.of.size()), seeing(search.of.size());
  search.for_each_particle([&](std::size_t i, auto rows) {
    for (const auto& image : search.images(rows)) {
      seeing[i].push_back(image.first);
      seen[image.first].push_back(static_cast<std::uint32_t>(i));
    }
  });
  for (auto* lists : {&seen, &seeing})
    for (auto& list : *lists) std::sort(list.begin(), list.end());
  CHECK(seen == seeing);
}

TEST_CASE("lists do not depend on the number of threads, entry by entry") {
  std::vector<std::vector<std::uint32_t>> first;
  for (const int count : {1, 2, 3, 4}) {
    const test::Threads threads(count);
    Search<3> search{.of = test::scattered<3>(500, 1.0, 6), .sources = test::scattered<3>(500, 1.0, 6), .box = test::cube<3>(1.0, {true, true, true}), .radius = 0.2, .same_group = true};
    search.run();
    CHECK(search.ranges.size() == static_cast<std::size_t>(count));
    std::vector<std::vector<std::uint32_t>> lists;
    search.for_each_particle([&](std::size_t, auto rows) { lists.emplace_back(rows.begin(), rows.end()); });
    if (first.empty()) first = lists;
    CHECK(lists == first);
  }
}

TEST_CASE("no particle has no list, and nobody to list leaves lists empty") {
  Search<2> nobody{.of = {}, .sources = test::scattered<2>(10, 1.0, 7), .box = test::cube<2>(1.0), .radius = 0.5, .same_group = false};
  nobody.run();
  int lists = 0;
  nobody.for_each_particle([&](std::size_t, auto) { ++lists; });
  CHECK(lists == 0);
  Search<2> alone{.of = test::scattered<2>(10, 1.0, 8), .sources = {}, .box = test::cube<2>(1.0, {true, true}), .radius = 0.5, .same_group = false};
  alone.run();
  alone.for_each_particle([&](std::size_t, auto rows) { CHECK(rows.empty()); });
}

TEST_CASE("a list built again forgets the lists before") {
  Search<2> search{.of = test::scattered<2>(100, 1.0, 9), .sources = test::scattered<2>(100, 1.0, 9), .box = test::cube<2>(1.0), .radius = 0.5, .same_group = true};
  search.run();
  search.of = search.sources = test::scattered<2>(60, 1.0, 10);
  search.radius = 0.1;
  search.run();
  CHECK(search.wrong_lists() == 0);
}

TEST_CASE("bonded particles leave the lists, as ghosts too, and the fillers close up") {
  // A ring of 12 through the periodic face; the radius reaches 4 to either side.
  test::Cloud<1> ring;
  for (int k = 0; k < 12; ++k) ring.emplace_back((k + 0.5) / 12.0 - 0.5);
  dmp::neighbours::BondGraph graph(12);
  for (std::uint32_t k = 0; k < 12; ++k) {
    graph[k].push_back((k + 1) % 12);
    graph[(k + 1) % 12].push_back(k);
  }
  for (const int reach : {1, 2, 3}) {
    CAPTURE(reach);
    Exclusions excluded;
    excluded.build(graph, {0, 12}, {0, 12}, reach);
    Search<1> search{.of = ring, .sources = ring, .box = test::cube<1>(1.0, {true}), .radius = 4.2 / 12.0, .same_group = true};
    search.run(excluded);
    search.for_each_particle([&](std::size_t i, auto rows) {
      CHECK(rows.size() % pack == 0);
      std::vector<std::uint32_t> listed, expected;
      for (const auto& image : search.images(rows)) listed.push_back(image.first);
      for (std::uint32_t j = 0; j < 12; ++j) {
        const int around = std::abs(static_cast<int>(i) - static_cast<int>(j)), apart = std::min(around, 12 - around);
        if (apart > reach && apart <= 4) expected.push_back(j);
      }
      CHECK(listed == expected);
    });
  }
}
