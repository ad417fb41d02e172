// A scene holds what its laws name, and nothing else: columns, records and sweeps of reference scenes (sheet 06, section 7).
#include <atomic>
#include <string>
#include <type_traits>
#include <doctest/doctest.h>

#include "scenes.hpp"

using namespace test;
using namespace dmp::field;

namespace {

template <class Scene, class Tag>
using LayoutIn = typename std::remove_cvref_t<decltype(std::declval<Scene&>().template group<Tag>())>::Layout;
template <class Scene, class Tag>
using GroupIn = std::remove_cvref_t<decltype(std::declval<Scene&>().template group<Tag>())>;

template <class G>
concept HasGhosts = requires(G group) { group.ghosts; };

geometry::Points<2> row(int count, double y) {
  geometry::Points<2> points{.positions = {}, .spacing = 0.1};
  for (int k = 0; k < count; ++k) points.positions.emplace_back(0.1 * k + 0.05, y);
  return points;
}

const geometry::Box<2> box{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {true, false}};
const Flow flow{.kernel = {.support_radius = 0.26}};
const eos::Tait tait{.rest_density = 1.0, .sound_speed_0 = 10.0};
const rheology::Constant newtonian{.dynamic_viscosity = 0.01};

auto chain() {  // KV-x: bonds only
  return scene<integrator::Leapfrog>(box, group<Solid>("chain", Mobile{}, row(4, 0.5), 1.0),
                                     bonds<Solid, Solid>(bond::Harmonic{.stiffness = 1.0}, {{0, 1}, {1, 2}, {2, 3}}));
}
[[maybe_unused]] auto damped_chain() {
  return scene<integrator::Leapfrog>(box, group<Solid>("chain", Mobile{}, row(4, 0.5), 1.0),
                                     bonds<Solid, Solid>(bond::KelvinVoigt{.stiffness = 1.0, .damping = 1.0}, {{0, 1}, {1, 2}, {2, 3}}));
}
auto channel() {  // VISC-1: fluid between frozen walls
  return scene<integrator::ExtrapolatedVerlet>(box, group<Water>("water", Mobile{}, row(10, 0.5), 1.0),
                                               group<Wall>("wall", Frozen<2>{}, row(10, 0.4), 1.0), interaction<Water, Water>(flow),
                                               interaction<Water, Wall>(flow), material<Water, Wall>(tait, newtonian));
}
auto basin() {  // fluid beside a wall whose density answers
  return scene<integrator::ExtrapolatedVerlet>(box, group<Water>("water", Mobile{}, row(10, 0.5), 1.0),
                                               group<Wall>("wall", Stationary{}, row(10, 0.4), 1.0), interaction<Water, Water>(flow),
                                               interaction<Water, Wall>(flow), material<Water, Wall>(tait, newtonian));
}
auto membrane() {  // DMP-A: fluid and bonded beads that are SPH particles too
  return scene<integrator::ExtrapolatedVerlet>(
      box, group<Water>("water", Mobile{}, row(10, 0.5), 1.0), group<Solid>("membrane", Mobile{}, row(10, 0.4), 1.0),
      interaction<Water, Water>(flow),
      interaction<Water, Solid>(flow, potential::LennardJones{.energy_scale = 1.0, .diameter = 0.1, .cutoff = 0.1}),
      bonds<Solid, Solid>(bond::Harmonic{.stiffness = 1.0}, {{0, 1}}), material<Water, Solid>(tait, newtonian));
}

/// T = e/c.
struct Caloric {
  double c;  // [J/(kg K)]
  [[nodiscard]] auto temperature(const auto& e) const { return e * (1.0 / c); }
  [[nodiscard]] auto specific_energy(const auto& temperature) const { return temperature * c; }
  [[nodiscard]] double specific_heat() const { return c; }
};
void validate(const Caloric&) {}
struct Conductor {
  using reads = Fields<>;
  using writes = Fields<ThermalConductivity>;
  double kappa;  // [W/(m K)]
  void apply(auto& particle) const { particle.thermal_conductivity = kappa; }
};
void validate(const Conductor&) {}
struct Rigid {
  using reads = Fields<>;
  using writes = Fields<Density>;
  double rho;  // [kg/m^3]
  void apply(auto& particle) const { particle.density = rho; }
};
void validate(const Rigid&) {}
struct Arrhenius {
  double c1, c2;  // [Pa s], [K]
  [[nodiscard]] auto viscosity(const auto& temperature) const { return c1 * exp(c2 / temperature); }
};
void validate(const Arrhenius&) {}
struct CountedArrhenius : Arrhenius {
  static inline std::atomic<long> evaluations = 0;
  [[nodiscard]] auto viscosity(const auto& temperature) const {
    ++evaluations;
    return Arrhenius::viscosity(temperature);
  }
};
struct Thinning {
  double mu;  // [Pa s]
  [[nodiscard]] auto apparent_viscosity(const auto& shear_rate) const { return mu / (1.0 + shear_rate); }
};
void validate(const Thinning&) {}

using Lucy = kernel::Lucy<2>;
constexpr Lucy lucy{.support_radius = 0.26};
const sph::HeatConduction<Lucy> conduction{.kernel = lucy};

template <class Integrator, class V>
auto tube(const V& viscosity) {  // NASG-1, with an ideal gas: a fluid whose pressure depends on the energy, between frozen ends
  const sph::Compressible<Lucy, V> law{.kernel = lucy, .viscosity = viscosity};
  return scene<Integrator>(box, group<Water>("gas", Mobile{}, row(10, 0.5), 1.0), group<Wall>("ends", Frozen<2>{}, row(10, 0.4), 1.0),
                           interaction<Water, Water>(law), interaction<Water, Wall>(law), material<Water, Wall>(eos::liquid_water));
}
template <class Integrator>
auto slabs() {  // HX: two phases at rest
  return scene<Integrator>(
      box, group<Water>("liquid", Stationary{}, row(10, 0.5), 1.0), group<Solid>("gas", Stationary{}, row(10, 0.4), 1.0),
      group<Wall>("face", Frozen<2>{}, row(10, 0.3), 1.0), interaction<Water, Water>(conduction), interaction<Water, Solid>(conduction),
      interaction<Solid, Solid>(conduction), interaction<Solid, Wall>(conduction),
      material<Water>(Caloric{4000.0}, Conductor{0.6}, Rigid{1000.0}), material<Solid, Wall>(Caloric{1000.0}, Conductor{0.02}, Rigid{1.0}));
}
template <class Integrator, class Viscosity>
auto channel_of_given_temperature(const Viscosity& viscosity, const geometry::Points<2>& wall) {  // VISC-2
  return scene<Integrator>(box, group<Water>("water", Mobile{}, row(10, 0.5), 0.01), group<Wall>("wall", Frozen<2>{}, wall, 0.01),
                           interaction<Water, Water>(flow), interaction<Water, Wall>(flow), material<Water, Wall>(tait, viscosity));
}
template <class Integrator>
auto warm_channel() {  // VISC-3: the temperature is conducted, the viscosity follows it
  const Flow friction{.kernel = {.support_radius = 0.26}};
  return scene<Integrator>(box, group<Water>("water", Mobile{}, row(10, 0.5), 1.0), group<Wall>("wall", Frozen<2>{}, row(10, 0.4), 1.0),
                           interaction<Water, Water>(friction, conduction), interaction<Water, Wall>(friction, conduction),
                           material<Water, Wall>(tait, Caloric{4000.0}, Conductor{0.6}, Arrhenius{1.83e-4, 1879.9}));
}
auto thinning_channel() {  // VISC-5: the viscosity follows the shear rate
  return scene<integrator::LammpsVerlet>(box, group<Water>("water", Mobile{}, row(10, 0.5), 1.0),
                                         group<Wall>("wall", Frozen<2>{}, row(10, 0.4), 1.0), interaction<Water, Water>(flow),
                                         interaction<Water, Wall>(flow),
                                         summed<Water>(sph::ShearRate<kernel::WendlandC2<2>>{.kernel = {.support_radius = 0.26}}),
                                         material<Water>(tait, Thinning{0.01}), material<Wall>(tait, newtonian));
}

}  // namespace

