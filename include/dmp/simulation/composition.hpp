#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <dmp/core/field.hpp>
#include <dmp/particles/mobility.hpp>
#include <dmp/simulation/items.hpp>

/// From the items of a scene to what each group must hold, at compile time.
namespace dmp::simulation {

template <class T>
inline constexpr bool is_group = false;
template <class Tag, class M, int Dim>
inline constexpr bool is_group<GroupItem<Tag, M, Dim>> = true;
template <class T>
inline constexpr bool is_interaction = false;
template <class A, class B, class... Law>
inline constexpr bool is_interaction<Interaction<A, B, Law...>> = true;
template <class T>
inline constexpr bool is_bonds = false;
template <class A, class B, class Law, bool S>
inline constexpr bool is_bonds<Bonds<A, B, Law, S>> = true;
template <class T>
inline constexpr bool is_material = false;
template <class Tags, class... Law>
inline constexpr bool is_material<Material<Tags, Law...>> = true;
template <class T>
inline constexpr bool is_forced = false;
template <class Tags, class... Law>
inline constexpr bool is_forced<Forced<Tags, Law...>> = true;
template <class T>
inline constexpr bool is_confined = false;
template <class Tags, int Dim, std::size_t Count>
inline constexpr bool is_confined<Confined<Tags, Dim, Count>> = true;
template <class T>
inline constexpr bool is_summed = false;
template <class Tags, class Law>
inline constexpr bool is_summed<Summed<Tags, Law>> = true;

namespace detail {

template <class G, class Item>
inline constexpr bool joins = false;  // an interaction or a bond item with G at one end
template <class G, class A, class B, class... Law>
inline constexpr bool joins<G, Interaction<A, B, Law...>> = std::is_same_v<G, A> || std::is_same_v<G, B>;
template <class G, class A, class B, class Law, bool S>
inline constexpr bool joins<G, Bonds<A, B, Law, S>> = std::is_same_v<G, A> || std::is_same_v<G, B>;

template <class Item>
inline constexpr bool solves_dashpots = false;
template <class A, class B>
inline constexpr bool solves_dashpots<Bonds<A, B, ImplicitKelvinVoigt, false>> = true;

template <class G, class H, class Item>
inline constexpr bool joins_both = false;  // an interaction between G and H
template <class G, class H, class A, class B, class... Law>
inline constexpr bool joins_both<G, H, Interaction<A, B, Law...>> =
    (std::is_same_v<G, A> && std::is_same_v<H, B>) || (std::is_same_v<G, B> && std::is_same_v<H, A>);

template <class G, class Item>
inline constexpr bool acts_within = false;  // an interaction with G at both ends
template <class G, class... Law>
inline constexpr bool acts_within<G, Interaction<G, G, Law...>> = true;

template <class G, class Item>
inline constexpr bool confines = false;  // planes that G is not to get behind
template <class G, class... Tag, int Dim, std::size_t Count>
inline constexpr bool confines<G, Confined<std::tuple<Tag...>, Dim, Count>> = (std::is_same_v<G, Tag> || ...);

template <class G, class Item>
struct OfItem {
  using reads = Fields<>;
  using writes = Fields<>;
  static constexpr bool uses_velocity = false, substepped = false;
};
template <class G, class Item>
  requires joins<G, Item>
struct OfItem<G, Item> {
  using reads = typename Item::reads;
  using writes = typename Item::writes;
  static constexpr bool uses_velocity = Item::uses_velocity;
  static constexpr bool substepped = [] {
    if constexpr (is_bonds<Item>) return Item::substepped;
    return false;
  }();
};

template <class Law>
inline constexpr bool is_constant = std::is_same_v<typename Law::reads, Fields<>>;

template <class G, class Item>
struct OfMaterial {
  using laws = std::tuple<>;
  using reads = Fields<>;
  using constants = Fields<>;
  using derived = Fields<>;
};
template <class G, class... Tag, class... Law>
  requires(Material<std::tuple<Tag...>, Law...>::template concerns<G>)
struct OfMaterial<G, Material<std::tuple<Tag...>, Law...>> {
  using laws = std::tuple<Law...>;
  using reads = unite<typename Law::reads...>;
  using constants = unite<std::conditional_t<is_constant<Law>, typename Law::writes, Fields<>>...>;
  using derived = unite<std::conditional_t<is_constant<Law>, Fields<>, typename Law::writes>...>;
};

/// Whether no law sets what another one has set, or has read before it was set.
template <class Laws>
inline constexpr bool set_once = true;
template <class First, class... Rest>
inline constexpr bool set_once<std::tuple<First, Rest...>> =
    ((intersect<typename First::writes, typename Rest::writes>::count == 0) && ...) && set_once<std::tuple<Rest...>>;
template <class Laws>
inline constexpr bool set_before_read = true;
template <class First, class... Rest>
inline constexpr bool set_before_read<std::tuple<First, Rest...>> =
    ((intersect<typename First::reads, typename Rest::writes>::count == 0) && ...) && set_before_read<std::tuple<Rest...>>;

/// Whether a law says how much energy a kelvin takes, by which conduction bounds the time step.
template <class Law>
inline constexpr bool has_specific_heat = requires(const Law law) { law.specific_heat(); };
template <class... L>
inline constexpr bool has_specific_heat<sweep::ChosenOf<L...>> = (has_specific_heat<L> && ...);
template <class Laws>
inline constexpr bool any_specific_heat = false;
template <class... Law>
inline constexpr bool any_specific_heat<std::tuple<Law...>> = (has_specific_heat<Law> || ...);

/// Whether of laws to choose from at run time each sets whatever is needed of what any of them sets.
template <class Law, class Needed>
inline constexpr bool sets_whole = true;
template <class... L, class Needed>
inline constexpr bool sets_whole<sweep::ChosenOf<L...>, Needed> =
    ((intersect<subtract<unite<typename L::writes...>, typename L::writes>, Needed>::count == 0) && ...);
template <class Laws, class Needed>
inline constexpr bool all_set_whole = true;
template <class... Law, class Needed>
inline constexpr bool all_set_whole<std::tuple<Law...>, Needed> = (sets_whole<Law, Needed> && ...);

/// Interactions whose partners summed laws sum over: those of particles that have a density. A repulsion beside them brings none.
template <class Item>
inline constexpr bool is_summed_over = false;
template <class A, class B, class... Law>
inline constexpr bool is_summed_over<Interaction<A, B, Law...>> = contains<field::Density, typename Interaction<A, B, Law...>::reads> ||
                                                                  contains<field::DensityRate, typename Interaction<A, B, Law...>::writes>;

template <class G, class H, class... Item>
inline constexpr bool is_partner = ((joins_both<G, H, Item> && is_summed_over<Item>) || ...);

/// What a summed law asks of group G, and what it sets there. Its partners are all groups that an interaction joins to its own.
template <class G, class Summed_, class... Item>
struct OfSummed {
  using reads = Fields<>;
  using sets = Fields<>;
  static constexpr bool uses_velocity = false;
};
template <class G, class... Tag, class Law, class... Item>
  requires((std::is_same_v<G, Tag> || is_partner<G, Tag, Item...>) || ...)
struct OfSummed<G, Summed<std::tuple<Tag...>, Law>, Item...> {
  using reads = typename Law::reads;
  using sets = std::conditional_t<(std::is_same_v<G, Tag> || ...), typename Law::sets, Fields<>>;
  static constexpr bool uses_velocity = Law::uses_velocity;
};

template <class Field>
inline constexpr bool is_rate = requires {
  typename Field::integrates;
};
template <class Field>
using rate_only = std::conditional_t<is_rate<Field>, Fields<Field>, Fields<>>;
template <class List>
struct Rates;
template <class... Field>
struct Rates<Fields<Field...>> {
  using type = unite<rate_only<Field>...>;
};

/// What must be set by a law, and never is a column that the user fills.
using SetByLaws = Fields<field::PressureTerm, field::DynamicViscosity, field::SoundSpeed, field::ThermalConductivity, field::ShearRate>;

template <class List>
struct Integrated;
template <class... Rate>
struct Integrated<Fields<Rate...>> {
  using type = unite<Fields<typename Rate::integrates>...>;
};

}  // namespace detail

/// The sub-step acceleration of groups with sub-stepped bonds.
struct FastAcceleration {
  static constexpr std::string_view name = "fast_acceleration", unit = "m/s^2";
  static constexpr bool is_vector = true;
};
/// Where the particles of a driven group started.
struct StartPosition {
  static constexpr std::string_view name = "start_position", unit = "m";
  static constexpr bool is_vector = true;
};

/// With what contact planes push a particle.
struct ContactForce {
  static constexpr std::string_view name = "contact_force", unit = "N";
  static constexpr bool is_vector = true;
};

/// What one group of a scene holds: sets of fields and yes-or-no answers, without the items they come from (which keeps names short).
template <class Columns, class State, class Rates, class Record, class Constants, class Derived, class Writes, bool HasPairs, bool HasBonds,
          bool HasSubsteps, bool SumsInMemory>
struct Layout {
  using columns = Columns;                ///< stored from step to step
  using state = State;                    ///< the columns that material and pair laws read, beside position and velocity
  using rates = Rates;                    ///< rates of change of the state
  using record = Record;                  ///< what pair and bond laws read, packed anew each step
  using constants = Constants;            ///< one value for the whole group
  using derived = Derived;                ///< what material laws set of each particle, as far as any law reads it
  using writes = Writes;                  ///< what pair and bond laws sum
  using seen = unite<Record, Constants>;  ///< what laws see of a particle
  using prepared = unite<Fields<field::Position, field::Velocity>, State, Derived, Constants>;  ///< what material laws work on
  static constexpr bool has_pairs = HasPairs, has_bonds = HasBonds, has_substeps = HasSubsteps, has_records = HasPairs || HasBonds;
  static constexpr bool sums_in_memory = SumsInMemory;  ///< has pairs between its own particles, or bonds that act on it
};

/// A rate of change as it was one step ago, for integrators that extrapolate the state.
template <class Rate>
struct Previous {
  static constexpr std::string_view prefix = "previous_";
  static constexpr auto text = [] {
    std::array<char, prefix.size() + Rate::name.size()> both{};
    std::copy(prefix.begin(), prefix.end(), both.begin());
    std::copy(Rate::name.begin(), Rate::name.end(), both.begin() + prefix.size());
    return both;
  }();
  static constexpr std::string_view name{text.data(), text.size()}, unit = Rate::unit;
  static constexpr bool is_vector = Rate::is_vector;
};

namespace detail {

template <class List>
struct AllPrevious;
template <class... Rate>
struct AllPrevious<Fields<Rate...>> {
  using type = Fields<Previous<Rate>...>;
};

template <class G, bool KeepsRates, class... Item>
struct Compose {
  using Tag = typename G::Tag;
  using Mobility = typename G::Mobility;
  static constexpr bool has_pairs = ((is_interaction<Item> && joins<Tag, Item>) || ...);
  static constexpr bool has_bonds = ((is_bonds<Item> && joins<Tag, Item>) || ...);
  static constexpr bool uses_velocity = (OfItem<Tag, Item>::uses_velocity || ...) || (OfSummed<Tag, Item, Item...>::uses_velocity || ...);
  static constexpr bool has_substeps = particles::is_mobile<Mobility> && (OfItem<Tag, Item>::substepped || ...);
  static constexpr int confinements = (0 + ... + (confines<Tag, Item> ? 1 : 0));
  static_assert(confinements <= 1, "dmp: two confined_by<...> concern the same group; name all its planes in one");
  static_assert(confinements == 0 || std::is_same_v<Mobility, particles::Mobile>,
                "dmp: confined_by: only mobile groups make way for a plane; driven groups and rollers follow their motion");
  static_assert(confinements == 0 || !has_substeps,
                "dmp: confined_by: where the particles of a group with sub-stepped bonds will be is not known; make them bonds<...>, or "
                "the plane a forcing::Plane");
  static_assert(confinements == 0 || !((solves_dashpots<Item> && joins<Tag, Item>) || ...),
                "dmp: confined_by: the dashpots of implicit_bonds are solved for without contact; make them bonds<...>, or the plane a "
                "forcing::Plane");
  template <bool Wanted, class... Field>
  using only_if = std::conditional_t<Wanted, Fields<Field...>, Fields<>>;

