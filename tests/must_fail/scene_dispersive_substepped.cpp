// expect: dmp: substepped_bonds: bonds with a dispersive share need the strains of all bonds of their ends anew in each sub-step
#include <dmp/dmp.hpp>

namespace {
using namespace dmp;
using namespace dmp::simulation;
struct Bead {};

[[maybe_unused]] auto compose() {
  return substepped_bonds<Bead, Bead>(bond::Dispersive{.stiffness = 1.0, .dispersive_share = 0.5}, {{0, 1}});
}
}  // namespace
