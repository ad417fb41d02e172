#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>
#include "support/threads.hpp"
#include <doctest/doctest.h>
#include <dmp/core/threads.hpp>

using dmp::Blocks;
using dmp::Ranges;

namespace {

/// How often each of `count` rows is visited by for_each_block and by for_each_range.
struct Visits {
  std::vector<int> by_block, by_range;

  Visits(const Blocks& blocks, std::size_t count) : by_block(count, 0), by_range(count, 0) {
    std::mutex one_at_a_time;
    dmp::for_each_range(blocks.ranges(), [&](std::size_t, std::size_t first, std::size_t last) {
      const std::lock_guard lock(one_at_a_time);
      for (std::size_t row = first; row < last; ++row) ++by_range.at(row);
    });
    dmp::for_each_block(blocks, [&](std::size_t, std::size_t block) {
      const std::lock_guard lock(one_at_a_time);
      for (std::size_t row = blocks.begin(block); row < blocks.end(block); ++row) ++by_block.at(row);
    });
  }
  [[nodiscard]] bool once_each() const { return by_block == std::vector<int>(by_block.size(), 1) && by_range == by_block; }
};

Blocks of_bounds(const std::vector<std::size_t>& bounds) {
  Blocks blocks;
  blocks.set_bounds(bounds);
  return blocks;
}

std::vector<std::size_t> bounds_of(const Blocks& blocks) {
  std::vector<std::size_t> bounds{blocks.begin(0)};
  for (std::size_t block = 0; block < blocks.size(); ++block) bounds.push_back(blocks.end(block));
  return bounds;
}

}  // namespace

TEST_CASE("every row lies in one block and in one range, and a range holds whole blocks, for any number of rows and threads") {
  for (const int threads : {1, 2, 3, 4}) {
    const test::Threads use(threads);
    for (const std::size_t count : {0u, 1u, 1023u, 2048u, 4096u, 8191u, 8192u, 20000u, 70001u, 200003u}) {
      CAPTURE(threads);
      CAPTURE(count);
      const Blocks blocks(count);
      const Visits visits(blocks, count);
      CHECK(visits.once_each());
      CHECK(blocks.ranges().size() <= static_cast<std::size_t>(threads));
      CHECK(blocks.ranges().size() <= blocks.size());
    }
  }
}

TEST_CASE("blocks depend on the rows alone, not on the threads: equal, of 4096 rows at least, 16 as long as 16 bits name a row") {
  for (const std::size_t count : {0u, 5u, 8191u, 8192u, 20000u, 70001u, 1000000u}) {
    std::vector<std::size_t> first;
    for (const int threads : {1, 2, 3, 4}) {
      const test::Threads use(threads);
      const Blocks blocks(count);
      if (first.empty()) first = bounds_of(blocks);
      CHECK(bounds_of(blocks) == first);
    }
    CHECK(first.front() == 0);
    CHECK(first.back() == count);
    CHECK(first.size() - 1 <= 16);
    for (std::size_t block = 0; block + 1 < first.size(); ++block) {
      const std::size_t rows = first[block + 1] - first[block];
      CHECK((first.size() == 2 || rows >= 4096));
      CHECK(rows + 1 >= count / (first.size() - 1));
      CHECK(rows <= count / (first.size() - 1) + 1);
    }
  }
  CHECK(Blocks(8191).size() == 1);
  CHECK(Blocks(8192).size() == 2);
  CHECK(Blocks(27 * 27 * 27).size() == 4);
  CHECK(Blocks(36 * 36 * 36).size() == 4);  // layers of a cube: 6 blocks of 6 were possible, and are no power of two
  CHECK(Blocks(43 * 43 * 43).size() == 4);  // 5.4 to a block would make 8
  CHECK(Blocks(46 * 46 * 46).size() == 8);  // 5.75 to a block
  CHECK(Blocks(128 * 128, 2).size() == 4);  // in the plane 4096 rows are the bound
  CHECK(Blocks(256 * 256, 2).size() == 16);
  CHECK(Blocks(100000, 1).size() == 16);
  CHECK(Blocks(1000000).size() == 16);
  CHECK(Blocks(16 * Blocks::most_rows).size() == 16);
  CHECK(Blocks(16 * Blocks::most_rows + 1).size() == 17);
}

