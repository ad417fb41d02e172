#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <dmp/integrator/concept.hpp>
#include <dmp/simulation/lists.hpp>
#include <dmp/sweep/bonds.hpp>
#include <dmp/sweep/gather.hpp>

namespace dmp::simulation {

/// What a model's laws say of its present state: records of all particles, then sums over pairs and bonds, accelerations and rates.
template <int Dim, class Integrator, class Precision, class... Item>
class Forces : public Lists<Dim, Integrator::keeps_rates, Precision, Item...> {
  using Base = Lists<Dim, Integrator::keeps_rates, Precision, Item...>;

 public:
  using Base::Base, Base::group, Base::for_each_group, Base::for_each_item;

  /// Fresh lists and ghosts; every particle may have got another row. The records of groups that evolve must be packed next. With `sort`, a
  /// run that goes on from here and one that restarts here from a checkpoint do the same arithmetic.
  void build_lists(bool sort) {
    this->find_neighbours(sort);
    for_each_group([](auto& g) {
      using C = LayoutOf<decltype(g)>;
      if constexpr (C::has_records) g.records.resize(g.first_ghost() + g.ghost_count());
      if constexpr (C::sums_in_memory && Precision::pairs_once) {
        g.sums.resize(g.first_ghost());
        for_each_range(g.blocks.ranges(), [&g](std::size_t, std::size_t first, std::size_t last) { g.sums.set_zero(first, last); });
        g.sums.set_zero(g.size(), g.first_ghost());
      }
    });
    refresh_frozen();
    for_each_group([&](auto& g) {
      if constexpr (LayoutOf<decltype(g)>::has_pairs) {
        pack_one(g, 0, 0.0);
        auto far_away = g.records.load(0);
        for (double& x : far_away.position.component) x = 1e30;
        for (std::size_t row = g.size(); row < g.first_ghost(); ++row) g.records.store(row, far_away);
      }
    });
  }
  /// Records of groups that do not evolve, which steps leave alone: for what the user has changed between runs.
  void refresh_frozen() {
    for_each_group([&](auto& g) {
      if constexpr (LayoutOf<decltype(g)>::has_records && !evolves<decltype(g)>) pack(g, 0.0);
    });
  }

  /// Particle i as the material laws have completed it: state, pressure term, viscosity, ...; `dt` [s] is the step under way, 0 between
  /// steps.
  template <class G>
  [[nodiscard]] auto prepared(const G& g, std::size_t i, double dt) const noexcept {
    using C = LayoutOf<decltype(g)>;
    View<Dim, double, typename C::prepared> particle;
    spread_fields<double>(typename C::constants{}, particle, g.constants);
    particle.position = to_components<Dim>(g.positions()[i]);
    particle.velocity = to_components<Dim>(seen_velocity(g, i, dt));
    load_state(typename C::state{}, g, i, dt, particle);
    for_each_item([&](const auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_material<I>)
        if constexpr (I::template concerns<typename std::remove_cvref_t<G>::Tag>)
          std::apply([&](const auto&... law) { (apply_material(law, particle), ...); }, active.item.laws);
    });
    return particle;
  }

  /// Velocity of particle i as laws see it; the wall velocity of groups that do not move.
  template <class G>
  [[nodiscard]] Vector<Dim> seen_velocity(const G& g, std::size_t i, double dt) const noexcept {
    using M = typename std::remove_cvref_t<G>::Mobility;
    if constexpr (particles::is_mobile<M>)
      return Integrator::seen(g.template get<field::Velocity>()[i], g.template get<field::Acceleration>()[i], dt);
    else if constexpr (particles::is_driven<M>) return g.template get<field::Velocity>()[i];
    else if constexpr (requires { g.mobility.wall_velocity; }) return g.mobility.wall_velocity;
    else return Vector<Dim>::Zero();
  }

 protected:
  using typename Base::Lanes;
  template <class G>
  using LayoutOf = typename Base::template LayoutOf<G>;
  template <class G>
  static constexpr bool evolves = Base::template evolves<G>;
  template <class G>
  static constexpr bool mobile = Base::template mobile<G>;

