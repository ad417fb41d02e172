#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>
#include <dmp/core/pack.hpp>
#include <dmp/geometry/box.hpp>
#include <dmp/neighbours/bond_list.hpp>
#include <dmp/neighbours/exclusions.hpp>
#include <dmp/neighbours/pair_list.hpp>
#include <dmp/simulation/composition.hpp>
#include <dmp/simulation/group.hpp>
#include <dmp/simulation/rules.hpp>
#include <dmp/sweep/bonds.hpp>

namespace dmp::simulation {

namespace detail {
template <int Dim, class Item>
struct Active {  // materials and forcings need nothing beside themselves
  Item item;
};
template <int Dim, class Item>
  requires is_interaction<Item>
struct Active<Dim, Item> {
  Item item;
  neighbours::PairList of_a{}, of_b{};
  neighbours::Exclusions excluded_of_a{}, excluded_of_b{};
};
template <int Dim, class Item>
  requires is_bonds<Item>
struct Active<Dim, Item> {
  Item item;
  neighbours::BondList of_a{}, of_b{};
  sweep::Recall<decltype(Item::law)> recall{};
};
template <int Dim, class... Tag, class Law>
struct Active<Dim, Summed<std::tuple<Tag...>, Law>> {
  Summed<std::tuple<Tag...>, Law> item;
  std::array<particles::Sums<Dim, typename Law::sums>, sizeof...(Tag)> sums{};
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
  using type = Values<Group<G, Composition<G, KeepsRates, Item...>, Precision>...>;
};
template <int Dim, class List>
struct Actives;
template <int Dim, class... Item>
struct Actives<Dim, std::tuple<Item...>> {
  using type = Values<Active<Dim, Item>...>;
};
}  // namespace detail

/// The groups and items of a scene. Knows no law's formula, no neighbours, no time and no integrator.
template <int Dim, bool KeepsRates, class Precision, class... Item>
class Model {
 public:
  using Groups = typename detail::Groups<detail::filter<detail::IsGroup, Item...>, KeepsRates, Precision, Item...>::type;
  static constexpr bool has_pairs = (is_interaction<Item> || ...), has_bonds = (is_bonds<Item> || ...);
  static constexpr bool bonds_break = [] {
    return ([] {
      if constexpr (is_bonds<Item>) return bond::CanBreak<decltype(Item::law)>;
      return false;
    }() || ...);
  }();
  static_assert(std::is_same_v<typename Precision::Real, double> || !(is_bonds<Item> || ...),
                "dmp: bond laws are evaluated in double only: a scene with bonds needs precision::Double");
  static_assert(detail::all_different<detail::filter<detail::IsGroup, Item...>>, "dmp: two groups of the scene have the same tag");
  static_assert((detail::names_groups<detail::filter<detail::IsGroup, Item...>, Item> && ...),
                "dmp: an item of the scene names a group that the scene does not hold");
  static_assert(detail::declared_once<Item...>, "dmp: two interactions of the scene join the same two groups; name all their laws in one");
  static_assert((detail::fits_dimension<Dim, Item>() && ...), "dmp: a law of the scene is made for another dimension than the box");

  Model(const geometry::Box<Dim>& box, const Item&... item)
      : box_(box),
        groups_(make_groups((Values<>{} + ... + keep<is_group<Item>>(item)))),
        items_(make_items((Values<>{} + ... + keep<!is_group<Item>>(item)))) {
    validate(box);
    for (int d = 0; d < Dim; ++d)
      periods_[static_cast<std::size_t>(d)] = box.periodic[static_cast<std::size_t>(d)] ? box.upper[d] - box.lower[d] : 0.0;
    for_each_group([this](const auto& g) {
      if constexpr (particles::is_roller<typename std::remove_cvref_t<decltype(g)>::Mobility>)
        for (int d = 0; d < Dim; ++d) {  // through an oblique face a particle would change its rail
          const double along = std::fabs(g.mobility.motion.direction.value[d]);
          if (periods_[static_cast<std::size_t>(d)] > 0.0 && along > 1e-12 && along < 1.0 - 1e-12)
            throw ParameterError("group " + g.name +
                                 ": direction of a Roller must lie along or across each periodic direction, got component " +
                                 to_text(along) + " along one");
        }
    });
    for_each_item([&](auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_bonds<I>) prepare_bonds(active);
      if constexpr (is_material<I>) set_constants(active.item);
      if constexpr (is_summed<I>) check_summed(active.item);
    });
    if constexpr (has_bonds) check_dispersion();
    if constexpr (has_bonds && has_pairs) prepare_exclusions();
  }

