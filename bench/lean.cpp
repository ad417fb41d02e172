// What is left out of a scene, and what it would cost. Three scenes in 3D, alone and with one thing more: a liquid (weakly compressible
// SPH, Wendland C2, support h = 2.6 spacings, Morris' viscosity, Tait's equation, a row of vortices), a solid of springs (six to each
// bead), and heat in a body at rest. Periodic box, 46 656 particles, one thread. Each is timed in turns with the scene alone: processor
// time of 30 steps, seven times; the ratio is the median of those of neighbouring turns.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>
#include <dmp/dmp.hpp>

#include "lattice.hpp"

namespace {

using namespace dmp;
using namespace dmp::simulation;
struct Water {};

constexpr int side = 36, turns = 7, steps_of_turn = 30;
constexpr double support_radius = 2.6, sound_speed = 10.0, time_step = 0.1 * support_radius / sound_speed;
constexpr double temperature = 300.0, specific_heat = 1000.0, mu = 0.1;

using Kernel = kernel::WendlandC2<3>;
constexpr Kernel wendland{.support_radius = support_radius};
constexpr sph::WeaklyCompressible<Kernel, viscosity::Morris<>> flow{.kernel = wendland};
constexpr eos::Tait tait{.rest_density = 1.0, .sound_speed_0 = sound_speed};
constexpr rheology::Constant newtonian{.dynamic_viscosity = mu};

/// A body of what is given, with vortices of a highest `speed`, some steps on: first lists, first forces; in a liquid the lattice is gone.
template <class Mobility, class... Item>
auto body(double speed, const Mobility& mobility, const Item&... item) {
  geometry::Points<3> points{.positions = bench::jittered_lattice(side), .spacing = 1.0, .volume = 1.0};
  const double size = side;
  auto result = scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<3>{.lower = {0.0, 0.0, 0.0}, .upper = {size, size, size}, .periodic = {true, true, true}},
      group<Water>("water", mobility, std::move(points), 1.0), item...);
  auto& water = result.template group<Water>();
  using Columns = typename std::remove_cvref_t<decltype(water)>::Layout::columns;
  if constexpr (contains<field::Density, Columns>) water.template set<field::Density>([](const auto&) { return 1.0; });
  if constexpr (contains<field::Velocity, Columns>)
    water.template set<field::Velocity>([speed, k = 2.0 * std::numbers::pi / size](const Vector<3>& x) {
      return Vector<3>(speed * std::sin(k * x[0]) * std::cos(k * x[1]), -speed * std::cos(k * x[0]) * std::sin(k * x[1]), 0.0);
    });
  const auto warm = [](const Vector<3>& x) { return temperature * (1.0 + 0.01 * x[0] / side); };
  if constexpr (contains<field::Temperature, Columns>) water.template set<field::Temperature>(warm);
  if constexpr (contains<field::SpecificEnergy, Columns>)
    water.template set<field::SpecificEnergy>([&warm](const Vector<3>& x) { return specific_heat * warm(x); });
  result.run({.until = 20.0 * time_step, .time_step = time_step});
  return result;
}
template <class... Item>
auto fluid(const Item&... item) {
  return body(1.0, particles::Mobile{}, item...);
}
/// Its beads start at rest but for a small speed.
template <class... Item>
auto solid(const Item&... item) {
  return body(0.001, particles::Mobile{}, item...);
}
template <class... PairLaw>
auto pairs(const PairLaw&... law) {
  return interaction<Water, Water>(law...);
}
template <class... Law>
auto of(const Law&... law) {
  return material<Water>(law...);
}
/// Each particle joined to its six neighbours on the lattice.
template <class Law>
auto springs(const Law& law) {
  std::vector<neighbours::Bond> list;
  const auto index = [](int i, int j, int k) { return static_cast<std::uint32_t>((i % side) + side * ((j % side) + side * (k % side))); };
  for (int k = 0; k < side; ++k)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i)
        for (const auto other : {index(i + 1, j, k), index(i, j + 1, k), index(i, j, k + 1)}) list.push_back({index(i, j, k), other, 1.0});
  return bonds<Water, Water>(law, list);
}

/// Processor time per particle and step [ns].
template <class Scene>
double nanoseconds(Scene& scene) {
  const std::clock_t start = std::clock();
  const auto report = scene.run({.until = scene.time() + steps_of_turn * time_step, .time_step = time_step});
  return 1e9 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / report.particle_steps;
}
double median(std::array<double, turns> values) {
  std::sort(values.begin(), values.end());
  return values[turns / 2];
}

/// One line: in which scene, what, bytes of columns, of the record and of all per particle; time per particle and step, and over that of
/// the other scene.
template <class Scene, class Lean>
void compare(const std::string& in, const std::string& what, Scene scene, Lean& lean) {
  using Group = std::remove_cvref_t<decltype(scene.template group<Water>())>;
  std::array<double, turns> time{}, ratio{};
  for (std::size_t turn = 0; turn < turns; ++turn) {
    const double alone = nanoseconds(lean);
    time[turn] = nanoseconds(scene);
    ratio[turn] = time[turn] / alone;
  }
  const auto [least, largest] = std::minmax_element(ratio.begin(), ratio.end());
  const auto columns = static_cast<std::size_t>(Group::Columns::bytes_per_particle);
  const auto record = static_cast<std::size_t>(Group::Records::bytes_per_particle());
  std::printf("%s; %s; %zu; %zu; %.0f; %.0f; %.2f; %.2f; %.2f\n", in.c_str(), what.c_str(), columns, record, bytes_per_particle(scene),
              median(time), median(ratio), *least, *largest);
  std::fflush(stdout);
}

