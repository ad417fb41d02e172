// expect: dmp: not a ViscosityLaw: no `double damping_rate(nu, support_radius, radial_factor_integral, dimension) const` [1/s]
#include <dmp/viscosity/concept.hpp>

namespace {
struct Sticky {
  using reads = dmp::Fields<dmp::field::Density>;
  template <class Pair, class I, class J>
  auto along_velocity(const Pair&, const I& i, const J& j) const {
    return 1.0 / (i.density * j.density);
  }
};
void validate(const Sticky&) {}
}  // namespace

static_assert(dmp::viscosity::explain_viscosity<Sticky>());
