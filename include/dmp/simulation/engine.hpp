#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>
#include <dmp/core/simulation_error.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/geometry/box.hpp>
#include <dmp/integrator/concept.hpp>
#include <dmp/neighbours/exclusions.hpp>
#include <dmp/neighbours/pair_list.hpp>
#include <dmp/simulation/composition.hpp>
#include <dmp/simulation/group.hpp>
#include <dmp/sweep/gather.hpp>

namespace dmp::simulation {

namespace detail {
template <class Item>
struct Active {  // materials and forcings need nothing beside themselves
  Item item;
};
template <class Item>
  requires is_interaction<Item>
struct Active<Item> {
  Item item;
  neighbours::PairList of_a{}, of_b{};
  neighbours::Exclusions excluded_of_a{}, excluded_of_b{};
};
template <class Item>
  requires is_bonds<Item>
struct Active<Item> {
  Item item;
  neighbours::BondList of_a{}, of_b{};
};

template <template <class> class Predicate, class... Item>
using filter = decltype(std::tuple_cat(std::declval<std::conditional_t<Predicate<Item>::value, std::tuple<Item>, std::tuple<>>>()...));
template <class Item>
using IsGroup = std::bool_constant<is_group<Item>>;
template <class Item>
using IsNotGroup = std::bool_constant<!is_group<Item>>;

template <class List, class... Item>
struct Groups;
template <class... G, class... Item>
struct Groups<std::tuple<G...>, Item...> {
  using type = std::tuple<Group<G, Composition<G, Item...>>...>;
};
template <class List>
struct Actives;
template <class... Item>
struct Actives<std::tuple<Item...>> {
  using type = std::tuple<Active<Item>...>;
};
}  // namespace detail

/// The groups of a scene, their lists, and one time step: begin, lists when needed, records, gather, end. Knows neither output nor run length.
template <int Dim, class Integrator, class... Item>
class Engine {
  static_assert(integrator::explain_integrator<Integrator>());
  using Lanes = sweep::Lanes;

 public:
  using Groups = typename detail::Groups<detail::filter<detail::IsGroup, Item...>, Item...>::type;
  static constexpr bool has_pairs = (is_interaction<Item> || ...);
  static constexpr bool has_substeps = [] {
    return ([] {
      if constexpr (is_bonds<Item>) return Item::substepped;
      return false;
    }() || ...);
  }();

  Engine(const geometry::Box<Dim>& box, const Item&... item) : box_(box), groups_(make_groups(std::tuple_cat(keep<is_group<Item>>(item)...))),
                                                               items_(make_items(std::tuple_cat(keep<!is_group<Item>>(item)...))) {
    validate(box);
    for (int d = 0; d < Dim; ++d)
      periods_[static_cast<std::size_t>(d)] = box.periodic[static_cast<std::size_t>(d)] ? box.upper[d] - box.lower[d] : 0.0;
    for_each_item([this](auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_interaction<I>) longest_cutoff_ = std::max(longest_cutoff_, active.item.cutoff());
      if constexpr (is_bonds<I>) prepare_bonds(active);
      if constexpr (is_material<I>) set_constants(active.item);
    });
    skin_ = 0.1 * longest_cutoff_;
    prepare_exclusions();
  }

  template <class Tag>
  [[nodiscard]] auto& group() noexcept {
    return std::get<index_of<Tag>()>(groups_);
  }
  template <class Tag>
  [[nodiscard]] const auto& group() const noexcept {
    return std::get<index_of<Tag>()>(groups_);
  }
  template <class Function>
  void for_each_group(Function&& function) {
    std::apply([&](auto&... g) { (function(g), ...); }, groups_);
  }
  template <class Function>
  void for_each_group(Function&& function) const {
    std::apply([&](const auto&... g) { (function(g), ...); }, groups_);
  }
  template <class Function>
  void for_each_item(Function&& function) {
    std::apply([&](auto&... active) { (function(active), ...); }, items_);
  }
  template <class Function>
  void for_each_item(Function&& function) const {
    std::apply([&](const auto&... active) { (function(active), ...); }, items_);
  }

  [[nodiscard]] const geometry::Box<Dim>& box() const noexcept { return box_; }
  [[nodiscard]] double skin() const noexcept { return skin_; }
  [[nodiscard]] double longest_cutoff() const noexcept { return longest_cutoff_; }
  [[nodiscard]] std::uint64_t list_builds() const noexcept { return list_builds_; }
  void set_skin(double skin) noexcept { skin_ = skin; }
  /// How often substepped bonds are evaluated per step.
  void set_substeps(int substeps) noexcept { substeps_ = substeps; }
  [[nodiscard]] int substeps() const noexcept { return substeps_; }

