// expect: dmp: find_sums: a frozen group, or one without interactions, has no lists of neighbours
#include <dmp/dmp.hpp>

struct Water {};
struct Wall {};

int main() {
  using namespace dmp;
  const geometry::Points<2> points{.positions = {{0.5, 0.5}}, .spacing = 0.0, .volume = 1.0}, wall{.positions = {{0.5, 1.5}}, .spacing = 0.0, .volume = 1.0};
  const sph::WeaklyCompressible<kernel::Lucy<2>> law{.kernel = {.support_radius = 1.5}};
  auto scene = simulation::scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>::unbounded(), simulation::group<Water>("water", particles::Mobile{}, points, 1.0),
      simulation::group<Wall>("wall", particles::Frozen<2>{}, wall, 1.0), simulation::interaction<Water, Wall>(law),
      simulation::material<Water, Wall>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 10.0}));
  return static_cast<int>(scene.find_sums<Wall>(sph::DensitySum<kernel::Lucy<2>>{.kernel = {.support_radius = 1.5}}).size());
}
