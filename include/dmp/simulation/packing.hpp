#pragma once
#include <atomic>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <dmp/forcing/concept.hpp>
#include <dmp/integrator/concept.hpp>
#include <dmp/simulation/lists.hpp>
#include <dmp/sweep/particle_law.hpp>

namespace dmp::simulation {

/// What laws see of each particle: its state as the integrator shows it, completed by the material laws, and packed into records.
template <int Dim, class Integrator, class Precision, class... Item>
class Packing : public Lists<Dim, Integrator::keeps_rates, Precision, Item...> {
  using Base = Lists<Dim, Integrator::keeps_rates, Precision, Item...>;

 public:
  using Base::Base, Base::for_each_group, Base::for_each_item;

  /// Records of groups that do not evolve, which steps leave alone: for what the user has changed between runs.
  void refresh_frozen() {
    for_each_group([&](auto& g) {
      if constexpr (LayoutOf<decltype(g)>::has_records && !evolves<decltype(g)>) pack(g, 0.0);
    });
  }

  /// Calls function(laws...) with the material laws of a group; what was chosen at run time is looked up here, once.
  template <class G, class Function>
  void with_materials(const G&, Function&& function) const {
    laws_for<typename G::Tag>().apply([&](const auto&... law) { sweep::with_chosen(function, law...); });
  }
  /// Particle i as the material laws complete it: state, pressure term, viscosity, ...; `dt` [s] is the step under way, 0 between steps.
  template <class G, class... Law>
  [[nodiscard]] auto prepared_by(const G& g, std::size_t i, double dt, const Law&... law) const noexcept {
    using C = LayoutOf<decltype(g)>;
    View<Dim, double, typename C::prepared> particle;
    spread_fields<double>(typename C::constants{}, particle, g.constants);
    particle.position = to_components<Dim>(g.positions()[i]);
    particle.velocity = to_components<Dim>(seen_velocity(g, i, dt));
    load_state(typename C::state{}, g, i, dt, particle);
    [[maybe_unused]] const auto one = [&particle]<class L>(const L& l) {
      if constexpr (intersect<typename L::writes, typename C::derived>::count > 0) l.apply(particle);
    };
    (one(law), ...);
    return particle;
  }
  template <class G>
  [[nodiscard]] auto prepared(const G& g, std::size_t i, double dt = 0.0) const noexcept {
    View<Dim, double, typename LayoutOf<G>::prepared> particle;
    with_materials(g, [&](const auto&... law) { particle = prepared_by(g, i, dt, law...); });
    return particle;
  }

  /// Whether records have been packed of a particle that a material law cannot work with. Forgets it.
  [[nodiscard]] bool has_refused() noexcept { return std::exchange(refused_, false); }
  /// Calls found(group, i, demand, particle, fields read) for the first particle that a material law cannot work with, if there is one.
  template <class Function>
  void find_refused(double dt, Function&& found) const {
    for_each_group([&](const auto& g) {
      with_materials(g, [&](const auto&... law) {
        using Particle = View<Dim, double, typename LayoutOf<decltype(g)>::prepared>;
        if constexpr ((sweep::Restricted<std::remove_cvref_t<decltype(law)>, Particle> || ...))
          for (std::size_t i = 0; i < g.size(); ++i) {
            const auto particle = prepared_by(g, i, dt, law...);
            const auto one = [&]<class L>(const L& l) {
              if constexpr (sweep::Restricted<L, Particle>)
                if (!l.admits(particle)) found(g, i, l.demand(), particle, typename L::reads{});
            };
            (one(law), ...);
          }
      });
    });
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

  /// What forcings see of particle i at `time` [s]; `dt` [s] is the step under way, 0 between steps.
  template <class G>
  [[nodiscard]] forcing::Subject<Dim> subject(const G& g, std::size_t i, double time, double dt) const noexcept {
    return {to_components<Dim>(g.positions()[i]), to_components<Dim>(seen_velocity(g, i, dt)), g.mass, time};
  }

 protected:
  template <class G>
  using LayoutOf = typename Base::template LayoutOf<G>;
  template <class G>
  static constexpr bool evolves = Base::template evolves<G>;

  void pack_all(double dt) {
    for_each_group([&](auto& g) {
      if constexpr (LayoutOf<decltype(g)>::has_records && evolves<decltype(g)>) pack(g, dt);
    });
  }
  /// Records of all particles of a group and of its ghosts.
  template <class G>
  void pack(G& g, double dt) {
    with_materials(g, [&](const auto&... law) {
      for_each_range(g.blocks.ranges(), [&](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) pack_one(g, i, dt, law...);
      });
    });
    pack_ghosts(g);
  }
  /// Record of particle i as laws see it in a step of length `dt`; material laws say if they cannot work with it.
  template <class G, class... Law>
  void pack_one(G& g, std::size_t i, double dt, const Law&... law) noexcept {
    using Record = typename LayoutOf<G>::record;
    const auto particle = prepared_by(g, i, dt, law...);
    if constexpr ((sweep::Restricted<Law, std::remove_cv_t<decltype(particle)>> || ...)) {
      const auto admits = [&particle]<class L>(const L& l) {
        if constexpr (sweep::Restricted<L, std::remove_cvref_t<decltype(particle)>>) return l.admits(particle);
        else return true;
      };
      if (!(admits(law) && ...)) std::atomic_ref<bool>(refused_).store(true, std::memory_order_relaxed);
    }
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
  template <class... Field, class G, class Particle>
  static void load_state(Fields<Field...>, const G& g, std::size_t i, double dt, Particle& particle) noexcept {
    [[maybe_unused]] const auto one = [&]<class F>(F) {
      double value = g.template get<F>()[i];
      for_each_field(typename LayoutOf<G>::rates{}, [&]<class Rate>(Rate) {
        if constexpr (std::is_same_v<typename Rate::integrates, F>) {
          if (!(dt > 0.0)) return;  // between steps a state is what it is, whatever its rate
          const double rate = g.template get<Rate>()[i];
          if constexpr (Integrator::keeps_rates) value = Integrator::seen_state(value, rate, g.template get<Previous<Rate>>()[i], dt);
          else value = Integrator::seen_state(value, rate, rate, dt);
        }
      });
      F::of(particle) = value;
    };
    (one(Field{}), ...);
  }

 private:
  template <class Tag>
  [[nodiscard]] auto laws_for() const {  // of all materials that concern the group; apart from what is done with them: compiled once
    return this->items().apply([](const auto&... active) { return (Values<>{} + ... + laws_of<Tag>(active.item)); });
  }
  template <class Tag, class I>
  static auto laws_of(const I& item) {
    if constexpr (is_material<I>)
      if constexpr (I::template concerns<Tag>)
        return item.laws.apply([]<class... Law>(const Law&... law) { return Values<const Law&...>{{law}...}; });
      else return Values<>{};
    else return Values<>{};
  }

  bool refused_ = false;  // a material law could not work with a particle
};

}  // namespace dmp::simulation
