#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>
#include <dmp/bond/concept.hpp>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/forcing/concept.hpp>
#include <dmp/integrator/leapfrog.hpp>
#include <dmp/particles/mobility.hpp>
#include <dmp/simulation/composition.hpp>
#include <dmp/simulation/holds.hpp>
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

/// Calls function(item, per_mass, list, partners) for every item whose bonds end in group g. Along each of its bonds in `list`, for each
/// unit of weight, a particle has omega^2 <= per_mass k and lambda <= per_mass c, with per_mass = f/m.
template <class Engine, class G, class Function>
void for_each_bonds_of(const Engine& engine, const G& g, BondKind kind, Function&& function) {
  engine.for_each_item([&](const auto& active) {
    using I = std::remove_cvref_t<decltype(active.item)>;
    if constexpr (is_bonds<I>) {
      if (kind == (I::substepped ? BondKind::slow : BondKind::fast)) return;
      const auto call = [&]<class Partner>(const Partner& partners, const neighbours::BondList& list) {
        const double per_mass = (particles::is_mobile<typename Partner::Mobility> ? 2.0 : 1.0) / g.mass;
        function(active.item, per_mass, list, partners);
      };
      if constexpr (std::is_same_v<typename G::Tag, typename I::A>) call(engine.template group<typename I::B>(), active.of_a);
      else if constexpr (std::is_same_v<typename G::Tag, typename I::B>) call(engine.template group<typename I::A>(), active.of_b);
    }
  });
}

/// The two groups that bonds join; and which item it is, in the order of declaration, where several join the same two.
template <class Engine, class I>
[[nodiscard]] std::string name_of_bonds(const Engine& engine, const I& item) {
  int number = 0, count = 0;
  engine.for_each_item([&](const auto& active) {
    using Other = std::remove_cvref_t<decltype(active.item)>;
    if constexpr (is_bonds<Other>)
      if constexpr (std::is_same_v<typename Other::A, typename I::A> && std::is_same_v<typename Other::B, typename I::B>) {
        ++count;
        if (static_cast<const void*>(&active.item) == &item) number = count;
      }
  });
  const std::string name = engine.template group<typename I::A>().name + " - " + engine.template group<typename I::B>().name;
  return count == 1 ? name : name + " (number " + std::to_string(number) + " of " + std::to_string(count) + ")";
}

/// The bonds that by themselves give particle i the largest lambda or omega^2.
template <class Engine, class G>
[[nodiscard]] std::string binding_bonds(const Engine& engine, const G& g, BondKind kind, std::size_t i, bool by_dashpot) {
  std::string name;
  double most = -1.0;
  int items = 0;
  for_each_bonds_of(engine, g, kind, [&items](const auto&...) { ++items; });
  for_each_bonds_of(engine, g, kind, [&](const auto& item, double per_mass, const neighbours::BondList& list, const auto& partners) {
    double share = 0.0;
    if (items > 1) {
      Holds<G::Dim> springs, dashpots;
      add_holds(item.law, per_mass, list, g, partners, engine.periods(), springs, dashpots);
      share = by_dashpot ? dashpots.largest(i) : springs.largest(i);
    }
    if (share <= most) return;
    most = share;
    name = name_of_bonds(engine, item);
  });
  return name;
}

/// What the pair laws of one interaction do to the particles of a group, the largest of all interactions.
struct PairRates {
  double damping = 0.0;      ///< lambda [1/s]
  double oscillation = 0.0;  ///< omega^2 [1/s^2]
  double sound = 0.0;        ///< 1/the bound of sound [1/s]
};

