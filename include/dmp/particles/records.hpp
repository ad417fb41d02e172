#pragma once
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <dmp/core/aligned.hpp>
#include <dmp/core/field.hpp>
#include <dmp/core/pack.hpp>

namespace dmp::particles {

namespace detail {
/// Calls function(slot, number) for every number of the view, slots being compile-time numbers.
template <int Dim, class T, class... Field, class Function>
[[gnu::always_inline]] inline void for_each_number(View<Dim, T, Fields<Field...>>& view, Function function) noexcept {
  constexpr auto numbers_before = []<class Wanted>(std::type_identity<Wanted>) consteval {
    int count = 0;
    bool found = false;
    ((found = found || std::is_same_v<Wanted, Field>, count += found ? 0 : (Field::is_vector ? Dim : 1)), ...);
    return count;
  };
  const auto one = [&]<class F>(std::type_identity<F>) __attribute__((always_inline)) {
    constexpr int first = numbers_before(std::type_identity<F>{});
    auto& member = F::of(view);
    if constexpr (F::is_vector)
      unrolled<Dim>([&](auto d)
                        __attribute__((always_inline)) { function(std::integral_constant<int, first + d>{}, member.component[d]); });
    else function(std::integral_constant<int, first>{}, member);
  };
  (one(std::type_identity<Field>{}), ...);
}
}  // namespace detail

/// What laws read of a particle, packed side by side: one record per particle, in doubles, padded to whole vector registers. The owned
/// particles come first, then the ghosts, and last one record far away from everything, with which lists fill up incomplete packs.
template <int Dim, class List>
class Records;
template <int Dim, class... Field>
class Records<Dim, Fields<Field...>> {
 public:
  using List = Fields<Field...>;
  template <class T>
  using view = View<Dim, T, List>;
  static constexpr int numbers = (0 + ... + (Field::is_vector ? Dim : 1));
  static constexpr int width = native_width<double>;
  static constexpr int stride = (numbers + width - 1) / width * width;  ///< doubles from one record to the next

  [[nodiscard]] static constexpr std::size_t bytes_per_particle() noexcept { return stride * sizeof(double); }
  void resize(std::size_t count) { data_.resize(count * stride); }
  [[nodiscard]] std::size_t size() const noexcept { return data_.size() / stride; }

  void store(std::size_t index, view<double>& record) noexcept {
    double* const to = data_.data() + index * stride;
    detail::for_each_number(
        record, [to](auto slot, double number) __attribute__((always_inline)) { to[slot] = number; });
  }
  [[nodiscard]] view<double> load(std::size_t index) const noexcept {
    const double* const from = data_.data() + index * stride;
    view<double> record;
    detail::for_each_number(
        record, [from](auto slot, double& number) __attribute__((always_inline)) { number = from[slot]; });
    return record;
  }
  /// The same record in all lanes.
  template <class T>
  [[nodiscard, gnu::always_inline]] view<T> spread(std::size_t index) const noexcept {
    const double* const from = data_.data() + index * stride;
    view<T> record;
    detail::for_each_number(
        record, [from](auto slot, T& number) __attribute__((always_inline)) { number = T(from[slot]); });
    return record;
  }
  /// Record index[l] in lane l.
  [[nodiscard, gnu::always_inline]] view<Pack<double, width>> gather(const std::uint32_t* index) const noexcept {
    Pack<double, width> numbers_of[stride];
    load_transposed<numbers>(data_.data(), stride, index, numbers_of);
    view<Pack<double, width>> record;
    detail::for_each_number(
        record, [&numbers_of](auto slot, Pack<double, width>& number) __attribute__((always_inline)) { number = numbers_of[slot]; });
    return record;
  }

 private:
  AlignedVector<double> data_;
};

}  // namespace dmp::particles
