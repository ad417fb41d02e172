// expect: dmp: implicit_bonds need integrator::Leapfrog
#include <dmp/dmp.hpp>

namespace {
using namespace dmp;
using namespace dmp::simulation;
struct Bead {};

[[maybe_unused]] auto compose() {
  const geometry::Points<2> points{.positions = {{0.0, 0.0}, {1.0, 0.0}}};
  return scene<integrator::ExtrapolatedVerlet>(geometry::Box<2>::unbounded(), group<Bead>("beads", particles::Mobile{}, points, 1.0),
                                               implicit_bonds<Bead, Bead>(bond::KelvinVoigt{.stiffness = 1.0, .damping = 1.0}, {{0, 1}}));
}
}  // namespace
