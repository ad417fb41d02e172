#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <dmp/bond/concept.hpp>
#include <dmp/core/components.hpp>
#include <dmp/core/math.hpp>
#include <dmp/core/pack.hpp>
#include <dmp/neighbours/bond_list.hpp>
#include <dmp/sweep/gather.hpp>

namespace dmp::sweep {

/// A vector of one particle in whole registers, one component per lane; lanes beyond the last component are zero.
template <int Dim>
struct Row {
  static constexpr int registers = (Dim + Lanes::width - 1) / Lanes::width;
  Lanes part[registers];

  [[nodiscard, gnu::always_inline]] static Row load(const double* from) noexcept {
    Row row;
    unrolled<registers>([&](auto r) __attribute__((always_inline)) { row.part[r] = Lanes::load(from + r * Lanes::width); });
    return row;
  }
  [[gnu::always_inline]] void store(double* to) const noexcept {
    unrolled<registers>([&](auto r) __attribute__((always_inline)) { part[r].store(to + r * Lanes::width); });
  }
  /// The vector alone: zero in the lanes beyond.
  [[nodiscard, gnu::always_inline]] Row alone() const noexcept {
    Row row = *this;
    if constexpr (Dim % Lanes::width != 0) {
      Lanes within(0.0);
      unrolled<Lanes::width>([&](auto lane) __attribute__((always_inline)) {
        if constexpr ((registers - 1) * Lanes::width + lane < Dim) within.raw[static_cast<int>(lane)] = 1.0;
      });
      row.part[registers - 1] = select(within > 0.0, part[registers - 1], 0.0);
    }
    return row;
  }
  /// this + factor * b
  [[nodiscard, gnu::always_inline]] Row plus(Lanes factor, const Row& b) const noexcept {
    Row row;
    unrolled<registers>([&](auto r) __attribute__((always_inline)) { row.part[r] = part[r] + factor * b.part[r]; });
    return row;
  }
  [[nodiscard, gnu::always_inline]] friend Lanes products(const Row& a, const Row& b) noexcept {  // to be summed over the lanes
    Lanes sum = a.part[0] * b.part[0];
    unrolled<registers - 1>([&](auto r) __attribute__((always_inline)) { sum += a.part[r + 1] * b.part[r + 1]; });
    return sum;
  }
  [[nodiscard, gnu::always_inline]] friend Row operator-(const Row& a, const Row& b) noexcept { return a.plus(-1.0, b); }
};

/// Lengths of the periodic directions and their inverses, 0 for the others, for whole registers.
template <int Dim>
class Periods {
 public:
  Periods() = default;
  explicit Periods(const std::array<double, Dim>& lengths) {
    for (std::size_t d = 0; d < Dim; ++d) {
      length_[d] = lengths[d];
      inverse_[d] = lengths[d] > 0.0 ? 1.0 / lengths[d] : 0.0;
    }
  }
  [[nodiscard, gnu::always_inline]] Row<Dim> length() const noexcept { return Row<Dim>::load(length_.data()); }
  [[nodiscard, gnu::always_inline]] Row<Dim> inverse() const noexcept { return Row<Dim>::load(inverse_.data()); }
  [[nodiscard, gnu::always_inline]] double length(std::size_t d) const noexcept { return length_[d]; }
  [[nodiscard, gnu::always_inline]] double inverse(std::size_t d) const noexcept { return inverse_[d]; }

