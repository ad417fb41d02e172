// expect: dmp: not a TensileCorrection: it has parameters but no `T correction(pair, i, j, kernel) const` [Pa m^6/kg^2]
#include <dmp/tensile/concept.hpp>

namespace {
struct Repulsion {
  using reads = dmp::Fields<dmp::field::PressureTerm>;
  double strength;
  template <class Pair, class I, class J, class Kernel>
  auto corection(const Pair& pair, const I&, const J&, const Kernel& kernel) const {
    return strength * kernel.value(pair.distance);
  }
};
}  // namespace

static_assert(dmp::tensile::explain_tensile_correction<Repulsion>());
