// expect: dmp: confined_by: only mobile groups make way for a plane
#include <dmp/dmp.hpp>

namespace {
using namespace dmp;
using namespace dmp::simulation;
struct Bead {};

[[maybe_unused]] auto compose() {
  const geometry::Points<2> points{.positions = {{0.0, 0.0}, {1.0, 0.0}}};
  return scene<integrator::Leapfrog>(geometry::Box<2>::unbounded(), group<Bead>("beads", particles::Stationary{}, points, 1.0),
                                     confined_by<Bead>(forcing::ContactPlane<2>{.normal = {{0.0, 1.0}}, .position = 0.0}));
}
}  // namespace
