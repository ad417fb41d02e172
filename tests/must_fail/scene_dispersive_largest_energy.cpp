// expect: dmp: bond::Dispersive: the energy of a bond depends on the strains of all bonds at its ends
#include <dmp/dmp.hpp>

namespace {
using namespace dmp;
using namespace dmp::simulation;
struct Bead {};

[[maybe_unused]] auto compose() {
  return bonds<Bead, Bead>(bond::Breaking{bond::Dispersive{.stiffness = 1.0, .dispersive_share = 0.5}, bond::LargestEnergy{.energy = 0.1}},
                           {{0, 1}});
}
}  // namespace
