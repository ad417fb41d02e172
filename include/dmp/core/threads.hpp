#pragma once
#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <exception>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>
#if defined(_OPENMP)
#include <omp.h>
#endif

namespace dmp {

/// Threads that sweeps may use: OpenMP's setting (OMP_NUM_THREADS, omp_set_num_threads), 1 without OpenMP.
[[nodiscard]] inline int available_threads() noexcept {
#if defined(_OPENMP)
  return omp_get_max_threads();
#else
  return 1;
#endif
}
inline void use_threads([[maybe_unused]] int count) noexcept {
#if defined(_OPENMP)
  omp_set_num_threads(count);
#endif
}

/// Division of rows 0 .. count - 1 into contiguous ranges, one per thread; a range is not worth a thread below `least` rows.
/// What a range computes never depends on where it begins and ends, so results do not depend on the number of threads.
class Ranges {
 public:
  Ranges() = default;
  explicit Ranges(std::size_t count, std::size_t least = 1024) {
    const std::size_t parts = std::clamp<std::size_t>(count / least, 1, static_cast<std::size_t>(available_threads()));
    bounds_.resize(parts + 1);
    for (std::size_t part = 0; part <= parts; ++part) bounds_[part] = count * part / parts;
  }
  [[nodiscard]] std::size_t size() const noexcept { return bounds_.size() - 1; }
  [[nodiscard]] std::size_t begin(std::size_t range) const noexcept { return bounds_[range]; }
  [[nodiscard]] std::size_t end(std::size_t range) const noexcept { return bounds_[range + 1]; }

  /// The same with bounds of the caller's: range r holds rows bounds[r] .. bounds[r + 1] - 1.
  explicit Ranges(std::vector<std::size_t> bounds) : bounds_(std::move(bounds)) {}

