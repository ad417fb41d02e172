#pragma once
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <dmp/forcing/concept.hpp>
#include <dmp/simulation/items.hpp>

/// What the items of a scene must agree on; each rule is a static_assert of Model.
namespace dmp::simulation {

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

template <class Groups, class... Tag, int Dim, std::size_t Count>
inline constexpr bool names_groups<Groups, Confined<std::tuple<Tag...>, Dim, Count>> = (is_tag<Tag, Groups> && ...);
template <class Groups, class... Tag, class Law>
inline constexpr bool names_groups<Groups, Summed<std::tuple<Tag...>, Law>> = (is_tag<Tag, Groups> && ...);

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
template <int Dim, class Tags, class Law>
inline constexpr bool laws_fit<Dim, Summed<Tags, Law>> = law_fits<Dim, Law>();
template <int Dim, class Tags, class... Law>
inline constexpr bool laws_fit<Dim, Forced<Tags, Law...>> = (forcing::explain_forcing<Law, Dim>() && ...);
template <int Dim, class Tags, int PlaneDim, std::size_t Count>
inline constexpr bool laws_fit<Dim, Confined<Tags, PlaneDim, Count>> = Dim == PlaneDim;
template <int Dim, class Tag, class M, int GroupDim>
inline constexpr bool laws_fit<Dim, GroupItem<Tag, M, GroupDim>> = Dim == GroupDim;
template <int Dim, class Item>
consteval bool fits_dimension() {
  return laws_fit<Dim, Item>;
}
}  // namespace detail

}  // namespace dmp::simulation
