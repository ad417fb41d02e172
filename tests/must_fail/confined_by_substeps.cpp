// expect: dmp: confined_by: where the particles of a group with sub-stepped bonds will be is not known
#include <dmp/dmp.hpp>

namespace {
using namespace dmp;
using namespace dmp::simulation;
struct Bead {};

[[maybe_unused]] auto compose() {
  const geometry::Points<2> points{.positions = {{0.0, 0.0}, {1.0, 0.0}}};
  return scene<integrator::Leapfrog>(geometry::Box<2>::unbounded(), group<Bead>("beads", particles::Mobile{}, points, 1.0),
                                     substepped_bonds<Bead, Bead>(bond::Harmonic{.stiffness = 1.0}, {{0, 1}}),
                                     confined_by<Bead>(forcing::ContactPlane<2>{.normal = {{0.0, 1.0}}, .position = 0.0}));
}
}  // namespace
