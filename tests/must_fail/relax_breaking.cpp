// expect: dmp: relax: bonds that break would do so on the way to the minimum
#include <dmp/dmp.hpp>

namespace {
using namespace dmp;
using namespace dmp::simulation;
struct Bead {};

[[maybe_unused]] void compose() {
  const geometry::Points<2> points{.positions = {{0.0, 0.0}, {1.0, 0.0}}};
  auto pair = scene<integrator::Leapfrog>(
      geometry::Box<2>::unbounded(), group<Bead>("beads", particles::Mobile{}, points, 1.0),
      bonds<Bead, Bead>(bond::Breaking{bond::Harmonic{.stiffness = 1.0}, bond::LargestStrain{.strain = 0.1}}, {{0, 1}}));
  relax(pair, {.force_tolerance = 1e-9});
}
}  // namespace
