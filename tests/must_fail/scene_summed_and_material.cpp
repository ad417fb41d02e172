// expect: dmp: summed<Group> sets a property that a law in the materials of the group sets too; leave one of them out
#include <dmp/dmp.hpp>

namespace {
using namespace dmp;
using namespace dmp::simulation;
struct Water {};
const geometry::Points<2> points{.positions = {{0.0, 0.0}}};
struct Incompressible {
  using reads = Fields<>;
  using writes = Fields<field::Density>;
  void apply(auto& particle) const { particle.density = 1.0; }
};
void validate(const Incompressible&) {}

[[maybe_unused]] auto compose() {
  return scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>::unbounded(), group<Water>("water", particles::Mobile{}, points, 1.0),
      interaction<Water, Water>(sph::WeaklyCompressible<kernel::Lucy<2>>{.kernel = {.support_radius = 1.0}}),
      summed<Water>(sph::DensitySum<kernel::Quartic<2>>{.kernel = {.support_radius = 1.0}}),
      material<Water>(Incompressible{}, eos::Tait{.rest_density = 1.0, .sound_speed_0 = 1.0}));
}
}  // namespace
