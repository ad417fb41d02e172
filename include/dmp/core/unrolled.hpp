#pragma once
#include <tuple>
#include <type_traits>
#include <utility>

namespace dmp {

/// Calls function(0), ..., function(Count - 1) with compile-time numbers: short loops over components, fields and lanes that must end up
/// in registers whatever the optimisation level.
template <int Count, class Function>
[[gnu::always_inline]] constexpr void unrolled(Function&& function) {
  [&]<int... Index>(std::integer_sequence<int, Index...>) __attribute__((always_inline)) {
    (function(std::integral_constant<int, Index>{}), ...);
  }(std::make_integer_sequence<int, Count>{});
}

/// Calls function(element) for every element of a tuple, in order, in the caller's own loop: what std::apply may leave as a call.
template <class Tuple, class Function>
[[gnu::always_inline]] constexpr void for_each_of(Tuple& tuple, Function&& function) {
  unrolled<static_cast<int>(std::tuple_size_v<std::remove_const_t<Tuple>>)>([&](auto index)
                                                                    __attribute__((always_inline)) { function(std::get<index>(tuple)); });
}

}  // namespace dmp
