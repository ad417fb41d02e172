// expect: dmp: summed<Group>: no interaction of a law that knows the density joins the group to any
#include <dmp/dmp.hpp>

namespace {
using namespace dmp;
using namespace dmp::simulation;
struct Water {};
const geometry::Points<2> points{.positions = {{0.0, 0.0}}};

[[maybe_unused]] auto compose() {
  return scene<integrator::ExtrapolatedVerlet>(geometry::Box<2>::unbounded(), group<Water>("water", particles::Mobile{}, points, 1.0),
                                               summed<Water>(sph::DensitySum<kernel::Quartic<2>>{.kernel = {.support_radius = 1.0}}));
}
}  // namespace