TEST_CASE("a bond-only scene has no density, no neighbour list and no ghosts; a spring loads no velocities, a dashpot does") {
  using Chain = decltype(chain());
  static_assert(std::is_same_v<LayoutIn<Chain, Solid>::columns, Fields<Position, Velocity, Acceleration>>);
  static_assert(std::is_same_v<LayoutIn<Chain, Solid>::record, Fields<Position>>);
  static_assert(std::is_same_v<LayoutIn<Chain, Solid>::writes, Fields<Force>>);
  static_assert(!LayoutIn<Chain, Solid>::has_pairs);
  static_assert(!HasGhosts<GroupIn<Chain, Solid>> && HasGhosts<GroupIn<decltype(channel()), Water>>);
  static_assert(GroupIn<Chain, Solid>::Columns::bytes_per_particle == 48);
  using Damped = decltype(damped_chain());
  static_assert(std::is_same_v<LayoutIn<Damped, Solid>::record, Fields<Position, Velocity>>);
  auto scene = chain();
  const std::string text = describe(scene);
  CHECK(text.find("no neighbour lists, no ghosts") != std::string::npos);
  CHECK(text.find("density") == std::string::npos);
  CHECK(text.find("bound by bond stiffness of chain - chain\n") != std::string::npos);
}

TEST_CASE("an isothermal 2D fluid stores two components and no energy; mass and viscosity are constants of the group") {
  using Channel = decltype(channel());
  static_assert(std::is_same_v<LayoutIn<Channel, Water>::columns,
                               Fields<Position, Velocity, Acceleration, Density, DensityRate, Previous<DensityRate>>>);
  static_assert(std::is_same_v<LayoutIn<Channel, Water>::record, Fields<Position, Velocity, Density, PressureTerm>>);
  static_assert(std::is_same_v<LayoutIn<Channel, Water>::constants, Fields<Mass, DynamicViscosity>>);
  static_assert(std::is_same_v<LayoutIn<Channel, Water>::derived, Fields<PressureTerm>>);  // the sound speed is for the time step alone
  static_assert(std::is_same_v<LayoutIn<Channel, Water>::writes, Fields<Acceleration, DensityRate>>);
  static_assert(GroupIn<Channel, Water>::Columns::bytes_per_particle == 3 * 16 + 3 * 8);
  auto scene = channel();
  scene.engine().for_each_group([](auto& g) { g.template set<Density>([](const auto&) { return 1.0; }); });
  const std::string text = describe(scene);
  CHECK(text.find("each step: 1 pass over the particles (integration, records), 1 sweep over their pairs and bonds") != std::string::npos);
}

