#pragma once
#include <cstddef>
#include <utility>

namespace dmp {

namespace detail {
template <std::size_t Index, class T>
struct ValueAt {
  T value;
};
template <class Indices, class... T>
struct ValuesAt;
template <std::size_t... Index, class... T>
struct ValuesAt<std::index_sequence<Index...>, T...> : ValueAt<Index, T>... {
  static constexpr std::size_t count = sizeof...(T);

  template <std::size_t I>
  [[nodiscard]] constexpr auto& get() noexcept {
    return at<I>(*this);
  }
  template <std::size_t I>
  [[nodiscard]] constexpr decltype(auto) get() const noexcept {
    return at<I>(*this);
  }
  /// Calls function(value) for every value, in order, in the caller's own loop.
  template <class Function>
  [[gnu::always_inline]] constexpr void for_each(Function&& function) {
    (function(ValueAt<Index, T>::value), ...);
  }
  template <class Function>
  [[gnu::always_inline]] constexpr void for_each(Function&& function) const {
    (function(ValueAt<Index, T>::value), ...);
  }
  /// function(values...), in the caller's own loop.
  template <class Function>
  [[gnu::always_inline]] constexpr decltype(auto) apply(Function&& function) const {
    return function(ValueAt<Index, T>::value...);
  }

 private:
  template <std::size_t I, class U>
  static constexpr U& at(ValueAt<I, U>& one) noexcept {
    return one.value;
  }
  template <std::size_t I, class U>
  static constexpr const U& at(const ValueAt<I, U>& one) noexcept {
    return one.value;
  }
};
/// All values of two rows, one after the other.
template <std::size_t... I, class... A, std::size_t... K, class... B>
[[nodiscard]] constexpr ValuesAt<std::index_sequence_for<A..., B...>, A..., B...> operator+(
    const ValuesAt<std::index_sequence<I...>, A...>& a, const ValuesAt<std::index_sequence<K...>, B...>& b) {
  return {{a.template get<I>()}..., {b.template get<K>()}...};
}
}  // namespace detail

/// Values of several types, made in place: `Values<A, B>{{a}, {b}}`. A std::tuple for what every scene has much of, at a fraction of what a
/// tuple costs to compile.
template <class... T>
using Values = detail::ValuesAt<std::index_sequence_for<T...>, T...>;

}  // namespace dmp
