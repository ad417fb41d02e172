#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>
#include <dmp/integrator/concept.hpp>
#include <dmp/simulation/contacts.hpp>
#include <dmp/simulation/packing.hpp>
#include <dmp/sweep/bonds.hpp>
#include <dmp/sweep/gather.hpp>

namespace dmp::simulation {

/// What a model's laws say of its present state: sums over pairs and bonds, accelerations and rates.
template <int Dim, class Integrator, class Precision, class... Item>
class Forces : public Packing<Dim, Integrator, Precision, Item...> {
  using Base = Packing<Dim, Integrator, Precision, Item...>;

 public:
  using Base::Base, Base::group, Base::for_each_group, Base::for_each_item, Base::refresh_frozen;

  /// Fresh lists and ghosts; every particle may have got another row. The records of groups that evolve must be packed next. A run that
  /// goes on from here and one that restarts here from a checkpoint do the same arithmetic.
  void build_lists() {
    this->find_neighbours();
    for_each_group([](auto& g) {
      using C = LayoutOf<decltype(g)>;
      if constexpr (C::has_records) g.records.resize(g.first_ghost() + g.ghost_count());
      if constexpr (C::sums_in_memory && Precision::pairs_once) {
        g.sums.resize(g.first_ghost());
        for_each_range(g.blocks.ranges(), [&g](std::size_t, std::size_t first, std::size_t last) { g.sums.set_zero(first, last); });
        g.sums.set_zero(g.size(), g.first_ghost());
      }
    });
    for_each_item([&](auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_summed<I>) for_each_concerned<I>([&](auto& g, std::size_t n) { clear_sums(g, active.sums[n]); });
    });
    refresh_frozen();
    for_each_group([&](auto& g) {
      if constexpr (LayoutOf<decltype(g)>::has_pairs) {
        this->with_materials(g, [&](const auto&... law) { this->pack_one(g, 0, 0.0, law...); });
        auto far_away = g.records.load(0);
        for (double& x : far_away.position.component) x = 1e30;
        for (std::size_t row = g.size(); row < g.first_ghost(); ++row) g.records.store(row, far_away);
      }
    });
  }
  /// What a summed law finds now at every particle of a group, row by row; for looking on, the particles stay as they are.
  template <class Tag, class Law>
  [[nodiscard]] auto find_sums(const Law& law) {
    static_assert(sweep::explain_summed_law<Law>());
    auto& g = this->template group<Tag>();
    static_assert(evolves<decltype(g)> && LayoutOf<decltype(g)>::has_pairs,
                  "dmp: find_sums: a frozen group, or one without interactions, has no lists of neighbours");
    check_parameters(law);
    this->template check_reach<Tag>(law);
    this->pack_all(0.0);  // the state between two steps; also after lists were built
    std::vector<View<Dim, double, typename Law::sets>> result(g.size());
    particles::Sums<Dim, typename Law::sums> sums;
    clear_sums(g, sums);
    sum_over_neighbours(law, g, sums, [&result](std::size_t i, const auto& particle) {
      copy_fields(typename Law::sets{}, result[i], particle);
    });
    return result;
  }

 protected:
  using typename Base::Lanes;
  template <class G>
  using LayoutOf = typename Base::template LayoutOf<G>;
  template <class G>
  static constexpr bool evolves = Base::template evolves<G>;
  template <class G>
  static constexpr bool mobile = Base::template mobile<G>;