void liquid_and_more() {
  auto lean = fluid(pairs(flow), of(tait, newtonian));
  const auto add = [&lean](const std::string& what, auto&& scene) { compare("liquid", what, std::move(scene), lean); };
  add("nothing: the scene twice", fluid(pairs(flow), of(tait, newtonian)));
  add("density diffusion", fluid(pairs(sph::WeaklyCompressible<Kernel, viscosity::Morris<>, diffusion::MolteniColagrossi>{
                                     .kernel = wendland, .diffusion = {.sound_speed = sound_speed}}),
                                 of(tait, newtonian)));
  add("energy equation", fluid(pairs(sph::Compressible<Kernel, viscosity::Morris<>>{.kernel = wendland}), of(tait, newtonian)));
  add("heat conduction", fluid(pairs(flow, sph::HeatConduction<Kernel>{.kernel = wendland}),
                               of(tait, newtonian, thermal::Linear{.specific_heat_capacity = specific_heat},
                                  thermal::Conductivity{.thermal_conductivity = 0.1 * specific_heat})));
  add("viscosity of each particle, mu(T)",
      fluid(pairs(flow), of(tait, rheology::Arrhenius{.pre_exponential_factor = mu * std::exp(-1000.0 / temperature),
                                                      .activation_temperature = 1000.0,
                                                      .temperature_range = {.lowest = 250.0, .highest = 350.0}})));
  add("viscosity of each particle, mu(shear rate), a sum over neighbours",
      fluid(pairs(flow), summed<Water>(sph::ShearRate<Kernel>{.kernel = wendland}),
            of(tait, rheology::PowerLaw{.consistency_index = mu,
                                        .power_law_index = 0.8,
                                        .lowest_shear_rate = 0.01,
                                        .lowest_viscosity = 0.1 * mu,
                                        .highest_viscosity = 10.0 * mu})));
  add("artificial viscosity instead of Morris'",
      fluid(pairs(sph::WeaklyCompressible<Kernel, viscosity::Artificial>{
                .kernel = wendland, .viscosity = {.alpha = 0.1, .sound_speed = sound_speed}}),
            of(tait)));
  add("shock capturing instead: sound speed of each particle",
      fluid(pairs(sph::WeaklyCompressible<Kernel, viscosity::ShockCapturing>{
                .kernel = wendland, .viscosity = {.alpha = 0.1, .beta = 0.1}}),
            of(tait)));
  add("tensile correction", fluid(pairs(sph::WeaklyCompressible<Kernel, viscosity::Morris<>, diffusion::None, tensile::Monaghan>{
                                      .kernel = wendland, .tensile = {.spacing = 1.0}}),
                                  of(tait, newtonian)));
  add("bonds: springs, 6 to each particle", fluid(pairs(flow), of(tait, newtonian), springs(bond::Harmonic{.stiffness = 1.0})));
  add("bonds with velocity: spring and dashpot",
      fluid(pairs(flow), of(tait, newtonian), springs(bond::KelvinVoigt{.stiffness = 1.0, .damping = 0.1})));
  add("bonds with memory: standard linear solid",
      fluid(pairs(flow), of(tait, newtonian),
            springs(bond::StandardLinearSolid{.stiffness = 1.0, .branch_stiffness = 1.0, .branch_damping = 0.1})));
}

void solid_and_more() {
  const bond::Harmonic spring{.stiffness = 1.0};
  auto lean = solid(springs(spring));
  const auto add = [&lean](const std::string& what, auto&& scene) { compare("solid of springs", what, std::move(scene), lean); };
  add("nothing: the scene twice", solid(springs(spring)));
  add("neighbour lists and repulsion between beads",
      solid(springs(spring), pairs(potential::LennardJones{.energy_scale = 1e-3, .diameter = 0.5, .cutoff = 1.25})));
  add("pressure and viscosity of a liquid: density, neighbour lists", solid(springs(spring), pairs(flow), of(tait, newtonian)));
  add("bonds with velocity: spring and dashpot", solid(springs(bond::KelvinVoigt{.stiffness = 1.0, .damping = 0.1})));
  add("bonds with memory: standard linear solid",
      solid(springs(bond::StandardLinearSolid{.stiffness = 1.0, .branch_stiffness = 1.0, .branch_damping = 0.1})));
  add("bonds that break", solid(springs(bond::Breaking{spring, bond::LargestStrain{.strain = 0.9}})));
}

void heat_and_more() {
  const sph::HeatConduction<Kernel> conduction{.kernel = wendland};
  const thermal::Linear caloric{.specific_heat_capacity = specific_heat};
  const thermal::Conductivity conductivity{.thermal_conductivity = 0.1 * specific_heat};
  const eos::ConstantDensity constant{.density = 1.0};
  const auto at_rest = [&] { return body(0.0, particles::Stationary{}, pairs(conduction), of(constant, caloric, conductivity)); };
  auto lean = at_rest();
  compare("heat at rest", "nothing: the scene twice", at_rest(), lean);
  compare("heat at rest", "flow: motion, pressure, viscosity",
          fluid(pairs(flow, conduction), of(tait, newtonian, caloric, conductivity)), lean);
}

}  // namespace

int main() {
  use_threads(1);
  liquid_and_more();
  solid_and_more();
  heat_and_more();
}
