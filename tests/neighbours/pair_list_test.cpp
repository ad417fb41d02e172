#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include "neighbours/oracle.hpp"
#include <doctest/doctest.h>
#include <dmp/core/threads.hpp>
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
  double cutoff;
  bool same_group;
  double skin = 0.0;
  bool once = true;
  std::vector<std::size_t> bounds{};  // of blocks; none: two blocks of which the second is larger
  dmp::Blocks blocks{};
  Ghosts<Dim> ghosts{};
  PairList list{};
  double margin = 0.0;  // of the grid: those who are this little too far may be listed, or not

  void run(const Exclusions& excluded = {}) {
    ghosts.build(sources, box, reach());
    auto all = sources;
    for (std::size_t k = 0; k < ghosts.size(); ++k) all.push_back(sources[ghosts.owner[k]] + ghosts.shift[k]);
    CellGrid<Dim> grid;
    grid.build(all, 0.5 * reach());
    const std::vector<std::size_t> one{0, of.size()}, two{0, of.size() / 3, of.size()};
    blocks.set_bounds(!bounds.empty() ? bounds : of.size() > 3 ? two : one);
    margin = grid.margin() + 1e-6 * reach();
    list.template build<Dim>(blocks, of, grid, cutoff, skin, {same_group, owned(), first_ghost(), ghosts.owner, once}, excluded, pack);
  }
  [[nodiscard]] double reach() const { return cutoff + skin; }
  [[nodiscard]] std::uint32_t owned() const { return static_cast<std::uint32_t>(sources.size()); }
  /// The rows between lie far away: of a group of its own, the sources have as many blocks as they like, here one.
  [[nodiscard]] std::uint32_t first_ghost() const {
    return owned() + static_cast<std::uint32_t>(dmp::Blocks::far_rows * (same_group ? blocks.size() : 1));
  }
  /// Whether a block holds two particles so far apart that nobody is in reach of both: else its pairs are not listed once.
  [[nodiscard]] bool is_wide(std::size_t block) const {
    double farthest = 0.0;
    const auto& first = of[blocks.begin(block)];
    for (std::size_t k = blocks.begin(block); k < blocks.end(block); ++k) farthest = std::max(farthest, (of[k] - first).norm());
    return farthest > 2.0 * reach();
  }
  /// Rows of a list of pairs of the block, without those that fill it up: at its end, fewer than a pack, and out of reach.
  [[nodiscard]] std::vector<std::uint32_t> rows_once(std::size_t block, std::size_t i, std::size_t level = PairList::levels - 1) const {
    std::vector<std::uint32_t> result;
    for (const std::uint16_t row : list.of(block, i, level).once) result.push_back(static_cast<std::uint32_t>(blocks.begin(block) + row));
    const auto out_of_reach = [&](std::uint32_t row) { return (sources.at(row) - of[i]).norm() > reach() + margin; };
    for (std::size_t k = 1; k < pack && !result.empty() && out_of_reach(result.back()); ++k) result.pop_back();
    return result;
  }
  /// f(block, i, all rows listed)
  template <class Function>
  void for_each_particle(const Function& f) const {
    for (std::size_t block = 0; block < blocks.size(); ++block)
      for (std::size_t i = blocks.begin(block); i < blocks.end(block); ++i) {
        auto rows = rows_once(block, i);
        const auto others = list.of(block, i).others;
        rows.insert(rows.end(), others.begin(), others.end());
        f(block, i, rows);
      }
  }
  /// What a list says, without the filler, as images in order.
  [[nodiscard]] std::vector<test::Image<Dim>> images(std::span<const std::uint32_t> rows) const {
    std::vector<test::Image<Dim>> result;
    for (const std::uint32_t row : rows) {
      if (row >= owned() && row < first_ghost()) continue;
      std::array<int, Dim> boxes{};
      if (row >= owned())
        for (int d = 0; d < Dim; ++d)
          boxes[static_cast<std::size_t>(d)] =
              static_cast<int>(std::lround(ghosts.shift.at(row - first_ghost())[d] / (box.upper[d] - box.lower[d])));
      result.push_back({row < owned() ? row : ghosts.owner.at(row - first_ghost()), boxes});
    }
    std::sort(result.begin(), result.end());
    return result;
  }
  /// Whom particle i of `block` must list: all within `radius`, but of its own block only those further down, in a list of their own, if
  /// pairs are listed once.
  [[nodiscard]] std::vector<test::Image<Dim>> expected(bool listed_once, std::size_t block, std::size_t i, double radius) const {
    auto near = test::all_near<Dim>(of[i], radius, same_group ? static_cast<std::int64_t>(i) : -1, sources, box);
    std::erase_if(near, [&](const test::Image<Dim>& image) {
      const bool in_block = same_group && once && is_wide(block) && image.second == std::array<int, Dim>{} &&
                            image.first >= blocks.begin(block) && image.first < blocks.end(block);
      return listed_once != in_block || (in_block && image.first < i);
    });
    return near;
  }
  /// Particles whose lists are not what looking at every pair gives, or not filled as they should be.
  [[nodiscard]] int wrong_lists() const {
    int wrong = 0;
    for_each_particle([&](std::size_t block, std::size_t i, const auto&) {
      const auto lists = list.of(block, i);
      const auto rows_of_once = rows_once(block, i);
      for (const bool listed_once : {true, false}) {
        const auto rows = listed_once ? std::span<const std::uint32_t>(rows_of_once) : lists.others;
        const std::size_t entries = listed_once ? lists.once.size() : lists.others.size();
        const auto listed = images(rows), near = expected(listed_once, block, i, reach()),
                   around = expected(listed_once, block, i, reach() + margin);
        const bool right = std::adjacent_find(listed.begin(), listed.end()) == listed.end() &&
                           std::includes(listed.begin(), listed.end(), near.begin(), near.end()) &&
                           std::includes(around.begin(), around.end(), listed.begin(), listed.end());
        const bool whole_packs = entries == (listed.size() + pack - 1) / pack * pack;
        const auto first_filler = rows.begin() + static_cast<std::ptrdiff_t>(std::min(listed.size(), rows.size()));
        const bool fillers_last = std::all_of(first_filler, rows.end(), [&](std::uint32_t row) { return row == owned(); });
        wrong += !(right && whole_packs && fillers_last);
      }
      for (const std::uint16_t row : lists.once) wrong += !(row < blocks.end(block) - blocks.begin(block));
    });
    return wrong;
  }
  /// Particles and levels at which somebody is missing who can act, or a list is not the beginning of the whole one.
  [[nodiscard]] int wrong_levels() const {
    int wrong = 0;
    const auto begins = [](const auto& read, const auto& whole) {
      return read.data() == whole.data() && read.size() <= whole.size() && read.size() % pack == 0;
    };
    for_each_particle([&](std::size_t block, std::size_t i, const auto&) {
      const auto lists = list.of(block, i);
      for (std::size_t level = 0; level < PairList::levels; ++level) {
        const auto read = list.of(block, i, level);
        wrong += !(begins(read.once, lists.once) && begins(read.others, lists.others));
        for (const bool listed_once : {true, false}) {
          const auto seen = listed_once ? images(rows_once(block, i, level)) : images(read.others),
                     near = expected(listed_once, block, i, cutoff + skin * PairList::share[level]);
          wrong += !std::includes(seen.begin(), seen.end(), near.begin(), near.end());
        }
      }
    });
    return wrong;
  }
};