TEST_CASE("a frozen wall stores position and density, and is neither integrated nor listed against itself") {
  using Channel = decltype(channel());
  static_assert(std::is_same_v<LayoutIn<Channel, Wall>::columns, Fields<Position, Density>>);
  static_assert(GroupIn<Channel, Wall>::Columns::bytes_per_particle == 24);
  auto scene = channel();
  scene.engine().for_each_group([](auto& g) { g.template set<Density>([](const auto&) { return 1.0; }); });
  scene.run({.until = 1e-3});
  scene.engine().for_each_item([](const auto& active) {
    using Item = std::remove_cvref_t<decltype(active.item)>;
    if constexpr (is_interaction<Item>)
      if constexpr (std::is_same_v<typename Item::B, Wall>) {
        CHECK(active.of_a.bytes() > 0);
        CHECK(active.of_b.bytes() == 0);
      }
  });
}

TEST_CASE("a stationary wall stores its density and the rate of it, no velocity and no acceleration") {
  using Basin = decltype(basin());
  static_assert(std::is_same_v<LayoutIn<Basin, Wall>::columns, Fields<Position, Density, DensityRate, Previous<DensityRate>>>);
  static_assert(GroupIn<Basin, Wall>::Columns::bytes_per_particle == 40);
  auto scene = basin();
  CHECK(scene.particles() == 20);
}

TEST_CASE("an elastic membrane in a fluid carries what both its laws need, and no energy") {
  using Balloon = decltype(membrane());
  static_assert(std::is_same_v<LayoutIn<Balloon, Solid>::columns,
                               Fields<Position, Velocity, Acceleration, Density, DensityRate, Previous<DensityRate>>>);
  static_assert(std::is_same_v<LayoutIn<Balloon, Solid>::writes, Fields<Force, Acceleration, DensityRate>>);
  static_assert(std::is_same_v<LayoutIn<Balloon, Water>::columns, LayoutIn<Balloon, Solid>::columns>);
  auto scene = membrane();
  CHECK(scene.particles() == 20);
}

TEST_CASE("absent physics takes no byte") {
  static_assert(std::is_empty_v<viscosity::None> && std::is_empty_v<diffusion::None> && std::is_empty_v<tensile::None>);
  static_assert(sizeof(sph::WeaklyCompressible<kernel::Lucy<2>>) == sizeof(double));
  static_assert(sizeof(Flow) == sizeof(double));
  CHECK(sizeof(kernel::Lucy<3>) == sizeof(double));
}

// In these scenes we hold what the sheet's table names, but that v* is no column (laws see it in the record), and that an integrator which
// extrapolates the state (ExtrapolatedVerlet) keeps each rate of the step before; LAMMPS' (LammpsVerlet) does not.

