// expect: dmp: summed<Group>: nothing changes in a frozen group; make it stationary
#include <dmp/dmp.hpp>

namespace {
using namespace dmp;
using namespace dmp::simulation;
struct Water {};
struct Wall {};
const geometry::Points<2> points{.positions = {{0.0, 0.0}}};

[[maybe_unused]] auto compose() {
  const sph::WeaklyCompressible<kernel::Lucy<2>> law{.kernel = {.support_radius = 1.0}};
  return scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>::unbounded(), group<Water>("water", particles::Mobile{}, points, 1.0), group<Wall>("wall", particles::Frozen<2>{}, points, 1.0),
      interaction<Water, Wall>(law), summed<Water, Wall>(sph::DensitySum<kernel::Quartic<2>>{.kernel = {.support_radius = 1.0}}),
      material<Water, Wall>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 1.0}));
}
}  // namespace
