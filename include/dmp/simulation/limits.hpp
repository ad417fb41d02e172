#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>
#include <Eigen/Eigenvalues>
#include <dmp/bond/concept.hpp>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/forcing/concept.hpp>
#include <dmp/integrator/leapfrog.hpp>
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

template <class Law>
[[nodiscard]] double largest_damping(const Law& law) {
  if constexpr (bond::UsesVelocity<Law>) return law.largest_damping();
  else return 0.0;
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

/// The bonds that contribute most to lambda or omega^2 of particle i.
template <class Engine, class G>
[[nodiscard]] std::string binding_bonds(const Engine& engine, const G& g, BondKind kind, std::size_t i, bool by_dashpot) {
  std::string name;
  double most = -1.0;  // bonds without stiffness hold a particle too, if they are under tension
  for_each_bonds_of(engine, g, kind, [&](const auto& item, double per_mass, const neighbours::BondList& list, const auto&) {
    const double share = per_mass * (by_dashpot ? largest_damping(item.law) : item.law.largest_stiffness()) * list.sum_of_weights(i);
    if (share <= most) return;
    most = share;
    name = name_of_bonds(engine, item);
  });
  return name;
}

/// How bonds hold a particle, per mass: springs [1/s^2] and dashpots [1/s].
template <int Dim>
struct Hold {
  Eigen::Matrix<double, Dim, Dim> springs = Eigen::Matrix<double, Dim, Dim>::Zero(), dashpots = springs;
};
template <int Dim>
[[nodiscard]] double largest_eigenvalue(const Eigen::Matrix<double, Dim, Dim>& symmetric) {
  if constexpr (Dim == 1) return symmetric(0, 0);
  else
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Dim, Dim>>()
        .computeDirect(symmetric, Eigen::EigenvaluesOnly)
        .eigenvalues()[Dim - 1];
}

/// Adds what the bonds of one item do to the particles of a group as they stand now: f k/m n n^T, f c/m n n^T, and across a bond under
/// tension f T/(m r) (1 - n n^T). A bond of length zero may act in any direction.
template <class Engine, class Item, class G, class Partners>
void add_hold(const Engine& engine, const Item& item, double per_mass, const neighbours::BondList& list, const G& g,
              const Partners& partners, std::vector<Hold<G::Dim>>& hold) {
  constexpr int Dim = G::Dim;
  const double stiffness = per_mass * item.law.largest_stiffness(), damping = per_mass * largest_damping(item.law);
  constexpr bool same = std::is_same_v<G, Partners>;
  for_each_block(g.blocks, [&](std::size_t, std::size_t block) {
    for (std::size_t i = g.blocks.begin(block); i < g.blocks.end(block); ++i) {
      const auto bonds = list.of(i);
      for (std::size_t k = 0; k < bonds.size; ++k) {
        if (bonds.rest_length[k] < 0.0) continue;
        const std::size_t j = list.partner_of(i, k);
        const Vector<Dim> apart = neighbours::minimum_image<Dim>(g.positions()[i] - partners.positions()[j], engine.box());
        const double squared = apart.squaredNorm(), weight = bonds.weight[k * bonds.weight_step];
        using Matrix = Eigen::Matrix<double, Dim, Dim>;
        const Matrix all_ways = weight * Matrix::Identity(),
                     along = squared > 0.0 ? Matrix(weight / squared * apart * apart.transpose()) : all_ways;
        double across = 0.0;
        if (squared > 0.0) {
          bond::Remembering<bond::MovingStretch<double>, double> seen{};
          seen.length = std::sqrt(squared);
          seen.rest_length = bonds.rest_length[k];
          if constexpr (bond::HasMemory<decltype(Item::law)>) seen.memory = list.memory_at(i, k);
          across = per_mass * std::max(0.0, item.law.tension(seen) / seen.length);
        }
        const Hold<Dim> one{stiffness * along + across * (all_ways - along), damping * along};
        const auto add = [&one](Hold<Dim>& to) {
          to.springs += one.springs;
          to.dashpots += one.dashpots;
        };
        add(hold[i]);
        if (same && list.is_listed_once(i, k)) add(hold[j]);  // in the same block
      }
    }
  });
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
    std::vector<Hold<G::Dim>> hold;  // empty without bonds
    std::vector<double> forced;      // omega^2 of forcings; empty without any that have a stiffness
    double drag = 0.0;
    for_each_bonds_of(engine, g, kind,
                      [&](const auto& item, double per_mass, const neighbours::BondList& list, const auto& partners) {
                        hold.resize(g.size());
                        add_hold(engine, item, per_mass, list, g, partners, hold);
                      });
    std::vector<double> stiffness(hold.size()), dashpot(hold.size());  // omega^2 and lambda of bonds
    if (!hold.empty())
      for_each_range(g.blocks.ranges(), [&](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          stiffness[i] = largest_eigenvalue<G::Dim>(hold[i].springs);
          dashpot[i] = hold[i].dashpots.isZero(0.0) ? 0.0 : largest_eigenvalue<G::Dim>(hold[i].dashpots);
        }
      });
    engine.for_each_item([&](const auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
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
    std::size_t where = 0;
    enum { bond_dashpots, drags, viscosities, bond_springs, forcing_springs, potentials } bound_by = bond_dashpots;
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
      where = i;
      if (!springs || half >= 0.5)
        bound_by = damping >= drag && damping >= pairs.damping ? bond_dashpots : drag >= pairs.damping ? drags : viscosities;
      else
        bound_by = bonds >= forcings && bonds >= pairs.oscillation ? bond_springs
                   : forcings >= pairs.oscillation                 ? forcing_springs
                                                                   : potentials;
    }
    if (shortest == std::numeric_limits<double>::infinity()) return;
    std::string law;
    switch (bound_by) {
      case bond_dashpots: law = "bond dashpot of " + binding_bonds(engine, g, kind, where, true); break;
      case bond_springs: law = "bond stiffness of " + binding_bonds(engine, g, kind, where, false); break;
      case drags: law = "drag on " + g.name; break;
      case forcing_springs: law = "stiffness of a forcing on " + g.name; break;
      case viscosities: law = "viscosity of " + g.name; break;
      case potentials: law = "pair potential of " + g.name; break;
    }
    limit.require_below(shortest, law);
  }
}

}  // namespace detail

namespace detail {

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
        std::apply(
            [&](const auto&... law) {
              const auto one = [&](const auto& l) {
                if constexpr (requires { l.damping_rate(g.mass); })
                  stated([&] { return "drag on " + g.name; }, "damping_rate", l.damping_rate(g.mass), "1/s");
              };
              (one(law), ...);
            },
            item.laws);
    });
}

}  // namespace detail

/// Every law's bound of the time step for the present state: the smallest, and whose it is. `time` [s] as forcings see it. ParameterError
/// if what a law states is no bound.
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
    detail::check_stated_rates(engine, active.item);
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
