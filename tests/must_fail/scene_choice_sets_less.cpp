// expect: dmp: one of the laws to be chosen from in the materials of a group sets a property that another does not set, and a law reads it
#include <variant>
#include <dmp/dmp.hpp>

namespace {
using namespace dmp;
using namespace dmp::simulation;
struct Water {};
const geometry::Points<2> points{.positions = {{0.0, 0.0}}};
struct Still {
  using reads = Fields<>;
  using writes = Fields<field::SoundSpeed>;
  void apply(auto& particle) const { particle.sound_speed = 1.0; }
};
void validate(const Still&) {}

[[maybe_unused]] auto compose() {
  using Choice = std::variant<eos::Tait, Still>;
  return scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>::unbounded(), group<Water>("water", particles::Mobile{}, points, 1.0),
      interaction<Water, Water>(sph::WeaklyCompressible<kernel::Lucy<2>>{.kernel = {.support_radius = 1.0}}), material<Water>(Choice(Still{})));
}
}  // namespace
