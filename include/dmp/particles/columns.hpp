#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>
#include <dmp/core/field.hpp>
#include <dmp/core/vector.hpp>

namespace dmp::particles {

/// What one particle stores of a field.
template <int Dim, class Field>
using Value = std::conditional_t<Field::is_vector, Vector<Dim>, double>;

/// Structure-of-arrays store: one column per field, all of one length, nothing else.
template <int Dim, class List>
class Columns;
template <int Dim, class... Field>
class Columns<Dim, Fields<Field...>> {
 public:
  using List = Fields<Field...>;
  static constexpr std::size_t bytes_per_particle = (std::size_t{0} + ... + sizeof(Value<Dim, Field>));

  template <class F>
  [[nodiscard]] std::vector<Value<Dim, F>>& get() noexcept {
    return std::get<Column<F>>(columns_).values;
  }
  template <class F>
  [[nodiscard]] const std::vector<Value<Dim, F>>& get() const noexcept {
    return std::get<Column<F>>(columns_).values;
  }
  void resize(std::size_t count) { (resize_one(get<Field>(), count), ...); }

  /// Moves row order[k] to row k, for all columns; `order` is a permutation of 0 .. count - 1.
  void permute(std::span<const std::uint32_t> order) {
    (permute_one(get<Field>(), std::get<Scratch<Value<Dim, Field>>>(scratch_).values, order), ...);
  }

 private:
  template <class F>
  struct Column {
    std::vector<Value<Dim, F>> values;
  };
  template <class V>
  struct Scratch {
    std::vector<V> values;
  };

  template <class V>
  static void resize_one(std::vector<V>& values, std::size_t count) {
    if constexpr (std::is_same_v<V, double>) values.resize(count, 0.0);
    else values.resize(count, V::Zero());
  }
  template <class V>
  static void permute_one(std::vector<V>& values, std::vector<V>& scratch, std::span<const std::uint32_t> order) {
    scratch.resize(values.size());
    const auto count = static_cast<std::ptrdiff_t>(order.size());
    for (std::ptrdiff_t k = 0; k < count; ++k) scratch[static_cast<std::size_t>(k)] = values[order[static_cast<std::size_t>(k)]];
    values.swap(scratch);
  }

  std::tuple<Column<Field>...> columns_;
  std::tuple<Scratch<double>, Scratch<Vector<Dim>>> scratch_;
};

}  // namespace dmp::particles