  /// Which group, in the order of declaration.
  template <class Tag>
  static consteval std::size_t index_of() {
    constexpr std::size_t found = []<class Indices, class... G>(std::type_identity<dmp::detail::ValuesAt<Indices, G...>>) consteval {
      std::size_t index = 0, result = sizeof...(G);
      ((result = std::is_same_v<Tag, typename G::Tag> ? index : result, ++index), ...);
      return result;
    }
    (std::type_identity<Groups>{});
    static_assert(found < Groups::count, "dmp: an item of the scene names a group that the scene does not hold");
    return found;
  }
  template <class Tag>
  [[nodiscard]] auto& group() noexcept {
    return groups_.template get<index_of<Tag>()>();
  }
  template <class Tag>
  [[nodiscard]] const auto& group() const noexcept {
    return groups_.template get<index_of<Tag>()>();
  }
  template <class Function>
  [[gnu::always_inline]] void for_each_group(Function&& function) {
    groups_.for_each(function);
  }
  template <class Function>
  [[gnu::always_inline]] void for_each_group(Function&& function) const {
    groups_.for_each(function);
  }
  template <class Function>
  [[gnu::always_inline]] void for_each_item(Function&& function) {
    items_.for_each(function);
  }
  template <class Function>
  [[gnu::always_inline]] void for_each_item(Function&& function) const {
    items_.for_each(function);
  }

  /// Calls function(list, row, entry): where a bond of an item is listed; at its first end, if at both.
  template <class Active, class Function>
  static auto look_up(Active& active, const neighbours::Bond& bond, const Function& function) {
    using I = std::remove_cvref_t<decltype(active.item)>;
    constexpr bool same = std::is_same_v<typename I::A, typename I::B>;
    const bool at_b = !same && active.of_a.empty();
    auto& list = at_b ? active.of_b : active.of_a;
    const auto at = [&](std::uint32_t own, std::uint32_t other) { return std::pair(own, list.find(own, other)); };
    auto [own, entry] = at_b ? at(bond.j, bond.i) : at(bond.i, bond.j);
    if (same && entry == list.of(own).size) std::tie(own, entry) = at(bond.j, bond.i);
    return function(list, own, entry);
  }
  /// Whether a bond of an item has broken.
  template <class Active>
  [[nodiscard]] static bool is_broken([[maybe_unused]] const Active& active, [[maybe_unused]] const neighbours::Bond& bond) noexcept {
    if constexpr (bond::CanBreak<decltype(active.item.law)>) {
      if (active.of_a.empty() && active.of_b.empty()) return false;  // between groups that do not move: never asked
      return look_up(active, bond, [](const auto& list, std::size_t i, std::size_t entry) { return list.of(i).rest_length[entry] < 0.0; });
    }
    return false;
  }

  /// What broken bonds had left out is found anew with the next lists.
  void forget_exclusions() noexcept { whole_bonds_ = std::numeric_limits<std::size_t>::max(); }

  /// The first bond that is longer than a bond may be in a periodic box; nullptr if there is none.
  template <class Active>
  [[nodiscard]] const neighbours::Bond* find_long_bond(const Active& active) const {
    using I = decltype(active.item);
    if (periods_ == std::array<double, Dim>{}) return nullptr;
    const auto& a = group<typename I::A>();
    const auto& b = group<typename I::B>();
    if (!active.of_a.empty() ? !has_long_bonds(a, b, active.of_a) : !active.of_b.empty() && !has_long_bonds(b, a, active.of_b))
      return nullptr;
    for (const auto& bond : active.item.bonds) {
      if (is_broken(active, bond)) continue;
      const Vector<Dim> apart = neighbours::minimum_image<Dim>(a.positions()[bond.i] - b.positions()[bond.j], box_);
      for (int d = 0; d < Dim; ++d)
        if (std::fabs(apart[d]) > longest_bond(static_cast<std::size_t>(d))) return &bond;
    }
    return nullptr;
  }

  [[nodiscard]] const geometry::Box<Dim>& box() const noexcept { return box_; }
  [[nodiscard]] sweep::Periods<Dim> periods() const { return sweep::Periods<Dim>(periods_); }

