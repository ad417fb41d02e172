#pragma once
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <dmp/core/threads.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/simulation/composition.hpp>

/// What the contact planes of a scene (confined_by) do to the particles of its groups.
namespace dmp::simulation {

/// Whether particles of a group must stay in front of planes.
template <class G>
inline constexpr bool meets_planes = contains<ContactForce, typename std::remove_cvref_t<G>::Layout::columns>;

/// Calls function(plane, normal) for each of them.
template <class Engine, class G, class Function>
void for_each_plane(const Engine& engine, const G&, const Function& function) {
  engine.for_each_item([&](const auto& active) {
    using I = std::remove_cvref_t<decltype(active.item)>;
    if constexpr (is_confined<I>)
      if constexpr (I::template concerns<typename G::Tag>)
        for (const auto& plane : active.item.planes) function(plane, to_vector<G::Dim>(plane.normal.value));
  });
}

/// Adds to the acceleration of particle i at `time` what keeps it from being behind a plane after a next step of `dt`; nothing if dt = 0,
/// which says nothing of a step.
template <class Integrator, class Engine, class G>
void add_contact_forces(const Engine& engine, G& g, std::size_t i, double time, double dt, Vector<G::Dim>& acceleration) {
  auto& force = g.template get<ContactForce>()[i];
  if (!(dt > 0.0)) {
    force.setZero();
    return;
  }
  Vector<G::Dim> there = g.positions()[i], velocity = g.template get<field::Velocity>()[i];
  const Vector<G::Dim> free = acceleration;
  Integrator::end(velocity, free, dt);
  Integrator::begin(there, velocity, free, dt);
  for_each_plane(engine, g, [&](const auto& plane, const Vector<G::Dim>& normal) {
    const double behind = plane.behind(to_components<G::Dim>(there), time + dt);
    if (!(behind > 0.0)) return;
    acceleration += behind / (dt * dt) * normal;
    force += g.mass * behind / (dt * dt) * normal;
  });
}
/// Takes particle i, which has moved for `dt` up to `time`, out of planes; its mean force over the step begins the contact force.
template <class Engine, class G>
void stop_at_planes(const Engine& engine, G& g, std::size_t i, double dt, double time) {
  auto& force = g.template get<ContactForce>()[i];
  force.setZero();
  for_each_plane(engine, g, [&](const auto& plane, const Vector<G::Dim>& normal) {
    const double behind = plane.behind(to_components<G::Dim>(g.positions()[i]), time);
    if (!(behind > 0.0)) return;
    g.positions()[i] += behind * normal;
    g.template get<field::Velocity>()[i] += behind / dt * normal;
    force += g.mass * behind / (dt * dt) * normal;
  });
}

/// Calls function(group, row, plane, normal) for all planes and particles of a scene that meet.
template <class Engine, class Function>
void for_each_meeting(Engine& engine, const Function& function) {
  engine.for_each_group([&](auto& g) {
    if constexpr (meets_planes<decltype(g)>)
      for_each_range(g.blocks.ranges(), [&](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
          for_each_plane(engine, g, [&](const auto& plane, const auto& normal) { function(g, i, plane, normal); });
      });
  });
}
/// For states of rest: puts what is behind a plane on it.
template <class Engine>
void put_before_planes(Engine& engine, double time) {
  for_each_meeting(engine, [time](auto& g, std::size_t i, const auto& plane, const auto& normal) {
    auto& place = g.positions()[i];
    place += std::fmax(0.0, plane.behind(to_components<std::remove_cvref_t<decltype(g)>::Dim>(place), time)) * normal;
  });
}
/// For states of rest: planes bear what presses at them.
template <class Engine>
void rest_on_planes(Engine& engine, double time) {
  for_each_meeting(engine, [time](auto& g, std::size_t i, const auto& plane, const auto& normal) {
    auto& acceleration = g.template get<field::Acceleration>()[i];
    const double pressing = -normal.dot(acceleration);
    if (!(pressing > 0.0 && plane.touches(to_components<std::remove_cvref_t<decltype(g)>::Dim>(g.positions()[i]), time))) return;
    acceleration += pressing * normal;
    g.template get<ContactForce>()[i] += g.mass * pressing * normal;
  });
}
/// Calls found(group, row, plane) for the first particle that is behind a plane, by more than rounding makes.
template <class Engine, class Function>
void find_behind_planes(const Engine& engine, double time, const Function& found) {
  engine.for_each_group([&](const auto& g) {
    if constexpr (meets_planes<decltype(g)>)
      for (std::size_t i = 0; i < g.size(); ++i)
        for_each_plane(engine, g, [&](const auto& plane, const auto&) {
          const auto place = to_components<std::remove_cvref_t<decltype(g)>::Dim>(g.positions()[i]);
          if (plane.behind(place, time) > plane.rounding(place)) found(g, i, plane);
        });
  });
}

}  // namespace dmp::simulation
