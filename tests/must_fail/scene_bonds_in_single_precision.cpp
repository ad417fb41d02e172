// expect: dmp: bond laws are evaluated in double only: a scene with bonds needs precision::Double
#include <dmp/dmp.hpp>

namespace {
using namespace dmp;
using namespace dmp::simulation;
struct Bead {};

[[maybe_unused]] auto compose() {
  const geometry::Points<2> points{.positions = {{0.0, 0.0}, {1.0, 0.0}}};
  return scene<integrator::Leapfrog, precision::Single>(geometry::Box<2>::unbounded(), group<Bead>("beads", particles::Mobile{}, points, 1.0),
                                                        bonds<Bead, Bead>(bond::Harmonic{.stiffness = 1.0}, {{0, 1}}));
}
}  // namespace
