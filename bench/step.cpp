// A whole step of 3D weakly compressible SPH (Wendland C2, support 2.6 spacings, artificial viscosity, periodic box) and its parts:
// neighbour lists with sorting and ghosts, and the step between two list builds. ns/particle counts one step of one particle.
#include <cmath>
#include <cstdint>
#include <benchmark/benchmark.h>
#include <dmp/dmp.hpp>

#include "lattice.hpp"

namespace {

using namespace dmp;
using namespace dmp::simulation;
using Law = sph::WeaklyCompressible<kernel::WendlandC2<3>, viscosity::Artificial>;
struct Water {};

auto fluid(int n) {
  geometry::Points<3> points{.positions = bench::jittered_lattice(n), .spacing = 0.0, .volume = 1.0};
  const double size = n;
  auto result = scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<3>{.lower = {0.0, 0.0, 0.0}, .upper = {size, size, size}, .periodic = {true, true, true}},
      group<Water>("water", particles::Mobile{}, std::move(points), 1.0),
      interaction<Water, Water>(Law{.kernel = {.support_radius = 2.6}, .viscosity = {.alpha = 0.1, .sound_speed = 10.0}}),
      material<Water>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 10.0}));
  result.template group<Water>().template set<field::Density>([](const auto&) { return 1.0; });
  return result;
}

void per_particle(benchmark::State& state, std::size_t particles, std::uint64_t steps) {
  state.counters["ns/particle"] =
      benchmark::Counter(1e-9 * static_cast<double>(particles) * static_cast<double>(steps), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void whole_steps(benchmark::State& state) {
  use_threads(static_cast<int>(state.range(1)));
  auto scene = fluid(static_cast<int>(state.range(0)));
  scene.run({.until = 5.0 * scene.step_limit().time_step});  // first lists, first forces
  std::uint64_t steps = 0;
  for (auto _ : state) steps += scene.run({.until = scene.time() + 20.0 * 0.05}).steps;
  per_particle(state, scene.particles(), steps);
  state.counters["bytes/particle"] = bytes_per_particle(scene);
  state.counters["list builds/step"] = static_cast<double>(scene.engine().list_builds()) / static_cast<double>(scene.step());
}

void list_build(benchmark::State& state) {
  use_threads(1);
  auto scene = fluid(static_cast<int>(state.range(0)));
  (void)scene.step_limit();
  std::uint64_t builds = 0;
  for (auto _ : state) {
    scene.engine().build_lists();
    ++builds;
  }
  per_particle(state, scene.particles(), builds);
}

void forces(benchmark::State& state) {
  use_threads(1);
  auto scene = fluid(static_cast<int>(state.range(0)));
  (void)scene.step_limit();
  std::uint64_t steps = 0;
  for (auto _ : state) {
    scene.engine().finish_step(0.0, 0.0);
    ++steps;
  }
  per_particle(state, scene.particles(), steps);
}

}  // namespace

BENCHMARK(forces)->Arg(50)->Unit(benchmark::kMillisecond);
BENCHMARK(list_build)->Arg(50)->Unit(benchmark::kMillisecond);
BENCHMARK(whole_steps)->Args({22, 1})->Args({50, 1})->Args({50, 2})->Args({50, 4})->Unit(benchmark::kMillisecond)->UseRealTime();
