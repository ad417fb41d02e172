// A whole step of 3D weakly compressible SPH (Wendland C2, support h = 2.6 spacings, artificial viscosity, Tait's equation, periodic box)
// and its parts: the sweep over the pairs, the building of neighbour lists with sorting and ghosts, and the passes over the particles. The
// flow is a row of vortices of speed c0/10; the step is 0.1 h/c0. ns/particle counts one step of one particle.
#include <cmath>
#include <cstdint>
#include <ctime>
#include <numbers>
#include <benchmark/benchmark.h>
#include <dmp/dmp.hpp>

#include "lattice.hpp"

namespace {

using namespace dmp;
using namespace dmp::simulation;
using Law = sph::WeaklyCompressible<kernel::WendlandC2<3>, viscosity::Artificial>;
struct Water {};

constexpr double support_radius = 2.6, sound_speed = 10.0, time_step = 0.1 * support_radius / sound_speed;

/// n^3 particles; skin as a fraction of the support.
auto fluid(int n, double skin) {
  geometry::Points<3> points{.positions = bench::jittered_lattice(n), .spacing = 1.0, .volume = 1.0};
  const double size = n;
  auto result = scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<3>{.lower = {0.0, 0.0, 0.0}, .upper = {size, size, size}, .periodic = {true, true, true}},
      group<Water>("water", particles::Mobile{}, std::move(points), 1.0),
      interaction<Water, Water>(Law{.kernel = {.support_radius = support_radius}, .viscosity = {.alpha = 0.1, .sound_speed = sound_speed}}),
      material<Water>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = sound_speed}));
  auto& water = result.template group<Water>();
  water.template set<field::Density>([](const auto&) { return 1.0; });
  water.template set<field::Velocity>([k = 2.0 * std::numbers::pi / size](const Vector<3>& x) {
    return Vector<3>(std::sin(k * x[0]) * std::cos(k * x[1]), -std::cos(k * x[0]) * std::sin(k * x[1]), 0.0);
  });
  if (skin > 0.0) result.set_skin(skin * support_radius);
  result.run({.until = 20.0 * time_step, .time_step = time_step});  // first lists, first forces; the lattice is gone
  return result;
}

void per_particle(benchmark::State& state, std::size_t particles, std::uint64_t steps) {
  state.counters["ns/particle"] = benchmark::Counter(1e-9 * static_cast<double>(particles) * static_cast<double>(steps),
                                                     benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// Arguments: particles along a side, threads.
void whole_step(benchmark::State& state) {
  use_threads(static_cast<int>(state.range(1)));
  auto scene = fluid(static_cast<int>(state.range(0)), 0.0);
  const std::uint64_t first_step = scene.step(), first_builds = scene.engine().list_builds();
  std::uint64_t steps = 0;
  for (auto _ : state) steps += scene.run({.until = scene.time() + 40.0 * time_step, .time_step = time_step}).steps;
  per_particle(state, scene.particles(), steps);
  state.counters["bytes/particle"] = bytes_per_particle(scene);
  state.counters["list builds/step"] =
      static_cast<double>(scene.engine().list_builds() - first_builds) / static_cast<double>(scene.step() - first_step);
}

/// The steps of Scene::run, without its checks, and where their time goes. They run from one building of lists to another, so that lists of
/// all ages are read and each is paid for once. Processor time, of one thread. Arguments: particles along a side, skin in thousandths of
/// the support (0: as a scene chooses it).
void parts_of_step(benchmark::State& state) {
  use_threads(1);
  auto scene = fluid(static_cast<int>(state.range(0)), 1e-3 * static_cast<double>(state.range(1)));
  auto& engine = scene.engine();
  std::clock_t lists = 0, sweep = 0, rest = 0;
  std::uint64_t steps = 0, builds = 0;
  double time = scene.time() + time_step;
  bool worn = engine.begin_step(time_step, time);
  const auto step = [&] {
    const std::clock_t start = std::clock();
    if (worn) engine.build_lists();
    const std::clock_t listed = std::clock();
    engine.prepare_forces(time_step, 0, worn);
    engine.forces(time_step, time);
    const std::clock_t swept = std::clock();
    time += time_step;
    worn = engine.go_on(time_step, time_step, time);
    lists += listed - start, sweep += swept - listed, rest += std::clock() - swept;
    ++steps;
  };
  while (!worn) step();
  lists = sweep = rest = 0;
  steps = 0;
  for (auto _ : state) {
    for (int list = 0; list < 3; ++list, ++builds) {
      step();  // the one that builds
      while (!worn) step();
    }
  }
  const auto nanoseconds = [&](std::clock_t time_of_all) {
    return 1e9 * static_cast<double>(time_of_all) / CLOCKS_PER_SEC / (static_cast<double>(scene.particles()) * static_cast<double>(steps));
  };
  state.counters["sweep ns"] = nanoseconds(sweep);
  state.counters["lists ns"] = nanoseconds(lists);
  state.counters["rest ns"] = nanoseconds(rest);
  state.counters["bytes/particle"] = bytes_per_particle(scene);
  state.counters["list builds/step"] = static_cast<double>(builds) / static_cast<double>(steps);
}

}  // namespace

BENCHMARK(parts_of_step)
    ->Args({50, 0})
    ->Args({50, 50})
    ->Args({50, 100})
    ->Args({50, 125})
    ->Args({50, 175})
    ->Args({50, 200})
    ->Args({50, 300})
    ->Args({100, 0})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(whole_step)
    ->Args({22, 1})
    ->Args({50, 1})
    ->Args({100, 1})
    ->Args({160, 1})
    ->Args({63, 1})
    ->Args({63, 2})
    ->Args({63, 4})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
