#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <dmp/core/aligned.hpp>
#include <dmp/core/field.hpp>
#include <dmp/core/pack.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/particles/records.hpp>

namespace dmp::particles {

/// What bonds say of a particle, and pairs of the partner further down, summed in double, one record per particle, padded to whole vector
/// registers.
template <int Dim, class List>
class Sums;
template <int Dim, class... Field>
class Sums<Dim, Fields<Field...>> {
 public:
  using List = Fields<Field...>;
  template <class T>
  using view = View<Dim, T, List>;
  static constexpr int numbers = (0 + ... + numbers_of<Field, Dim>);
  static constexpr int width = native_width<double>;
  static constexpr int stride = (numbers + width - 1) / width * width;  ///< doubles from one record to the next

  void resize(std::size_t count) {
    count_ = count;
    resize_with_margin(data_, count * stride);
  }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] std::size_t bytes() const noexcept { return data_.capacity() * sizeof(double); }
  [[nodiscard]] double* data() noexcept { return data_.data(); }
  void set_zero(std::size_t first, std::size_t last) noexcept {
    std::fill(data_.data() + first * stride, data_.data() + last * stride, 0.0);
  }

  /// Adds lane l to record index[l].
  struct Adder {
    double* data;

    /// The same with rows counted from `row`.
    [[nodiscard, gnu::always_inline]] Adder from(std::size_t row) const noexcept { return {data + row * stride}; }
    template <class Real, int Width>
    [[gnu::always_inline]] void operator()(const std::uint32_t* index, view<Pack<Real, Width>>& lanes) const noexcept {
      Pack<Real, Width> numbers_of[stride > 0 ? stride : 1];
      detail::for_each_number(
          lanes, [&numbers_of](auto slot, Pack<Real, Width> number) __attribute__((always_inline)) { numbers_of[slot] = number; });
      unrolled<Width / width>([&](auto part) __attribute__((always_inline)) {
        Pack<double, width> doubles[stride > 0 ? stride : 1];
        unrolled<numbers>([&](auto slot) __attribute__((always_inline)) { doubles[slot] = part_of<part, width>(numbers_of[slot]); });
        add_transposed<numbers>(data, stride, index + part * width, doubles);
      });
    }
  };
  [[nodiscard]] Adder adder() noexcept { return {data_.data()}; }

  /// Sum over the lanes of every number.
  template <class Real, int Width>
  [[nodiscard, gnu::always_inline]] static view<double> totals(view<Pack<Real, Width>>& lanes) noexcept {
    Pack<double, width> doubles[stride > 0 ? stride : 1];
    detail::for_each_number(
        lanes, [&doubles](auto slot, Pack<Real, Width> number) __attribute__((always_inline)) {
          doubles[slot] = part_of<0, width>(number);
          unrolled<Width / width - 1>([&](auto part) __attribute__((always_inline)) { doubles[slot] += part_of<part + 1, width>(number); });
        });
    double total[stride > 0 ? stride : 1];
    sum_transposed<numbers>(doubles, total);
    view<double> record;
    detail::for_each_number(
        record, [&total](auto slot, double& number) __attribute__((always_inline)) { number = total[slot]; });
    return record;
  }
  /// The same, and what record `index` holds, which is zero thereafter.
  template <class Real, int Width>
  [[nodiscard, gnu::always_inline]] view<double> take(std::size_t index, view<Pack<Real, Width>>& lanes) noexcept {
    view<double> record = totals(lanes);
    double* const from = data_.data() + index * stride;
    detail::for_each_number(
        record, [from](auto slot, double& number) __attribute__((always_inline)) {
          number += from[slot];
          from[slot] = 0.0;
        });
    return record;
  }

 private:
  AlignedVector<double> data_;
  std::size_t count_ = 0;
};

}  // namespace dmp::particles
