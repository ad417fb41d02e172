#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>
#include <dmp/bond/concept.hpp>
#include <dmp/core/require.hpp>
#include <dmp/particles/mobility.hpp>
#include <dmp/simulation/composition.hpp>
#include <dmp/sweep/step_limit.hpp>

namespace dmp::simulation {

namespace detail {

/// Extremes over the particles of a group.
template <class Integrator, class Engine, class G>
[[nodiscard]] sweep::StepState state_of(const Engine& engine, const G& g) {
  sweep::StepState state{.oscillation_limit = Integrator::oscillation_limit,
                         .damping_limit = Integrator::damping_limit,
                         .state_damping_limit = Integrator::state_damping_limit};
  if constexpr (particles::is_mobile<typename G::Mobility>) state.mass = g.mass;
  for (std::size_t i = 0; i < g.size(); ++i) {
    const auto particle = engine.prepared(g, i, 0.0);
    state.speed = std::max(state.speed, dot(particle.velocity, particle.velocity));
    if constexpr (particles::is_mobile<typename G::Mobility>)
      state.acceleration = std::max(state.acceleration, g.template get<field::Acceleration>()[i].squaredNorm());
    if constexpr (requires {
                    particle.dynamic_viscosity;
                    particle.density;
                  })
      state.kinematic_viscosity = std::max(state.kinematic_viscosity, particle.dynamic_viscosity / particle.density);
    engine.for_each_item([&](const auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_material<I>)
        if constexpr (I::template concerns<typename std::remove_cvref_t<G>::Tag>)
          std::apply(
              [&](const auto&... law) {
                const auto one = [&](const auto& l) {
                  if constexpr (requires { l.sound_speed(particle); })
                    state.sound_speed = std::max(state.sound_speed, l.sound_speed(particle));
                };
                (one(law), ...);
              },
              active.item.laws);
    });
  }
  state.speed = std::sqrt(state.speed);
  state.acceleration = std::sqrt(state.acceleration);
  return state;
}

/// omega^2 <= 2 n k/m and lambda <= 2 n c/m for a particle with n bonds (Gershgorin's circles of the stiffness matrix).
template <class Integrator, class Engine, class Active>
void limit_bonds(const Engine& engine, const Active& active, sweep::StepLimit& limit) {
  using I = std::remove_cvref_t<decltype(active.item)>;
  const auto end = [&](const auto& g, const neighbours::BondList& list) {
    if constexpr (particles::is_mobile<typename std::remove_cvref_t<decltype(g)>::Mobility>) {
      const double per_mass = 2.0 * list.most_bonds() / g.mass;
      const double stiffness = active.item.law.largest_stiffness();
      if (stiffness * per_mass > 0.0)
        limit.require_below(Integrator::oscillation_limit / std::sqrt(stiffness * per_mass), "bond stiffness");
      if constexpr (bond::UsesVelocity<decltype(active.item.law)>) {
        const double damping = active.item.law.largest_damping();
        if (damping * per_mass > 0.0) limit.require_below(Integrator::damping_limit / (damping * per_mass), "bond dashpot");
      }
    }
  };
  end(engine.template group<typename I::A>(), active.of_a);
  if constexpr (!std::is_same_v<typename I::A, typename I::B>) end(engine.template group<typename I::B>(), active.of_b);
}

}  // namespace detail

/// Every law's bound of the time step for the present state: the smallest, and whose it is.
template <class Integrator, class Engine>
[[nodiscard]] sweep::StepLimit find_step_limit(const Engine& engine, bool without_substepped) {
  sweep::StepLimit limit;
  std::vector<sweep::StepState> states;
  engine.for_each_group([&](const auto& g) { states.push_back(detail::state_of<Integrator>(engine, g)); });
  const auto state = [&]<class Tag>(std::type_identity<Tag>) {
    std::size_t index = 0, found = 0;
    engine.for_each_group([&](const auto& g) {
      if (std::is_same_v<typename std::remove_cvref_t<decltype(g)>::Tag, Tag>) found = index;
      ++index;
    });
    return states[found];
  };
  engine.for_each_item([&](const auto& active) {
    using I = std::remove_cvref_t<decltype(active.item)>;
    if constexpr (is_interaction<I>) {
      sweep::StepState both = state(std::type_identity<typename I::A>{});
      const sweep::StepState other = state(std::type_identity<typename I::B>{});
      both.speed = std::max(both.speed, other.speed);
      both.acceleration = std::max(both.acceleration, other.acceleration);
      both.sound_speed = std::max(both.sound_speed, other.sound_speed);
      both.kinematic_viscosity = std::max(both.kinematic_viscosity, other.kinematic_viscosity);
      both.mass = std::min(both.mass, other.mass);
      std::apply([&](const auto&... law) { (law.step_limits(both, limit), ...); }, active.item.laws);
    }
    if constexpr (is_bonds<I>) {
      if (!(I::substepped && without_substepped)) detail::limit_bonds<Integrator>(engine, active, limit);
    }
    if constexpr (is_forced<I>)
      engine.for_each_group([&](const auto& g) {
        if constexpr (I::template concerns<typename std::remove_cvref_t<decltype(g)>::Tag>)
          std::apply(
              [&](const auto&... law) {
                const auto one = [&](const auto& l) {
                  if constexpr (requires { l.damping_rate(g.mass); })
                    if (l.damping_rate(g.mass) > 0.0) limit.require_below(Integrator::damping_limit / l.damping_rate(g.mass), "drag");
                };
                (one(law), ...);
              },
              active.item.laws);
      });
  });
  return limit;
}

/// Sub-steps of the sub-stepped bonds for a step of `dt` [s]: what the scene asks for, or as many as their own bound needs.
template <class Integrator, class Engine>
[[nodiscard]] int substeps_for(const Engine& engine, double dt) {
  sweep::StepLimit fast;
  int asked = 0;
  engine.for_each_item([&](const auto& active) {
    using I = std::remove_cvref_t<decltype(active.item)>;
    if constexpr (is_bonds<I>)
      if constexpr (I::substepped) {
        detail::limit_bonds<Integrator>(engine, active, fast);
        asked = std::max(asked, active.item.substeps);
      }
  });
  const double needed = std::ceil(dt / (0.9 * fast.time_step));
  if (asked > 0 && dt / asked > fast.time_step)
    throw ParameterError("substepped_bonds: substeps must be >= " + to_text(std::ceil(dt / fast.time_step)) + " for a step of " +
                         to_text(dt) + " s, got " + std::to_string(asked));
  return asked > 0 ? asked : std::max(1, static_cast<int>(needed));
}

}  // namespace dmp::simulation