TEST_CASE(
    "NASG-1: a gas in a tube carries density and energy, and shows its neighbours pressure term and sound speed; no temperature, no "
    "viscosity") {
  using Tube = decltype(tube<integrator::LammpsVerlet>(viscosity::ShockCapturing{.alpha = 1.0}));
  static_assert(std::is_same_v<LayoutIn<Tube, Water>::columns,
                               Fields<Position, Velocity, Acceleration, Density, SpecificEnergy, DensityRate, SpecificEnergyRate>>);
  static_assert(std::is_same_v<LayoutIn<Tube, Water>::record, Fields<Position, Velocity, Density, PressureTerm, SoundSpeed>>);
  static_assert(std::is_same_v<LayoutIn<Tube, Water>::constants, Fields<Mass>>);
  static_assert(std::is_same_v<LayoutIn<Tube, Water>::derived, Fields<PressureTerm, SoundSpeed>>);
  static_assert(std::is_same_v<LayoutIn<Tube, Water>::writes, Fields<Acceleration, DensityRate, SpecificEnergyRate>>);
  static_assert(std::is_same_v<LayoutIn<Tube, Wall>::columns, Fields<Position, Density, SpecificEnergy>>);
  using Global =
      decltype(tube<integrator::LammpsVerlet>(viscosity::Artificial{.alpha = 1.0, .sound_speed = 1.0}));  // one sound speed for all
  static_assert(std::is_same_v<LayoutIn<Global, Water>::record, Fields<Position, Velocity, Density, PressureTerm>>);
  using Extrapolated = decltype(tube<integrator::ExtrapolatedVerlet>(viscosity::ShockCapturing{.alpha = 1.0}));
  static_assert(std::is_same_v<LayoutIn<Extrapolated, Water>::columns,
                               Fields<Position, Velocity, Acceleration, Density, SpecificEnergy, DensityRate, SpecificEnergyRate,
                                      Previous<DensityRate>, Previous<SpecificEnergyRate>>>);
  static_assert(std::is_same_v<LayoutIn<Extrapolated, Wall>::columns, LayoutIn<Tube, Wall>::columns>);
  CHECK(GroupIn<Tube, Water>::Columns::bytes_per_particle == 3 * 16 + 4 * 8);
}

TEST_CASE(
    "HX: heat between bodies at rest needs position and energy; no velocity, no acceleration; density and conductivity are constants of "
    "the group") {
  using Slabs = decltype(slabs<integrator::LammpsVerlet>());
  static_assert(std::is_same_v<LayoutIn<Slabs, Water>::columns, Fields<Position, SpecificEnergy, SpecificEnergyRate>>);
  static_assert(std::is_same_v<LayoutIn<Slabs, Water>::record, Fields<Position, Temperature>>);
  static_assert(std::is_same_v<LayoutIn<Slabs, Water>::constants, Fields<Mass, ThermalConductivity, Density>>);
  static_assert(std::is_same_v<LayoutIn<Slabs, Water>::writes, Fields<SpecificEnergyRate>>);
  static_assert(std::is_same_v<LayoutIn<Slabs, Solid>::columns, LayoutIn<Slabs, Water>::columns>);
  static_assert(std::is_same_v<LayoutIn<Slabs, Wall>::columns, Fields<Position, SpecificEnergy>>);
  using Extrapolated = decltype(slabs<integrator::ExtrapolatedVerlet>());
  static_assert(std::is_same_v<LayoutIn<Extrapolated, Water>::columns,
                               Fields<Position, SpecificEnergy, SpecificEnergyRate, Previous<SpecificEnergyRate>>>);
  auto scene = slabs<integrator::LammpsVerlet>();
  scene.engine().for_each_group([](auto& g) { g.template set<SpecificEnergy>([](const auto&) { return 3e5; }); });
  scene.run({.until = 1.0, .time_step = 0.01});
  CHECK(scene.engine().list_builds() == 1);  // nothing moves
  CHECK(GroupIn<Slabs, Water>::Columns::bytes_per_particle == 32);
}

