#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>
#include <dmp/bond/concept.hpp>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/forcing/concept.hpp>
#include <dmp/particles/mobility.hpp>
#include <dmp/simulation/composition.hpp>
#include <dmp/sweep/step_limit.hpp>

namespace dmp::simulation {

namespace detail {

/// The extremes of two sets of particles together.
[[nodiscard]] inline sweep::StepState widest(sweep::StepState a, const sweep::StepState& b) {
  a.speed = std::max(a.speed, b.speed);
  a.acceleration = std::max(a.acceleration, b.acceleration);
  a.sound_speed = std::max(a.sound_speed, b.sound_speed);
  a.kinematic_viscosity = std::max(a.kinematic_viscosity, b.kinematic_viscosity);
  a.thermal_conductivity = std::max(a.thermal_conductivity, b.thermal_conductivity);
  a.heat_capacity = std::min(a.heat_capacity, b.heat_capacity);
  a.mass = std::min(a.mass, b.mass);
  return a;
}

/// Extremes over the particles of a group.
template <class Integrator, class Engine, class G>
[[nodiscard]] sweep::StepState state_of(const Engine& engine, const G& g) {
  sweep::StepState state{.oscillation_limit = Integrator::oscillation_limit,
                         .damping_limit = Integrator::damping_limit,
                         .state_damping_limit = Integrator::state_damping_limit};
  if constexpr (particles::is_mobile<typename G::Mobility>) state.mass = g.mass;
  engine.with_materials(g, [&](const auto&... law) {
    state = merge_ranges(
        g.blocks.ranges(), state,
        [&](std::size_t first, std::size_t last) {
          sweep::StepState part;
          for (std::size_t i = first; i < last; ++i) {
            const auto particle = engine.prepared_by(g, i, 0.0, law...);
            part.speed = std::max(part.speed, dot(particle.velocity, particle.velocity));
            if constexpr (particles::is_mobile<typename G::Mobility>)
              part.acceleration = std::max(part.acceleration, g.template get<field::Acceleration>()[i].squaredNorm());
            if constexpr (requires {
                            particle.dynamic_viscosity;
                            particle.density;
                          })
              part.kinematic_viscosity = std::max(part.kinematic_viscosity, particle.dynamic_viscosity / particle.density);
            if constexpr (requires { particle.thermal_conductivity; })
              part.thermal_conductivity = std::max(part.thermal_conductivity, particle.thermal_conductivity);
            [[maybe_unused]] const auto one = [&part](const auto& l, const auto& p) {
              if constexpr (requires { l.sound_speed(p); }) part.sound_speed = std::max(part.sound_speed, l.sound_speed(p));
              if constexpr (G::Mobility::evolves && requires { l.specific_heat() * p.density; })
                part.heat_capacity = std::min(part.heat_capacity, p.density * l.specific_heat());
            };
            (one(law, particle), ...);
          }
          return part;
        },
        widest);
  });
  state.speed = std::sqrt(state.speed);
  state.acceleration = std::sqrt(state.acceleration);
  return state;
}

enum class BondKind { all, slow, fast };  ///< fast: the sub-stepped ones

/// What the pair laws of one interaction do to the particles of a group, the largest of all interactions.
struct PairRates {
  double damping = 0.0;      ///< lambda [1/s]
  double oscillation = 0.0;  ///< omega^2 [1/s^2]
  double sound = 0.0;        ///< 1/the bound of sound [1/s]
};

/// What bonds and forcings do to the particles of a group: omega^2 <= sum of f k/m and lambda <= sum of f c/m over the bonds of one
/// particle, plus stiffness/m and damping rates of forcings (Gershgorin's circles of the stiffness matrix); f = 2, or 1 where the partner
/// cannot move. What pair laws do adds to both: `pairs`. All together are stable for (omega dt/oscillation limit)^2 + lambda dt/damping
/// limit < 1; and where there is sound too, see integrator/concept.hpp.
template <class Integrator, class Engine, class G>
void limit_group(const Engine& engine, const G& g, double time, BondKind kind, const PairRates& pairs, sweep::StepLimit& limit) {
  if constexpr (particles::is_mobile<typename G::Mobility>) {
    std::vector<double> stiffness, dashpot;  // omega^2 and lambda of each particle; empty without bonds
    std::vector<double> forced;              // omega^2 of forcings; empty without any that have a stiffness
    double drag = 0.0;
    engine.for_each_item([&](const auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_bonds<I>) {
        if (kind == (I::substepped ? BondKind::slow : BondKind::fast)) return;
        const auto add = [&]<class Partner>(const Partner&, const neighbours::BondList& list) {
          const double per_mass = (particles::is_mobile<typename Partner::Mobility> ? 2.0 : 1.0) / g.mass;
          double damping = 0.0;
          if constexpr (bond::UsesVelocity<decltype(active.item.law)>) damping = active.item.law.largest_damping();
          stiffness.resize(g.size(), 0.0);
          dashpot.resize(g.size(), 0.0);
          for (std::size_t i = 0; i < g.size(); ++i) {
            const double bonds = list.sum_of_weights(i) * per_mass;
            stiffness[i] += active.item.law.largest_stiffness() * bonds;
            dashpot[i] += damping * bonds;
          }
        };
        if constexpr (std::is_same_v<typename G::Tag, typename I::A>) add(engine.template group<typename I::B>(), active.of_a);
        else if constexpr (std::is_same_v<typename G::Tag, typename I::B>) add(engine.template group<typename I::A>(), active.of_b);
      }
      if constexpr (is_forced<I>)
        if constexpr (I::template concerns<typename G::Tag>)
          std::apply(
              [&](const auto&... law) {
                const auto one = [&](const auto& l) {
                  if constexpr (requires { l.damping_rate(g.mass); })
                    if (kind != BondKind::fast) drag += l.damping_rate(g.mass);
                  if constexpr (requires(const forcing::Subject<G::Dim> subject) { l.stiffness(subject); }) {
                    if (kind == BondKind::fast) return;
                    forced.resize(g.size(), 0.0);
                    for_each_range(g.blocks.ranges(), [&](std::size_t, std::size_t first, std::size_t last) {
                      for (std::size_t i = first; i < last; ++i) forced[i] += l.stiffness(engine.subject(g, i, time, 0.0)) / g.mass;
                    });
                  }
                };
                (one(law), ...);
              },
              active.item.laws);
    });
    if (drag > 0.0) limit.require_below(Integrator::damping_limit / (drag + pairs.damping), "drag on " + g.name);
    double shortest = std::numeric_limits<double>::infinity();
    const char* bound_by = "";
    const std::size_t rows = std::max({stiffness.size(), forced.size(), std::size_t{pairs.oscillation > 0.0 ? 1u : 0u}});
    for (std::size_t i = 0; i < rows; ++i) {
      const double bonds = stiffness.empty() ? 0.0 : stiffness[i], forcings = forced.empty() ? 0.0 : forced[i];
      const double damping = dashpot.empty() ? 0.0 : dashpot[i], squared = bonds + forcings + pairs.oscillation;
      const double per_damping = (damping + drag + pairs.damping) / Integrator::damping_limit;
      const double oscillation = Integrator::oscillation_limit / std::sqrt(squared), half = 0.5 * oscillation * per_damping;
      const bool springs = squared > 0.0;
      if (!springs && damping == 0.0) continue;
      double bound = springs ? oscillation * (std::sqrt(half * half + 1.0) - half) : 1.0 / per_damping;
      if constexpr (requires { Integrator::coupled_limit; })
        if (springs && pairs.sound > 0.0) {
          const double sound = square(pairs.sound), undamped = 1.0 / std::sqrt(sound + squared / square(Integrator::coupled_limit));
          bound = std::min(bound, std::max(undamped, (damping + drag + pairs.damping) / (Integrator::coupled_damping * sound)));
        }
      if (bound >= shortest) continue;
      shortest = bound;
      if (!springs || half >= 0.5)
        bound_by = damping >= drag && damping >= pairs.damping ? "bond dashpot of " : drag >= pairs.damping ? "drag on " : "viscosity of ";
      else
        bound_by = bonds >= forcings && bonds >= pairs.oscillation ? "bond stiffness of "
                   : forcings >= pairs.oscillation                 ? "stiffness of a forcing on "
                                                                   : "pair potential of ";
    }
    if (shortest < std::numeric_limits<double>::infinity()) limit.require_below(shortest, bound_by + g.name);
  }
}

}  // namespace detail