  using reads = unite<typename OfItem<Tag, Item>::reads..., typename OfSummed<Tag, Item, Item...>::reads...>;
  using writes = unite<std::conditional_t<has_bonds, Fields<field::Force>, Fields<>>,  // the force first: bonds add it in whole registers
                       typename OfItem<Tag, Item>::writes...>;
  using constants = unite<Fields<field::Mass>, typename OfMaterial<Tag, Item>::constants...>;
  using materials = decltype(std::tuple_cat(std::declval<typename OfMaterial<Tag, Item>::laws>()...));
  static_assert(set_once<materials>, "dmp: two laws in the materials of a group set the same property; leave one of them out");
  static_assert(set_before_read<materials>,
                "dmp: a law in the materials of a group reads a property that a later one sets (a viscosity of temperature before the law "
                "of the temperature, say): name the one that sets it first");
  using material_reads = unite<typename OfMaterial<Tag, Item>::reads...>;
  using needed = unite<reads, material_reads>;
  static_assert(
      all_set_whole<materials, needed>,
      "dmp: one of the laws to be chosen from in the materials of a group sets a property that another does not set, and a law reads it");
  using derived = intersect<unite<typename OfMaterial<Tag, Item>::derived...>, needed>;
  using summed = unite<typename OfSummed<Tag, Item, Item...>::sets...>;
  static_assert(intersect<subtract<reads, unite<constants, derived>>, subtract<SetByLaws, Fields<field::ShearRate>>>::count == 0,
                "dmp: a pair law reads the pressure term, the sound speed, the viscosity or the conductivity of a group, but no "
                "material<Group>(...) of this scene sets it");
  static_assert(!contains<field::ShearRate, subtract<needed, summed>>,
                "dmp: a law reads the shear rate of a group, but nothing sets it; add summed<Group>(sph::ShearRate<...>{...})");
  static_assert(summed::count == 0 || Mobility::evolves, "dmp: summed<Group>: nothing changes in a frozen group; make it stationary");
  static_assert(
      summed::count == 0 || ((joins<Tag, Item> && is_summed_over<Item>) || ...),
      "dmp: summed<Group>: no interaction of a law that knows the density joins the group to any, so it has no neighbours to sum over");
  static_assert(intersect<summed, unite<constants, derived>>::count == 0,
                "dmp: summed<Group> sets a property that a law in the materials of the group sets too; leave one of them out");