 private:
  std::vector<std::size_t> bounds_{0, 0};
};

namespace detail {
template <class F, class... Number>
void call_object(void* object, Number... number) {
  (*static_cast<F*>(object))(number...);
}
/// A function of a range without its type: what a loop does is compiled once, not once for each way to run it.
struct RangeFunction {
  void* object;
  void (*call)(void* object, std::size_t range, std::size_t first, std::size_t last);
};
inline void run_ranges(const Ranges& ranges, RangeFunction function) {
  if (ranges.size() == 1) {
    function.call(function.object, 0, ranges.begin(0), ranges.end(0));
    return;
  }
#if defined(_OPENMP)
  std::exception_ptr failure;
  const int count = static_cast<int>(ranges.size());
#pragma omp parallel for schedule(static, 1) num_threads(count)
  for (int range = 0; range < count; ++range) {
    const auto r = static_cast<std::size_t>(range);
    try {
      function.call(function.object, r, ranges.begin(r), ranges.end(r));
    } catch (...) {
#pragma omp critical(dmp_failure)
      failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
#else
  for (std::size_t range = 0; range < ranges.size(); ++range) function.call(function.object, range, ranges.begin(range), ranges.end(range));
#endif
}
}  // namespace detail

/// Calls function(range, first row, one past the last row) for every range, each on its own thread. What a range throws is thrown on.
template <class Function>
void for_each_range(const Ranges& ranges, Function&& function) {
  using F = std::remove_reference_t<Function>;
  detail::run_ranges(ranges, {const_cast<std::remove_const_t<F>*>(&function),
                              detail::call_object<F, std::size_t, std::size_t, std::size_t>});
}

/// The largest of function(first row, one past the last row) over all ranges, by `merge(a, b)`, which must not depend on the order.
template <class T, class Function, class Merge>
[[nodiscard]] T merge_ranges(const Ranges& ranges, T start, Function&& function, Merge&& merge) {
  for_each_range(ranges, [&](std::size_t, std::size_t first, std::size_t last) {
    const T part = function(first, last);
#if defined(_OPENMP)
#pragma omp critical(dmp_merge)
#endif
    start = merge(start, part);
  });
  return start;
}

/// Rows in contiguous blocks, which depend on the particles alone, and the blocks divided among the threads. Who is summed with whom, and
/// in which order, is decided within blocks: results do not depend on the number of threads.
class Blocks {
 public:
  /// Rows of a block where `count` particles are sorted in space: its sums stay in a core's cache, most neighbours are in the same block,
  /// and there are enough blocks to share out.
  [[nodiscard]] static constexpr std::size_t rows_wanted(std::size_t count) noexcept {
    return std::clamp<std::size_t>(count / 64, 4096, 16384);
  }

  /// Rows of a block that 16 bits can name.
  static constexpr std::size_t most_rows = std::size_t{1} << 16;
  /// For each block, rows after those of the particles where sums end up that nobody wants, one per lane; apart, so that no two threads
  /// share a cache line.
  static constexpr std::size_t far_rows = 16;
  [[nodiscard]] std::size_t far_row(std::size_t block) const noexcept { return bounds_.back() + far_rows * block; }

  Blocks() = default;
  /// Equal blocks, for particles in an order that is not ours. Those that act on each other lie apart by whole layers of the body: blocks
  /// are at least five and a half layers of a cube (in two dimensions a square) thick, so that few bonds are listed at both ends, and at
  /// most 16 unless those would exceed `most_rows`.
  explicit Blocks(std::size_t count, int dimension = 3) {
    const auto thick = static_cast<std::size_t>(std::pow(static_cast<double>(count), 1.0 / dimension) / 5.5);
    const std::size_t wanted = std::clamp<std::size_t>(std::min(count / 4096, std::bit_floor(thick)), 1, 16);
    const std::size_t blocks = std::max(wanted, (count + most_rows - 1) / most_rows);
    bounds_.resize(blocks + 1);
    for (std::size_t b = 0; b <= blocks; ++b) bounds_[b] = count * b / blocks;
    divide_evenly();
  }
  /// Block b holds rows bounds[b] .. bounds[b + 1] - 1.
  void set_bounds(std::span<const std::size_t> bounds) {
    bounds_.assign(bounds.begin(), bounds.end());
    divide_evenly();
  }
  /// Gives every thread blocks of about the same total cost; `cost(block)` in any unit.
  template <class Cost>
  void divide(const Cost& cost) {
    std::vector<double> costs(size());
    for (std::size_t b = 0; b < size(); ++b) costs[b] = cost(b);
    divide_by(costs);
  }

  [[nodiscard]] std::size_t size() const noexcept { return bounds_.size() - 1; }
  [[nodiscard]] std::size_t begin(std::size_t block) const noexcept { return bounds_[block]; }
  [[nodiscard]] std::size_t end(std::size_t block) const noexcept { return bounds_[block + 1]; }
  [[nodiscard]] const Ranges& ranges() const noexcept { return ranges_; }  ///< rows of each thread, whole blocks
  [[nodiscard]] std::size_t first_block(std::size_t range) const noexcept { return first_block_[range]; }

 private:
  void divide_by(std::span<const double> cost) {
    double total = 0.0;
    for (const double c : cost) total += c;
    const std::size_t parts = worth_ranges();
    first_block_.assign(1, 0);
    double reached = 0.0;
    for (std::size_t b = 0; b < size(); ++b) {  // a block goes where its middle lies
      const double middle = reached + 0.5 * cost[b];
      while (first_block_.size() < parts && middle * static_cast<double>(parts) >= total * static_cast<double>(first_block_.size()))
        first_block_.push_back(b);
      reached += cost[b];
    }
    first_block_.resize(parts, size());
    first_block_.push_back(size());
    std::vector<std::size_t> rows;
    for (const std::size_t b : first_block_) rows.push_back(bounds_[b]);
    ranges_ = Ranges(std::move(rows));
  }
  [[nodiscard]] std::size_t worth_ranges() const { return std::min(Ranges(bounds_.back()).size(), size()); }
  void divide_evenly() {
    divide([this](std::size_t b) { return static_cast<double>(end(b) - begin(b)); });
  }

  std::vector<std::size_t> bounds_{0, 0}, first_block_{0, 1};
  Ranges ranges_;
};

namespace detail {
/// A function of a block without its type.
struct BlockFunction {
  void* object;
  void (*call)(void* object, std::size_t thread, std::size_t block);
};
inline void run_blocks(const Blocks& blocks, BlockFunction function) {
  const std::size_t ranges = blocks.ranges().size();
  constexpr std::size_t apart = 64 / sizeof(std::size_t);  // no two threads share a cache line until one is done
  std::vector<std::size_t> next(apart * ranges);
  for (std::size_t range = 0; range < ranges; ++range) next[apart * range] = blocks.first_block(range);
  for_each_range(blocks.ranges(), [&](std::size_t thread, std::size_t, std::size_t) {
    for (std::size_t k = 0; k < ranges; ++k) {
      const std::size_t range = (thread + k) % ranges, end = blocks.first_block(range + 1);
      const std::atomic_ref<std::size_t> first(next[apart * range]);
      for (std::size_t block; (block = first.fetch_add(1, std::memory_order_relaxed)) < end;)
        function.call(function.object, thread, block);
    }
  });
}
}  // namespace detail

/// Calls function(thread, block) for every block. Each thread begins with the blocks of its own range, one after the other, and takes over
/// what others have not begun when it is done: cores are not equally fast at all times.
template <class Function>
void for_each_block(const Blocks& blocks, Function&& function) {
  using F = std::remove_reference_t<Function>;
  detail::run_blocks(blocks, {const_cast<std::remove_const_t<F>*>(&function), detail::call_object<F, std::size_t, std::size_t>});
}

/// zero + function(row) of all rows, added up by blocks, and the blocks in their order: the same bits for any number of threads.
template <class T, class Function>
[[nodiscard]] T sum_over_rows(const Blocks& blocks, const T& zero, Function&& function) {
  std::vector<T> parts(blocks.size(), zero);
  for_each_block(blocks, [&](std::size_t, std::size_t block) {
    T part = zero;
    for (std::size_t i = blocks.begin(block); i < blocks.end(block); ++i) part += function(i);
    parts[block] = part;
  });
  T sum = zero;
  for (const T& part : parts) sum += part;
  return sum;
}

}  // namespace dmp