 protected:
  using Lanes = Pack<typename Precision::Real, native_width<typename Precision::Real>>;
  template <class G>
  using LayoutOf = typename std::remove_cvref_t<G>::Layout;
  template <class G>
  static constexpr bool evolves = std::remove_cvref_t<G>::Mobility::evolves;
  template <class G>
  static constexpr bool mobile = particles::is_mobile<typename std::remove_cvref_t<G>::Mobility>;

  [[nodiscard]] const auto& items() const noexcept { return items_; }

  template <class Tag, class Law>
  void check_reach(const Law& summed) const {  // every list that a summed law sweeps must reach far enough
    for_each_item([&](const auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (detail::is_summed_over<I>)
        if constexpr (std::is_same_v<Tag, typename I::A> || std::is_same_v<Tag, typename I::B>)
          require(summed.cutoff() <= active.item.cutoff(),
                  ("summed: support radius must be <= the cut-off of the interaction of " + group<typename I::A>().name + " and " +
                   group<typename I::B>().name + " (" + to_text(active.item.cutoff()) + " m)")
                      .c_str(),
                  summed.cutoff());
    });
  }

  /// Whether bonds have broken since exclusions were found.
  [[nodiscard]] bool exclusions_are_worn() const noexcept {
    if constexpr (has_pairs && bonds_break) return excluded_reach() > 0 && whole_bonds() != whole_bonds_;
    else return false;
  }
  /// Pairs that were left out because of bonds that have broken since are pairs again.
  void renew_exclusions() {
    if constexpr (has_pairs && bonds_break)
      if (exclusions_are_worn()) {
        whole_bonds_ = whole_bonds();
        prepare_exclusions();
      }
  }

  geometry::Box<Dim> box_;
  std::array<double, Dim> periods_{};  // lengths of the periodic directions, 0 for the others

 private:
  using Items = typename detail::Actives<Dim, detail::filter<detail::IsNotGroup, Item...>>::type;
  template <bool Keep, class I>
  static auto keep(const I& item) {
    if constexpr (Keep) return Values<const I&>{{item}};
    else return Values<>{};
  }
  static Groups make_groups(const auto& items) {
    return items.apply(
        []<class... G>(const G&... item) { return Groups{{Group<G, Composition<G, KeepsRates, Item...>, Precision>(item)}...}; });
  }
  static Items make_items(const auto& items) {
    return items.apply([]<class... I>(const I&... item) { return Items{{detail::Active<Dim, I>{item}}...}; });
  }
  /// Longest bond [m] along a direction.
  [[nodiscard]] double longest_bond(std::size_t d) const noexcept {
    return periods_[d] > 0.0 ? neighbours::longest_periodic_bond * periods_[d] : std::numeric_limits<double>::infinity();
  }
  /// Whether some of the bonds that group `own` lists are longer.
  template <class G, class Partners>
  [[nodiscard]] bool has_long_bonds(const G& own, const Partners& partners, const neighbours::BondList& list) const {
    using sweep::Lanes;
    const sweep::Periods<Dim> lengths = periods();
    return merge_ranges(
        own.blocks.ranges(), false,
        [&](std::size_t first, std::size_t last) {
          Lanes most(0.0);  // how far too long
          for (std::size_t i = first; i < last; ++i) {
            const auto bonds = list.of(i);
            for (std::size_t k = 0; k < bonds.size; k += Lanes::width) {
              const auto apart = sweep::separations_of<Partners::Records::stride>(own.positions()[i], partners.positions().data(),
                                                                                  bonds.partner + k, lengths);
              const auto is_bond = Lanes::load(bonds.rest_length + k) >= 0.0;
              for (int d = 0; d < Dim; ++d)
                most = max(most, select(is_bond, abs(apart[d]) - longest_bond(static_cast<std::size_t>(d)), 0.0));
            }
          }
          bool result = false;
          for (int lane = 0; lane < Lanes::width; ++lane) result = result || most[lane] > 0.0;
          return result;
        },
        [](bool a, bool b) { return a || b; });
  }
  template <class Active>
  void prepare_bonds(Active& active) {
    using I = std::remove_cvref_t<decltype(active.item)>;
    auto& a = group<typename I::A>();
    auto& b = group<typename I::B>();
    constexpr bool same = std::is_same_v<typename I::A, typename I::B>;
    neighbours::complete_bonds<Dim>(active.item.bonds, a.positions(), b.positions(), same, box_, same ? a.name : a.name + " and " + b.name);
    using GroupA = std::remove_cvref_t<decltype(a)>;
    using GroupB = std::remove_cvref_t<decltype(b)>;
    constexpr bool dispersive = bond::IsDispersive<decltype(I::law)>;  // particles that do not move know the strain of their bonds too
    if constexpr (mobile<GroupA> || dispersive)
      active.of_a.build(a.blocks, active.item.bonds, same, false, Lanes::width, {GroupB::Records::stride, GroupA::Sums::stride});
    if constexpr ((mobile<GroupB> || dispersive) && !same)
      active.of_b.build(b.blocks, active.item.bonds, false, true, Lanes::width, {GroupA::Records::stride, GroupB::Sums::stride});
    a.may_be_sorted = b.may_be_sorted = false;
    if constexpr (bond::HasMemory<decltype(I::law)>) {
      if (!active.of_a.empty()) active.of_a.template remember<Dim>(a.positions(), b.positions(), box_);
      if (!active.of_b.empty()) active.of_b.template remember<Dim>(b.positions(), a.positions(), box_);
    }
  }

