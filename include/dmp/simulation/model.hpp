#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>
#include <dmp/core/threads.hpp>
#include <dmp/geometry/box.hpp>
#include <dmp/neighbours/exclusions.hpp>
#include <dmp/neighbours/pair_list.hpp>
#include <dmp/neighbours/relative_motion.hpp>
#include <dmp/neighbours/spatial_order.hpp>
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

template <class List, bool KeepsRates, class Precision, class... Item>
struct Groups;
template <class... G, bool KeepsRates, class Precision, class... Item>
struct Groups<std::tuple<G...>, KeepsRates, Precision, Item...> {
  using type = std::tuple<Group<G, Composition<G, KeepsRates, Item...>, Precision>...>;
};
template <class List>
struct Actives;
template <class... Item>
struct Actives<std::tuple<Item...>> {
  using type = std::tuple<Active<Item>...>;
};
}  // namespace detail

namespace detail {
template <class Groups>
inline constexpr bool all_different = true;
template <class First, class... Rest>
inline constexpr bool all_different<std::tuple<First, Rest...>> =
    (!std::is_same_v<typename First::Tag, typename Rest::Tag> && ...) && all_different<std::tuple<Rest...>>;

template <class Tag, class Groups>
inline constexpr bool is_tag = false;
template <class Tag, class... G>
inline constexpr bool is_tag<Tag, std::tuple<G...>> = (std::is_same_v<Tag, typename G::Tag> || ...);
template <class Groups, class Item>
inline constexpr bool names_groups = true;
template <class Groups, class A, class B, class... Law>
inline constexpr bool names_groups<Groups, Interaction<A, B, Law...>> = is_tag<A, Groups>&& is_tag<B, Groups>;
template <class Groups, class A, class B, class Law, bool S>
inline constexpr bool names_groups<Groups, Bonds<A, B, Law, S>> = is_tag<A, Groups>&& is_tag<B, Groups>;
template <class Groups, class... Tag, class... Law>
inline constexpr bool names_groups<Groups, Material<std::tuple<Tag...>, Law...>> = (is_tag<Tag, Groups> && ...);
template <class Groups, class... Tag, class... Law>
inline constexpr bool names_groups<Groups, Forced<std::tuple<Tag...>, Law...>> = (is_tag<Tag, Groups> && ...);

template <class X, class Y>
inline constexpr bool same_pair = false;
template <class A, class B, class... Law, class C, class D, class... Other>
inline constexpr bool same_pair<Interaction<A, B, Law...>, Interaction<C, D, Other...>> = (std::is_same_v<A, C> && std::is_same_v<B, D>) ||
                                                                                          (std::is_same_v<A, D> && std::is_same_v<B, C>);
template <class... Item>
inline constexpr bool declared_once = true;
template <class First, class... Rest>
inline constexpr bool declared_once<First, Rest...> = (!same_pair<First, Rest> && ...) && declared_once<Rest...>;

template <int Dim, class Law>
consteval bool law_fits() {
  if constexpr (requires { Law::dimension; }) return Law::dimension == Dim;
  return true;
}
template <int Dim, class Item>
inline constexpr bool laws_fit = true;
template <int Dim, class A, class B, class... Law>
inline constexpr bool laws_fit<Dim, Interaction<A, B, Law...>> = (law_fits<Dim, Law>() && ...);
template <int Dim, class Tags, class... Law>
inline constexpr bool laws_fit<Dim, Forced<Tags, Law...>> = (forcing::explain_forcing<Law, Dim>() && ...);
template <int Dim, class Tag, class M, int GroupDim>
inline constexpr bool laws_fit<Dim, GroupItem<Tag, M, GroupDim>> = Dim == GroupDim;
template <int Dim, class Item>
consteval bool fits_dimension() {
  return laws_fit<Dim, Item>;
}
}  // namespace detail