  /// Accelerations and rates from the present state, e.g. before the first step; `time` [s] as forcings see it.
  void evaluate(double time) {
    build_lists();
    if constexpr (has_substeps) {
      fast_forces();
    }
    forces(time, 0.0);
  }

  /// First part of a step of length `dt` [s] that ends at `time` [s]: everything moves. Returns whether neighbour lists are worn out, so
  /// that build_lists must be called before `finish_step`.
  [[nodiscard]] bool begin_step(double dt, double time) {
    if constexpr (has_substeps)
      begin_with_substeps(dt, time);
    else
      for_each_group([&](auto& g) { begin(g, dt, time); });
    bool worn = false;
    if constexpr (has_pairs)
      for_each_item([&](const auto& active) {
        using I = std::remove_cvref_t<decltype(active.item)>;
        if constexpr (is_interaction<I>) worn = worn || !(moved_[index_of<typename I::A>()] + moved_[index_of<typename I::B>()] <= skin_);
      });
    return worn;
  }
  /// Second part: forces at the new positions, and the end of the step.
  void finish_step(double dt, double time) {
    forces(time, dt);
    for_each_group([&](auto& g) { end(g, dt); });
  }

  /// Wraps positions into the periodic box, sorts the particles in space, finds ghosts and neighbours. Every list is then fresh: a run
  /// that goes on from here and one that restarts here from a checkpoint do the same arithmetic.
  void build_lists() {
    for_each_group([&](auto& g) { settle(g); });
    if constexpr (has_pairs) {
      for_each_group([&](auto& g) { prepare_sources(g); });
      for_each_item([&](auto& active) {
        using I = std::remove_cvref_t<decltype(active.item)>;
        if constexpr (is_interaction<I>) {
          auto& a = group<typename I::A>();
          auto& b = group<typename I::B>();
          const double radius = active.item.cutoff() + skin_;
          list(a, b, active.of_a, active.excluded_of_a, radius);
          if constexpr (!std::is_same_v<typename I::A, typename I::B>) list(b, a, active.of_b, active.excluded_of_b, radius);
        }
      });
    }
    for_each_group([&](auto& g) {
      if constexpr (LayoutOf<decltype(g)>::has_records) {
        g.records.resize(g.size() + g.ghosts.size() + 1);
        if constexpr (!evolves<decltype(g)>) pack(g, 0.0);
      }
    });
    ++list_builds_;
  }

  /// Calls function(i, particle) with the view that material laws have completed: state, pressure term, viscosity, ...
  template <class G>
  [[nodiscard]] auto prepared(const G& g, std::size_t i, double dt) const noexcept {
    using C = LayoutOf<decltype(g)>;
    View<Dim, double, typename C::prepared> particle;
    detail::spread_fields<double>(typename C::constants{}, particle, g.constants);
    particle.position = detail::components<Dim>(g.positions()[i]);
    particle.velocity = detail::components<Dim>(seen_velocity(g, i, dt));
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
    else if constexpr (particles::is_driven<M>)
      return g.template get<field::Velocity>()[i];
    else if constexpr (requires { g.mobility.wall_velocity; })
      return g.mobility.wall_velocity;
    else
      return Vector<Dim>::Zero();
  }

 private:
  template <class G>
  using LayoutOf = typename std::remove_cvref_t<G>::Layout;
  template <class G>
  static constexpr bool evolves = std::remove_cvref_t<G>::Mobility::evolves;
  template <class G>
  static constexpr bool mobile = particles::is_mobile<typename std::remove_cvref_t<G>::Mobility>;

  template <bool Keep, class I>
  static auto keep(const I& item) {
    if constexpr (Keep)
      return std::tuple<I>(item);
    else
      return std::tuple<>();
  }
  using Items = typename detail::Actives<detail::filter<detail::IsNotGroup, Item...>>::type;
  static Groups make_groups(const auto& items) {
    return std::apply([]<class... G>(const G&... item) { return Groups{Group<G, Composition<G, Item...>>(item)...}; }, items);
  }
  static Items make_items(const auto& items) {
    return std::apply([]<class... I>(const I&... item) { return Items{detail::Active<I>{item}...}; }, items);
  }
  template <class Tag>
  static consteval std::size_t index_of() {
    std::size_t index = 0, found = std::tuple_size_v<Groups>;
    [&]<class... G>(std::type_identity<std::tuple<G...>>) { ((std::is_same_v<Tag, typename G::Tag> ? void(found = index++) : void(++index)), ...); }(
        std::type_identity<Groups>{});
    if (found == std::tuple_size_v<Groups>) throw "dmp: an item names a group that this scene does not hold";
    return found;
  }

