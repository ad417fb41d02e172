// Scene::restart: any checkpoint, with CRCs put right, is refused with a CheckpointError and changes nothing, or can be run: to finite
// values or to an error.
#include <string>
#include <dmp/dmp.hpp>
#include "fuzz/checkpoint.hpp"

namespace {

using namespace dmp;
using namespace dmp::simulation;

struct Water {};
struct Beads {};

/// Four particles of a liquid in a box that is periodic one way, and three on bonds with a memory.
auto small_scene() {
  using Flow = sph::WeaklyCompressible<kernel::WendlandC2<2>, viscosity::Morris<>>;
  const geometry::Points<2> water{.positions = {{0.1, 0.1}, {0.2, 0.1}, {0.1, 0.2}, {0.2, 0.2}}, .spacing = 0.1, .volume = 0.01};
  const geometry::Points<2> beads{.positions = {{0.5, 0.1}, {0.6, 0.1}, {0.6, 0.2}}};
  const Flow flow{.kernel = {.support_radius = 0.26}};
  const geometry::Box<2> box{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {true, false}};
  return scene<integrator::ExtrapolatedVerlet>(
      box, group<Water>("water", particles::Mobile{}, water, 0.01), group<Beads>("beads", particles::Mobile{}, beads, 0.01),
      interaction<Water, Water>(flow), interaction<Water, Beads>(flow),
      bonds<Beads, Beads>(bond::Maxwell{.stiffness = 1.0, .damping = 0.1}, {{0, 1}, {1, 2}}),
      material<Water, Beads>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 10.0}, rheology::Constant{.dynamic_viscosity = 0.01}));
}

}  // namespace

void fuzz::write_start(const std::string& path) {
  auto scene = small_scene();
  scene.run({.until = 1e-3});
  scene.checkpoint(path);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::MemoryFile file;
  file.write(data, size);
  auto scene = small_scene();
  try {
    scene.restart(file.path());
  } catch (const io::CheckpointError& error) {
    fuzz::require_named(error, file);
    fuzz::require(scene.time() == 0.0 && scene.step() == 0, "a refused checkpoint must change nothing");
    return 0;
  }
  try {
    scene.run({.until = scene.time() + 1e-3, .time_step = 2e-4, .check_every = 3});
    fuzz::require(find_fault(scene.engine()).what.empty(), "a run must end with finite values");
  } catch (const SimulationError&) {
  } catch (const ParameterError&) {
  }
  return 0;
}
