#pragma once
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

}  // namespace dmp
