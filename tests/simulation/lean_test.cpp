// A scene holds what its laws name, and nothing else: columns, records and sweeps of five reference scenes (sheet 06, section 7).
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
  return scene<integrator::ExtrapolatedVerlet>(box, group<Water>("water", Mobile{}, row(10, 0.5), 1.0), group<Wall>("wall", Frozen<2>{}, row(10, 0.4), 1.0),
                                               interaction<Water, Water>(flow), interaction<Water, Wall>(flow), material<Water, Wall>(tait, newtonian));
}
auto basin() {  // fluid beside a wall whose density answers
  return scene<integrator::ExtrapolatedVerlet>(box, group<Water>("water", Mobile{}, row(10, 0.5), 1.0), group<Wall>("wall", Stationary{}, row(10, 0.4), 1.0),
                                               interaction<Water, Water>(flow), interaction<Water, Wall>(flow), material<Water, Wall>(tait, newtonian));
}
auto membrane() {  // DMP-A: fluid and bonded beads that are SPH particles too
  return scene<integrator::ExtrapolatedVerlet>(
      box, group<Water>("water", Mobile{}, row(10, 0.5), 1.0), group<Solid>("membrane", Mobile{}, row(10, 0.4), 1.0), interaction<Water, Water>(flow),
      interaction<Water, Solid>(flow, potential::LennardJones{.energy_scale = 1.0, .diameter = 0.1, .cutoff = 0.1}),
      bonds<Solid, Solid>(bond::Harmonic{.stiffness = 1.0}, {{0, 1}}), material<Water, Solid>(tait, newtonian));
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
  CHECK(text.find("bound by bond stiffness") != std::string::npos);
}

TEST_CASE("an isothermal 2D fluid stores two components and no energy; mass and viscosity are constants of the group") {
  using Channel = decltype(channel());
  static_assert(std::is_same_v<LayoutIn<Channel, Water>::columns, Fields<Position, Velocity, Acceleration, Density, DensityRate, Previous<DensityRate>>>);
  static_assert(std::is_same_v<LayoutIn<Channel, Water>::record, Fields<Position, Velocity, Density, PressureTerm>>);
  static_assert(std::is_same_v<LayoutIn<Channel, Water>::constants, Fields<Mass, DynamicViscosity>>);
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
  static_assert(std::is_same_v<LayoutIn<Balloon, Solid>::columns, Fields<Position, Velocity, Acceleration, Density, DensityRate, Previous<DensityRate>>>);
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
