// expect: dmp: two laws in the materials of a group set the same property; leave one of them out
#include <dmp/dmp.hpp>

namespace {
using namespace dmp;
using namespace dmp::simulation;
struct Water {};
const geometry::Points<2> points{.positions = {{0.0, 0.0}}};

[[maybe_unused]] auto compose() {
  return scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>::unbounded(), group<Water>("water", particles::Mobile{}, points, 1.0),
      interaction<Water, Water>(sph::WeaklyCompressible<kernel::Lucy<2>>{.kernel = {.support_radius = 1.0}}),
      material<Water>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 1.0}), material<Water>(eos::Linear{.rest_density = 1.0, .sound_speed_0 = 1.0}));
}
}  // namespace
