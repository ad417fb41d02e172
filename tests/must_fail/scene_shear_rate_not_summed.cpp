// expect: dmp: a law reads the shear rate of a group, but nothing sets it; add summed<Group>(sph::ShearRate<...>{...})
#include <dmp/dmp.hpp>

namespace {
using namespace dmp;
using namespace dmp::simulation;
struct Water {};
const geometry::Points<2> points{.positions = {{0.0, 0.0}}};
struct Thinning {
  double mu;
  auto apparent_viscosity(const auto& shear_rate) const { return mu / (1.0 + shear_rate); }
};
void validate(const Thinning&) {}

[[maybe_unused]] auto compose() {
  return scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>::unbounded(), group<Water>("water", particles::Mobile{}, points, 1.0),
      interaction<Water, Water>(sph::WeaklyCompressible<kernel::Lucy<2>, viscosity::Morris<>>{.kernel = {.support_radius = 1.0}}),
      material<Water>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 1.0}, Thinning{1.0}));
}
}  // namespace