  static_assert(!contains<field::ThermalConductivity, reads> || !Mobility::evolves || any_specific_heat<materials>,
                "dmp: heat is conducted into a group, but no law in its materials states `specific_heat()`, which bounds the time step");

  using rates = std::conditional_t<Mobility::evolves, typename Rates<writes>::type, Fields<>>;
  using state = subtract<unite<needed, typename Integrated<rates>::type, summed>,
                         unite<constants, derived, Fields<field::Position, field::Velocity>>>;
  using columns = unite<Fields<field::Position>, only_if<particles::is_mobile<Mobility>, field::Velocity, field::Acceleration>,
                        only_if<particles::is_driven<Mobility> || particles::is_roller<Mobility>, StartPosition, field::Velocity>,
                        only_if<has_substeps, FastAcceleration>, only_if<confinements == 1, ContactForce>, state, rates,
                        std::conditional_t<KeepsRates, typename AllPrevious<rates>::type, Fields<>>>;
  using record = std::conditional_t<has_pairs || has_bonds,
                                    unite<Fields<field::Position>, only_if<uses_velocity, field::Velocity>, subtract<reads, constants>>,
                                    Fields<>>;
  using type = Layout<columns, state, rates, record, constants, derived, writes, has_pairs, has_bonds, has_substeps,
                      contains<field::BondStrain, reads> || (Mobility::evolves && (has_bonds || (acts_within<Tag, Item> || ...)))>;
};

}  // namespace detail

/// The layout of group G (a GroupItem) in a scene made of `Item...`; KeepsRates: the integrator asks for the rates of the step before.
template <class G, bool KeepsRates, class... Item>
using Composition = typename detail::Compose<G, KeepsRates, Item...>::type;

}  // namespace dmp::simulation