template <int Dim>
void check_against_every_pair(const std::array<bool, Dim>& periodic) {
  const auto box = test::cube<Dim>(1.0, periodic);
  for (const double radius : {0.08, 0.25, 0.7}) {  // 0.7: longer than half the box, so a neighbour may be near twice
    CAPTURE(radius);
    const test::Cloud<Dim> clouds[] = {test::scattered<Dim>(100, 1.0, 1), test::clustered<Dim>(100, 1.0, 2),
                                       test::lattice<Dim>(Dim == 1 ? 16 : 4, 1.0), test::scattered<Dim>(1, 1.0, 3)};
    for (std::size_t cloud = 0; cloud < std::size(clouds); ++cloud) {
      CAPTURE(cloud);
      Search<Dim> among_themselves{.of = clouds[cloud], .sources = clouds[cloud], .box = box, .cutoff = radius, .same_group = true};
      among_themselves.run();
      CHECK(among_themselves.wrong_lists() == 0);
      among_themselves.once = false;
      among_themselves.run();
      CHECK(among_themselves.wrong_lists() == 0);
      Search<Dim> other_group{
          .of = test::scattered<Dim>(70, 1.0, 4), .sources = clouds[cloud], .box = box, .cutoff = radius, .same_group = false};
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

TEST_CASE(
    "neighbours farther than the cut-off by more than the margin are not listed, those a rounding closer are, directly or through a "
    "periodic face") {
  Search<2> search{.of = test::lattice<2>(8, 1.0),
                   .sources = test::lattice<2>(8, 1.0),
                   .box = test::cube<2>(1.0, {true, true}),
                   .cutoff = 0.125 * (1.0 - 1e-5),
                   .same_group = true};
  search.run();
  CHECK(search.margin < 0.125e-5);
  search.for_each_particle([&](std::size_t, std::size_t, const auto& rows) { CHECK(rows.empty()); });
  search.cutoff = std::nextafter(0.125, 1.0);
  search.run();
  std::size_t pairs = 0;
  search.for_each_particle([&](std::size_t block, std::size_t i, const auto& rows) {
    CHECK(search.is_wide(block));
    for (const auto& image : search.images(rows))
      pairs += image.second == std::array<int, 2>{} && image.first > i && image.first < search.blocks.end(block) ? 2 : 1;
  });
  CHECK(pairs == 64 * 4);
}

TEST_CASE("every neighbour sees back: in full, or as the partner of a pair listed once") {
  Search<2> search{.of = test::clustered<2>(300, 1.0, 5),
                   .sources = test::clustered<2>(300, 1.0, 5),
                   .box = test::cube<2>(1.0, {true, true}),
                   .cutoff = 0.15,
                   .same_group = true,
                   .bounds = {0, 50, 51, 200, 300}};
  search.run();
  std::vector<std::vector<std::uint32_t>> seen(search.of.size()), seeing(search.of.size());
  CHECK(search.is_wide(0));
  CHECK_FALSE(search.is_wide(1));
  search.for_each_particle([&](std::size_t block, std::size_t i, const auto& rows) {
    for (const auto& image : search.images(rows)) {
      seeing[i].push_back(image.first);
      seen[image.first].push_back(static_cast<std::uint32_t>(i));
      if (!search.is_wide(block) || image.second != std::array<int, 2>{}) continue;
      if (image.first < search.blocks.begin(block) || image.first >= search.blocks.end(block)) continue;
      seeing[image.first].push_back(static_cast<std::uint32_t>(i));  // the law speaks for both
      seen[i].push_back(image.first);
    }
  });
  for (auto* lists : {&seen, &seeing})
    for (auto& list : *lists) std::sort(list.begin(), list.end());
  CHECK(seen == seeing);
  for (std::uint32_t i = 0; i < search.of.size(); ++i) {
    std::vector<std::uint32_t> near;
    for (const auto& image : test::all_near<2>(search.of[i], 0.15, i, search.sources, search.box)) near.push_back(image.first);
    CHECK(seeing[i] == near);
  }
}

TEST_CASE("what the skin is for: at each level every pair is there that can act by then, and nobody beyond cut-off and skin is listed") {
  for (const double skin : {0.0, 0.01, 0.1, 0.5}) {
    CAPTURE(skin);
    for (const auto& periodic : {std::array{false, false}, std::array{true, true}})
      for (const auto& cloud : {test::scattered<2>(120, 1.0, 1), test::clustered<2>(120, 1.0, 2), test::lattice<2>(8, 1.0)}) {
        Search<2> search{
            .of = cloud, .sources = cloud, .box = test::cube<2>(1.0, periodic), .cutoff = 0.125, .same_group = true, .skin = skin};
        search.run();
        CHECK(search.wrong_lists() == 0);
        CHECK(search.wrong_levels() == 0);
      }
    Search<3> two_groups{.of = test::scattered<3>(50, 1.0, 3),
                         .sources = test::scattered<3>(150, 1.0, 4),
                         .box = test::cube<3>(1.0, {true, false, true}),
                         .cutoff = 0.2,
                         .same_group = false,
                         .skin = skin};
    two_groups.run();
    CHECK(two_groups.wrong_lists() == 0);
    CHECK(two_groups.wrong_levels() == 0);
  }
}

TEST_CASE("the lower levels are shorter: a list just built is read as far as an eighth of the skin") {
  Search<3> search{.of = test::scattered<3>(600, 1.0, 1),
                   .sources = test::scattered<3>(600, 1.0, 1),
                   .box = test::cube<3>(1.0, {true, true, true}),
                   .cutoff = 0.2,
                   .same_group = true,
                   .skin = 0.1};
  search.run();
  std::array<double, PairList::levels> entries{};
  search.for_each_particle([&](std::size_t block, std::size_t i, const auto&) {
    for (std::size_t level = 0; level < PairList::levels; ++level)
      entries[level] += static_cast<double>(search.list.of(block, i, level).once.size() + search.list.of(block, i, level).others.size());
  });
  for (std::size_t level = 0; level < PairList::levels; ++level) {
    const double radius = 0.2 + 0.1 * PairList::share[level];
    CHECK(entries[level] / entries.back() ==
          doctest::Approx(std::pow(radius / 0.3, 3)).epsilon(0.15));  // packs of four make the short ones longer
  }
}

TEST_CASE("a list is read as far as the share of the skin that has been used up asks for; all of it without a skin") {
  const auto above = [](double share) { return std::nextafter(share, 2.0); };
  CHECK(PairList::level_at(0.0) == 0);
  for (std::size_t level = 0; level + 1 < PairList::levels; ++level) {
    CHECK(PairList::level_at(PairList::share[level]) == level);
    CHECK(PairList::level_at(above(PairList::share[level])) == level + 1);
  }
  CHECK(PairList::level_at(1.0) == PairList::levels - 1);
  CHECK(PairList::level_at(std::nan("")) == PairList::levels - 1);
}

TEST_CASE("more neighbours than a list can count, and packs that are no power of two, are refused") {
  const test::Cloud<1> one(1, Vector<1>(0.0));
  const auto build = [&one](std::size_t sources, std::size_t pack_size) {
    CellGrid<1> grid;
    grid.build(test::Cloud<1>(sources, Vector<1>(0.0)), 1.0);
    dmp::Blocks blocks;
    blocks.set_bounds(std::vector<std::size_t>{0, 1});
    PairList list;
    const auto rows = static_cast<std::uint32_t>(sources);
    list.build<1>(blocks, one, grid, 1.0, 0.0, {.same_group = false, .owned = rows, .first_ghost = rows + 1, .owner = {}}, {}, pack_size);
    return list.of(0, 0).others.size();
  };
  CHECK(build(65535, 1) == 65535);
  CHECK_THROWS_WITH_AS(build(65536, 1), "neighbours::PairList: a particle must not have more than 65535 neighbours, got 65536",
                       dmp::ParameterError);
  CHECK(build(65536, 2) == 65536);
  CHECK_THROWS_WITH_AS(build(10, 3), "neighbours::PairList: pack must be a power of two, got 3", dmp::ParameterError);
}

TEST_CASE("two groups, each with lists of the other of its own reach, as with two supports") {
  const auto few = test::scattered<2>(120, 1.0, 1), many = test::clustered<2>(400, 1.0, 2);
  for (const double cutoff : {0.05, 0.3}) {
    Search<2> of_few{
        .of = few, .sources = many, .box = test::cube<2>(1.0, {true, true}), .cutoff = cutoff, .same_group = false, .skin = 0.02};
    Search<2> of_many{
        .of = many, .sources = few, .box = test::cube<2>(1.0, {true, true}), .cutoff = cutoff, .same_group = false, .skin = 0.02};
    of_few.run();
    of_many.run();
    CHECK(of_few.wrong_lists() == 0);
    CHECK(of_many.wrong_lists() == 0);
  }
}

TEST_CASE("a grid that reaches further than a list, as when another pair of groups has a longer cut-off") {
  const auto cloud = test::scattered<2>(300, 1.0, 1);
  const auto box = test::cube<2>(1.0, {true, false});
  Ghosts<2> ghosts;
  ghosts.build(cloud, box, 0.3);
  auto all = cloud;
  for (std::size_t k = 0; k < ghosts.size(); ++k) all.push_back(cloud[ghosts.owner[k]] + ghosts.shift[k]);
  Search<2> search{.of = cloud, .sources = cloud, .box = box, .cutoff = 0.08, .same_group = true, .ghosts = ghosts};
  for (const double cell_width : {0.02, 0.15, 0.6}) {
    CellGrid<2> grid;
    grid.build(all, cell_width);
    search.blocks.set_bounds(std::vector<std::size_t>{0, 100, 300});
    search.margin = grid.margin() + 1e-6;
    search.list.build<2>(search.blocks, cloud, grid, 0.08, 0.0, {true, search.owned(), search.first_ghost(), ghosts.owner}, {}, pack);
    CHECK(search.wrong_lists() == 0);
  }
}

TEST_CASE("lists of several blocks and threads hold whom looking at every pair finds") {
  const test::Threads threads(4);
  const auto cloud = test::scattered<1>(4200, 1.0, 6);
  Search<1> search{.of = cloud, .sources = cloud, .box = test::cube<1>(1.0, {true}), .cutoff = 0.002, .same_group = true, .skin = 0.0005,
                   .bounds = {0, 1, 1000, 1500, 3000, 3003, 4200}};
  search.run();
  CHECK(search.blocks.ranges().size() == 4);
  CHECK(search.wrong_lists() == 0);
}

TEST_CASE("lists do not depend on the number of threads, entry by entry") {
  const auto cloud = test::scattered<3>(5000, 1.0, 6);
  std::vector<std::size_t> bounds;
  for (std::size_t block = 0; block <= 10; ++block) bounds.push_back(500 * block);
  std::vector<std::vector<std::uint32_t>> first;
  for (const int count : {1, 2, 3, 4}) {
    const test::Threads threads(count);
    Search<3> search{.of = cloud,
                     .sources = cloud,
                     .box = test::cube<3>(1.0, {true, true, true}),
                     .cutoff = 0.08,
                     .same_group = true,
                     .skin = 0.02,
                     .bounds = bounds};
    search.run();
    CHECK(search.blocks.ranges().size() == static_cast<std::size_t>(count));
    std::vector<std::vector<std::uint32_t>> lists;
    search.for_each_particle([&](std::size_t block, std::size_t i, const auto&) {
      for (std::size_t level = 0; level < PairList::levels; ++level)
        lists.push_back(search.rows_once(block, i, level));
      const auto others = search.list.of(block, i).others;
      lists.emplace_back(others.begin(), others.end());
    });
    if (first.empty()) first = lists;
    CHECK(lists == first);
  }
}

TEST_CASE("the entries of a block are those of its particles") {
  Search<2> search{.of = test::clustered<2>(200, 1.0, 5),
                   .sources = test::clustered<2>(200, 1.0, 5),
                   .box = test::cube<2>(1.0),
                   .cutoff = 0.1,
                   .same_group = true,
                   .bounds = {0, 60, 61, 200}};
  search.run();
  std::vector<double> entries(3, 0.0);
  search.for_each_particle([&](std::size_t block, std::size_t i, const auto&) {
    const auto lists = search.list.of(block, i);
    entries[block] += static_cast<double>(lists.once.size() + lists.others.size());
  });
  for (std::size_t block = 0; block < 3; ++block) CHECK(search.list.entries(search.blocks, block) == entries[block]);
}

TEST_CASE("no particle has no list, one alone an empty one, and nobody to list leaves lists empty") {
  for (const bool same_group : {true, false}) {
    Search<2> nobody{.of = {}, .sources = {}, .box = test::cube<2>(1.0, {true, false}), .cutoff = 0.5, .same_group = same_group};
    if (!same_group) nobody.sources = test::scattered<2>(10, 1.0, 7);
    nobody.run();
    int lists = 0;
    nobody.for_each_particle([&](std::size_t, std::size_t, auto) { ++lists; });
    CHECK(lists == 0);
    CHECK(nobody.list.entries(nobody.blocks, 0) == 0.0);
  }
  Search<2> one{.of = {{0.0, 0.0}}, .sources = {{0.0, 0.0}}, .box = test::cube<2>(1.0, {true, true}), .cutoff = 0.3, .same_group = true};
  one.run();
  one.for_each_particle([&](std::size_t, std::size_t, const auto& rows) { CHECK(rows.empty()); });
  one.cutoff = 1.1;  // its own images
  one.box = test::cube<2>(1.2, {true, true});
  one.skin = 0.05;
  one.of[0] = one.sources[0] = {0.59, 0.0};
  one.run();
  one.for_each_particle([&](std::size_t, std::size_t, const auto& rows) { CHECK(rows.empty()); });  // 1.2 m away
  one.skin = 0.1001;
  one.run();
  one.for_each_particle([&](std::size_t, std::size_t, auto rows) { CHECK(one.images(rows).size() == 4); });
  Search<2> alone{
      .of = test::scattered<2>(10, 1.0, 8), .sources = {}, .box = test::cube<2>(1.0, {true, true}), .cutoff = 0.5, .same_group = false};
  alone.run();
  alone.for_each_particle([&](std::size_t, std::size_t, const auto& rows) { CHECK(rows.empty()); });
}

TEST_CASE("pairs of a block are listed once if its rows fit into 16 bits, and at both ends otherwise") {
  for (const std::size_t count : {dmp::Blocks::most_rows, dmp::Blocks::most_rows + 1}) {
    CAPTURE(count);
    test::Cloud<1> row;
    for (std::size_t k = 0; k < count; ++k) row.emplace_back(static_cast<double>(k) / static_cast<double>(count));
    Search<1> search{.of = row, .sources = row, .box = test::cube<1>(1.0), .cutoff = 1.5 / static_cast<double>(count), .same_group = true,
                     .bounds = {0, count}};
    search.run();
    std::size_t once = 0, others = 0;
    for (std::size_t i = 0; i < count; ++i) {
      once += search.rows_once(0, i).size();
      others += search.images(search.list.of(0, i).others).size();
    }
    CHECK(once == (count == dmp::Blocks::most_rows ? count - 1 : 0));
    CHECK(others == (count == dmp::Blocks::most_rows ? 0 : 2 * (count - 1)));
  }
}

TEST_CASE("a list built again forgets the lists before") {
  Search<2> search{.of = test::scattered<2>(100, 1.0, 9),
                   .sources = test::scattered<2>(100, 1.0, 9),
                   .box = test::cube<2>(1.0),
                   .cutoff = 0.5,
                   .same_group = true};
  search.run();
  search.of = search.sources = test::scattered<2>(60, 1.0, 10);
  search.cutoff = 0.1;
  search.run();
  CHECK(search.wrong_lists() == 0);
}

TEST_CASE("bonded particles leave the lists, as ghosts too, and the fillers close up") {
  // A ring of 48 through the periodic face; the radius reaches 4 to either side.
  test::Cloud<1> ring;
  for (int k = 0; k < 48; ++k) ring.emplace_back((k + 0.5) / 48.0 - 0.5);
  dmp::neighbours::BondGraph graph(48);
  for (std::uint32_t k = 0; k < 48; ++k) {
    graph[k].push_back((k + 1) % 48);
    graph[(k + 1) % 48].push_back(k);
  }
  for (const int reach : {1, 2, 3}) {
    CAPTURE(reach);
    Exclusions excluded;
    excluded.build(graph, {0, 48}, {0, 48}, reach);
    Search<1> search{
        .of = ring, .sources = ring, .box = test::cube<1>(1.0, {true}), .cutoff = 3.0 / 48.0, .same_group = true, .skin = 1.2 / 48.0};
    search.run(excluded);
    search.for_each_particle([&](std::size_t block, std::size_t i, const auto& rows) {
      CHECK(search.is_wide(block));
      std::vector<std::uint32_t> listed, expected;
      std::array<std::size_t, 2> expected_in{};  // once, and at both ends
      for (const auto& image : search.images(rows)) listed.push_back(image.first);
      for (std::uint32_t j = 0; j < 48; ++j) {
        const int around = std::abs(static_cast<int>(i) - static_cast<int>(j)), apart = std::min(around, 48 - around);
        const bool listed_there = apart == around && j < i && j >= search.blocks.begin(block);
        if (!(apart > reach && apart <= 4) || listed_there) continue;
        expected.push_back(j);
        ++expected_in[apart == around && j < search.blocks.end(block) && j >= search.blocks.begin(block) ? 0 : 1];
      }
      CHECK(listed == expected);
      const auto lists = search.list.of(block, i);
      CHECK(lists.once.size() == (expected_in[0] + pack - 1) / pack * pack);
      CHECK(lists.others.size() == (expected_in[1] + pack - 1) / pack * pack);
    });
  }
}