TEST_CASE(
    "VISC-2: a channel of given temperature adds that column and shows neighbours the viscosity: no energy, no rate of it, no conduction; "
    "once per particle and step") {
  using Channel = decltype(channel_of_given_temperature<integrator::LammpsVerlet>(Arrhenius{1.83e-4, 1879.9}, row(10, 0.4)));
  static_assert(
      std::is_same_v<LayoutIn<Channel, Water>::columns, Fields<Position, Velocity, Acceleration, Density, Temperature, DensityRate>>);
  static_assert(std::is_same_v<LayoutIn<Channel, Water>::record, Fields<Position, Velocity, Density, PressureTerm, DynamicViscosity>>);
  static_assert(std::is_same_v<LayoutIn<Channel, Water>::derived, Fields<PressureTerm, DynamicViscosity>>);
  static_assert(std::is_same_v<LayoutIn<Channel, Water>::constants, Fields<Mass>>);
  static_assert(std::is_same_v<LayoutIn<Channel, Water>::writes, Fields<Acceleration, DensityRate>>);
  static_assert(std::is_same_v<LayoutIn<Channel, Wall>::columns, Fields<Position, Density, Temperature>>);
  static_assert(GroupIn<Channel, Water>::Columns::bytes_per_particle == 3 * 16 + 3 * 8);
  using Extrapolated = decltype(channel_of_given_temperature<integrator::ExtrapolatedVerlet>(Arrhenius{1.83e-4, 1879.9}, row(10, 0.4)));
  static_assert(std::is_same_v<LayoutIn<Extrapolated, Water>::columns,
                               Fields<Position, Velocity, Acceleration, Density, Temperature, DensityRate, Previous<DensityRate>>>);

  const auto evaluations_of = [](std::uint64_t steps, const geometry::Points<2>& wall) {
    auto scene = channel_of_given_temperature<integrator::LammpsVerlet>(CountedArrhenius{{1.83e-7, 1879.9}}, wall);
    scene.engine().for_each_group([](auto& g) {
      g.template set<Density>([](const auto&) { return 1.0; });
      g.template set<Temperature>([](const auto&) { return 300.0; });
    });
    CountedArrhenius::evaluations = 0;
    scene.run({.until = 1e-3 * static_cast<double>(steps), .time_step = 1e-3});
    CHECK(scene.step() == steps);
    return CountedArrhenius::evaluations.load();
  };
  CHECK(evaluations_of(90, row(10, 0.4)) - evaluations_of(30, row(10, 0.4)) == 60 * 10);
  CHECK(evaluations_of(90, geometry::merge(row(10, 0.4), row(10, 0.3))) - evaluations_of(30, geometry::merge(row(10, 0.4), row(10, 0.3))) ==
        60 * 10);  // more pairs
}

TEST_CASE(
    "VISC-3: a channel whose viscosity follows a conducted temperature: flow and conduction are one sweep, temperature and viscosity no "
    "columns") {
  using Channel = decltype(warm_channel<integrator::LammpsVerlet>());
  static_assert(std::is_same_v<LayoutIn<Channel, Water>::columns,
                               Fields<Position, Velocity, Acceleration, Density, SpecificEnergy, DensityRate, SpecificEnergyRate>>);
  static_assert(
      std::is_same_v<LayoutIn<Channel, Water>::record, Fields<Position, Velocity, Density, PressureTerm, DynamicViscosity, Temperature>>);
  static_assert(std::is_same_v<LayoutIn<Channel, Water>::derived, Fields<PressureTerm, Temperature, DynamicViscosity>>);
  static_assert(std::is_same_v<LayoutIn<Channel, Water>::constants, Fields<Mass, ThermalConductivity>>);
  static_assert(std::is_same_v<LayoutIn<Channel, Wall>::columns, Fields<Position, Density, SpecificEnergy>>);
  auto scene = warm_channel<integrator::LammpsVerlet>();
  scene.engine().for_each_group([](auto& g) { g.template set<SpecificEnergy>([](const auto&) { return 4000.0 * 300.0; }); });
  CHECK(describe(scene).find("each step: 1 pass over the particles (integration, records), 1 sweep over their pairs and bonds") !=
        std::string::npos);
}

TEST_CASE(
    "VISC-5: a shear rate is one column of the fluid alone, and one sweep more; its neighbours see the viscosity, not the shear rate") {
  using Channel = decltype(thinning_channel());
  static_assert(
      std::is_same_v<LayoutIn<Channel, Water>::columns, Fields<Position, Velocity, Acceleration, Density, ShearRate, DensityRate>>);
  static_assert(std::is_same_v<LayoutIn<Channel, Water>::record, Fields<Position, Velocity, Density, PressureTerm, DynamicViscosity>>);
  static_assert(std::is_same_v<LayoutIn<Channel, Wall>::columns, Fields<Position, Density>>);
  auto scene = thinning_channel();
  const std::string text = describe(scene);
  CHECK(text.find("summed") != std::string::npos);
}