 private:
  std::array<double, Row<Dim>::registers * Lanes::width> length_{}, inverse_{};
};

/// Records in which bond laws look: position first, then the velocity if they read it.
struct BondRecords {
  const double* own;       ///< of the particle
  const double* partners;  ///< of the group at the other ends
  int own_strain = 0, strain_of_partners = 0;  ///< where the records of either group have the field::BondStrain, if the law reads it
};

/// r_i - r_j [m] of a particle and a partner, by the shortest way through the periodic faces.
template <int Dim, bool Periodic, bool PositionsAlone>
[[nodiscard, gnu::always_inline]] inline Row<Dim> separation_of(const Row<Dim>& own, const double* partner,
                                                                [[maybe_unused]] const Row<Dim>& period,
                                                                [[maybe_unused]] const Row<Dim>& per_period) noexcept {
  Row<Dim> apart = own - Row<Dim>::load(partner);
  if constexpr (!PositionsAlone) apart = apart.alone();
  if constexpr (Periodic)
    unrolled<Row<Dim>::registers>([&](auto r) __attribute__((always_inline)) {
      apart.part[r] = apart.part[r] - period.part[r] * nearest_whole(apart.part[r] * per_period.part[r]);
    });
  return apart;
}

/// The same of a pack of partners at once: rows partner[0 .. width - 1] of `positions`, times Stride.
template <int Stride, int Dim>
[[nodiscard, gnu::always_inline]] inline Components<Dim, Lanes> separations_of(const Vector<Dim>& own, const Vector<Dim>* positions,
                                                                               const std::uint32_t* partner,
                                                                               const Periods<Dim>& periods) noexcept {
  Components<Dim, Lanes> apart;
  unrolled<Dim>([&](auto d) __attribute__((always_inline)) {
    const Lanes there = [&]<std::size_t... Lane>(std::index_sequence<Lane...>) __attribute__((always_inline)) {
      return Lanes(typename Lanes::Raw{positions[partner[Lane] / Stride][d]...});
    }
    (std::make_index_sequence<Lanes::width>{});
    const Lanes direct = own[d] - there;
    apart[d] = direct - periods.length(d) * nearest_whole(direct * periods.inverse(d));
  });
  return apart;
}

/// What changes in the bonds of a law in the step under way: nothing ...
struct NoMemory {};
template <class Law>
struct Recall {
  void begin(const Law&, double) noexcept {}
  [[nodiscard]] NoMemory of(const neighbours::BondList&, std::size_t) const noexcept { return {}; }
};
/// ... or whether they are there ...
template <bond::CanBreak Law>
  requires(!bond::HasMemory<Law>)
struct Recall<Law> {
  struct Entries {
    neighbours::BondList::Memory at;
  };
  void begin(const Law&, double) noexcept {}
  [[nodiscard, gnu::always_inline]] Entries of(neighbours::BondList& list, std::size_t i) const noexcept { return {list.memory_of(i)}; }
};
/// ... or a number that they remember, which `after` carries to the end of the step.
template <bond::HasMemory Law>
struct Recall<Law> {
  using After = decltype(std::declval<const Law&>().memory_after(0.0));
  struct Entries {
    neighbours::BondList::Memory at;
    After after;
  };
  std::optional<After> after;

