#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <dmp/bond/concept.hpp>
#include <dmp/core/field.hpp>
#include <dmp/core/math.hpp>
#include <dmp/core/pack.hpp>
#include <dmp/core/pair.hpp>

namespace dmp::sweep {

/// The pack of numbers that sweeps work with.
using Lanes = Pack<double, native_width<double>>;

/// Sums before and after a sweep: all zero, and the lanes of a pack added up.
template <int Dim, class T, class... Field>
[[gnu::always_inline]] inline void set_zero(View<Dim, T, Fields<Field...>>& view) noexcept {
  [[maybe_unused]] const auto one = [](auto& member) {
    if constexpr (requires { member.component; })
      unrolled<Dim>([&](auto d) __attribute__((always_inline)) { member.component[d] = T(0.0); });
    else member = T(0.0);
  };
  (one(Field::of(view)), ...);
}

template <int Dim, class... Field>
[[gnu::always_inline]] inline void add_lanes(View<Dim, double, Fields<Field...>>& to,
                                             const View<Dim, Lanes, Fields<Field...>>& from) noexcept {
  [[maybe_unused]] const auto one = [](auto& total, const auto& part) {
    if constexpr (requires { part.component; })
      unrolled<Dim>([&](auto d) __attribute__((always_inline)) { total.component[d] += sum(part.component[d]); });
    else total += sum(part);
  };
  (one(Field::of(to), Field::of(from)), ...);
}
/// Geometry of a pair from the views of its particles. Velocities enter only if a law asks for them.
template <bool Velocity, int Dim, class I, class J>
[[nodiscard, gnu::always_inline]] inline auto pair_of(const I& i, const J& j) noexcept {
  using T = std::remove_cvref_t<decltype(i.position[0])>;
  Pair<Dim, T> pair;
  pair.separation = i.position - j.position;
  pair.distance_squared = dot(pair.separation, pair.separation);
  pair.distance = sqrt(pair.distance_squared);
  if constexpr (Velocity) {
    pair.relative_velocity = i.velocity - j.velocity;
    pair.approach = dot(pair.separation, pair.relative_velocity);
  }
  return pair;
}

/// Adds to `sums` what the laws say of particle i and all its neighbours. `i` holds the particle in all lanes; `source(index)` gives the
/// views of the particles index[0 .. width - 1]; the list fills whole packs.
template <int Dim, class I, class Source, class Sums, class... Law>
[[gnu::always_inline]] inline void sum_pairs(const I& i, const Source& source, std::span<const std::uint32_t> neighbours, Sums& sums,
                                             const Law&... law) noexcept {
  for (std::size_t k = 0; k < neighbours.size(); k += Lanes::width) {
    const auto j = source(neighbours.data() + k);
    const auto pair = pair_of<(Law::uses_velocity || ...), Dim>(i, j);
    (law.add(pair, i, j, sums), ...);
  }
}

/// Lengths of the periodic directions of a box; 0 where it is not periodic.
template <int Dim>
using Periods = std::array<double, Dim>;

/// Adds to sums.force what a bond law says of particle i and its partners, given in whole packs; entries with a negative rest length are
/// none. A bond of length zero has no direction and exerts no force.
template <int Dim, bool Periodic, class I, class Source, class Sums, class Law>
[[gnu::always_inline]] inline void sum_bonds(const I& i, const Source& source, std::span<const std::uint32_t> partners,
                                             const double* rest_lengths, const Periods<Dim>& periods, Sums& sums, const Law& law) noexcept {
  for (std::size_t k = 0; k < partners.size(); k += Lanes::width) {
    const auto j = source(partners.data() + k);
    const Lanes rest_length = Lanes::load(rest_lengths + k);
    Components<Dim, Lanes> separation = i.position - j.position;
    if constexpr (Periodic)
      unrolled<Dim>([&](auto d) __attribute__((always_inline)) {
        const double period = periods[static_cast<std::size_t>(static_cast<int>(d))], half = period > 0.0 ? 0.5 * period : 1e300;
        const Lanes x = separation[d];
        separation[d] = x + select(x > half, -period, select(x < -half, Lanes(period), 0.0));
      });
    const Lanes length_squared = dot(separation, separation), length = sqrt(length_squared);
    const Lanes inverse = select(length_squared > 0.0, 1.0 / length, 0.0);
    Lanes tension;
    if constexpr (bond::UsesVelocity<Law>) {
      const Lanes rate = inverse * dot(separation, i.velocity - j.velocity);
      tension = law.tension(bond::MovingStretch<Lanes>{{length, rest_length}, rate});
    } else {
      tension = law.tension(bond::Stretch<Lanes>{length, rest_length});
    }
    sums.force -= select(rest_length >= 0.0 && length_squared > 0.0, tension * inverse, 0.0) * separation;
  }
}

}  // namespace dmp::sweep
