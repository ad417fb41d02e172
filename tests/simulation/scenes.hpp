#pragma once
#include <cmath>
#include <numbers>
#include <utility>
#include <dmp/dmp.hpp>

/// Scenes that several tests run.
namespace test {

using namespace dmp;
using namespace dmp::simulation;
using particles::Frozen, particles::Mobile, particles::Stationary;

struct Water {};
struct Wall {};
struct Solid {};

using Flow = sph::WeaklyCompressible<kernel::WendlandC2<2>, viscosity::Morris<>>;

struct Vortex {
  int columns = 24;
  double sound_speed = 10.0, viscosity = 0.01;
};

/// Doubly periodic vortex in the unit square, density 1.
inline auto vortex(const Vortex& v) {
  const double spacing = 1.0 / v.columns;
  const Flow law{.kernel = {.support_radius = 2.6 * spacing}};
  const geometry::Box<2> box{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {true, true}};
  auto result = scene<integrator::ExtrapolatedVerlet>(
      box,
      group<Water>("water", Mobile{}, geometry::fill(geometry::Cubic<2>{.spacing = spacing}, {.lower = {0.0, 0.0}, .upper = {1.0, 1.0}}),
                   spacing * spacing),
      interaction<Water, Water>(law),
      material<Water>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = v.sound_speed},
                      rheology::Constant{.dynamic_viscosity = v.viscosity}));
  auto& water = result.template group<Water>();
  water.template set<field::Density>([](const auto&) { return 1.0; });
  water.template set<field::Velocity>([](const Vector<2>& x) {
    constexpr double k = 2.0 * std::numbers::pi;
    return Vector<2>(std::sin(k * x[0]) * std::cos(k * x[1]), -std::cos(k * x[0]) * std::sin(k * x[1]));
  });
  return result;
}

}  // namespace test