/// Every law's bound of the time step for the present state: the smallest, and whose it is. `time` [s] as forcings see it.
template <class Integrator, class Engine>
[[nodiscard]] sweep::StepLimit find_step_limit(const Engine& engine, double time, bool without_substepped) {
  sweep::StepLimit limit;
  std::vector<sweep::StepState> states;
  engine.for_each_group([&](const auto& g) { states.push_back(detail::state_of<Integrator>(engine, g)); });
  std::vector<detail::PairRates> rates(states.size());
  const auto index_of = [&]<class Tag>(std::type_identity<Tag>) {
    std::size_t index = 0, found = 0;
    engine.for_each_group([&](const auto& g) {
      if (std::is_same_v<typename std::remove_cvref_t<decltype(g)>::Tag, Tag>) found = index;
      ++index;
    });
    return found;
  };
  engine.for_each_item([&](const auto& active) {
    using I = std::remove_cvref_t<decltype(active.item)>;
    if constexpr (is_interaction<I>) {
      const std::size_t a = index_of(std::type_identity<typename I::A>{}), b = index_of(std::type_identity<typename I::B>{});
      limit.damping = limit.oscillation = limit.sound = 0.0;
      const auto one = [&](const auto& law) {
        if constexpr (requires { law.step_limits(states[a], states[b], limit); }) law.step_limits(states[a], states[b], limit);
        else law.step_limits(detail::widest(states[a], states[b]), limit);
      };
      std::apply([&](const auto&... law) { (one(law), ...); }, active.item.laws);
      for (const std::size_t group : {a, b}) {
        rates[group].damping = std::max(rates[group].damping, limit.damping);
        rates[group].oscillation = std::max(rates[group].oscillation, limit.oscillation);
        rates[group].sound = std::max(rates[group].sound, limit.sound);
      }
    }
  });
  std::size_t index = 0;
  engine.for_each_group([&](const auto& g) {
    detail::limit_group<Integrator>(engine, g, time, without_substepped ? detail::BondKind::slow : detail::BondKind::all, rates[index++],
                                    limit);
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
        asked = std::max(asked, active.item.substeps);
      }
  });
  engine.for_each_group([&](const auto& g) { detail::limit_group<Integrator>(engine, g, 0.0, detail::BondKind::fast, {}, fast); });
  const double needed = std::ceil(dt / (0.9 * fast.time_step));
  if (asked > 0 && dt / asked > fast.time_step)
    throw ParameterError("substepped_bonds: substeps must be >= " + to_text(std::ceil(dt / fast.time_step)) + " for a step of " +
                         to_text(dt) + " s, got " + std::to_string(asked));
  return asked > 0 ? asked : std::max(1, static_cast<int>(needed));
}

}  // namespace dmp::simulation
