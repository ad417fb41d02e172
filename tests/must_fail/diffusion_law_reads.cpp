// expect: dmp: not a DiffusionLaw: no `using reads = Fields<...>;`, the fields it reads of both particles
#include <dmp/diffusion/concept.hpp>

namespace {
struct Blur {
  template <class Pair, class I, class J>
  auto flux(const Pair&, const I& i, const J& j, double support_radius) const {
    return support_radius * (i.density - j.density) / j.density;
  }
};
void validate(const Blur&) {}
}  // namespace

static_assert(dmp::diffusion::explain_diffusion<Blur>());
