#pragma once
#include <algorithm>
#include <sstream>
#include <string>
#include <type_traits>
#include <dmp/simulation/scene.hpp>

namespace dmp::simulation {

/// Bytes that a scene holds per particle: columns, ids, records, sums, ghosts, cell grid, lists, and what sorting needs.
template <class Scene>
[[nodiscard]] double bytes_per_particle(const Scene& scene) {
  auto bytes = static_cast<double>(scene.engine().bytes());
  scene.engine().for_each_group([&bytes](const auto& g) {
    using G = std::remove_cvref_t<decltype(g)>;
    bytes += static_cast<double>(g.size() * (G::Columns::bytes_per_particle + sizeof(std::uint32_t)));
    if constexpr (G::Layout::has_records) bytes += static_cast<double>(g.records.bytes() + g.sums.bytes());
    if constexpr (G::Layout::has_pairs)
      bytes += static_cast<double>(g.at_list_build.size() * sizeof(Vector<G::Dim>) + g.level.size() + g.grid.bytes() +
                                   g.ghosts.size() * (sizeof(std::uint32_t) + sizeof(Vector<G::Dim>)));
  });
  scene.engine().for_each_item([&bytes](const auto& active) {
    if constexpr (requires { active.of_a.bytes(); }) bytes += static_cast<double>(active.of_a.bytes() + active.of_b.bytes());
    if constexpr (requires { active.sums; })
      for (const auto& sums : active.sums) bytes += static_cast<double>(sums.bytes());
  });
  return bytes / static_cast<double>(std::max<std::size_t>(1, scene.particles()));
}

/// What a scene consists of, and therefore what it costs: groups with their columns and records, interactions, sweeps of one step, and
/// the law that binds the time step. What is not listed is not in the program.
template <class Scene>
[[nodiscard]] std::string describe(Scene& scene) {
  const auto limit = scene.step_limit();
  std::ostringstream text;
  const auto fields = [&text]<class... Field>(Fields<Field...>) { ((text << ' ' << Field::name), ...); };
  text << "groups\n";
  int gathers = 0, passes = 0;
  scene.engine().for_each_group([&](const auto& g) {
    using G = std::remove_cvref_t<decltype(g)>;
    using L = typename G::Layout;
    text << "  " << g.name << ": " << g.size() << " particles, " << G::Mobility::name << ", " << G::Columns::bytes_per_particle
         << " B in columns:";
    fields(typename L::columns{});
    if constexpr (L::has_records) {
      text << "; " << G::Records::bytes_per_particle() << " B record:";
      fields(typename L::record{});
    } else {
      text << "; no record";
    }
    text << "; constants:";
    fields(typename L::constants{});
    text << "; " << g.ghost_count() << " ghosts\n";
    if (G::Mobility::evolves) {
      ++passes;
      if (particles::is_mobile<typename G::Mobility> || !std::is_same_v<typename L::rates, Fields<>>) ++gathers;
    }
  });
  const auto name = [&scene]<class Tag>(std::type_identity<Tag>) { return scene.template group<Tag>().name; };
  text << "interactions\n";
  bool any = false;
  scene.engine().for_each_item([&](const auto& active) {
    using I = std::remove_cvref_t<decltype(active.item)>;
    if constexpr (is_interaction<I>) {
      text << "  pairs " << name(std::type_identity<typename I::A>{}) << " - " << name(std::type_identity<typename I::B>{}) << ": cut-off "
           << active.item.cutoff() << " m, writes";
      fields(typename I::writes{});
      text << '\n';
      any = true;
    }
    if constexpr (is_summed<I>) {
      text << "  summed over neighbours:";
      fields(typename decltype(active.item.law)::sets{});
      text << ", every " << active.item.every << (active.item.every == 1 ? " step, a sweep" : " steps, a sweep") << " of its own\n";
      any = true;
    }
    if constexpr (is_confined<I>) {
      text << "  contact planes in front of which particles stay: " << active.item.planes.size() << '\n';
      any = true;
    }
    if constexpr (is_bonds<I>) {
      text << "  bonds " << name(std::type_identity<typename I::A>{}) << " - " << name(std::type_identity<typename I::B>{}) << ": "
           << active.item.bonds.size() << " bonds" << (I::uses_velocity ? ", with velocities" : "")
           << (I::substepped ? ", sub-stepped" : "") << (bond::HasMemory<decltype(I::law)> ? ", with memory" : "")
           << (bond::CanBreak<decltype(I::law)> ? ", breaking" : "")
           << (bond::IsDispersive<decltype(I::law)> ? ", dispersive: a sweep of its own for strains" : "")
           << (std::is_same_v<decltype(I::law), ImplicitKelvinVoigt> ? ", dashpots implicit" : "") << '\n';
      any = true;
    }
  });
  if (!any) text << "  none\n";
  if constexpr (std::remove_cvref_t<decltype(scene.engine())>::has_substeps)
    text << "sub-steps of the sub-stepped bonds: as many as the step asks for, each one record pass and one gather sweep of its groups\n";
  text << "each step: " << passes << (passes == 1 ? " pass" : " passes") << " over the particles (integration, records), " << gathers
       << (gathers == 1 ? " sweep" : " sweeps") << " over their pairs and bonds";
  if constexpr (!std::remove_cvref_t<decltype(scene.engine())>::has_pairs) text << ", no neighbour lists, no ghosts";
  text << "\ntime step <= " << limit.time_step << " s, bound by " << limit.bound_by << '\n';
  text << bytes_per_particle(scene) << " bytes per particle\n";
  return text.str();
}

}  // namespace dmp::simulation
