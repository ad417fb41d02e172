#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>
#include <dmp/dmp.hpp>

#include "support/random.hpp"

/// How far the bounds of the time step are from where a run in fact blows up: for tests/simulation/stability_limits_test.cpp, and for the
/// tables of docs/stability.md (bench/stability.cpp). Each case is a small scene in which one law's bound is the one that binds, at rest
/// but for a disturbance in all of its motions. Scenes refuse steps beyond a bound; these are told of bounds `widening` times as large.
namespace test::stability {

using namespace dmp;
using namespace dmp::simulation;

inline constexpr double widening = 1024.0;  ///< a power of two: bounds keep every bit

/// The integrator I, as somebody would write it who claims far too much.
template <class I>
struct Careless : I {
  static constexpr double oscillation_limit = widening * I::oscillation_limit, damping_limit = widening * I::damping_limit,
                          state_damping_limit = widening * I::state_damping_limit, coupled_limit = widening * I::coupled_limit,
                          coupled_damping = widening * I::coupled_damping;
};
/// The same for the flow equations, whose bound of sound does not depend on the integrator.
template <class Law>
struct CarelessLaw : Law {
  void step_limits(sweep::StepState state, sweep::StepLimit& limit) const {
    state.damping_limit /= widening;
    state.state_damping_limit /= widening;
    sweep::StepLimit own;
    Law::step_limits(state, own);
    limit.require_below(widening * own.stable_time_step, own.stability_bound_by);
    limit.damping += own.damping;
    limit.sound = own.sound / widening;
  }
};

/// And for sub-stepped springs, whose bound is that of leapfrog whatever the integrator.
struct Understated : bond::Harmonic {
  [[nodiscard]] double largest_stiffness() const noexcept { return stiffness / (widening * widening); }
};

/// How a run ended.
struct Outcome {
  double growth = 0.0;  ///< of the disturbance; infinite if the run was stopped
  std::string error{};
  SimulationError::Where where{};
};

struct Case {
  std::string law, scene;
  double stated;          ///< bound of the time step [s]
  std::string bound_by;   ///< whose it is
  double stopped = 1.2;   ///< a run at this many times the bound is stopped by an error
  std::string why = "";   ///< what keeps the bound from being sharp, where it is not
  std::function<Outcome(double time_step, std::uint64_t steps)> run{};
};

/// Every bound of a scene, that of sub-stepped bonds too.
template <int Dim, class Integrator, class Precision, class... Item>
[[nodiscard]] sweep::StepLimit all_bounds(Scene<Dim, Integrator, Precision, Item...>& scene) {
  (void)scene.step_limit();  // computes what bounds are made of
  return find_step_limit<Integrator>(scene.engine(), 0.0, false);
}

/// `disturbance(scene)` is of order 1 at the start.
template <class Scene, class Disturbance>
[[nodiscard]] Case make_case(std::string law, std::string text, Scene scene, Disturbance disturbance) {
  const auto limit = all_bounds(scene);
  const auto run = [scene = std::move(scene), disturbance](double time_step, std::uint64_t steps) {
    Scene copy = scene;
    try {
      copy.run({.until = (static_cast<double>(steps) - 0.25) * time_step, .time_step = time_step});
    } catch (const SimulationError& error) {
      return Outcome{std::numeric_limits<double>::infinity(), error.what(), error.where};
    }
    return Outcome{disturbance(copy)};
  };
  return {.law = std::move(law),
          .scene = std::move(text),
          .stated = limit.stable_time_step / widening,
          .bound_by = limit.stability_bound_by,
          .run = run};
}

/// The largest step, as a multiple of the stated bound, up to which the disturbance does not grow a thousandfold in `steps` steps: looked
/// for upwards from half the bound, to half a percent. Infinite: none such below 100 times the bound.
[[nodiscard]] inline double largest_stable(const Case& c, std::uint64_t steps) {
  const auto stable = [&](double multiple) { return c.run(multiple * c.stated, steps).growth < 1e3; };
  double below = 0.5, above = 0.5;
  while (stable(above)) {
    below = above;
    above *= 1.1;
    if (above > 100.0) return std::numeric_limits<double>::infinity();
  }
  while (above > 1.005 * below) (stable(std::sqrt(below * above)) ? below : above) = std::sqrt(below * above);
  return below;
}

// ---- Fluids: a periodic lattice of spacing 1 and density 1 ---------------------------------------------------------------------------

struct Fluid {};

/// What a lattice of fluid is made of, and how much it is disturbed.
struct Patch {
  double sound_speed = 1.0, viscosity = 0.0;
  double disturbance = 1e-6;  ///< random velocities [m/s] and densities [-]
  double drag = 0.0;          ///< [N s/m]
  int side = 8;
};

template <int Dim>
[[nodiscard]] geometry::Box<Dim> periodic_cube(double side) {
  geometry::Box<Dim> box{.lower = Vector<Dim>::Zero(), .upper = Vector<Dim>::Constant(side)};
  box.periodic.fill(true);
  return box;
}
template <int Dim>
[[nodiscard]] geometry::Points<Dim> square_lattice(int side) {
  return geometry::fill(geometry::Cubic<Dim>{.spacing = 1.0}, {.lower = Vector<Dim>::Zero(), .upper = Vector<Dim>::Constant(side)});
}
template <class G>
void disturb_velocities(G& group, double size) {
  RandomVectors random;
  group.template set<field::Velocity>([&](const auto&) { return Vector<G::Dim>(random.vector(size).template head<G::Dim>()); });
}
/// Largest speed in a group.
[[nodiscard]] double largest_speed(const auto& group) {
  double largest = 0.0;
  for (const auto& v : group.template get<field::Velocity>()) largest = std::max(largest, v.norm());
  return largest;
}

/// `extra`: further items, summed laws for instance.
template <class Integrator, class Law, class... Extra>
[[nodiscard]] Case fluid(std::string name, std::string text, const Law& law, const Patch& p, const Extra&... extra) {
  constexpr int dim = Law::dimension;
  auto patch =
      scene<Careless<Integrator>>(periodic_cube<dim>(p.side), group<Fluid>("fluid", particles::Mobile{}, square_lattice<dim>(p.side), 1.0),
                                  interaction<Fluid, Fluid>(CarelessLaw<Law>{law}),
                                  material<Fluid>(eos::Linear{.rest_density = 1.0, .sound_speed_0 = p.sound_speed},
                                                  rheology::Constant{.dynamic_viscosity = p.viscosity}),
                                  extra...);
  auto& g = patch.template group<Fluid>();
  disturb_velocities(g, p.disturbance);
  RandomVectors random;
  g.template set<field::Density>([&](const auto&) { return 1.0 + random.vector(p.disturbance)[0]; });
  return make_case(std::move(name), std::move(text), std::move(patch), [p](const auto& s) {
    double largest = 0.0;
    for (const double density : s.template group<Fluid>().template get<field::Density>())
      largest = std::max(largest, std::fabs(density - 1.0));
    return (largest + largest_speed(s.template group<Fluid>()) / std::max(1.0, p.sound_speed)) / p.disturbance;
  });
}

/// Ideal gas with its energy equation, of sound speed 1, on a line: in a plane its pressure drives
/// the lattice apart, however short the step. With some viscosity: see docs/stability.md, "Where no bound holds".
template <class Integrator>
[[nodiscard]] Case gas(std::string name, std::string text, double support) {
  constexpr double disturbance = 1e-6;
  using Law = sph::Compressible<kernel::WendlandC2<1>, viscosity::ShockCapturing>;
  const eos::IdealGas air{};
  const double energy = air.specific_energy(1.0 / air.heat_capacity_ratio, 1.0);
  auto patch = scene<Careless<Integrator>>(
      periodic_cube<1>(16.0), group<Fluid>("gas", particles::Mobile{}, square_lattice<1>(16), 1.0),
      interaction<Fluid, Fluid>(CarelessLaw<Law>{Law{.kernel = {.support_radius = support}, .viscosity = {.alpha = 0.1}}}),
      material<Fluid>(air));
  auto& g = patch.template group<Fluid>();
  disturb_velocities(g, disturbance);
  RandomVectors random;
  g.template set<field::Density>([&](const auto&) { return 1.0 + random.vector(disturbance)[0]; });
  g.template set<field::SpecificEnergy>([&](const auto&) { return energy; });
  return make_case(std::move(name), std::move(text), std::move(patch), [](const auto& s) {
    double largest = 0.0;
    for (const double density : s.template group<Fluid>().template get<field::Density>())
      largest = std::max(largest, std::fabs(density - 1.0));
    return (largest + largest_speed(s.template group<Fluid>())) / disturbance;
  });
}

// ---- Beads: masses of 1 kg ------------------------------------------------------------------------------------------------------------

struct Beads {};

/// A ring of 16 beads through the faces of a periodic box, every second one displaced or thrown by 1e-3: of all motions the fastest one,
/// omega^2 = 4 k/m and lambda = 4 c/m. `Bonds`: what makes an item of a list.
template <class Integrator, class Moved = Careless<Integrator>, class Bonds>
[[nodiscard]] Case ring(std::string name, std::string text, const Bonds& bonds, double displacement = 1e-3, double speed = 0.0) {
  geometry::Points<1> points;
  std::vector<neighbours::Bond> list;
  for (std::uint32_t k = 0; k < 16; ++k) {
    points.positions.push_back(Vector<1>(k + 0.5 + (k % 2 == 0 ? displacement : -displacement)));
    list.push_back({k, (k + 1) % 16, 1.0});
  }
  auto result = scene<Moved>(periodic_cube<1>(16.0), group<Beads>("beads", particles::Mobile{}, points, 1.0), bonds(list));
  auto& v = result.template group<Beads>().template get<field::Velocity>();
  for (std::size_t k = 0; k < v.size(); ++k) v[k] = Vector<1>(k % 2 == 0 ? speed : -speed);
  return make_case(std::move(name), std::move(text), std::move(result), [=](const auto& s) {
    const auto& g = s.template group<Beads>();
    double largest = 0.0;
    for (std::size_t k = 0; k < g.size(); ++k) largest = std::max(largest, std::fabs(g.positions()[k][0] - static_cast<double>(k) - 0.5));
    return displacement > 0.0 ? largest / displacement : largest_speed(g) / speed;
  });
}
[[nodiscard]] inline auto bonds_of(const auto& law) {
  return [law](const auto& list) { return simulation::bonds<Beads, Beads>(law, list); };
}

/// A force that does not depend on the length.
struct Cable {
  double force;
  [[nodiscard]] auto tension(const auto& bond) const noexcept { return force + 0.0 * bond.length; }
  [[nodiscard]] double largest_stiffness() const noexcept { return 0.0; }
};
/// That ring in a plane, of cables under tension, every second bead displaced across: omega^2 = 4 T/(m r). It must not swing to 0.3 m.
template <class Integrator>
[[nodiscard]] Case taut(std::string name, std::string text) {
  constexpr double displacement = 1e-6;
  geometry::Points<2> points;
  std::vector<neighbours::Bond> list;
  for (std::uint32_t k = 0; k < 16; ++k) {
    points.positions.push_back({k + 0.5, k % 2 == 0 ? displacement : -displacement});
    list.push_back({k, (k + 1) % 16, 1.0});
  }
  auto result = scene<Careless<Integrator>>(geometry::Box<2>{.lower = {0.0, -0.3}, .upper = {16.0, 0.3}, .periodic = {true, false}},
                                            group<Beads>("beads", particles::Mobile{}, points, 1.0), bonds<Beads, Beads>(Cable{1.0}, list));
  return make_case(std::move(name), std::move(text), std::move(result), [](const auto& s) {
    double largest = 0.0;
    for (const auto& x : s.template group<Beads>().positions()) largest = std::max(largest, std::fabs(x[1]));
    return largest / displacement;
  });
}

/// A block of the cubic lattice of springs, 18 to a bead inside, free on all sides.
template <class Integrator, class Law>
[[nodiscard]] Case block(std::string name, std::string text, const Law& law) {
  const auto body = lattice_spring::lattice_block(lattice_spring::CubicLattice{.spacing = 1.0}, {6, 6, 6});
  auto result = scene<Careless<Integrator>>(geometry::Box<3>::unbounded(), group<Beads>("beads", particles::Mobile{}, body.points, 1.0),
                                            bonds<Beads, Beads>(law, body.bonds));
  disturb_velocities(result.template group<Beads>(), 1e-6);
  return make_case(std::move(name), std::move(text), std::move(result),
                   [](const auto& s) { return largest_speed(s.template group<Beads>()) / 1e-6; });
}

/// Close-packed beads that touch their twelve neighbours at r = sigma, and see no others.
template <class Integrator>
[[nodiscard]] Case close_packed(std::string name, std::string text) {
  const double side = 3.0 * std::numbers::sqrt2;
  const auto points = geometry::fill(geometry::FaceCentredCubic{.lattice_constant = std::numbers::sqrt2},
                                     {.lower = Vector<3>::Zero(), .upper = Vector<3>::Constant(side)});
  auto result =
      scene<Careless<Integrator>>(periodic_cube<3>(side), group<Beads>("beads", particles::Mobile{}, points, 1.0),
                                  interaction<Beads, Beads>(potential::LennardJones{.energy_scale = 1.0, .diameter = 1.0, .cutoff = 1.2}));
  disturb_velocities(result.template group<Beads>(), 1e-6);
  return make_case(std::move(name), std::move(text), std::move(result),
                   [](const auto& s) { return largest_speed(s.template group<Beads>()) / 1e-6; });
}

/// A bead thrown at 1 m/s, between walls 2000 m apart that it must not reach.
template <class Integrator, class Forcing>
[[nodiscard]] Case thrown(std::string name, std::string text, const Forcing& forcing) {
  auto result = scene<Careless<Integrator>>(geometry::Box<1>{.lower = {-1e3}, .upper = {1e3}},
                                            group<Beads>("beads", particles::Mobile{}, geometry::Points<1>{{Vector<1>(0.0)}}, 1.0),
                                            forced_by<Beads>(forcing));
  disturb_velocities(result.template group<Beads>(), 1.0);
  return make_case(std::move(name), std::move(text), std::move(result),
                   [](const auto& s) { return largest_speed(s.template group<Beads>()); });
}

/// A bead that lies on a plane under its weight of 1 N, 0.1 m deep, and is lifted by 1e-6 m: omega^2 = 20/s^2.
template <class Integrator>
[[nodiscard]] Case on_plane(std::string name, std::string text) {
  auto result = scene<Careless<Integrator>>(geometry::Box<1>{.lower = {-1e3}, .upper = {1e3}},
                                            group<Beads>("beads", particles::Mobile{}, geometry::Points<1>{{Vector<1>(-0.1 + 1e-6)}}, 1.0),
                                            forced_by<Beads>(forcing::Constant<1>{.uniform_acceleration = {{-1.0}}},
                                                             forcing::Plane<1>{.normal = {{1.0}}, .position = 0.0, .strength = 100.0}));
  return make_case(std::move(name), std::move(text), std::move(result),
                   [](const auto& s) { return std::fabs(s.template group<Beads>().positions()[0][0] + 0.1) / 1e-6; });
}

// ---- Heat: a lattice at rest ----------------------------------------------------------------------------------------------------------

template <class Integrator>
[[nodiscard]] Case heat(std::string name, std::string text, double support) {
  constexpr double step = 1e-6;  // [K]
  auto result = scene<Careless<Integrator>>(
      periodic_cube<2>(12.0), group<Fluid>("plate", particles::Stationary{}, square_lattice<2>(12), 1.0),
      interaction<Fluid, Fluid>(sph::HeatConduction<kernel::Lucy<2>>{.kernel = {.support_radius = support}}),
      material<Fluid>(thermal::Linear{.specific_heat_capacity = 1.0}, thermal::Conductivity{.thermal_conductivity = 1.0}));
  auto& g = result.template group<Fluid>();
  g.template set<field::Density>([](const auto&) { return 1.0; });
  RandomVectors random;
  g.template set<field::SpecificEnergy>([&](const auto&) { return 300.0 + random.vector(step)[0]; });
  return make_case(std::move(name), std::move(text), std::move(result), [](const auto& s) {
    double largest = 0.0;
    for (const double energy : s.template group<Fluid>().template get<field::SpecificEnergy>())
      largest = std::max(largest, std::fabs(energy - 300.0));
    return largest / step;
  });
}

// ---- All laws -----------------------------------------------------------------------------------------------------------------------

template <class K, class V = viscosity::None, class D = diffusion::None>
[[nodiscard]] auto flow(double support, const V& viscosity = {}, const D& diffusion = {}) {
  return sph::WeaklyCompressible<K, V, D>{.kernel = {.support_radius = support}, .viscosity = viscosity, .diffusion = diffusion};
}
/// Between where a lattice blows up and `stopped` the run may go on: the particles leave the lattice, and in disorder are damped less.
[[nodiscard]] inline Case expect(Case c, double stopped, std::string why = "") {
  c.stopped = stopped;
  c.why = std::move(why);
  return c;
}
using Kernel = kernel::WendlandC2<2>;
inline constexpr double support = 2.6;
inline constexpr Patch viscous{.sound_speed = 0.01, .viscosity = 1.0};

template <class Integrator>
[[nodiscard]] Case sound() {
  return expect(fluid<Integrator>("sound", "liquid without viscosity", flow<Kernel>(support), {}), 1.5);
}
template <class Integrator>
[[nodiscard]] Case morris() {
  return expect(fluid<Integrator>("viscosity::Morris", "slow liquid", flow<Kernel>(support, viscosity::Morris<>{}), viscous), 2.0);
}
template <class Integrator>
[[nodiscard]] Case molteni_colagrossi() {
  return expect(fluid<Integrator>("diffusion::MolteniColagrossi", "delta = 10",
                                  flow<Kernel>(support, viscosity::None{}, diffusion::MolteniColagrossi{.sound_speed = 1.0, .delta = 10.0}),
                                  {.sound_speed = 0.01}),
                2.5);
}
template <class Integrator>
[[nodiscard]] Case dashpots() {
  return ring<Integrator>("bond::KelvinVoigt, dashpots", "ring of 16 beads", bonds_of(bond::KelvinVoigt{.stiffness = 0.0, .damping = 1.0}),
                          0.0, 1e-3);
}
template <class Integrator>
[[nodiscard]] Case drag() {
  return thrown<Integrator>("forcing::Drag", "a bead", forcing::Drag{.coefficient = 1.0});
}
template <class Integrator>
[[nodiscard]] Case springs() {
  return ring<Integrator>("bond::Harmonic", "ring of 16 beads", bonds_of(bond::Harmonic{.stiffness = 1.0}));
}

/// Laws of fluids and heat, as Integrator moves them.
template <class Integrator>
[[nodiscard]] std::vector<Case> fluids() {
  const std::string one_sided = "only about half of the pairs approach at a time";
  const sph::WeaklyCompressible<Kernel, viscosity::None, diffusion::None, tensile::Monaghan> repulsive{
      .kernel = {.support_radius = support}, .tensile = {.spacing = 1.0}};
  return {sound<Integrator>(),
          expect(gas<Integrator>("sound, energy equation", "ideal gas on a line, alpha = 0.1", support), 2.5,
                 "neighbours on a line carry less sound"),
          expect(fluid<Integrator>("tensile::Monaghan", "liquid without viscosity", repulsive, {}), 1.6),
          morris<Integrator>(),
          expect(fluid<Integrator>("viscosity::Monaghan", "slow liquid", flow<Kernel>(support, viscosity::Monaghan<2>{}), viscous), 3.0),
          expect(fluid<Integrator>("viscosity::Artificial", "alpha = 50",
                                   flow<Kernel>(support, viscosity::Artificial{.alpha = 50.0, .sound_speed = 1.0}), {}),
                 3.0, one_sided),
          expect(fluid<Integrator>("viscosity::ShockCapturing", "alpha = 50",
                                   flow<Kernel>(support, viscosity::ShockCapturing{.alpha = 50.0}), {}),
                 3.0, one_sided),
          molteni_colagrossi<Integrator>(),
          heat<Integrator>("sph::HeatConduction", "plate, Lucy's kernel", support)};
}
/// Laws of beads, bonds and forcings.
template <class Integrator>
[[nodiscard]] std::vector<Case> beads() {
  const auto dashpot = [](double stiffness, double damping) {
    return bonds_of(bond::KelvinVoigt{.stiffness = stiffness, .damping = damping});
  };
  const auto solid = [](double damping) {
    return bonds_of(bond::StandardLinearSolid{.stiffness = 1.0, .branch_stiffness = 3.0, .branch_damping = damping});
  };
  const auto dispersive = [](double share) { return bond::Dispersive{.stiffness = 1.0, .dispersive_share = share}; };
  const auto substepped = [](const auto& list) { return substepped_bonds<Beads, Beads>(Understated{{.stiffness = 1.0}}, list, 1); };
  const auto implicit = [](double damping) {
    return
        [damping](const auto& list) { return implicit_bonds<Beads, Beads>(bond::KelvinVoigt{.stiffness = 1.0, .damping = damping}, list); };
  };
  return {springs<Integrator>(),
          block<Integrator>("bond::Harmonic", "free block of 6^3 cells, 18 springs each inside", bond::Harmonic{.stiffness = 1.0}),
          expect(block<Integrator>("bond::Dispersive", "that block, D = 0.4", dispersive(0.4)), 1.5),
          expect(block<Integrator>("bond::Dispersive", "that block, D = 0.96", dispersive(0.96)), 2.1,
                 "in the fastest motions the mean strain is small, and D k acts through it alone"),
          expect(block<Integrator>("bond::Dispersive", "that block, D = -0.5", dispersive(-0.5)), 1.5),
          dashpots<Integrator>(),
          ring<Integrator>("bond::KelvinVoigt, both", "ring of 16 beads", dashpot(1.0, 1.0)),
          taut<Integrator>("bond under tension, across", "ring of cables, T = 1 N"),
          ring<Integrator>("bond::Maxwell", "ring, slow dashpots", bonds_of(bond::Maxwell{.stiffness = 1.0, .damping = 1e3}), 0.0, 1e-3),
          ring<Integrator>("bond::StandardLinearSolid", "ring, slow dashpots", solid(1e3)),
          expect(ring<Integrator>("bond::StandardLinearSolid", "ring, fast dashpots", solid(0.1)), 2.1,
                 "a branch that relaxes within a step has no stiffness"),
          ring<Integrator, Integrator>("substepped_bonds", "ring, bond::Harmonic, the sub-step", substepped),
          ring<Integrator>("implicit_bonds", "ring, weak dashpots", implicit(1e-3)),
          expect(ring<Integrator>("implicit_bonds", "ring, strong dashpots", implicit(1e3)), 20.0, "strong dashpots hold the springs too"),
          expect(close_packed<Integrator>("potential::LennardJones", "close packing at r = sigma"), 1.5),
          drag<Integrator>(),
          on_plane<Integrator>("forcing::Plane", "a bead that lies on it")};
}
/// Several laws at once, which would each bound the step alike.
template <class Integrator>
[[nodiscard]] std::vector<Case> together() {
  const auto law = flow<Kernel>(support, viscosity::Morris<>{});
  const double alone = morris<Integrator>().stated;
  std::vector<neighbours::Bond> rows;
  for (std::uint32_t k = 0; k < 64; ++k) rows.push_back({k, k % 8 == 7 ? k - 7 : k + 1, 1.0});
  const auto rows_of = [&rows](double bound) { return bonds<Fluid, Fluid>(bond::Harmonic{.stiffness = 1.0 / square(bound)}, rows); };
  return {
      expect(fluid<Integrator>("viscosity::Morris, forcing::Drag", "slow liquid", law, viscous,
                               forced_by<Fluid>(forcing::Drag{.coefficient = Integrator::damping_limit / alone})),
             2.0),
      expect(fluid<Integrator>("viscosity::Morris, bond::Harmonic", "slow liquid with rows of springs", law, viscous, rows_of(alone)), 2.0),
      expect(fluid<Integrator>("sound, viscosity::Morris", "liquid", law, {.sound_speed = 0.25 * support / alone, .viscosity = 1.0}), 2.0),
      expect(fluid<Integrator>("sound, viscosity::Morris, bond::Harmonic", "liquid with rows of springs", law,
                               {.sound_speed = 0.25 * support / alone, .viscosity = 1.0}, rows_of(alone)),
             2.0)};
}
/// A liquid of little or no viscosity that is held by springs, which alone would allow a step of `share` times that of sound.
template <class Integrator>
[[nodiscard]] Case sound_and_springs(double share, double alpha) {
  std::vector<neighbours::Bond> rows;
  for (std::uint32_t k = 0; k < 64; ++k) rows.push_back({k, k % 8 == 7 ? k - 7 : k + 1, 1.0});
  return expect(fluid<Integrator>("sound, bond::Harmonic",
                                  "alpha = " + to_text(alpha) + ", springs alone " + to_text(share) + " of the bound of sound",
                                  flow<Kernel>(support, viscosity::Artificial{.alpha = alpha, .sound_speed = 1.0}), {},
                                  bonds<Fluid, Fluid>(bond::Harmonic{.stiffness = 1.0 / square(share * 0.25 * support)}, rows)),
                3.0, alpha > 0.0 ? "some viscosity helps before it is enough to be counted" : "");
}
template <class Integrator>
[[nodiscard]] std::vector<Case> liquid_with_springs() {
  return {sound_and_springs<Integrator>(1.0, 0.0), sound_and_springs<Integrator>(0.25, 0.0), sound_and_springs<Integrator>(1.0, 0.1),
          sound_and_springs<Integrator>(0.25, 0.1)};
}

}  // namespace test::stability
