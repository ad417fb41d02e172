// expect: dmp: a law in the materials of a group reads a property that a later one sets (a viscosity of temperature before the law
#include <dmp/dmp.hpp>

namespace {
using namespace dmp;
using namespace dmp::simulation;
struct Water {};
const geometry::Points<2> points{.positions = {{0.0, 0.0}}};
struct Caloric {
  double c;
  auto temperature(const auto& e) const { return e * (1.0 / c); }
  auto specific_energy(const auto& temperature) const { return c * temperature; }
  double specific_heat() const { return c; }
};
void validate(const Caloric&) {}
struct Arrhenius {
  double c1, c2;
  auto viscosity(const auto& temperature) const { return c1 * exp(c2 / temperature); }
};
void validate(const Arrhenius&) {}

[[maybe_unused]] auto compose() {
  return scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>::unbounded(), group<Water>("water", particles::Mobile{}, points, 1.0),
      interaction<Water, Water>(sph::Compressible<kernel::Lucy<2>, viscosity::Morris<>>{.kernel = {.support_radius = 1.0}}),
      material<Water>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 1.0}, Arrhenius{1e-4, 1800.0}, Caloric{4000.0}));
}
}  // namespace
