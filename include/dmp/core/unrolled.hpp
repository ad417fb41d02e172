#pragma once
#include <cstddef>
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

}  // namespace dmp