/// The groups and items of a scene, and who is near whom. Knows no law's formula, no time and no integrator.
template <int Dim, bool KeepsRates, class Precision, class... Item>
class Model {
 public:
  using Groups = typename detail::Groups<detail::filter<detail::IsGroup, Item...>, KeepsRates, Precision, Item...>::type;
  static constexpr bool has_pairs = (is_interaction<Item> || ...);
  static_assert(std::is_same_v<typename Precision::Real, double> || !(is_bonds<Item> || ...),
                "dmp: bond laws are evaluated in double only: a scene with bonds needs precision::Double");
  static_assert(detail::all_different<detail::filter<detail::IsGroup, Item...>>, "dmp: two groups of the scene have the same tag");
  static_assert((detail::names_groups<detail::filter<detail::IsGroup, Item...>, Item> && ...),
                "dmp: an item of the scene names a group that the scene does not hold");
  static_assert(detail::declared_once<Item...>, "dmp: two interactions of the scene join the same two groups; name all their laws in one");
  static_assert((detail::fits_dimension<Dim, Item>() && ...), "dmp: a law of the scene is made for another dimension than the box");

  Model(const geometry::Box<Dim>& box, const Item&... item)
      : box_(box),
        groups_(make_groups(std::tuple_cat(keep<is_group<Item>>(item)...))),
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
    skin_ = 0.2 * longest_cutoff_;  // least time of a step, see docs/performance.md
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

  /// The first bond that is longer than a bond may be in a periodic box; nullptr if there is none.
  template <class I>
  [[nodiscard]] const neighbours::Bond* find_long_bond(const I& item) const {
    const auto& a = group<typename I::A>().positions();
    const auto& b = group<typename I::B>().positions();
    for (const auto& bond : item.bonds) {
      const Vector<Dim> apart = neighbours::minimum_image<Dim>(a[bond.i] - b[bond.j], box_);
      for (int d = 0; d < Dim; ++d)
        if (const double period = periods_[static_cast<std::size_t>(d)];
            period > 0.0 && std::fabs(apart[d]) > neighbours::longest_periodic_bond * period)
          return &bond;
    }
    return nullptr;
  }

  [[nodiscard]] const geometry::Box<Dim>& box() const noexcept { return box_; }
  [[nodiscard]] double skin() const noexcept { return skin_; }
  [[nodiscard]] double longest_cutoff() const noexcept { return longest_cutoff_; }
  [[nodiscard]] std::uint64_t list_builds() const noexcept { return list_builds_; }
  void set_skin(double skin) noexcept { skin_ = skin; }

 protected:
  using Lanes = Pack<typename Precision::Real, native_width<typename Precision::Real>>;
  template <class G>
  using LayoutOf = typename std::remove_cvref_t<G>::Layout;
  template <class G>
  static constexpr bool evolves = std::remove_cvref_t<G>::Mobility::evolves;
  template <class G>
  static constexpr bool mobile = particles::is_mobile<typename std::remove_cvref_t<G>::Mobility>;

  template <class Tag>
  static consteval std::size_t index_of() {
    constexpr std::size_t found = []<class... G>(std::type_identity<std::tuple<G...>>) consteval {
      std::size_t index = 0, result = sizeof...(G);
      ((result = std::is_same_v<Tag, typename G::Tag> ? index : result, ++index), ...);
      return result;
    }
    (std::type_identity<Groups>{});
    static_assert(found < std::tuple_size_v<Groups>, "dmp: an item of the scene names a group that the scene does not hold");
    return found;
  }

