// expect: dmp: not a material law: neither an EquationOfState, nor a ThermalLaw, nor a viscosity(temperature), nor an apparent_viscosity(shear_rate), nor a ParticleLaw
#include <dmp/sweep/particle_law.hpp>

namespace {
struct Paint {
  using reads = dmp::Fields<dmp::field::Density>;
  void apply(auto&) const {}
};
}  // namespace

static_assert(dmp::sweep::explain_particle_law<Paint>());
