#pragma once
#include <cstddef>
#include <tuple>
#include <type_traits>

namespace dmp {

/// Calls function(First), ..., function(Count - 1) with compile-time numbers: short loops over components, fields and lanes that must end
/// up in registers whatever the optimisation level. Four at a time, for each of these calls is one more function to compile.
template <int Count, int First = 0, class Function>
[[gnu::always_inline]] constexpr void unrolled(Function&& function) {
  if constexpr (First < Count) function(std::integral_constant<int, First>{});
  if constexpr (First + 1 < Count) function(std::integral_constant<int, First + 1>{});
  if constexpr (First + 2 < Count) function(std::integral_constant<int, First + 2>{});
  if constexpr (First + 3 < Count) function(std::integral_constant<int, First + 3>{});
  if constexpr (First + 4 < Count) unrolled<Count, First + 4>(function);
}

/// Calls function(element) for every element of a tuple, in order, in the caller's own loop: what std::apply may leave as a call.
template <std::size_t First = 0, class Tuple, class Function>
[[gnu::always_inline]] constexpr void for_each_of(Tuple& tuple, Function&& function) {
  constexpr std::size_t count = std::tuple_size_v<std::remove_const_t<Tuple>>;
  if constexpr (First < count) function(std::get<First>(tuple));
  if constexpr (First + 1 < count) function(std::get<First + 1>(tuple));
  if constexpr (First + 2 < count) function(std::get<First + 2>(tuple));
  if constexpr (First + 3 < count) function(std::get<First + 3>(tuple));
  if constexpr (First + 4 < count) for_each_of<First + 4>(tuple, function);
}

}  // namespace dmp