/// What bonds and forcings do to the particles of a group: omega^2 <= lambda_max(sum of f k/m n n^T, and of f T/(m r) (1 - n n^T) where T >
/// 0) and lambda <= lambda_max(sum of f c/m n n^T) over the bonds of one particle, n their directions, plus stiffness/m and damping rates
/// of forcings; f = 2, or 1 where the partner cannot move. From (u_i - u_j)^2 <= 2 (u_i^2 + u_j^2) along each bond; the cubic lattice
/// reaches it. What pair laws do adds to both: `pairs`. All together are stable for (omega dt/oscillation limit)^2 + lambda dt/damping
/// limit < 1; and where there is sound too, see integrator/concept.hpp.
template <class Integrator, class Engine, class G>
void limit_group(const Engine& engine, const G& g, double time, BondKind kind, const PairRates& pairs, sweep::StepLimit& limit) {
  if constexpr (particles::is_mobile<typename G::Mobility>) {
    Holds<G::Dim> springs, dashpots;  // of bonds; empty without any
    std::vector<double> forced;       // omega^2 of forcings; empty without any that have a stiffness
    double drag = 0.0;
    if constexpr (G::Layout::has_bonds)
      for_each_bonds_of(engine, g, kind, [&](const auto& item, double per_mass, const neighbours::BondList& list, const auto& partners) {
        add_holds(item.law, per_mass, list, g, partners, engine.periods(), springs, dashpots);
      });
    engine.for_each_item([&](const auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_forced<I>)
        if constexpr (I::template concerns<typename G::Tag>)
          active.item.laws.for_each([&](const auto& law) {
            if constexpr (requires { law.damping_rate(g.mass); })
              if (kind != BondKind::fast) drag += law.damping_rate(g.mass);
            if constexpr (requires(const forcing::Subject<G::Dim> subject) { law.stiffness(subject); }) {
              if (kind == BondKind::fast) return;
              forced.resize(g.size(), 0.0);
              for_each_range(g.blocks.ranges(), [&](std::size_t, std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i) {
                  const double stiffness = law.stiffness(engine.subject(g, i, time, 0.0));
                  if (!(stiffness >= 0.0))
                    throw ParameterError("stiffness of a forcing on " + g.name + " must be >= 0 N/m, got " + to_text(stiffness));
                  forced[i] += stiffness / g.mass;
                }
              });
            }
          });
    });
    if (drag > 0.0) limit.require_below(Integrator::damping_limit / (drag + pairs.damping), "drag on " + g.name);
    enum class By { bond_dashpots, drags, viscosities, bond_springs, forcing_springs, potentials };
    struct Shortest {
      double bound = std::numeric_limits<double>::infinity();
      std::size_t where = 0;
      By by = By::bond_dashpots;
    };
    const auto bound_of = [&](std::size_t i, double bonds, double damping) {
      const double forcings = forced.empty() ? 0.0 : forced[i], squared = bonds + forcings + pairs.oscillation;
      const double per_damping = (damping + drag + pairs.damping) / Integrator::damping_limit;
      const double oscillation = Integrator::oscillation_limit / std::sqrt(squared), half = 0.5 * oscillation * per_damping;
      const bool has_springs = squared > 0.0;
      Shortest result{.where = i};
      if (!(squared >= 0.0 && damping >= 0.0)) {  // refused below
        result.bound = -1.0;
        result.by = !(bonds >= 0.0) ? By::bond_springs : !(damping >= 0.0) ? By::bond_dashpots : By::forcing_springs;
        return result;
      }
      if (!has_springs && damping == 0.0) return result;
      result.bound = has_springs ? oscillation * (std::sqrt(half * half + 1.0) - half) : 1.0 / per_damping;
      if constexpr (requires { Integrator::coupled_limit; })
        if (has_springs && pairs.sound > 0.0) {
          const double sound = square(pairs.sound), undamped = 1.0 / std::sqrt(sound + squared / square(Integrator::coupled_limit));
          result.bound =
              std::min(result.bound, std::max(undamped, (damping + drag + pairs.damping) / (Integrator::coupled_damping * sound)));
        }
      if (!has_springs || half >= 0.5)
        result.by = damping >= drag && damping >= pairs.damping ? By::bond_dashpots
                    : drag >= pairs.damping                     ? By::drags
                                                                : By::viscosities;
      else
        result.by = bonds >= forcings && bonds >= pairs.oscillation ? By::bond_springs
                    : forcings >= pairs.oscillation                 ? By::forcing_springs
                                                                    : By::potentials;
      return result;
    };
    if (springs.empty() && dashpots.empty() && forced.empty() && !(pairs.oscillation > 0.0)) return;
    // Eigenvalues only where they may matter. The margin, wider than the solver's error (1e-8), keeps that from depending on how rows are
    // divided among threads.
    const auto largest = [](const Holds<G::Dim>& holds, std::size_t i) {
      if constexpr (G::Layout::has_bonds) return holds.largest(i);
      else return 0.0;
    };
    const auto at_most = [](const Holds<G::Dim>& holds, std::size_t i) {
      if constexpr (G::Layout::has_bonds) return holds.at_most(i);
      else return 0.0;
    };
    const auto shortest = merge_ranges(
        g.blocks.ranges(), Shortest{},
        [&](std::size_t first, std::size_t last) {
          Shortest part;
          for (std::size_t i = first; i < last; ++i) {
            const bool no_sound = !(pairs.sound > 0.0);  // beside sound, dashpots may allow a longer step
            if (no_sound && bound_of(i, at_most(springs, i), at_most(dashpots, i)).bound > (1.0 + 1e-6) * part.bound) continue;
            const auto one = bound_of(i, largest(springs, i), largest(dashpots, i));
            if (one.bound < part.bound) part = one;
          }
          return part;
        },
        [](const Shortest& a, const Shortest& b) { return a.bound < b.bound || (a.bound == b.bound && a.where < b.where) ? a : b; });
    if (shortest.bound == std::numeric_limits<double>::infinity()) return;
    std::string law;
    switch (shortest.by) {
      case By::bond_dashpots:
      case By::bond_springs:
        if constexpr (G::Layout::has_bonds) {
          const bool by_dashpot = shortest.by == By::bond_dashpots;
          law = (by_dashpot ? "bond dashpot of " : "bond stiffness of ") + binding_bonds(engine, g, kind, shortest.where, by_dashpot);
        }
        break;
      case By::drags: law = "drag on " + g.name; break;
      case By::forcing_springs: law = "stiffness of a forcing on " + g.name; break;
      case By::viscosities: law = "viscosity of " + g.name; break;
      case By::potentials: law = "pair potential of " + g.name; break;
    }
    limit.require_below(shortest.bound < 0.0 ? std::numeric_limits<double>::quiet_NaN() : shortest.bound, law);
  }
}