TEST_CASE("bounds of the caller's are taken as they are") {
  const test::Threads use(3);
  const std::vector<std::size_t> bounds{0, 10, 3000, 3001, 9000};
  const Blocks blocks = of_bounds(bounds);
  CHECK(bounds_of(blocks) == bounds);
  CHECK(Visits(blocks, 9000).once_each());
  CHECK(blocks.ranges().size() == 3);
}

TEST_CASE("threads get about the same cost each: no more than one block off the mean, wherever the cost lies") {
  constexpr std::size_t count = 40, rows = 200;
  std::vector<std::size_t> bounds(count + 1);
  for (std::size_t block = 0; block <= count; ++block) bounds[block] = rows * block;
  const std::vector<double (*)(std::size_t)> costs{
      [](std::size_t) { return 1.0; }, [](std::size_t block) { return static_cast<double>(block); },
      [](std::size_t block) { return block < 4 ? 10.0 : 1.0; }, [](std::size_t block) { return block % 7 == 0 ? 5.0 : 0.0; }};
  for (const int threads : {1, 2, 3, 4})
    for (std::size_t k = 0; k < costs.size(); ++k) {
      CAPTURE(threads);
      CAPTURE(k);
      const test::Threads use(threads);
      Blocks blocks = of_bounds(bounds);
      blocks.divide(costs[k]);
      CHECK(bounds_of(blocks) == bounds);
      REQUIRE(blocks.ranges().size() == static_cast<std::size_t>(threads));
      CHECK(Visits(blocks, rows * count).once_each());
      double total = 0.0, dearest = 0.0;
      for (std::size_t block = 0; block < count; ++block) total += costs[k](block), dearest = std::max(dearest, costs[k](block));
      for (std::size_t range = 0; range < blocks.ranges().size(); ++range) {
        double cost = 0.0;
        for (std::size_t block = blocks.first_block(range); block < blocks.first_block(range + 1); ++block) cost += costs[k](block);
        CHECK(std::abs(cost - total / threads) <= dearest);
      }
    }
}

TEST_CASE("more threads than blocks, and blocks without cost, lose no row") {
  const test::Threads use(4);
  Blocks two = of_bounds({0, 5000, 10000});
  CHECK(two.ranges().size() == 2);
  for (const double first : {0.0, 1.0, 1e9}) {
    two.divide([first](std::size_t block) { return block == 0 ? first : 1.0; });
    CHECK(Visits(two, 10000).once_each());
  }
  two.divide([](std::size_t) { return 0.0; });
  CHECK(Visits(two, 10000).once_each());
}

TEST_CASE("a thread that is held up keeps one block from being done, and no more: others take over the rest of its range") {
  const test::Threads use(2);
  const Blocks blocks = of_bounds({0, 1024, 2048, 3072, 4096});
  REQUIRE(blocks.first_block(1) == 2);
  std::atomic<int> done = 0;
  int tries = 0;
  dmp::for_each_block(blocks, [&](std::size_t, std::size_t block) {
    if (block == 0)
      for (; done < 3 && tries < 100000; ++tries) std::this_thread::sleep_for(std::chrono::microseconds(50));
    ++done;
  });
  CHECK(done == 4);
  CHECK(tries < 100000);
}

TEST_CASE("what a block throws is thrown on") {
  const test::Threads use(2);
  CHECK_THROWS_AS(dmp::for_each_block(Blocks(20000),
                                      [](std::size_t, std::size_t block) {
                                        if (block == 3) throw std::runtime_error("3");
                                      }),
                  std::runtime_error);
}

TEST_CASE("the largest over all ranges does not depend on the threads") {
  for (const int threads : {1, 2, 3, 4}) {
    const test::Threads use(threads);
    const auto largest = dmp::merge_ranges(
        Ranges(10000), 0.0,
        [](std::size_t first, std::size_t last) {
          double part = 0.0;
          for (std::size_t row = first; row < last; ++row) part = std::max(part, static_cast<double>(row * 7919 % 10007));
          return part;
        },
        [](double a, double b) { return std::max(a, b); });
    CHECK(largest == 10006.0);
  }
}