  /// Columns that summed laws set, in the evaluation of step number `step`, and records that know of them.
  void gather_summed(std::uint64_t step, double dt) {
    for_each_item([&](auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_summed<I>) {
        if (step % active.item.every != 0) return;
        for_each_concerned<I>([&](auto& g, std::size_t n) {
          sum_over_neighbours(active.item.law, g, active.sums[n], [&](std::size_t i, const auto& particle) {
            using Sets = typename decltype(active.item.law)::sets;
            View<Dim, double, Sets> seen;
            this->load_state(Sets{}, g, i, dt, seen);
            for_each_field(Sets{}, [&]<class F>(F) { g.template get<F>()[i] += F::of(particle) - F::of(seen); });
          });
        });
        this->pack_all(dt);
      }
    });
  }
  /// Accelerations and rates from the records as they are.
  void gather_all(double time, double dt) {
    if constexpr (Base::has_bonds) {
      gather_strains();
      begin_memories<false>(dt);
    }
    for_each_group([&](auto& g) { gather<false>(g, time, dt); });
  }
  /// Sub-stepped bonds alone, at the end of a sub-step of `dt`; of the groups at their ends only those that have moved are packed again.
  void fast_forces(double dt) {
    begin_memories<true>(dt);
    for_each_group([&](auto& g) {
      using G = std::remove_cvref_t<decltype(g)>;
      if constexpr (LayoutOf<G>::has_substeps || (LayoutOf<G>::has_bonds && particles::is_driven<typename G::Mobility>)) this->pack(g, 0.0);
    });
    for_each_group([&](auto& g) {
      if constexpr (LayoutOf<decltype(g)>::has_substeps) gather<true>(g, 0.0, 0.0);
    });
  }

  /// Adds the forces of the bonds of the particles of a block to their rows of sums, and the reactions to the rows of their partners if
  /// these are of this group. What bonds remember is memory_of(i).
  template <class Source, class G, class Add, class Law, class MemoryOf>
  [[gnu::always_inline]] void bonds(const G& g, std::size_t block, const neighbours::BondList& list, const Add& add, const Law law,
                                    const MemoryOf& memory_of) const noexcept {
    const auto& source = this->template group<Source>();
    using Partners = typename std::remove_cvref_t<decltype(source)>::Records;
    constexpr bool positions_alone = Partners::numbers == Dim && G::Records::numbers == Dim;
    const auto plus = [sums = add.data](std::size_t at, Lanes factor, const sweep::Row<Dim>& vector) __attribute__((always_inline)) {
      sweep::Row<Dim>::load(sums + at).plus(factor, vector).store(sums + at);
    };
    const auto react = [plus](std::size_t at, Lanes factor, const sweep::Row<Dim>& vector) __attribute__((always_inline)) {
      if constexpr (std::is_same_v<Source, typename G::Tag>) plus(at, factor, vector);
      else static_cast<void>(plus);
    };
    const auto bonds = list.reader();
    auto records = records_for(g, g.blocks.begin(block), source);
    const std::size_t end = g.blocks.end(block);
    for (std::size_t i = g.blocks.begin(block); i < end; ++i, records.own += G::Records::stride) {
      const std::size_t own = i * static_cast<std::size_t>(G::Sums::stride);
      if (bonds.crosses(i))
        plus(own, 1.0, sweep::sum_bonds<Dim, true, positions_alone>(records, bonds.of(i), bond_periods_, react, law, memory_of(i)));
      else plus(own, 1.0, sweep::sum_bonds<Dim, false, positions_alone>(records, bonds.of(i), bond_periods_, react, law, memory_of(i)));
    }
  }

 private:
  /// Where the bonds of particle i find it and its partners.
  template <class G, class Source>
  [[nodiscard, gnu::always_inline]] static sweep::BondRecords records_for(const G& g, std::size_t i, const Source& source) noexcept {
    return {g.records.data() + i * G::Records::stride, source.records.data(), G::Records::template first_of<field::BondStrain>,
            Source::Records::template first_of<field::BondStrain>};
  }
  /// Groups in which bonds with a dispersive share end.
  template <class Function>
  void for_each_strained(const Function& function) {
    for_each_group([&](auto& g) {
      if constexpr (contains<field::BondStrain, typename LayoutOf<decltype(g)>::record>) function(g);
    });
  }
  /// The mean strain of the bonds of each particle, where bonds have a dispersive share: columns, and records that know of them.
  void gather_strains() {
    for_each_strained([&](auto& g) {
      using G = std::remove_cvref_t<decltype(g)>;
      static_assert(G::Sums::stride >= 2);
      for_each_block(g.blocks, [&](std::size_t, std::size_t block) {
        for_each_item([&](auto& active) {
          using I = std::remove_cvref_t<decltype(active.item)>;
          if constexpr (is_bonds<I>)
            if constexpr (bond::IsDispersive<decltype(I::law)>) {
              const auto add = [&]<class Source>(std::type_identity<Source>, neighbours::BondList& list) {
                const auto& law = active.item.law;
                for (std::size_t i = g.blocks.begin(block); i < g.blocks.end(block); ++i) {
                  const auto records = records_for(g, i, this->template group<Source>());
                  const auto memory = active.recall.of(list, i);
                  const std::size_t own = i * static_cast<std::size_t>(G::Sums::stride);
                  double* const sums = g.sums.data();
                  if (list.crosses(i)) sweep::sum_strains<Dim, true>(records, list.of(i), bond_periods_, sums, own, law, memory);
                  else sweep::sum_strains<Dim, false>(records, list.of(i), bond_periods_, sums, own, law, memory);
                }
              };
              if constexpr (std::is_same_v<typename G::Tag, typename I::A>) add(std::type_identity<typename I::B>{}, active.of_a);
              else if constexpr (std::is_same_v<typename G::Tag, typename I::B>) add(std::type_identity<typename I::A>{}, active.of_b);
            }
        });
        for (std::size_t i = g.blocks.begin(block); i < g.blocks.end(block); ++i) {
          double* const sums = g.sums.data() + i * static_cast<std::size_t>(G::Sums::stride);  // theta and S, zero again for the forces
          g.template get<field::BondStrain>()[i] = sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
          sums[0] = sums[1] = 0.0;
        }
      });
    });
    for_each_strained([](auto& g) {  // when nobody looks into the records any more
      using Records = typename std::remove_cvref_t<decltype(g)>::Records;
      for_each_range(g.blocks.ranges(), [&g](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
          g.records.data()[i * Records::stride + Records::template first_of<field::BondStrain>] = g.template get<field::BondStrain>()[i];
      });
    });
  }
  /// The memories of bonds of one phase are about to be carried over a step of `dt`.
  template <bool Fast>
  void begin_memories(double dt) {
    for_each_item([dt](auto& active) {
      if constexpr (is_bonds<std::remove_cvref_t<decltype(active.item)>>)
        if (active.item.substepped == Fast) active.recall.begin(active.item.law, dt);
    });
  }
  /// What the pairs of particle i say, which lies in `block`.
  template <class G, class Sums, class Add>
  [[gnu::always_inline]] void sum_all_pairs(const G& g, std::size_t block, std::size_t i, Sums& sums, const Add& add) const noexcept {
    using Tag = typename G::Tag;
    [[maybe_unused]] const auto self = g.template spread<Lanes>(i);
    for_each_item([&](const auto& active) __attribute__((always_inline)) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_interaction<I>)
        active.item.laws.apply([&](const auto&... law) __attribute__((always_inline)) {
          if constexpr (std::is_same_v<Tag, typename I::A>)
            pairs<typename I::B>(g, block, self, active.of_a.of(block, i, g.level[i]), sums, add, law...);
          else if constexpr (std::is_same_v<Tag, typename I::B>)
            pairs<typename I::A>(g, block, self, active.of_b.of(block, i, g.level[i]), sums, add, law...);
        });
    });
  }
  /// Forces of the bonds of one phase on the particles of a block, in their rows of sums: of all before one is taken, since a bond within
  /// the block may be listed at either end.
  template <bool Fast, class G, class Add>
  void sum_all_bonds(const G& g, std::size_t block, const Add& add) noexcept {
    using Tag = typename G::Tag;
    for_each_item([&](auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_bonds<I>)
        if constexpr (mobile<G> && I::substepped == Fast && (std::is_same_v<Tag, typename I::A> || std::is_same_v<Tag, typename I::B>)) {
          const auto add_up = [&]<class Source>(std::type_identity<Source>, neighbours::BondList& list) __attribute__((always_inline)) {
            bonds<Source>(g, block, list, add, active.item.law, [&](std::size_t i) { return active.recall.of(list, i); });
          };
          if constexpr (std::is_same_v<Tag, typename I::A>) add_up(std::type_identity<typename I::B>{}, active.of_a);
          else add_up(std::type_identity<typename I::A>{}, active.of_b);
        }
    });
  }
  /// What laws say of a particle of a block of g and its partners in one list.
  template <class Source, class G, class Self, class Sums, class Add, class... Law>
  [[gnu::always_inline]] void pairs(const G& g, std::size_t block, const Self& self, const neighbours::PairList::Neighbours& neighbours,
                                    Sums& sums, const Add& add, const Law&... law) const noexcept {
    const auto source = this->template group<Source>().reader();
    if constexpr (std::is_same_v<Source, typename G::Tag> && Precision::pairs_once) {
      const std::size_t first = g.blocks.begin(block);
      sweep::sum_pairs_of_both<Dim>(self, source.from(first), neighbours.once, sums, add.from(first), law...);
    }
    sweep::sum_pairs<Dim>(self, source, neighbours.others, sums, law...);
  }

  template <class I, class Function>
  void for_each_concerned(Function&& function) {
    std::size_t n = 0;
    for_each_group([&](auto& g) {
      if constexpr (I::template concerns<typename std::remove_cvref_t<decltype(g)>::Tag>) function(g, n++);
    });
  }
  template <class G, class Sums>
  static void clear_sums(const G& g, Sums& sums) {
    sums.resize(g.size());
    for_each_range(g.blocks.ranges(), [&sums](std::size_t, std::size_t first, std::size_t last) { sums.set_zero(first, last); });
  }
  /// Calls store(i, particle) for every particle of a group, as a summed law has set it. All lists of the group are swept.
  template <class Law, class G, class Sums, class Store>
  void sum_over_neighbours(const Law& law, G& g, Sums& sums_of_partners, Store&& store) {
    using C = LayoutOf<G>;
    for_each_block(g.blocks, [&](std::size_t, std::size_t block) {
      const std::size_t end = g.blocks.end(block);
      for (std::size_t i = g.blocks.begin(block); i < end; ++i) {
        const auto add = sums_of_partners.adder();
        const auto self = g.template spread<Lanes>(i);
        View<Dim, Lanes, typename Law::sums> sums;
        sweep::set_zero(sums);
        for_each_item([&](const auto& active) {
          using I = std::remove_cvref_t<decltype(active.item)>;
          if constexpr (detail::is_summed_over<I>) {
            if constexpr (std::is_same_v<typename G::Tag, typename I::A>)
              pairs<typename I::B>(g, block, self, active.of_a.of(block, i, g.level[i]), sums, add, law);
            else if constexpr (std::is_same_v<typename G::Tag, typename I::B>)
              pairs<typename I::A>(g, block, self, active.of_b.of(block, i, g.level[i]), sums, add, law);
          }
        });
        View<Dim, double, unite<typename C::seen, typename Law::sets>> particle;
        copy_fields(typename C::record{}, particle, g.records.load(i));
        copy_fields(typename C::constants{}, particle, g.constants);
        law.set(particle, sums_of_partners.take(i, sums));
        store(i, particle);
      }
    });
  }

  template <bool Fast, class G>
  void gather(G& g, double time, double dt) {
    using C = LayoutOf<G>;
    constexpr bool adds_up_in_memory = C::sums_in_memory && Precision::pairs_once;
    constexpr bool needed = mobile<G> || !std::is_same_v<typename C::rates, Fields<>>;
    if constexpr (needed)
      for_each_block(g.blocks, [&](std::size_t, std::size_t block) {
        const std::size_t end = g.blocks.end(block);
        [[maybe_unused]] const double inverse_mass = 1.0 / g.mass;
        [[maybe_unused]] const auto add = g.sums.adder();
        if constexpr (C::has_bonds) sum_all_bonds<Fast>(g, block, add);
        for (std::size_t i = g.blocks.begin(block); i < end; ++i) {
          View<Dim, double, typename C::writes> total;
          if constexpr (C::has_records) {
            View<Dim, Lanes, typename C::writes> sums;
            sweep::set_zero(sums);
            if constexpr (!Fast && C::has_pairs) g.prefetch_for_sweep(i + 1024);
            if constexpr (!Fast && C::has_pairs) sum_all_pairs(g, block, i, sums, add);
            if constexpr (adds_up_in_memory) total = g.sums.take(i, sums);
            else total = G::Sums::totals(sums);
          }
          if constexpr (mobile<G>) {
            Vector<Dim> acceleration = Vector<Dim>::Zero();
            if constexpr (contains<field::Acceleration, typename C::writes>) acceleration += to_vector<Dim>(total.acceleration);
            if constexpr (contains<field::Force, typename C::writes>) acceleration += inverse_mass * to_vector<Dim>(total.force);
            if constexpr (!Fast) acceleration += forced(g, i, time, dt);
            if constexpr (particles::is_roller<typename G::Mobility>) acceleration -= g.mobility.held(acceleration);
            if constexpr (!Fast && meets_planes<G>) add_contact_forces<Integrator>(*this, g, i, time, dt, acceleration);
            if constexpr (Fast) g.template get<FastAcceleration>()[i] = acceleration;
            else g.template get<field::Acceleration>()[i] = acceleration;
          }
          if constexpr (!Fast)
            for_each_field(typename C::rates{}, [&]<class Rate>(Rate) {
              if constexpr (Integrator::keeps_rates) g.template get<Previous<Rate>>()[i] = g.template get<Rate>()[i];
              g.template get<Rate>()[i] = Rate::of(total);
            });
        }
      });
  }

  template <class G>
  [[nodiscard]] Vector<Dim> forced(const G& g, std::size_t i, double time, double dt) const noexcept {
    Vector<Dim> result = Vector<Dim>::Zero();
    for_each_item([&](const auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_forced<I>)
        if constexpr (I::template concerns<typename G::Tag>) {
          const auto seen = this->subject(g, i, time, dt);
          active.item.laws.apply([&](const auto&... law) { ((result += to_vector<Dim>(law.acceleration(seen))), ...); });
        }
    });
    return result;
  }

  sweep::Periods<Dim> bond_periods_{this->periods()};
};

}  // namespace dmp::simulation