  /// Bonds that share the strain of a particle must share it alike: else there is no energy.
  void check_dispersion() const {
    for_each_group([&](const auto& g) {
      double share = std::numeric_limits<double>::quiet_NaN();
      for_each_item([&](const auto& active) {
        using I = std::remove_cvref_t<decltype(active.item)>;
        if constexpr (is_bonds<I>)
          if constexpr (bond::IsDispersive<decltype(I::law)> && detail::joins<typename std::remove_cvref_t<decltype(g)>::Tag, I>) {
            const double own = active.item.law.dispersive_share;
            if (own != share && share == share)
              throw ParameterError("bonds of " + g.name + ": dispersive_share must be the same of all bonds of a group that have one, " +
                                   to_text(share) + ", got " + to_text(own));
            share = own;
          }
      });
    });
  }
  template <class... Tag, class Law>
  void check_summed(const Summed<std::tuple<Tag...>, Law>& summed) const {
    (check_reach<Tag>(summed.law), ...);
  }

  template <class I>
  void set_constants(const I& item) {  // and the density at the start, where the equation of state has one of rest
    for_each_group([&](auto& g) {
      using Layout = typename std::remove_cvref_t<decltype(g)>::Layout;
      if constexpr (I::template concerns<typename std::remove_cvref_t<decltype(g)>::Tag>)
        item.laws.apply([&g](const auto&... law) {
          const auto one = [&g]<class L>(const L& l) {
            if constexpr (intersect<typename L::writes, typename Layout::constants>::count > 0) l.apply(g.constants);
            if constexpr (contains<field::Density, typename Layout::columns>)  // two conditions: for Clang 14
              if constexpr (requires { l.eos.rest_density; }) g.template get<field::Density>().assign(g.size(), l.eos.rest_density);
          };
          sweep::with_chosen([&one](const auto&... chosen) { (one(chosen), ...); }, law...);
        });
    });
  }

  [[nodiscard]] std::size_t whole_bonds() const noexcept {  // of those that may break
    std::size_t whole = 0;
    for_each_item([&whole](const auto& active) {
      if constexpr (is_bonds<std::remove_cvref_t<decltype(active.item)>>)
        if constexpr (bond::CanBreak<decltype(active.item.law)>) whole += active.of_a.whole() + active.of_b.whole();
    });
    return whole;
  }
  [[nodiscard]] int excluded_reach() const noexcept {  // the longest of all interactions
    int reach = 0;
    for_each_item([&](const auto& active) {
      if constexpr (is_interaction<std::remove_cvref_t<decltype(active.item)>>) reach = std::max(reach, active.item.excluded_reach);
    });
    return reach;
  }

  void prepare_exclusions() {
    if (excluded_reach() == 0) return;
    std::array<std::uint32_t, Groups::count + 1> first{};
    for_each_group([&](const auto& g) {
      const std::size_t k = index_of<typename std::remove_cvref_t<decltype(g)>::Tag>();
      first[k + 1] = first[k] + static_cast<std::uint32_t>(g.size());
    });
    neighbours::BondGraph graph(first.back());
    for_each_item([&](const auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_bonds<I>)
        for (const auto& bond : active.item.bonds) {
          if (is_broken(active, bond)) continue;
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

  Groups groups_;
  Items items_;
  std::size_t whole_bonds_ = std::numeric_limits<std::size_t>::max();  // of those that may break, when exclusions were last found
};

}  // namespace dmp::simulation