  void pack_all(double dt) {
    for_each_group([&](auto& g) {
      if constexpr (LayoutOf<decltype(g)>::has_records && evolves<decltype(g)>) pack(g, dt);
    });
  }
  /// Accelerations and rates from the records as they are.
  void gather_all(double time, double dt) {
    begin_memories<false>(dt);
    for_each_group([&](auto& g) { gather<false>(g, time, dt); });
  }
  /// Sub-stepped bonds alone, at the end of a sub-step of `dt`; of the groups at their ends only those that have moved are packed again.
  void fast_forces(double dt) {
    begin_memories<true>(dt);
    for_each_group([&](auto& g) {
      using G = std::remove_cvref_t<decltype(g)>;
      if constexpr (LayoutOf<G>::has_substeps || (LayoutOf<G>::has_bonds && particles::is_driven<typename G::Mobility>)) pack(g, 0.0);
    });
    for_each_group([&](auto& g) {
      if constexpr (LayoutOf<decltype(g)>::has_substeps) gather<true>(g, 0.0, 0.0);
    });
  }

  /// Record of particle i as laws see it in a step of length `dt`.
  template <class G>
  void pack_one(G& g, std::size_t i, double dt) noexcept {
    using Record = typename LayoutOf<G>::record;
    const auto particle = prepared(g, i, dt);
    View<Dim, double, Record> record;
    copy_fields(Record{}, record, particle);
    g.records.store(i, record);
  }
  /// Records of the ghosts, once those of their originals are right.
  template <class G>
  void pack_ghosts(G& g) {
    if constexpr (LayoutOf<G>::has_pairs)
      for_each_range(Ranges(g.ghosts.size()), [&](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
          auto record = g.records.load(g.ghosts.owner[k]);
          record.position += to_components<Dim>(g.ghosts.shift[k]);
          g.records.store(g.first_ghost() + k, record);
        }
      });
  }
  /// Adds the force of the bonds of particle i to its row of sums, and the reactions to the rows of its partners if they are of this group.
  template <class Source, class G, class Add, class Law, class Memory>
  [[gnu::always_inline]] void bonds(const G& g, std::size_t i, const neighbours::BondList& list, const Add& add, const Law& law,
                                    const Memory& memory) const noexcept {
    const auto& source = this->template group<Source>();
    using Partners = typename std::remove_cvref_t<decltype(source)>::Records;
    const sweep::BondRecords records{g.records.data() + i * G::Records::stride, source.records.data(), Partners::stride};
    const auto plus = [&add](std::size_t row, Lanes factor, const sweep::Row<Dim>& vector) __attribute__((always_inline)) {
      double* const to = add.data + row * static_cast<std::size_t>(G::Sums::stride);
      sweep::Row<Dim>::load(to).plus(factor, vector).store(to);
    };
    const auto react = [&](std::size_t row, Lanes factor, const sweep::Row<Dim>& vector) __attribute__((always_inline)) {
      if constexpr (std::is_same_v<Source, typename G::Tag>) plus(row, factor, vector);
    };
    if (list.crosses(i)) plus(i, 1.0, sweep::sum_bonds<Dim, true>(records, list.of(i), bond_periods_, react, law, memory));
    else plus(i, 1.0, sweep::sum_bonds<Dim, false>(records, list.of(i), bond_periods_, react, law, memory));
  }

 private:
  /// The memories of bonds of one phase are about to be carried over a step of `dt`.
  template <bool Fast>
  void begin_memories(double dt) {
    for_each_item([dt](auto& active) {
      if constexpr (is_bonds<std::remove_cvref_t<decltype(active.item)>>)
        if (active.item.substepped == Fast) active.recall.begin(active.item.law, dt);
    });
  }
  /// Records of all particles of a group and of its ghosts.
  template <class G>
  void pack(G& g, double dt) {
    for_each_range(g.blocks.ranges(), [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) pack_one(g, i, dt);
    });
    pack_ghosts(g);
  }

  template <class Law, class Particle>
  static void apply_material(const Law& law, Particle& particle) noexcept {
    if constexpr (!detail::is_constant<Law>) law.apply(particle);
  }
  template <class... Field, class G, class Particle>
  static void load_state(Fields<Field...>, const G& g, std::size_t i, double dt, Particle& particle) noexcept {
    [[maybe_unused]] const auto one = [&]<class F>(F) {
      double value = g.template get<F>()[i];
      for_each_field(typename LayoutOf<G>::rates{}, [&]<class Rate>(Rate) {
        if constexpr (std::is_same_v<typename Rate::integrates, F>) {
          const double rate = g.template get<Rate>()[i];
          if constexpr (Integrator::keeps_rates) value = Integrator::seen_state(value, rate, g.template get<Previous<Rate>>()[i], dt);
          else value = Integrator::seen_state(value, rate, rate, dt);
        }
      });
      F::of(particle) = value;
    };
    (one(Field{}), ...);
  }

  /// What the items say of particle i, which lies in `block`: pairs and bonds of one phase.
  template <bool Fast, class G, class Sums, class Add>
  [[gnu::always_inline]] void sum_items(const G& g, std::size_t block, std::size_t i, Sums& sums, const Add& add) noexcept {
    using Tag = typename G::Tag;
    [[maybe_unused]] const auto self = g.template spread<Lanes>(i);
    for_each_item([&](auto& active) __attribute__((always_inline)) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_interaction<I> && !Fast) {
        if constexpr (std::is_same_v<Tag, typename I::A>)
          pairs<typename I::B>(self, active.of_a.of(block, i, g.level[block]), sums, add, active.item);
        else if constexpr (std::is_same_v<Tag, typename I::B>)
          pairs<typename I::A>(self, active.of_b.of(block, i, g.level[block]), sums, add, active.item);
      }
      if constexpr (is_bonds<I>)
        if constexpr (mobile<G> && I::substepped == Fast) {
          if constexpr (std::is_same_v<Tag, typename I::A>)
            bonds<typename I::B>(g, i, active.of_a, add, active.item.law, active.recall.of(active.of_a, i));
          else if constexpr (std::is_same_v<Tag, typename I::B>)
            bonds<typename I::A>(g, i, active.of_b, add, active.item.law, active.recall.of(active.of_b, i));
        }
    });
  }
  template <class Source, class Self, class Sums, class Add, class I>
  [[gnu::always_inline]] void pairs(const Self& self, std::span<const std::uint32_t> neighbours, Sums& sums, const Add& add,
                                    const I& item) const noexcept {
    const auto source = this->template group<Source>().reader();
    std::apply(
        [&](const auto&... law) __attribute__((always_inline)) {
          if constexpr (std::is_same_v<typename I::A, typename I::B> && Precision::pairs_once)
            sweep::sum_pairs_of_both<Dim>(self, source, neighbours, sums, add, law...);
          else sweep::sum_pairs<Dim>(self, source, neighbours, sums, law...);
        },
        item.laws);
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
        for (std::size_t i = g.blocks.begin(block); i < end; ++i) {
          const auto add = g.sums.adder(i + 1, end, g.blocks.far_row(block));
          View<Dim, double, typename C::writes> total;
          if constexpr (C::has_records) {
            View<Dim, Lanes, typename C::writes> sums;
            sweep::set_zero(sums);
            sum_items<Fast>(g, block, i, sums, add);
            if constexpr (adds_up_in_memory) total = g.sums.take(i, sums);
            else total = G::Sums::totals(sums);
          }
          if constexpr (mobile<G>) {
            Vector<Dim> acceleration = Vector<Dim>::Zero();
            if constexpr (contains<field::Acceleration, typename C::writes>) acceleration += to_vector<Dim>(total.acceleration);
            if constexpr (contains<field::Force, typename C::writes>) acceleration += inverse_mass * to_vector<Dim>(total.force);
            if constexpr (Fast) {
              g.template get<FastAcceleration>()[i] = acceleration;
            } else {
              acceleration += forced(g, i, time, dt);
              g.template get<field::Acceleration>()[i] = acceleration;
            }
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
          const forcing::Subject<Dim> subject{to_components<Dim>(g.positions()[i]), to_components<Dim>(seen_velocity(g, i, dt)), g.mass,
                                              time};
          std::apply([&](const auto&... law) { ((result += to_vector<Dim>(law.acceleration(subject))), ...); }, active.item.laws);
        }
    });
    return result;
  }

  sweep::Periods<Dim> bond_periods_{this->periods_};
};

}  // namespace dmp::simulation
