#include <algorithm>
#include <numeric>
#include "neighbours/oracle.hpp"
#include <doctest/doctest.h>
#include <dmp/neighbours/counting_sort.hpp>

using dmp::neighbours::CountingSort;
using Rows = std::vector<std::uint32_t>;

namespace {

Rows rows_of(const CountingSort& sort) { return {sort.rows().begin(), sort.rows().end()}; }

/// Rows sorted by the standard library, those of one key in their order.
Rows expected(const Rows& keys) {
  Rows rows(keys.size());
  std::iota(rows.begin(), rows.end(), 0u);
  std::stable_sort(rows.begin(), rows.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  return rows;
}

Rows keys_at_random(std::size_t count, std::size_t keys, unsigned seed) {
  test::Random random(seed);
  Rows result(count);
  for (auto& key : result) key = static_cast<std::uint32_t>(static_cast<double>(keys) * random() * random());  // small ones more often
  return result;
}

void sort_by(CountingSort& sort, const Rows& keys, std::size_t number) {
  sort.sort(keys.size(), number, [&keys](std::size_t row) { return keys[row]; });
}

}  // namespace

TEST_CASE("rows come in the order of their keys, those of one key in their own, for any number of threads") {
  for (const int count : {1, 2, 3, 4}) {
    const test::Threads threads(count);
    CountingSort sort;  // one for all: nothing stays from the sort before
    for (const std::size_t rows : {10000u, 3u, 5000u, 1u, 0u})
      for (const std::size_t keys : {1u, 7u, 3000u, 100000u}) {
        CAPTURE(count);
        CAPTURE(rows);
        CAPTURE(keys);
        const auto key = keys_at_random(rows, keys, 1);
        sort_by(sort, key, keys);
        CHECK(rows_of(sort) == expected(key));
      }
  }
}

TEST_CASE("where the rows of a key begin, those without rows among them") {
  for (const int count : {1, 4}) {
    const test::Threads threads(count);
    constexpr std::size_t keys = 5000;
    const auto key = keys_at_random(4000, keys, 2);
    CountingSort sort;
    sort_by(sort, key, keys);
    std::size_t wrong = 0;
    for (std::size_t k = 0; k <= keys; ++k)
      wrong +=
          sort.begin(k) != static_cast<std::size_t>(std::count_if(key.begin(), key.end(), [k](std::uint32_t other) { return other < k; }));
    CHECK(wrong == 0);
  }
}

TEST_CASE("whole vector registers may be read beyond the last row") {
  CountingSort sort;
  sort_by(sort, {2, 0, 1}, 3);
  CHECK(rows_of(sort) == Rows{1, 2, 0});
  std::uint32_t beyond = 0;
  for (std::size_t k = 0; k < CountingSort::readable_beyond; ++k) beyond |= sort.rows().data()[3 + k];  // for the sanitizer
  CHECK(beyond == 0);
}
