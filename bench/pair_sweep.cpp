// The pair sweep of 3D weakly compressible SPH (Wendland C2, support 2.6 spacings, about 72 neighbours, Monaghan's artificial viscosity), one
// core, double: composed from policies; the same formulas written by hand over the same records; and a plain scalar loop. The counter
// ns/pair is per directed pair, as in the yardstick's output.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>
#include <benchmark/benchmark.h>
#include <dmp/dmp.hpp>

#include "lattice.hpp"

namespace {

using namespace dmp;
using Lanes = sweep::Lanes;
using Law = sph::WeaklyCompressible<kernel::WendlandC2<3>, viscosity::Artificial>;
using Record = Fields<field::Position, field::Velocity, field::Density, field::PressureTerm>;

constexpr double support_radius = 2.6, sound_speed = 10.0, alpha = 0.1, mass = 1.0;

/// Particles, their records and full lists, all of one size.
struct Sample {
  std::vector<Vector<3>> positions;
  particles::Records<3, Record> records;
  neighbours::PairList pairs;
  Ranges ranges;
  double count = 0.0;  // directed pairs within the support
  std::vector<std::array<double, 4>> rates;

  explicit Sample(int n) : positions(bench::jittered_lattice(n)) {
    neighbours::CellGrid<3> grid;
    grid.build(positions, support_radius);
    std::vector<Vector<3>> sorted;
    for (const std::uint32_t row : grid.order()) sorted.push_back(positions[row]);
    positions = sorted;
    grid.build(positions, support_radius);
    use_threads(1);
    ranges = Ranges(positions.size());
    const auto size = static_cast<std::uint32_t>(positions.size());
    pairs.build<3>(ranges, positions, grid, support_radius, {.same_group = true, .owned = size, .owner = {}}, {}, Lanes::width);
    records.resize(positions.size() + 1);
    std::mt19937 generator(2);
    std::uniform_real_distribution<double> jitter(-0.2, 0.2);
    for (std::size_t i = 0; i <= positions.size(); ++i) {
      View<3, double, Record> record;
      for (int d = 0; d < 3; ++d) {
        record.position[d] = i < positions.size() ? positions[i][d] : 1e30;
        record.velocity[d] = jitter(generator);
      }
      record.density = 1.0 + 0.01 * jitter(generator);
      record.pressure_term = 1e-3 * (1.0 + jitter(generator));
      records.store(i, record);
    }
    for (std::size_t i = 0; i < positions.size(); ++i)
      for (const std::uint32_t j : pairs.of(0, i)) count += j < size ? 1.0 : 0.0;
    rates.resize(positions.size());
  }
};

Sample& sample() {
  static Sample result(50);
  return result;
}

void report(benchmark::State& state) {
  const Sample& s = sample();
  state.counters["neighbours"] = s.count / static_cast<double>(s.positions.size());
  state.counters["ns/pair"] = benchmark::Counter(1e-9 * s.count * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  double checksum = 0.0;
  for (const auto& rate : s.rates)
    for (const double x : rate) checksum += x * x;
  state.counters["checksum"] = checksum;
}

void pair_sweep_composed(benchmark::State& state) {
  Sample& s = sample();
  const Law law{.kernel = {.support_radius = support_radius}, .viscosity = {.alpha = alpha, .sound_speed = sound_speed}};
  const auto source = [&s](const std::uint32_t* index) __attribute__((always_inline)) {
    View<3, Lanes, unite<Record, Fields<field::Mass>>> view;
    copy_fields(Record{}, view, s.records.gather(index));
    view.mass = mass;
    return view;
  };
  for (auto _ : state)
    for (std::size_t i = 0; i < s.positions.size(); ++i) {
      View<3, Lanes, unite<Record, Fields<field::Mass>>> self;
      copy_fields(Record{}, self, s.records.spread<Lanes>(i));
      self.mass = mass;
      View<3, Lanes, Law::writes> sums;
      sweep::set_zero(sums);
      sweep::sum_pairs<3>(self, source, s.pairs.of(0, i), sums, law);
      s.rates[i] = {sum(sums.acceleration[0]), sum(sums.acceleration[1]), sum(sums.acceleration[2]), sum(sums.density_rate)};
    }
  report(state);
}

void pair_sweep_by_hand(benchmark::State& state) {
  Sample& s = sample();
  const double h = support_radius, gradient = -20.0 * 21.0 / (2.0 * std::numbers::pi * h * h * h) / (h * h);
  for (auto _ : state)
    for (std::size_t i = 0; i < s.positions.size(); ++i) {
      const auto p = s.records.spread<Lanes>(i);
      Lanes a[3] = {0.0, 0.0, 0.0}, rate = 0.0;
      const auto neighbours = s.pairs.of(0, i);
      for (std::size_t k = 0; k < neighbours.size(); k += Lanes::width) {
        const auto q = s.records.gather(neighbours.data() + k);
        const Lanes x = p.position[0] - q.position[0], y = p.position[1] - q.position[1], z = p.position[2] - q.position[2];
        const Lanes u = p.velocity[0] - q.velocity[0], v = p.velocity[1] - q.velocity[1], w = p.velocity[2] - q.velocity[2];
        const Lanes r2 = x * x + y * y + z * z, t = max(h - sqrt(r2), 0.0) * (1.0 / h), factor = mass * gradient * t * t * t;
        const Lanes approach = x * u + y * v + z * w;
        const Lanes viscous = -2.0 * alpha * sound_speed * h * min(approach, 0.0) / ((r2 + 0.01 * h * h) * (p.density + q.density));
        const Lanes force = (p.pressure_term + q.pressure_term + viscous) * factor;
        a[0] -= force * x, a[1] -= force * y, a[2] -= force * z, rate += factor * approach;
      }
      s.rates[i] = {sum(a[0]), sum(a[1]), sum(a[2]), sum(rate)};
    }
  report(state);
}

void pair_sweep_scalar(benchmark::State& state) {
  Sample& s = sample();
  const double h = support_radius, gradient = -20.0 * 21.0 / (2.0 * std::numbers::pi * h * h * h) / (h * h);
  const auto size = static_cast<std::uint32_t>(s.positions.size());
  for (auto _ : state)
    for (std::size_t i = 0; i < s.positions.size(); ++i) {
      const auto p = s.records.load(i);
      double a[3] = {0.0, 0.0, 0.0}, rate = 0.0;
      for (const std::uint32_t j : s.pairs.of(0, i)) {
        if (j == size) break;
        const auto q = s.records.load(j);
        const double x = p.position[0] - q.position[0], y = p.position[1] - q.position[1], z = p.position[2] - q.position[2];
        const double u = p.velocity[0] - q.velocity[0], v = p.velocity[1] - q.velocity[1], w = p.velocity[2] - q.velocity[2];
        const double r2 = x * x + y * y + z * z, t = std::max(0.0, 1.0 - std::sqrt(r2) * (1.0 / h)), factor = mass * gradient * t * t * t;
        const double approach = x * u + y * v + z * w;
        const double viscous = -2.0 * alpha * sound_speed * h * std::min(approach, 0.0) / ((r2 + 0.01 * h * h) * (p.density + q.density));
        const double force = (p.pressure_term + q.pressure_term + viscous) * factor;
        a[0] -= force * x, a[1] -= force * y, a[2] -= force * z, rate += factor * approach;
      }
      s.rates[i] = {a[0], a[1], a[2], rate};
    }
  report(state);
}

}  // namespace

BENCHMARK(pair_sweep_composed)->Unit(benchmark::kMillisecond);
BENCHMARK(pair_sweep_by_hand)->Unit(benchmark::kMillisecond);
BENCHMARK(pair_sweep_scalar)->Unit(benchmark::kMillisecond);