  /// A step of `dt` [s]; 0 for an evaluation between steps, which adds nothing unless positions have been changed by hand.
  void begin(const Law& law, double dt) { after.emplace(law.memory_after(dt)); }
  [[nodiscard, gnu::always_inline]] Entries of(neighbours::BondList& list, std::size_t i) const noexcept {
    return {list.memory_of(i), *after};
  }
};

/// Force [N] of its bonds on a particle. Entries with a negative rest length are none; a bond of length zero has no direction and exerts no
/// force. `react(to, factor, vector)` adds the reaction factor * vector [N] at double number `to` of the sums. Lanes are components while
/// vectors are at work, and bonds while the law is asked. `memory` is brought to the end of the step. `PositionsAlone`: records hold the
/// position, zeros and nothing else.
template <int Dim, bool Periodic, bool PositionsAlone = false, class React, class Law, class Memory = NoMemory>
[[nodiscard, gnu::always_inline]] inline Row<Dim> sum_bonds(const BondRecords records, const neighbours::BondList::Entries bonds,
                                                            [[maybe_unused]] const Periods<Dim>& periods, const React react, const Law law,
                                                            [[maybe_unused]] const Memory memory = {}) noexcept {
  constexpr int width = Lanes::width;
  constexpr bool with_velocity = bond::UsesVelocity<Law>;
  const auto own_position = Row<Dim>::load(records.own);
  [[maybe_unused]] const auto own_velocity = with_velocity ? Row<Dim>::load(records.own + Dim) : own_position;
  [[maybe_unused]] const auto period = periods.length(), per_period = periods.inverse();
  Row<Dim> force;
  unrolled<Row<Dim>::registers>([&](auto r) __attribute__((always_inline)) { force.part[r] = 0.0; });
  for (std::size_t k = 0; k < bonds.size; k += width) {
    __builtin_prefetch(bonds.partner + k + 256);  // of particles to come
    __builtin_prefetch(bonds.reaction + k + 256);
    __builtin_prefetch(bonds.rest_length + k + 256);
    Row<Dim> separation[width];
    Lanes squares[width], approaches[width];
    unrolled<width>([&](auto lane) __attribute__((always_inline)) {
      const double* const partner = records.partners + bonds.partner[k + lane];
      auto& apart = separation[lane];
      apart = separation_of<Dim, Periodic, PositionsAlone>(own_position, partner, period, per_period);
      squares[lane] = products(apart, apart);
      if constexpr (with_velocity) approaches[lane] = products(apart, (own_velocity - Row<Dim>::load(partner + Dim)).alone());
    });
    Lanes rest_length = Lanes::load(bonds.rest_length + k);
    const Lanes length_squared = sum_across(squares), length = sqrt(length_squared);
    const Lanes inverse = length * (1.0 / length_squared);  // the division need not wait for the root
    const auto stretch = [&]() __attribute__((always_inline)) {
      if constexpr (with_velocity)
        return bond::MovingStretch<Lanes>{{length, rest_length}, select(length_squared > 0.0, inverse * sum_across(approaches), 0.0)};
      else if constexpr (bond::IsDispersive<Law>) {
        double strain_of_partner[width];
        for (std::size_t lane = 0; lane < width; ++lane)
          strain_of_partner[lane] = records.partners[bonds.partner[k + lane] + static_cast<std::size_t>(records.strain_of_partners)];
        return bond::Dispersing<bond::Stretch<Lanes>, Lanes>{{length, rest_length},
                                                             records.own[records.own_strain] + Lanes::load(strain_of_partner)};
      } else return bond::Stretch<Lanes>{length, rest_length};
    }
    ();
    const auto seen = [&]() __attribute__((always_inline)) {
      if constexpr (bond::HasMemory<Law>) {
        double *const at = memory.at.memory + k, *const length_at = memory.at.length + k;
        bond::Remembering<std::remove_const_t<decltype(stretch)>, Lanes> now{stretch, length - Lanes::load(length_at), Lanes::load(at)};
        now.memory = memory.after(now);
        now.memory.store(at);
        length.store(length_at);
        return now;
      } else {
        return stretch;
      }
    }
    ();
    if constexpr (bond::CanBreak<Law> && !bond::IsDispersive<Law>) {  // those have been asked by sum_strains
      rest_length = select(law.breaks(seen), neighbours::BondList::filler, rest_length);
      rest_length.store(memory.at.rest_length + k);
    }
    const Lanes tension = law.tension(seen);
    const Lanes weight = Lanes::load(bonds.weight + k * bonds.weight_step);
    const Lanes pull = select(rest_length >= 0.0 && length_squared > 0.0, tension * (inverse * weight), 0.0);
    unrolled<width>([&](auto lane) __attribute__((always_inline)) {
      const Lanes pull_of_one = spread_lane<lane>(pull);
      force = force.plus(-pull_of_one, separation[lane]);
      react(bonds.reaction[k + lane], pull_of_one, separation[lane]);
    });
  }
  return force;
}

/// Adds theta = k r0 (r - r0) [J] and S = k r0^2 [J] of the bonds of a particle to doubles `own` and `own` + 1 of `sums`, and where a bond
/// is listed once, to those of its partner; bonds that break now count no more.
template <int Dim, bool Periodic, class Law, class Memory = NoMemory>
[[gnu::always_inline]] inline void sum_strains(const BondRecords records, const neighbours::BondList::Entries bonds,
                                               [[maybe_unused]] const Periods<Dim>& periods, double* const sums, std::size_t own,
                                               const Law law, [[maybe_unused]] const Memory memory = {}) noexcept {
  constexpr int width = Lanes::width;
  const auto own_position = Row<Dim>::load(records.own);
  const auto period = periods.length(), per_period = periods.inverse();
  Lanes totals[2]{Lanes(0.0), Lanes(0.0)};
  for (std::size_t k = 0; k < bonds.size; k += width) {
    Lanes squares[width];
    unrolled<width>([&](auto lane) __attribute__((always_inline)) {
      const auto apart =
          separation_of<Dim, Periodic, false>(own_position, records.partners + bonds.partner[k + lane], period, per_period);
      squares[lane] = products(apart, apart);
    });
    Lanes rest_length = Lanes::load(bonds.rest_length + k);
    const Lanes length = sqrt(sum_across(squares));
    if constexpr (bond::CanBreak<Law>) {
      rest_length = select(law.breaks(bond::Stretch<Lanes>{length, rest_length}), neighbours::BondList::filler, rest_length);
      rest_length.store(memory.at.rest_length + k);
    }
    const Lanes lever = law.stiffness * Lanes::load(bonds.weight + k * bonds.weight_step) * rest_length;
    const Lanes terms[2]{select(rest_length >= 0.0, lever * (length - rest_length), 0.0),
                         select(rest_length >= 0.0, lever * rest_length, 0.0)};
    for (int n = 0; n < 2; ++n) totals[n] += terms[n];
    add_transposed<2>(sums, 1, bonds.reaction + k, terms);
  }
  double total[2];
  sum_transposed<2>(totals, total);
  for (std::size_t n = 0; n < 2; ++n) sums[own + n] += total[n];
}

}  // namespace dmp::sweep
