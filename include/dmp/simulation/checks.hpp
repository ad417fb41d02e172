#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>
#include <dmp/core/simulation_error.hpp>
#include <dmp/simulation/engine.hpp>
#include <dmp/simulation/state.hpp>

/// What is asked of a scene before anything is computed, and of its state while it runs.
namespace dmp::simulation {

/// All columns of a scene's groups, and what its bonds remember.
template <int Dim, class... Rest>
[[nodiscard]] std::vector<particles::GroupView> views_of(Engine<Dim, Rest...>& engine) {
  std::vector<particles::GroupView> result;
  engine.for_each_group([&result](auto& g) { result.push_back(g.view()); });
  engine.for_each_item([&, item = 0](auto& active) mutable {
    using I = std::remove_cvref_t<decltype(active.item)>;
    if constexpr (is_bonds<I>)
      if constexpr (bond::HasMemory<decltype(I::law)> || bond::CanBreak<decltype(I::law)>)
        for (auto* const list : {&active.of_a, &active.of_b})
          if (!list->empty())
            result.push_back(list->view("bonds " + std::to_string(item) + (list == &active.of_a ? ", first ends" : ", second ends")));
    ++item;
  });
  return result;
}

/// The first value of the present state that cannot be, if there is one.
template <int Dim, class... Rest>
[[nodiscard]] Fault find_fault(Engine<Dim, Rest...>& engine) {
  std::array<double, Dim> lower, upper;
  for (int d = 0; d < Dim; ++d) {
    const auto k = static_cast<std::size_t>(d);
    const bool open = engine.box().periodic[k];  // particles wander out of a periodic face until the lists are rebuilt
    lower[k] = open ? -std::numeric_limits<double>::infinity() : engine.box().lower[d];
    upper[k] = open ? std::numeric_limits<double>::infinity() : engine.box().upper[d];
  }
  return find_fault(views_of(engine), lower, upper);
}

/// Text of what a material law was given and cannot work with.
template <class Particle, class... Field>
[[nodiscard]] std::string given(const Particle& particle, Fields<Field...>) {
  std::string text;
  ((text += (text.empty() ? "" : ", ") + std::string(Field::name) + " " + to_text(Field::of(particle)) + " " + std::string(Field::unit)),
   ...);
  return text;
}

/// All values must be finite, positive where they must be, and in the box; bonds must know which image of a partner they mean.
/// Throws SimulationError with time, particle, field and value.
template <int Dim, class... Rest>
void check_state(Engine<Dim, Rest...>& engine, const Clock& clock) {
  require_none(find_fault(engine), clock);
  engine.for_each_item([&](const auto& active) {
    using I = std::remove_cvref_t<decltype(active.item)>;
    if constexpr (is_bonds<I>) {
      const auto& a = engine.template group<typename I::A>();
      const auto& b = engine.template group<typename I::B>();
      if (const auto* const bond = engine.find_long_bond(active))
        throw SimulationError("a bond has become longer than 0.45 of the periodic box",
                              {clock.time, clock.step, a.name, bond->i, "distance to " + b.name + " " + std::to_string(bond->j),
                               neighbours::minimum_image<Dim>(a.positions()[bond->i] - b.positions()[bond->j], engine.box()).norm()});
    }
  });
  find_behind_planes(engine, clock.time, [&clock](const auto& g, std::size_t i, const auto& plane) {
    throw SimulationError("a particle is behind a contact plane: planes leave it no room",
                          {clock.time, clock.step, g.name, g.id[i], "distance behind it",
                           plane.behind(to_components<Dim>(g.positions()[i]), clock.time)});
  });
}

/// No particle may be behind a contact plane when a run begins. Throws ParameterError.
template <int Dim, class... Rest>
void check_places(const Engine<Dim, Rest...>& engine, double time) {
  find_behind_planes(engine, time, [time](const auto& g, std::size_t i, const auto& plane) {
    const auto place = to_components<Dim>(g.positions()[i]);
    throw ParameterError("scene: group " + g.name + ", particle " + std::to_string(g.id[i]) +
                         ": normal . position must be >= that of a contact plane, " +
                         to_text(plane.position + plane.motion.displacement(time)) + " m, got " +
                         to_text(dot(plane.normal.value, place)) + " (relax puts it on the plane)");
  });
}

/// Every particle must be one that the material laws of its group can work with; `dt` [s] is the step under way. Throws SimulationError.
template <int Dim, class... Rest>
void check_materials(const Engine<Dim, Rest...>& engine, const Clock& clock, double dt) {
  engine.find_refused(dt, [&clock]<class... Field>(const auto& g, std::size_t i, const std::string& demand, const auto& particle,
                                                   Fields<Field...> read) {
    double value = 0.0;
    std::string_view name;
    ((value = Field::of(particle), name = Field::name), ...);
    throw SimulationError(demand + ", got " + given(particle, read), {clock.time, clock.step, g.name, g.id[i], std::string(name), value});
  });
}
/// The same at the start, when summed properties are known. Throws ParameterError.
template <int Dim, class... Rest>
void check_materials_at_start(const Engine<Dim, Rest...>& engine) {
  engine.find_refused(0.0, [](const auto& g, std::size_t i, const std::string& demand, const auto& particle, auto read) {
    throw ParameterError("scene: group " + g.name + ", particle " + std::to_string(g.id[i]) + ": " + demand + ", got " +
                         given(particle, read));
  });
}

namespace detail {
inline void check_support(const std::string& a, const std::string& b, double spacing, double cutoff) {
  if (cutoff < (1.0 - 1e-9) * spacing)
    throw ParameterError("scene: support radius (cut-off) of " + a + " and " + b + " must be >= their spacing " + to_text(spacing) +
                         " m, got " + to_text(cutoff));
}
}  // namespace detail
/// Names, values, places and supports, before anything is computed. Throws ParameterError.
template <int Dim, class... Rest>
void check_input(Engine<Dim, Rest...>& engine) {
  check_groups(views_of(engine), find_fault(engine));
  engine.for_each_item([&](const auto& active) {
    using I = std::remove_cvref_t<decltype(active.item)>;
    if constexpr (is_interaction<I>) {
      const auto& a = engine.template group<typename I::A>();
      const auto& b = engine.template group<typename I::B>();
      detail::check_support(a.name, b.name, std::max(a.spacing, b.spacing), active.item.cutoff());
    }
    if constexpr (is_confined<I>)
      for (const auto& plane : active.item.planes)
        for (int d = 0; d < Dim; ++d)
          require(!engine.box().periodic[static_cast<std::size_t>(d)] || std::fabs(plane.normal.value[d]) <= 1e-12,
                  "scene: a contact plane must lie along periodic directions, the component of its normal there be 0",
                  plane.normal.value[d]);
  });
}

namespace detail {
/// Where the particles of a group are, without its type.
template <int Dim>
struct Placed {
  template <class G>
  explicit Placed(const G& g)
      : name(g.name), spacing(g.spacing), blocks(g.blocks), positions(g.positions()), id(g.id), first_ghost(g.first_ghost()),
        sources(g.sources(false)) {}
  const std::string& name;
  double spacing;
  const Blocks& blocks;
  std::span<const Vector<Dim>> positions;
  std::span<const std::uint32_t> id;
  std::size_t first_ghost;
  neighbours::PairList::Sources sources;
};
template <int Dim>
void reject_overlap(const geometry::Box<Dim>& box, const Placed<Dim>& a, const Placed<Dim>& b, const neighbours::PairList& pairs) {
  const double least = 0.5 * std::min(a.spacing, b.spacing);
  for (std::size_t block = 0; block < a.blocks.size(); ++block)
    for (std::size_t i = a.blocks.begin(block); i < a.blocks.end(block); ++i) {
      const auto check = [&](std::size_t j, double distance) {
        if (distance < least)
          throw ParameterError("scene: particles must not overlap at the start: " + a.name + " " + std::to_string(a.id[i]) + " and " +
                               b.name + " " + std::to_string(b.id[j]) + " must be >= " + to_text(least) + " m apart, got " +
                               to_text(distance));
      };
      const auto lists = pairs.of(block, i);
      for (const std::uint16_t row : lists.once) {  // directly: what fills up the pack may be near behind a periodic face
        const std::size_t j = a.blocks.begin(block) + row;
        check(j, (a.positions[i] - b.positions[j]).norm());
      }
      for (const std::uint32_t row : lists.others) {
        if (row >= b.positions.size() && row < b.first_ghost) continue;  // fills up the pack
        const std::size_t j = b.sources.original(row);
        check(j, neighbours::minimum_image<Dim>(a.positions[i] - b.positions[j], box).norm());
      }
    }
}
}  // namespace detail
/// Particles closer than half their spacing at the start are a fill done twice, or two fills that overlap. Throws ParameterError.
template <int Dim, class... Rest>
void reject_overlaps(const Engine<Dim, Rest...>& engine) {
  engine.for_each_item([&](const auto& active) {
    using I = std::remove_cvref_t<decltype(active.item)>;
    if constexpr (is_interaction<I>) {
      const auto& a = engine.template group<typename I::A>();
      const auto& b = engine.template group<typename I::B>();
      const detail::Placed<Dim> of_a(a), of_b(b);
      if (std::remove_cvref_t<decltype(a)>::Mobility::evolves) detail::reject_overlap(engine.box(), of_a, of_b, active.of_a);
      if (!std::is_same_v<typename I::A, typename I::B> && std::remove_cvref_t<decltype(b)>::Mobility::evolves)
        detail::reject_overlap(engine.box(), of_b, of_a, active.of_b);
    }
  });
}

}  // namespace dmp::simulation
