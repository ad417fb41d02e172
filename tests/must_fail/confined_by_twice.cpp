// expect: dmp: two confined_by<...> concern the same group; name all its planes in one
#include <dmp/dmp.hpp>

namespace {
using namespace dmp;
using namespace dmp::simulation;
struct Bead {};

[[maybe_unused]] auto compose() {
  const geometry::Points<2> points{.positions = {{0.0, 0.0}, {1.0, 0.0}}};
  const forcing::ContactPlane<2> floor{.normal = {{0.0, 1.0}}, .position = 0.0}, lid{.normal = {{0.0, -1.0}}, .position = -1.0};
  return scene<integrator::Leapfrog>(geometry::Box<2>::unbounded(), group<Bead>("beads", particles::Mobile{}, points, 1.0),
                                     confined_by<Bead>(floor), confined_by<Bead>(lid));
}
}  // namespace