  /// Wraps positions into the periodic box, finds ghosts and neighbours; every so often, or if `sort`, sorts the particles in space first.
  void find_neighbours(bool sort) {
    builds_since_sort_ = sort || builds_since_sort_ + 1 >= builds_per_sort ? 0 : builds_since_sort_ + 1;
    for_each_group([&](auto& g) { settle(g, builds_since_sort_ == 0); });
    if constexpr (has_pairs) {
      for_each_group([&](auto& g) { prepare_sources(g); });
      for_each_item([&](auto& active) {
        using I = std::remove_cvref_t<decltype(active.item)>;
        if constexpr (is_interaction<I>) {
          auto& a = group<typename I::A>();
          auto& b = group<typename I::B>();
          const double cutoff = active.item.cutoff();
          list(a, b, active.of_a, active.excluded_of_a, cutoff);
          if constexpr (!std::is_same_v<typename I::A, typename I::B>) list(b, a, active.of_b, active.excluded_of_b, cutoff);
        }
      });
    }
    for_each_item([&](auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_bonds<I>) {
        auto& a = group<typename I::A>();
        auto& b = group<typename I::B>();
        mark_crossing(active.of_a, a, b);
        mark_crossing(active.of_b, b, a);
      }
    });
    for_each_group([&](auto& g) { divide(g); });
    if constexpr (has_pairs) follow_from_here();
    ++list_builds_;
  }

  geometry::Box<Dim> box_;
  std::array<double, Dim> periods_{};                          // lengths of the periodic directions, 0 for the others
  neighbours::RelativeMotion<Dim> relative_motion_;  // since the lists were built
  double longest_cutoff_ = 0.0, skin_ = 0.0;

 private:
  using Items = typename detail::Actives<detail::filter<detail::IsNotGroup, Item...>>::type;
  template <bool Keep, class I>
  static auto keep(const I& item) {
    if constexpr (Keep) return std::tuple<I>(item);
    else return std::tuple<>();
  }
  static Groups make_groups(const auto& items) {
    return std::apply([]<class... G>(const G&... item) { return Groups{Group<G, Composition<G, KeepsRates, Item...>, Precision>(item)...}; }, items);
  }
  static Items make_items(const auto& items) {
    return std::apply([]<class... I>(const I&... item) { return Items{detail::Active<I>{item}...}; }, items);
  }
  template <class Active>
  void prepare_bonds(Active& active) {
    using I = std::remove_cvref_t<decltype(active.item)>;
    auto& a = group<typename I::A>();
    auto& b = group<typename I::B>();
    constexpr bool same = std::is_same_v<typename I::A, typename I::B>;
    neighbours::complete_bonds<Dim>(active.item.bonds, a.positions(), b.positions(), same, box_, same ? a.name : a.name + " and " + b.name);
    if constexpr (mobile<decltype(a)>) active.of_a.build(a.blocks, active.item.bonds, same, false, Lanes::width);
    if constexpr (mobile<decltype(b)> && !same) active.of_b.build(b.blocks, active.item.bonds, false, true, Lanes::width);
    a.may_be_sorted = b.may_be_sorted = false;
  }

  template <class I>
  void set_constants(const I& item) {  // and the density at the start, where the equation of state has one of rest
    for_each_group([&](auto& g) {
      if constexpr (I::template concerns<typename std::remove_cvref_t<decltype(g)>::Tag>)
        std::apply(
            [&g]<class... Law>(const Law&... law) {
              const auto one = [&g]<class L>(const L& l) {
                if constexpr (detail::is_constant<L>) l.apply(g.constants);
                if constexpr (requires { l.eos.rest_density; } &&
                              contains<field::Density, typename std::remove_cvref_t<decltype(g)>::Layout::columns>)
                  g.template get<field::Density>().assign(g.size(), l.eos.rest_density);
              };
              (one(law), ...);
            },
            item.laws);
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

  template <class G>
  void settle(G& g, bool sort) {  // positions into the box, particles into spatial order
    for_each_range(g.blocks.ranges(), [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) g.positions()[i] = box_.wrap(g.positions()[i]);
    });
    if constexpr (LayoutOf<G>::has_pairs) {
      if (G::Mobility::moves && sort && g.may_be_sorted) {
        const double cell = 0.5 * (longest_cutoff_ + skin_);
        order_.build(g.positions(), cell, g.spacing > 0.0 ? std::pow(cell / g.spacing, Dim) : 0.0);
        g.blocks.set_bounds(order_.bounds());
        // Records are packed anew after this: their memory is free, and takes one column at a time.
        const std::size_t rows_for_a_column = g.size() * Dim * sizeof(double) / G::Records::bytes_per_particle() + 1;
        g.records.resize(std::max(g.records.size(), rows_for_a_column));
        g.columns.permute(order_.rows(), g.blocks.ranges(), reinterpret_cast<double*>(g.records.data()));
        auto* const id = reinterpret_cast<std::uint32_t*>(g.records.data());
        std::copy(g.id.begin(), g.id.end(), id);
        for (std::size_t k = 0; k < g.size(); ++k) g.id[k] = id[order_.rows()[k]];
      }
    }
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
      g.grid.build(
          g.size() + g.ghosts.size(),
          [&g](std::size_t k) -> Vector<Dim> {
            if (k < g.size()) return g.positions()[k];
            return g.positions()[g.ghosts.owner[k - g.size()]] + g.ghosts.shift[k - g.size()];
          },
          0.5 * reach);
    }
  }

  template <class A, class B>
  void list(const A& of, const B& sources, neighbours::PairList& pairs, const neighbours::Exclusions& excluded, double cutoff) {
    if constexpr (evolves<A>)
      pairs.template build<Dim>(of.blocks, of.positions(), sources.grid, cutoff, skin_, sources.sources(std::is_same_v<A, B>), excluded,
                                Lanes::width);
  }

  template <class A, class B>
  void mark_crossing(neighbours::BondList& bonds, const A& own, const B& partners) {
    if (bonds.empty() || std::find(box_.periodic.begin(), box_.periodic.end(), true) == box_.periodic.end()) return;
    bonds.template mark_crossing<Dim>(own.positions(), partners.positions(), box_);
  }

  /// Shares the blocks of a group among the threads by what a sweep over them costs: entries of lists, and about ten more per particle.
  template <class G>
  void divide(G& g) {
    if constexpr (evolves<G>)
      g.blocks.divide([&](std::size_t block) {
        double cost = 10.0 * static_cast<double>(g.blocks.end(block) - g.blocks.begin(block));
        for_each_item([&](const auto& active) {
          using I = std::remove_cvref_t<decltype(active.item)>;
          if constexpr (is_interaction<I> || is_bonds<I>) {
            if constexpr (std::is_same_v<typename G::Tag, typename I::A>) cost += active.of_a.entries(g.blocks, block);
            else if constexpr (std::is_same_v<typename G::Tag, typename I::B>) cost += active.of_b.entries(g.blocks, block);
          }
        });
        return cost;
      });
  }

  /// The present positions are what relative motion is counted from.
  void follow_from_here() {
    neighbours::Bounds<Dim> bounds;
    for_each_group([&](auto& g) {
      if constexpr (LayoutOf<decltype(g)>::has_pairs)
        bounds.add(merge_ranges(
            g.blocks.ranges(), neighbours::Bounds<Dim>{},
            [&g](std::size_t first, std::size_t last) {
              neighbours::Bounds<Dim> part;
              for (std::size_t i = first; i < last; ++i) part.add(g.positions()[i]);
              return part;
            },
            [](neighbours::Bounds<Dim> a, const neighbours::Bounds<Dim>& b) {
              a.add(b);
              return a;
            }));
    });
    const double reach = longest_cutoff_ + skin_;
    relative_motion_.build(bounds, box_, reach);
    const double extent = 2.0 * ((bounds.upper - bounds.lower).maxCoeff() + 4.0 * reach);  // room for ghosts, and for moving along
    for_each_group([&](auto& g) { g.records.set_frame({0.5 * (bounds.lower + bounds.upper), extent}); });
    for_each_group([&](auto& g) {
      using G = std::remove_cvref_t<decltype(g)>;
      if constexpr (LayoutOf<G>::has_pairs) {
        if constexpr (G::Mobility::moves) g.at_list_build = g.positions();
        g.runs.resize(g.blocks.ranges().size());
        for_each_range(g.blocks.ranges(), [&](std::size_t range, std::size_t, std::size_t) {
          auto& runs = g.runs[range];
          runs.clear();
          for (std::size_t block = g.blocks.first_block(range); block < g.blocks.first_block(range + 1); ++block)
            for (std::size_t i = g.blocks.begin(block); i < g.blocks.end(block); ++i)
              if (const std::uint32_t cell = relative_motion_.cell_of(g.positions()[i]);
                  i == g.blocks.begin(block) || cell != runs.back().cell)
                runs.push_back({static_cast<std::uint32_t>(i), cell});
        });
        g.level.assign(g.blocks.size(), 0);
      }
    });
  }

  Groups groups_;
  Items items_;
  std::uint64_t list_builds_ = 0;
  static constexpr int builds_per_sort = 8;  // the order ages far more slowly than the lists
  int builds_since_sort_ = 0;
  neighbours::SpatialOrder<Dim> order_;
};

}  // namespace dmp::simulation
