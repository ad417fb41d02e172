#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>
#include <dmp/core/aligned.hpp>
#include <dmp/core/threads.hpp>

namespace dmp::neighbours {

/// Rows in the order of a whole number each has; rows of one number keep their order. Every thread places the rows of its own share of the
/// numbers, so the result does not depend on how many there are.
class CountingSort {
 public:
  /// key(row) < keys for all rows 0 .. count - 1.
  template <class Key>
  void sort(std::size_t count, std::size_t keys, const Key& key) {
    resize_with_margin(key_, count);
    for_each_range(Ranges(count), [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t row = first; row < last; ++row) key_[row] = static_cast<std::uint32_t>(key(row));
    });
    place_rows(count, keys);
  }

  [[nodiscard]] std::span<const std::uint32_t> rows() const noexcept { return {rows_.data(), count_}; }
  static constexpr std::size_t readable_beyond = 32;  ///< entries after the last row, for whole vector registers
  /// Rows of key k are rows()[begin(k)] .. rows()[begin(k + 1) - 1].
  [[nodiscard]] std::size_t begin(std::size_t k) const noexcept { return start_[k]; }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return (key_.capacity() + start_.capacity() + rows_.capacity()) * sizeof(std::uint32_t);
  }

 private:
  void place_rows(std::size_t count, std::size_t keys) {
    start_.assign(keys + 2, 0);
    resize_with_margin(rows_, count + readable_beyond);
    std::fill(rows_.end() - readable_beyond, rows_.end(), 0u);
    count_ = count;
    std::uint32_t* const start = start_.data() + 1;  // counts, then where each key begins, then (every row placed) where it ends
    const Ranges shares(keys, 1024);
    for_each_range(shares, [&](std::size_t, std::size_t first, std::size_t last) {
      for (const std::uint32_t k : key_)
        if (k - first < last - first) ++start[k];
    });
    std::uint32_t before = 0;
    for (std::size_t k = 0; k < keys; ++k) {
      const std::uint32_t here = start[k];
      start[k] = before;
      before += here;
    }
    for_each_range(shares, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t row = 0; row < count; ++row)
        if (key_[row] - first < last - first) rows_[start[key_[row]]++] = static_cast<std::uint32_t>(row);
    });
  }

  std::vector<std::uint32_t> key_, start_{0, 0}, rows_;
  std::size_t count_ = 0;
};

}  // namespace dmp::neighbours
