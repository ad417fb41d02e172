// expect: dmp: not a TensileCorrection: no `void validate(const C&)`, which throws ParameterError on bad parameters
#include <dmp/tensile/concept.hpp>

namespace {
struct Repulsion {
  using reads = dmp::Fields<dmp::field::PressureTerm>;
  double strength;
  template <class Pair, class I, class J, class Kernel>
  auto correction(const Pair& pair, const I&, const J&, const Kernel& kernel) const {
    return strength * kernel.value(pair.distance);
  }
};
}  // namespace

static_assert(dmp::tensile::explain_tensile_correction<Repulsion>());