/// What laws of bonds and forcings say of themselves is what bounds are made of: ParameterError unless it is a number >= 0.
template <class Engine, class Item>
void check_stated_rates(const Engine& engine, const Item& item) {
  const auto stated = [](const auto& whose, const char* what, double value, const char* unit) {
    if (!(value >= 0.0)) throw ParameterError(whose() + ": " + what + " must be >= 0 " + unit + ", got " + to_text(value));
  };
  if constexpr (is_bonds<Item>) {
    const auto whose = [&] { return "bonds of " + name_of_bonds(engine, item); };
    stated(whose, "largest_stiffness", item.law.largest_stiffness(), "N/m");
    stated(whose, "largest_damping", largest_damping(item.law), "N s/m");
  }
  if constexpr (is_forced<Item>)
    engine.for_each_group([&](const auto& g) {
      if constexpr (Item::template concerns<typename std::remove_cvref_t<decltype(g)>::Tag>)
        item.laws.for_each([&](const auto& law) {
          if constexpr (requires { law.damping_rate(g.mass); })
            stated([&] { return "drag on " + g.name; }, "damping_rate", law.damping_rate(g.mass), "1/s");
        });
    });
}

}  // namespace detail

/// Every law's bound of the time step for the present state: the smallest, and whose it is. `time` [s] as forcings see it. ParameterError
/// if what a law states is no bound.
template <class Integrator, class Engine>
[[nodiscard]] sweep::StepLimit find_step_limit(const Engine& engine, double time, bool without_substepped) {
  sweep::StepLimit limit;
  std::array<sweep::StepState, Engine::Groups::count> states;
  std::array<detail::PairRates, Engine::Groups::count> rates;
  std::size_t index = 0;
  engine.for_each_group([&](const auto& g) { states[index++] = detail::state_of<Integrator>(engine, g); });
  engine.for_each_item([&](const auto& active) {
    using I = std::remove_cvref_t<decltype(active.item)>;
    detail::check_stated_rates(engine, active.item);
    if constexpr (is_interaction<I>) {
      constexpr std::size_t a = Engine::template index_of<typename I::A>(), b = Engine::template index_of<typename I::B>();
      limit.damping = limit.oscillation = limit.sound = 0.0;
      active.item.laws.for_each([&](const auto& law) {
        if constexpr (requires { law.step_limits(states[a], states[b], limit); }) law.step_limits(states[a], states[b], limit);
        else law.step_limits(detail::widest(states[a], states[b]), limit);
      });
      for (const std::size_t group : {a, b}) {
        rates[group].damping = std::max(rates[group].damping, limit.damping);
        rates[group].oscillation = std::max(rates[group].oscillation, limit.oscillation);
        rates[group].sound = std::max(rates[group].sound, limit.sound);
      }
    }
  });
  index = 0;
  engine.for_each_group([&](const auto& g) {
    detail::limit_group<Integrator>(engine, g, time, without_substepped ? detail::BondKind::slow : detail::BondKind::all, rates[index++],
                                    limit);
  });
  return limit;
}

/// Sub-steps of the sub-stepped bonds for a step of `dt` [s]: what the scene asks for, or as many as their own bound needs. That is the
/// leapfrog's whatever the integrator, for that is how the engine sub-steps.
template <class Engine>
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
  engine.for_each_group(
      [&](const auto& g) { detail::limit_group<integrator::Leapfrog>(engine, g, 0.0, detail::BondKind::fast, {}, fast); });
  const double needed = std::ceil(dt / (0.9 * fast.time_step));
  constexpr double most = 1e6;
  if (asked == 0 && !(needed <= most))
    throw ParameterError("substepped_bonds: a step of " + to_text(dt) + " s must need <= " + to_text(most) + " sub-steps, got " +
                         to_text(needed) + " for the " + fast.bound_by);
  if (asked > 0 && dt / asked > fast.time_step)
    throw ParameterError("substepped_bonds: substeps must be >= " + to_text(std::ceil(dt / fast.time_step)) + " for a step of " +
                         to_text(dt) + " s, got " + std::to_string(asked));
  return asked > 0 ? asked : std::max(1, static_cast<int>(needed));
}

}  // namespace dmp::simulation