  template <class Active>
  void prepare_bonds(Active& active) {
    using I = std::remove_cvref_t<decltype(active.item)>;
    auto& a = group<typename I::A>();
    auto& b = group<typename I::B>();
    constexpr bool same = std::is_same_v<typename I::A, typename I::B>;
    neighbours::complete_bonds<Dim>(active.item.bonds, a.positions(), b.positions(), same, box_, same ? a.name : a.name + " and " + b.name);
    if constexpr (mobile<decltype(a)>) active.of_a.build(a.size(), active.item.bonds, same, false, Lanes::width);
    if constexpr (mobile<decltype(b)> && !same) active.of_b.build(b.size(), active.item.bonds, false, true, Lanes::width);
    a.may_be_sorted = b.may_be_sorted = false;
  }

  template <class I>
  void set_constants(const I& item) {
    for_each_group([&](auto& g) {
      if constexpr (I::template concerns<typename std::remove_cvref_t<decltype(g)>::Tag>)
        std::apply([&g]<class... Law>(const Law&... law) {
          const auto one = [&g]<class L>(const L& l) {
            if constexpr (detail::is_constant<L>) l.apply(g.constants);
          };
          (one(law), ...);
        }, item.laws);
    });
  }

  void prepare_exclusions() {
    int reach = 0;
    for_each_item([&](const auto& active) {
      if constexpr (is_interaction<std::remove_cvref_t<decltype(active.item)>>) reach = std::max(reach, active.item.excluded_reach);
    });
    if (reach == 0) return;
    std::array<std::uint32_t, std::tuple_size_v<Groups> + 1> first{};
    for_each_group([&](const auto& g) {
      const std::size_t k = index_of<typename std::remove_cvref_t<decltype(g)>::Tag>();
      first[k + 1] = first[k] + static_cast<std::uint32_t>(g.size());
    });
    neighbours::BondGraph graph(first.back());
    for_each_item([&](const auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_bonds<I>)
        for (const auto& bond : active.item.bonds) {
          const std::uint32_t i = first[index_of<typename I::A>()] + bond.i, j = first[index_of<typename I::B>()] + bond.j;
          graph[i].push_back(j);
          graph[j].push_back(i);
        }
    });
    for_each_item([&](auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_interaction<I>) {
        if (active.item.excluded_reach == 0) return;
        constexpr std::size_t a = index_of<typename I::A>(), b = index_of<typename I::B>();
        const neighbours::Exclusions::Nodes of_a{first[a], first[a + 1] - first[a]}, of_b{first[b], first[b + 1] - first[b]};
        active.excluded_of_a.build(graph, of_a, of_b, active.item.excluded_reach);
        active.excluded_of_b.build(graph, of_b, of_a, active.item.excluded_reach);
      }
    });
  }

  // ---- lists ----------------------------------------------------------------------------------------------------------------

  template <class G>
  void settle(G& g) {  // positions into the box, particles into spatial order
    if constexpr (G::Mobility::moves) {
      for (auto& x : g.positions()) x = box_.wrap(x);
      if constexpr (LayoutOf<G>::has_pairs) {
        if (g.may_be_sorted && longest_cutoff_ > 0.0) {
          g.grid.build(g.positions(), 0.5 * (longest_cutoff_ + skin_));
          g.columns.permute(g.grid.order());
          permuted_id_.resize(g.size());
          for (std::size_t k = 0; k < g.size(); ++k) permuted_id_[k] = g.id[g.grid.order()[k]];
          g.id.swap(permuted_id_);
        }
      }
    }
    g.ranges = Ranges(g.size());
    g.at_list_build = g.positions();
    moved_[index_of<typename G::Tag>()] = 0.0;
  }

  template <class G>
  void prepare_sources(G& g) {  // ghosts and the grid in which others search
    if constexpr (LayoutOf<G>::has_pairs) {
      const double reach = longest_cutoff_ + skin_;
      for (const double period : periods_)
        if (period > 0.0 && period <= reach)
          throw ParameterError("scene: a periodic box must be longer than support radius and skin (" + to_text(reach) + " m), got " +
                               to_text(period));
      g.ghosts.build(g.positions(), box_, reach);
      all_positions_.assign(g.positions().begin(), g.positions().end());
      for (std::size_t k = 0; k < g.ghosts.size(); ++k) all_positions_.push_back(g.positions()[g.ghosts.owner[k]] + g.ghosts.shift[k]);
      g.grid.build(all_positions_, 0.5 * reach);
    }
  }

  template <class A, class B>
  void list(const A& of, const B& sources, neighbours::PairList& pairs, const neighbours::Exclusions& excluded, double radius) {
    if constexpr (evolves<A>)
      pairs.template build<Dim>(of.ranges, of.positions(), sources.grid, radius,
                                {std::is_same_v<A, B>, static_cast<std::uint32_t>(sources.size()), sources.ghosts.owner}, excluded, Lanes::width);
  }

  // ---- one step -------------------------------------------------------------------------------------------------------------

  template <class G>
  void begin(G& g, double dt, double time) {
    using C = LayoutOf<G>;
    farthest_.assign(g.ranges.size(), 0.0);
    for_each_range(g.ranges, [&](std::size_t range, std::size_t first, std::size_t last) {
      double farthest = 0.0;
      for (std::size_t i = first; i < last; ++i) {
        if constexpr (mobile<G>) {
          Integrator::begin(g.positions()[i], g.template get<field::Velocity>()[i], g.template get<field::Acceleration>()[i], dt);
        } else if constexpr (particles::is_driven<typename G::Mobility>) {
          g.positions()[i] = g.mobility.motion.position(g.template get<StartPosition>()[i], time);
          g.template get<field::Velocity>()[i] = g.mobility.motion.velocity(g.template get<StartPosition>()[i], time);
        }
        for_each_field(typename C::rates{}, [&]<class Rate>(Rate) {
          Integrator::begin_state(g.template get<typename Rate::integrates>()[i], g.template get<Rate>()[i], dt);
        });
        if constexpr (G::Mobility::moves && C::has_pairs) farthest = std::max(farthest, (g.positions()[i] - g.at_list_build[i]).squaredNorm());
      }
      farthest_[range] = farthest;
    });
    moved_[index_of<typename G::Tag>()] = std::sqrt(*std::max_element(farthest_.begin(), farthest_.end()));
  }

  template <class G>
  void end(G& g, double dt) {
    if constexpr (evolves<G>)
      for_each_range(g.ranges, [&](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          if constexpr (mobile<G>) Integrator::end(g.template get<field::Velocity>()[i], g.template get<field::Acceleration>()[i], dt);
          for_each_field(typename LayoutOf<G>::rates{}, [&]<class Rate>(Rate) {
            Integrator::end_state(g.template get<typename Rate::integrates>()[i], g.template get<Rate>()[i], dt);
          });
        }
      });
  }

  /// Slow forces are kicks at the two ends of the step; between them the sub-stepped bonds alone move their groups.
  void begin_with_substeps(double dt, double time) {
    const double part = dt / substeps_;
    for_each_group([&](auto& g) {
      using G = std::remove_cvref_t<decltype(g)>;
      if constexpr (!LayoutOf<G>::has_substeps)
        begin(g, dt, time);
      else
        for_each_particle(g, [&](std::size_t i) {
          g.template get<field::Velocity>()[i] += 0.5 * dt * g.template get<field::Acceleration>()[i];
          for_each_field(typename LayoutOf<G>::rates{}, [&]<class Rate>(Rate) {
            Integrator::begin_state(g.template get<typename Rate::integrates>()[i], g.template get<Rate>()[i], dt);
          });
        });
    });
    for (int k = 0; k < substeps_; ++k) {
      for_each_fast([&](auto& g, std::size_t i) {
        g.template get<field::Velocity>()[i] += 0.5 * part * g.template get<FastAcceleration>()[i];
        g.positions()[i] += part * g.template get<field::Velocity>()[i];
      });
      fast_forces();
      for_each_fast([&](auto& g, std::size_t i) { g.template get<field::Velocity>()[i] += 0.5 * part * g.template get<FastAcceleration>()[i]; });
    }
    for_each_group([&](auto& g) {
      using G = std::remove_cvref_t<decltype(g)>;
      if constexpr (LayoutOf<G>::has_substeps && LayoutOf<G>::has_pairs) {
        double farthest = 0.0;
        for (std::size_t i = 0; i < g.size(); ++i) farthest = std::max(farthest, (g.positions()[i] - g.at_list_build[i]).squaredNorm());
        moved_[index_of<typename G::Tag>()] = std::sqrt(farthest);
      }
    });
  }
  template <class Function>
  void for_each_fast(Function&& function) {
    for_each_group([&](auto& g) {
      if constexpr (LayoutOf<decltype(g)>::has_substeps) for_each_particle(g, [&](std::size_t i) { function(g, i); });
    });
  }
  template <class G, class Function>
  static void for_each_particle(const G& g, Function&& function) {
    for_each_range(g.ranges, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) function(i);
    });
  }

  void forces(double time, double dt) {
    for_each_group([&](auto& g) {
      if constexpr (LayoutOf<decltype(g)>::has_records && evolves<decltype(g)>) pack(g, dt);
    });
    for_each_group([&](auto& g) { gather<false>(g, time, dt); });
  }
  void fast_forces() {
    for_each_group([&](auto& g) {
      if constexpr (LayoutOf<decltype(g)>::has_records && evolves<decltype(g)>) pack(g, 0.0);
    });
    for_each_group([&](auto& g) {
      if constexpr (LayoutOf<decltype(g)>::has_substeps) gather<true>(g, 0.0, 0.0);
    });
  }

  /// Records of all particles of a group, of its ghosts, and the one far away.
  template <class G>
  void pack(G& g, double dt) {
    using Record = typename LayoutOf<G>::record;
    for_each_range(g.ranges, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const auto particle = prepared(g, i, dt);
        View<Dim, double, Record> record;
        detail::copy_fields(Record{}, record, particle);
        g.records.store(i, record);
      }
    });
    for (std::size_t k = 0; k < g.ghosts.size(); ++k) {
      auto record = g.records.load(g.ghosts.owner[k]);
      record.position += detail::components<Dim>(g.ghosts.shift[k]);
      g.records.store(g.size() + k, record);
    }
    auto far_away = g.records.load(0);
    for (double& x : far_away.position.component) x = 1e30;
    g.records.store(g.size() + g.ghosts.size(), far_away);
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
        if constexpr (std::is_same_v<typename Rate::integrates, F>) value = Integrator::seen_state(value, g.template get<Rate>()[i], dt);
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
    const auto& source = group<Source>();
    std::apply([&](const auto&... law) {
      sweep::sum_pairs<Dim>(self, [&source](const std::uint32_t* index) { return source.gather(index); }, neighbours, sums, law...);
    }, item.laws);
  }
  template <class Source, class Self, class Sums, class Law>
  void bonds(const Self& self, std::size_t i, const neighbours::BondList& list, Sums& sums, const Law& law) const noexcept {
    const auto& source = group<Source>();
    const auto view = [&source](const std::uint32_t* index) { return source.gather(index); };
    if (is_periodic_)
      sweep::sum_bonds<Dim, true>(self, view, list.packs(i), list.rest_lengths(i), periods_, sums, law);
    else
      sweep::sum_bonds<Dim, false>(self, view, list.packs(i), list.rest_lengths(i), periods_, sums, law);
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
          sweep::detail::set_zero(total);
          if constexpr (C::has_records) {
            View<Dim, Lanes, Sums> sums;
            sweep::detail::set_zero(sums);
            sum_items<Fast>(g, range, i, sums);
            sweep::detail::add_lanes(total, sums);
          }
          if constexpr (mobile<G>) {
            Vector<Dim> acceleration = Vector<Dim>::Zero();
            if constexpr (contains<field::Acceleration, Sums>) acceleration += detail::vector<Dim>(total.acceleration);
            if constexpr (contains<field::Force, Sums>) acceleration += detail::vector<Dim>(total.force) / g.mass;
            if constexpr (Fast) {
              g.template get<FastAcceleration>()[i] = acceleration;
            } else {
              acceleration += forced(g, i, time, dt);
              g.template get<field::Acceleration>()[i] = acceleration;
            }
          }
          if constexpr (!Fast) for_each_field(typename C::rates{}, [&]<class Rate>(Rate) { g.template get<Rate>()[i] = Rate::of(total); });
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
          const forcing::Subject<Dim> subject{detail::components<Dim>(g.positions()[i]), detail::components<Dim>(seen_velocity(g, i, dt)), g.mass, time};
          std::apply([&](const auto&... law) { ((result += detail::vector<Dim>(law.acceleration(subject))), ...); }, active.item.laws);
        }
    });
    return result;
  }

  geometry::Box<Dim> box_;
  sweep::Periods<Dim> periods_{};
  bool is_periodic_ = std::find(box_.periodic.begin(), box_.periodic.end(), true) != box_.periodic.end();
  Groups groups_;
  Items items_;
  std::array<double, std::tuple_size_v<Groups>> moved_{};  // largest displacement of each group since the lists were built
  std::vector<double> farthest_;                           // squared, per range, while a group moves
  double longest_cutoff_ = 0.0, skin_ = 0.0;
  int substeps_ = 1;
  std::uint64_t list_builds_ = 0;
  std::vector<Vector<Dim>> all_positions_;
  std::vector<std::uint32_t> permuted_id_;
};

}  // namespace dmp::simulation
