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

template <class List, bool KeepsRates, class... Item>
struct Groups;
template <class... G, bool KeepsRates, class... Item>
struct Groups<std::tuple<G...>, KeepsRates, Item...> {
  using type = std::tuple<Group<G, Composition<G, KeepsRates, Item...>>...>;
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
template <int Dim, bool KeepsRates, class... Item>
class Model {
 public:
  using Groups = typename detail::Groups<detail::filter<detail::IsGroup, Item...>, KeepsRates, Item...>::type;
  static constexpr bool has_pairs = (is_interaction<Item> || ...);
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
  using Lanes = sweep::Lanes;
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

  /// Wraps positions into the periodic box, sorts the particles in space, finds ghosts and neighbours.
  void find_neighbours() {
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
    ++list_builds_;
  }

  geometry::Box<Dim> box_;
  sweep::Periods<Dim> periods_{};                          // lengths of the periodic directions, 0 for the others
  std::array<double, std::tuple_size_v<Groups>> moved_{};  // largest displacement of each group since the lists were built
  double longest_cutoff_ = 0.0, skin_ = 0.0;

 private:
  using Items = typename detail::Actives<detail::filter<detail::IsNotGroup, Item...>>::type;
  template <bool Keep, class I>
  static auto keep(const I& item) {
    if constexpr (Keep) return std::tuple<I>(item);
    else return std::tuple<>();
  }
  static Groups make_groups(const auto& items) {
    return std::apply([]<class... G>(const G&... item) { return Groups{Group<G, Composition<G, KeepsRates, Item...>>(item)...}; }, items);
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
    if constexpr (mobile<decltype(a)>) active.of_a.build(a.size(), active.item.bonds, same, false, Lanes::width);
    if constexpr (mobile<decltype(b)> && !same) active.of_b.build(b.size(), active.item.bonds, false, true, Lanes::width);
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
  void settle(G& g) {  // positions into the box, particles into spatial order
    for (auto& x : g.positions()) x = box_.wrap(x);
    if constexpr (G::Mobility::moves) {
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
    if constexpr (LayoutOf<G>::has_pairs) g.at_list_build = g.positions();
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
                                {std::is_same_v<A, B>, static_cast<std::uint32_t>(sources.size()), sources.ghosts.owner}, excluded,
                                Lanes::width);
  }

  Groups groups_;
  Items items_;
  std::uint64_t list_builds_ = 0;
  std::vector<Vector<Dim>> all_positions_;
  std::vector<std::uint32_t> permuted_id_;
};

}  // namespace dmp::simulation
