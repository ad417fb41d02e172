// The bond sweep of a spring lattice: cubic, springs to the 6 nearest and 12 next-nearest particles, 125 000 particles, one core. Composed
// from the bond law, by particle; and a plain scalar loop over bonds that writes both ends, as the classic codes do. ns/bond counts every
// bond once in both. `bond_step` is the whole step of a scene of them.
#include <array>
#include <cmath>
#include <random>
#include <vector>
#include <benchmark/benchmark.h>
#include <dmp/dmp.hpp>

namespace {

using namespace dmp;
using sweep::Lanes;
using Record = Fields<field::Position>;

struct Lattice {
  static constexpr int n = 50;
  std::vector<Vector<3>> positions;
  std::vector<neighbours::Bond> bonds;
  neighbours::BondList list;
  Blocks blocks;
  particles::Records<3, Record> records;
  particles::Sums<3, Fields<field::Force>> sums;
  std::vector<Vector<3>> force;

  Lattice() {
    std::mt19937 generator(2);
    std::uniform_real_distribution<double> jitter(-0.002, 0.002);
    const auto row = [](int i, int j, int k) { return static_cast<std::uint32_t>((k * n + j) * n + i); };
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          positions.emplace_back(i + jitter(generator), j + jitter(generator), k + jitter(generator));
          constexpr std::array<std::array<int, 3>, 9> steps{
              {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}}};
          for (const auto& step : steps) {
            const int a = i + step[0], b = j + step[1], c = k + step[2];
            if (a < 0 || b < 0 || c < 0 || a >= n || b >= n || c >= n) continue;
            bonds.push_back(
                {row(i, j, k), row(a, b, c), std::sqrt(static_cast<double>(step[0] * step[0] + step[1] * step[1] + step[2] * step[2]))});
          }
        }
    use_threads(1);
    blocks = Blocks(positions.size());
    list.build(blocks, bonds, true, false, Lanes::width,
               {particles::Records<3, Record>::stride, particles::Sums<3, Fields<field::Force>>::stride});
    records.resize(positions.size());
    sums.resize(blocks.far_row(blocks.size()));
    sums.set_zero(0, sums.size());
    force.resize(positions.size());
  }
};

Lattice& lattice() {
  static Lattice result;
  return result;
}

void report(benchmark::State& state) {
  const Lattice& l = lattice();
  state.counters["ns/bond"] = benchmark::Counter(1e-9 * static_cast<double>(l.bonds.size()) * static_cast<double>(state.iterations()),
                                                 benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  double checksum = 0.0;
  for (const auto& f : l.force) checksum += f.squaredNorm();
  state.counters["checksum"] = checksum;
}

void bond_sweep_composed(benchmark::State& state) {
  Lattice& l = lattice();
  const bond::Harmonic law{.stiffness = 100.0};
  using Row = sweep::Row<3>;
  constexpr int stride = particles::Records<3, Record>::stride;  // of the sums too, a vector each
  for (auto _ : state) {
    for (std::size_t i = 0; i < l.positions.size(); ++i) {  // the record pass belongs to the sweep
      View<3, double, Record> record;
      record.position = to_components<3>(l.positions[i]);
      l.records.store(i, record);
    }
    const auto react = [sums = l.sums.data()](std::size_t at, Lanes factor, const Row& vector) __attribute__((always_inline)) {
      Row::load(sums + at).plus(factor, vector).store(sums + at);
    };
    for (std::size_t block = 0; block < l.blocks.size(); ++block) {
      for (std::size_t i = l.blocks.begin(block); i < l.blocks.end(block); ++i) {
        const sweep::BondRecords records{l.records.data() + i * stride, l.records.data()};
        react(i * stride, 1.0, sweep::sum_bonds<3, false, true>(records, l.list.of(i), {}, react, law));
      }
      for (std::size_t i = l.blocks.begin(block); i < l.blocks.end(block); ++i) {  // a bond may be listed at either end
        View<3, Lanes, Fields<field::Force>> none;
        sweep::set_zero(none);
        l.force[i] = to_vector<3>(l.sums.take(i, none).force);
      }
    }
  }
  report(state);
}

void bond_sweep_scalar(benchmark::State& state) {
  Lattice& l = lattice();
  for (auto _ : state) {
    std::fill(l.force.begin(), l.force.end(), Vector<3>::Zero());
    for (const auto& bond : l.bonds) {
      const Vector<3> apart = l.positions[bond.i] - l.positions[bond.j];
      const double length = apart.norm(), pull = -100.0 * (length - bond.rest_length) / length;
      l.force[bond.i] += pull * apart;
      l.force[bond.j] -= pull * apart;
    }
  }
  report(state);
}

/// Whole steps of the same body as a scene: sweep, integration, records, and the checks that a run makes.
void bond_step(benchmark::State& state) {
  using namespace simulation;
  struct Bead {};
  const Lattice& l = lattice();
  auto body = scene<integrator::Leapfrog>(geometry::Box<3>::unbounded(),
                                          group<Bead>("beads", particles::Mobile{}, geometry::Points<3>{l.positions}, 1.0),
                                          bonds<Bead, Bead>(bond::Harmonic{.stiffness = 100.0}, l.bonds));
  constexpr double time_step = 0.01;
  constexpr int steps = 100;
  body.run({.until = time_step, .time_step = time_step});
  for (auto _ : state) body.run({.until = body.time() + steps * time_step, .time_step = time_step});
  state.counters["ns/bond"] =
      benchmark::Counter(1e-9 * steps * static_cast<double>(l.bonds.size()) * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

}  // namespace

BENCHMARK(bond_step)->Unit(benchmark::kMillisecond);
BENCHMARK(bond_sweep_composed)->Unit(benchmark::kMillisecond);
BENCHMARK(bond_sweep_scalar)->Unit(benchmark::kMillisecond);
