// expect: dmp: a pair law reads the pressure term, the sound speed, the viscosity or the conductivity of a group, but no
#include <dmp/dmp.hpp>

namespace {
using namespace dmp;
using namespace dmp::simulation;
struct Water {};
struct Oil {};
[[maybe_unused]] const potential::LennardJones repulsion{.energy_scale = 1.0, .diameter = 1.0, .cutoff = 1.0};

[[maybe_unused]] auto compose() {
  const geometry::Points<2> points{.positions = {{0.0, 0.0}}};
  return scene<integrator::ExtrapolatedVerlet>(geometry::Box<2>::unbounded(), group<Water>("water", particles::Mobile{}, points, 1.0), interaction<Water, Water>(sph::WeaklyCompressible<kernel::Lucy<2>>{.kernel = {.support_radius = 1.0}}));
}
}  // namespace
