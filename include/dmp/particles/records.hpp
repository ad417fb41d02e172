#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <dmp/core/aligned.hpp>
#include <dmp/core/field.hpp>
#include <dmp/core/pack.hpp>
#include <dmp/particles/precision.hpp>

namespace dmp::particles {

namespace detail {
/// Numbers of a record before those of the field Wanted.
template <class Wanted, int Dim, class... Field>
inline constexpr int numbers_before = [] {
  int count = 0;
  bool found = false;
  ((found = found || std::is_same_v<Wanted, Field>, count += found ? 0 : numbers_of<Field, Dim>), ...);
  return count;
}();
/// Calls function(slot, number) for every number of the view, slots being compile-time numbers.
template <int Dim, class T, class... Field, class Function>
[[gnu::always_inline]] inline void for_each_number(View<Dim, T, Fields<Field...>>& view, Function function) noexcept {
  const auto one = [&]<class F>(std::type_identity<F>) __attribute__((always_inline)) {
    constexpr int first = numbers_before<F, Dim, Field...>;
    auto& member = F::of(view);
    if constexpr (numbers_of<F, Dim> > 1 || F::is_vector)
      unrolled<numbers_of<F, Dim>>([&](auto d)
                        __attribute__((always_inline)) { function(std::integral_constant<int, first + d>{}, member.component[d]); });
    else function(std::integral_constant<int, first>{}, member);
  };
  (one(std::type_identity<Field>{}), ...);
}
}  // namespace detail

/// What laws read of each particle, packed side by side: one record per particle, padded to whole vector registers, in the numbers of a
/// Precision. The position comes first.
template <int Dim, class List, class Precision = precision::Double>
class Records;
template <int Dim, class... Field, class Precision>
class Records<Dim, Fields<Field...>, Precision> {
 public:
  using List = Fields<Field...>;
  using Real = typename Precision::Real;
  using Frame = typename Precision::template Frame<Dim>;
  template <class T>
  using view = View<Dim, T, List>;
  static constexpr int numbers = (0 + ... + numbers_of<Field, Dim>);
  static constexpr int width = native_width<Real>;
  static constexpr int stride = (numbers + width - 1) / width * width;  ///< numbers from one record to the next
  using Lanes = Pack<Real, width>;
  /// Where a field begins in a record.
  template <class F>
  static constexpr int first_of = detail::numbers_before<F, Dim, Field...>;

  [[nodiscard]] static constexpr std::size_t bytes_per_particle() noexcept { return stride * sizeof(Real); }
  void resize(std::size_t count) {
    count_ = count;
    resize_with_margin(data_, count * stride + width);
    std::fill(data_.end() - width, data_.end(), Real(0));  // whole registers may be loaded from any number of a record
  }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] std::size_t bytes() const noexcept { return data_.capacity() * sizeof(Real); }
  [[nodiscard]] Real* data() noexcept { return data_.data(); }
  [[nodiscard]] const Real* data() const noexcept { return data_.data(); }
  /// How positions are written from now on.
  void set_frame(const Frame& frame) noexcept { frame_ = frame; }

  /// To be read without the container: what a loop that also writes keeps in registers.
  struct Reader {
    const Real* data;
    Frame frame;
    /// The same with rows counted from `row`.
    [[nodiscard, gnu::always_inline]] Reader from(std::size_t row) const noexcept { return {data + row * stride, frame}; }
    /// Record index[l] in lane l.
    [[nodiscard, gnu::always_inline]] view<Lanes> gather(const std::uint32_t* index) const noexcept {
      Lanes numbers_of[stride > 0 ? stride : 1];
      load_transposed<numbers>(data, stride, index, numbers_of);
      view<Lanes> record;
      detail::for_each_number(
          record, [&numbers_of](auto slot, Lanes& number) __attribute__((always_inline)) { number = numbers_of[slot]; });
      return record;
    }
    /// r_i - r_j [m] of positions as they stand in records.
    [[nodiscard, gnu::always_inline]] Components<Dim, Lanes> separation(const Components<Dim, Lanes>& i,
                                                                        const Components<Dim, Lanes>& j) const noexcept {
      return frame.separation(i, j);
    }
  };
  [[nodiscard]] Reader reader() const noexcept { return {data_.data(), frame_}; }
  [[nodiscard, gnu::always_inline]] view<Lanes> gather(const std::uint32_t* index) const noexcept { return reader().gather(index); }

  void store(std::size_t index, view<double>& record) noexcept {
    Real* const to = data_.data() + index * stride;
    detail::for_each_number(
        record, [&](auto slot, double number) __attribute__((always_inline)) {
          if constexpr (slot < position_numbers) to[slot] = frame_.write(number, slot);
          else to[slot] = static_cast<Real>(number);
        });
    unrolled<stride - numbers>([to](auto slot) __attribute__((always_inline)) { to[numbers + slot] = Real(0); });
  }
  [[nodiscard]] view<double> load(std::size_t index) const noexcept {
    const Real* const from = data_.data() + index * stride;
    view<double> record;
    detail::for_each_number(
        record, [&](auto slot, double& number) __attribute__((always_inline)) {
          if constexpr (slot < position_numbers) number = frame_.read(from[slot], slot);
          else number = static_cast<double>(from[slot]);
        });
    return record;
  }
  /// The same record in all lanes, as `gather` gives it.
  template <class T>
  [[nodiscard, gnu::always_inline]] view<T> spread(std::size_t index) const noexcept {
    const Real* const from = data_.data() + index * stride;
    view<T> record;
    detail::for_each_number(
        record, [from](auto slot, T& number) __attribute__((always_inline)) { number = T::all(from[slot]); });
    return record;
  }

 private:
  /// Numbers of the position, which comes first if it is there.
  static constexpr int position_numbers = [] {
    bool first = true;
    int result = 0;
    ((result += first && std::is_same_v<Field, field::Position> ? Dim : 0, first = false), ...);
    return result;
  }();
  AlignedVector<Real> data_;
  std::size_t count_ = 0;
  Frame frame_{};
};

}  // namespace dmp::particles
