#pragma once
#include <algorithm>
#include <cstddef>
#include <exception>
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

 private:
  std::vector<std::size_t> bounds_{0, 0};
};

/// Calls function(range, first row, one past the last row) for every range, each on its own thread. What a range throws is thrown on.
template <class Function>
void for_each_range(const Ranges& ranges, Function&& function) {
  if (ranges.size() == 1) {
    function(std::size_t{0}, ranges.begin(0), ranges.end(0));
    return;
  }
#if defined(_OPENMP)
  std::exception_ptr failure;
  const int count = static_cast<int>(ranges.size());
#pragma omp parallel for schedule(static, 1) num_threads(count)
  for (int range = 0; range < count; ++range) {
    const auto r = static_cast<std::size_t>(range);
    try {
      function(r, ranges.begin(r), ranges.end(r));
    } catch (...) {
#pragma omp critical(dmp_failure)
      failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
#else
  for (std::size_t range = 0; range < ranges.size(); ++range) function(range, ranges.begin(range), ranges.end(range));
#endif
}

}  // namespace dmp
