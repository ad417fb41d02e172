#pragma once
#include <concepts>
#include <type_traits>
#include <dmp/core/field.hpp>

namespace dmp::sweep {

/// Contract of a summed law, a property of a particle that is found from its neighbours in a sweep of its own, before the forces.
///   using reads = Fields<...>   of both particles; their mass is always there
///   using sums  = Fields<...>   what is summed over the neighbours
///   using sets  = Fields<...>   columns that are set from the sums
///   uses_velocity, cutoff()     as in PairLaw
///   add(pair, i, j, sums)       adds what j says of i
///   set(particle, sums)         sets the members `sets` of `particle`, which also has those of `reads`; there is no pair of i with itself
template <class L>
concept SummedLaw = std::is_trivially_copyable_v<L> && requires(const L law) {
  typename L::reads;
  typename L::sums;
  typename L::sets;
  { L::uses_velocity } -> std::convertible_to<bool>;
  { law.cutoff() } -> std::convertible_to<double>;
};

template <class L>
consteval bool explain_summed_law() {
  static_assert(
      requires {
        typename L::reads;
        typename L::sums;
        typename L::sets;
        L::uses_velocity;
      },
      "dmp: not a SummedLaw: it needs `reads`, `sums` and `sets`, each a Fields<...>, and `static constexpr bool uses_velocity`");
  static_assert(
      requires(const L law) {
        { law.cutoff() } -> std::convertible_to<double>;
      },
      "dmp: not a SummedLaw: no `double cutoff() const` [m]");
  return SummedLaw<L>;
}

}  // namespace dmp::sweep
