// expect: dmp: relax: a group has a state with a rate
#include <dmp/dmp.hpp>

namespace {
using namespace dmp;
using namespace dmp::simulation;
struct Water {};

[[maybe_unused]] void compose() {
  const geometry::Points<2> points{.positions = {{0.0, 0.0}, {1.0, 0.0}}};
  const sph::WeaklyCompressible<kernel::WendlandC2<2>, viscosity::None> law{.kernel = {.support_radius = 2.6}};
  auto pair = scene<integrator::Leapfrog>(geometry::Box<2>::unbounded(), group<Water>("water", particles::Mobile{}, points, 1.0),
                                          interaction<Water, Water>(law), material<Water>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 10.0}));
  relax(pair, {.force_tolerance = 1e-9});
}
}  // namespace
