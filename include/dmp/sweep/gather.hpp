#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <dmp/core/field.hpp>
#include <dmp/core/math.hpp>
#include <dmp/core/pack.hpp>
#include <dmp/core/pair.hpp>

namespace dmp::sweep {

/// The pack of numbers that sweeps in double work with.
using Lanes = Pack<double, native_width<double>>;

/// Sums before a sweep. `zero`: -0.0 where the first thing added is all there is, since x + -0.0 is x, which the compiler knows; x + 0.0
/// may not be (-0.0 + 0.0).
template <int Dim, class T, class... Field>
[[gnu::always_inline]] inline void set_zero(View<Dim, T, Fields<Field...>>& view, double zero = 0.0) noexcept {
  [[maybe_unused]] const auto one = [zero](auto& member) {
    if constexpr (requires { member.component; })
      unrolled<std::extent_v<decltype(member.component)>>([&](auto d) __attribute__((always_inline)) { member.component[d] = T(zero); });
    else member = T(zero);
  };
  (one(Field::of(view)), ...);
}

/// Geometry of a pair from the views of its particles. Velocities enter only if a law asks for them. A source whose positions are not in
/// metres says what their difference is: `source.separation(i, j)`.
template <bool Velocity, int Dim, class Source, class I, class J>
[[nodiscard, gnu::always_inline]] inline auto pair_of([[maybe_unused]] const Source& source, const I& i, const J& j) noexcept {
  using T = std::remove_cvref_t<decltype(i.position[0])>;
  Pair<Dim, T> pair;
  if constexpr (requires { source.separation(i.position, j.position); }) pair.separation = source.separation(i.position, j.position);
  else pair.separation = -(j.position - i.position);
  pair.distance_squared = dot(pair.separation, pair.separation);
  pair.distance = sqrt(pair.distance_squared);
  if constexpr (Velocity) {
    const auto of_j = j.velocity - i.velocity;
    pair.relative_velocity = -of_j;
    pair.approach = -dot(pair.separation, of_j);  // the sign goes into the sum
  }
  return pair;
}

/// The same pair seen from the other particle.
template <bool Velocity, int Dim, class T>
[[nodiscard, gnu::always_inline]] inline Pair<Dim, T> reversed(Pair<Dim, T> pair) noexcept {
  unrolled<Dim>([&](auto d) __attribute__((always_inline)) {
    pair.separation[d] = -pair.separation[d];
    if constexpr (Velocity) pair.relative_velocity[d] = -pair.relative_velocity[d];
  });
  return pair;
}

/// Adds to `sums` what the laws say of particle i and all its neighbours. `i` holds the particle in all lanes; `source.gather(index)` gives
/// the views of the particles index[0 .. width - 1]; the list fills whole packs. Laws come by value, and
/// what the loop works on is its own, so that it stays in registers and what is constant is computed once.
template <int Dim, class I, class Source, class Sums, class... Law>
[[gnu::always_inline]] inline void sum_pairs(const I& particle, const Source source, std::span<const std::uint32_t> neighbours, Sums& total,
                                             const Law... law) noexcept {
  using T = std::remove_cvref_t<decltype(particle.position[0])>;
  constexpr std::size_t width = T::width;
  const I i = particle;
  Sums sums = total;
  for (std::size_t k = 0; k < neighbours.size(); k += width) {
    // Single precision has all pairs here, and is through with them before the next ones have come unasked.
    if constexpr (std::is_same_v<T, Pack<float, T::width>>) __builtin_prefetch(neighbours.data() + k + 512);
    const auto j = source.gather(neighbours.data() + k);
    const auto pair = pair_of<(Law::uses_velocity || ...), Dim>(source, i, j);
    (law.add(pair, i, j, sums), ...);
  }
  total = sums;
}

/// The same for pairs that are listed once: what the laws say of the partners goes to `add(index, sums)`. The laws are asked twice, once
/// from either side; what is the same for both the compiler computes once. Particles of a source with Source::Constants have these in
/// common.
template <int Dim, class I, class Source, class Sums, class Add, class... Law>
[[gnu::always_inline]] inline void sum_pairs_of_both(const I& particle, const Source source, std::span<const std::uint16_t> neighbours,
                                                     Sums& total, const Add add, const Law... law) noexcept {
  constexpr bool velocity = (Law::uses_velocity || ...);
  constexpr std::size_t width = std::remove_cvref_t<decltype(particle.position[0])>::width;
  const I i = particle;
  Sums sums = total;
  for (std::size_t k = 0; k < neighbours.size(); k += width) {
    std::uint32_t rows[width];
    unrolled<width>([&](auto lane) __attribute__((always_inline)) { rows[lane] = neighbours[k + lane]; });
    auto j = source.gather(rows);
    if constexpr (requires { typename Source::Constants; }) copy_fields(typename Source::Constants{}, j, i);
    const auto pair = pair_of<velocity, Dim>(source, i, j);
    (law.add(pair, i, j, sums), ...);
    const auto seen_from_j = reversed<velocity>(pair);
    Sums of_j;
    set_zero(of_j, -0.0);
    (law.add(seen_from_j, j, i, of_j), ...);
    add(rows, of_j);
  }
  total = sums;
}

}  // namespace dmp::sweep
