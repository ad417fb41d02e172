#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <dmp/core/aligned.hpp>
#include <dmp/core/field.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/core/vector.hpp>

namespace dmp::particles {

/// What one particle stores of a field.
template <int Dim, class Field>
using Value = std::conditional_t<Field::is_vector, Vector<Dim>, double>;

namespace detail {
template <int Dim, class Field>
struct Column {
  AlignedVector<Value<Dim, Field>> values;
};
}  // namespace detail

/// Structure-of-arrays store: one column per field, all of one length, nothing else.
template <int Dim, class List>
class Columns;
template <int Dim, class... Field>
class Columns<Dim, Fields<Field...>> : detail::Column<Dim, Field>... {
 public:
  using List = Fields<Field...>;
  static constexpr std::size_t bytes_per_particle = (std::size_t{0} + ... + sizeof(Value<Dim, Field>));

  template <class F>
  [[nodiscard]] AlignedVector<Value<Dim, F>>& get() noexcept {
    return detail::Column<Dim, F>::values;
  }
  template <class F>
  [[nodiscard]] const AlignedVector<Value<Dim, F>>& get() const noexcept {
    return detail::Column<Dim, F>::values;
  }
  void resize(std::size_t count) {
    const Ranges ranges(count);
    (resize_one(get<Field>(), count, ranges), ...);
  }

  [[gnu::always_inline]] void prefetch(std::size_t row) const noexcept {
    (__builtin_prefetch(get<Field>().data() + row), ...);
  }

  /// Moves row order[k] to row k, for all columns; `order` is a permutation of 0 .. count - 1, `scratch` has room for count vectors.
  void permute(std::span<const std::uint32_t> order, const Ranges& ranges, double* scratch) {
    (permute_one(get<Field>(), order, ranges, scratch), ...);
  }

 private:
  template <class V>
  static void resize_one(AlignedVector<V>& values, std::size_t count, const Ranges& ranges) {
    const std::size_t old = std::min(values.size(), count);
    values.resize(count);
    for_each_range(ranges,
                   [&values, old](std::size_t, std::size_t first, std::size_t last) {  // each thread places its rows in memory
                     if (last <= old) return;
                     first = std::max(first, old);
                     if constexpr (std::is_same_v<V, double>) std::fill(values.data() + first, values.data() + last, 0.0);
                     else std::fill(values.data() + first, values.data() + last, V::Zero());
                   });
  }
  template <class V>
  static void permute_one(AlignedVector<V>& values, std::span<const std::uint32_t> order, const Ranges& ranges, double* scratch) {
    V* const copy = reinterpret_cast<V*>(scratch);
    for_each_range(ranges, [&](std::size_t, std::size_t first, std::size_t last) {
      std::copy(values.data() + first, values.data() + last, copy + first);
    });
    for_each_range(ranges, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) values[k] = copy[order[k]];
    });
  }
};

}  // namespace dmp::particles
