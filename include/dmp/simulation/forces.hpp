#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <dmp/integrator/concept.hpp>
#include <dmp/simulation/model.hpp>

namespace dmp::simulation {

/// What a model's laws say of its present state: records of all particles, then sums over pairs and bonds, accelerations and rates.
template <int Dim, class Integrator, class... Item>
class Forces : public Model<Dim, Integrator::keeps_rates, Item...> {
  using Base = Model<Dim, Integrator::keeps_rates, Item...>;

 public:
  using Base::Base, Base::group, Base::for_each_group, Base::for_each_item;

  /// Fresh lists and ghosts; every particle may have got another row. A run that goes on from here and one that restarts here from a
  /// checkpoint do the same arithmetic.
  void build_lists() {
    this->find_neighbours();
    for_each_group([](auto& g) {
      if constexpr (LayoutOf<decltype(g)>::has_records) g.records.resize(g.size() + g.ghost_count() + 1);
    });
    pack_all(0.0);
    refresh_frozen();
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
  void forces(double time, double dt) {
    pack_all(dt);
    for_each_group([&](auto& g) { gather<false>(g, time, dt); });
  }
  /// Sub-stepped bonds alone; of the groups at their ends only those that have moved are packed again.
  void fast_forces() {
    for_each_group([&](auto& g) {
      using G = std::remove_cvref_t<decltype(g)>;
      if constexpr (LayoutOf<G>::has_substeps || (LayoutOf<G>::has_bonds && particles::is_driven<typename G::Mobility>)) pack(g, 0.0);
    });
    for_each_group([&](auto& g) {
      if constexpr (LayoutOf<decltype(g)>::has_substeps) gather<true>(g, 0.0, 0.0);
    });
  }

 private:
  /// Records of all particles of a group, of its ghosts, and the one far away.
  template <class G>
  void pack(G& g, double dt) {
    using Record = typename LayoutOf<G>::record;
    for_each_range(g.ranges, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const auto particle = prepared(g, i, dt);
        View<Dim, double, Record> record;
        copy_fields(Record{}, record, particle);
        g.records.store(i, record);
      }
    });
    if constexpr (LayoutOf<G>::has_pairs)
      for (std::size_t k = 0; k < g.ghosts.size(); ++k) {
        auto record = g.records.load(g.ghosts.owner[k]);
        record.position += to_components<Dim>(g.ghosts.shift[k]);
        g.records.store(g.size() + k, record);
      }
    auto far_away = g.records.load(0);
    for (double& x : far_away.position.component) x = 1e30;
    g.records.store(g.size() + g.ghost_count(), far_away);
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

  /// What the items say of particle i: pairs and bonds of one phase.
  template <bool Fast, class G, class Sums>
  void sum_items(const G& g, std::size_t range, std::size_t i, Sums& sums) const noexcept {
    using Tag = typename G::Tag;
    const auto self = g.template spread<Lanes>(i);
    for_each_item([&](const auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_interaction<I> && !Fast) {
        if constexpr (std::is_same_v<Tag, typename I::A>) pairs<typename I::B>(self, active.of_a.of(range, i), sums, active.item);
        if constexpr (std::is_same_v<Tag, typename I::B> && !std::is_same_v<Tag, typename I::A>)
          pairs<typename I::A>(self, active.of_b.of(range, i), sums, active.item);
      }
      if constexpr (is_bonds<I>)
        if constexpr (mobile<G> && I::substepped == Fast) {
          if constexpr (std::is_same_v<Tag, typename I::A>) bonds<typename I::B>(self, i, active.of_a, sums, active.item.law);
          if constexpr (std::is_same_v<Tag, typename I::B> && !std::is_same_v<Tag, typename I::A>)
            bonds<typename I::A>(self, i, active.of_b, sums, active.item.law);
        }
    });
  }
  template <class Source, class Self, class Sums, class I>
  void pairs(const Self& self, std::span<const std::uint32_t> neighbours, Sums& sums, const I& item) const noexcept {
    const auto& source = this->template group<Source>();
    std::apply(
        [&](const auto&... law) {
          sweep::sum_pairs<Dim>(
              self, [&source](const std::uint32_t* index) { return source.gather(index); }, neighbours, sums, law...);
        },
        item.laws);
  }
  template <class Source, class Self, class Sums, class Law>
  void bonds(const Self& self, std::size_t i, const neighbours::BondList& list, Sums& sums, const Law& law) const noexcept {
    const auto& source = this->template group<Source>();
    const auto view = [&source](const std::uint32_t* index) { return source.gather(index); };
    if (is_periodic_) sweep::sum_bonds<Dim, true>(self, view, list.packs(i), list.rest_lengths(i), this->periods_, sums, law);
    else sweep::sum_bonds<Dim, false>(self, view, list.packs(i), list.rest_lengths(i), this->periods_, sums, law);
  }

  template <bool Fast, class G>
  void gather(G& g, double time, double dt) {
    using C = LayoutOf<G>;
    using Sums = std::conditional_t<Fast, Fields<field::Force>, typename C::writes>;
    constexpr bool needed = mobile<G> || !std::is_same_v<typename C::rates, Fields<>>;
    if constexpr (needed)
      for_each_range(g.ranges, [&](std::size_t range, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          View<Dim, double, Sums> total;
          sweep::set_zero(total);
          if constexpr (C::has_records) {
            View<Dim, Lanes, Sums> sums;
            sweep::set_zero(sums);
            sum_items<Fast>(g, range, i, sums);
            sweep::add_lanes(total, sums);
          }
          if constexpr (mobile<G>) {
            Vector<Dim> acceleration = Vector<Dim>::Zero();
            if constexpr (contains<field::Acceleration, Sums>) acceleration += to_vector<Dim>(total.acceleration);
            if constexpr (contains<field::Force, Sums>) acceleration += to_vector<Dim>(total.force) / g.mass;
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

  bool is_periodic_ = std::find(this->box_.periodic.begin(), this->box_.periodic.end(), true) != this->box_.periodic.end();
};

}  // namespace dmp::simulation
