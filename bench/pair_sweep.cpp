// The pair sweep of 3D weakly compressible SPH (Wendland C2, support 2.6 spacings, about 72 neighbours, Monaghan's artificial viscosity),
// one core, records in double and in single precision: composed from policies, and the same formulas written by hand over the same records
// and lists. The counter ns/pair is per directed pair, as in the yardstick's output.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <vector>
#include <benchmark/benchmark.h>
#include <dmp/dmp.hpp>

#include "lattice.hpp"

namespace {

using namespace dmp;
using Law = sph::WeaklyCompressible<kernel::WendlandC2<3>, viscosity::Artificial>;
using Record = Fields<field::Position, field::Velocity, field::Density, field::PressureTerm>;

constexpr double support_radius = 2.6, sound_speed = 10.0, alpha = 0.1, mass = 1.0;

/// Particles in blocks, their records and lists, all of one size.
template <class Precision>
struct Sample {
  using Records = particles::Records<3, Record, Precision>;
  using Lanes = typename Records::Lanes;
  std::vector<Vector<3>> positions;
  Records records;
  particles::Sums<3, Law::writes> sums;
  neighbours::PairList pairs;
  Blocks blocks;
  double count = 0.0;  // directed pairs within the support
  std::vector<std::array<double, 4>> rates;

  explicit Sample(int n) {
    use_threads(1);
    const auto unsorted = bench::jittered_lattice(n);
    neighbours::SpatialOrder<3> order;
    order.build(unsorted, 0.5 * support_radius, std::pow(0.5 * support_radius, 3));
    for (const std::uint32_t row : order.rows()) positions.push_back(unsorted[row]);
    blocks.set_bounds(order.bounds());
    neighbours::CellGrid<3> grid;
    grid.build(positions, 0.8 * support_radius);
    const auto size = static_cast<std::uint32_t>(positions.size()), all = static_cast<std::uint32_t>(blocks.far_row(blocks.size()));
    pairs.build<3>(blocks, positions, grid, support_radius, 0.0,
                   {.same_group = true, .owned = size, .first_ghost = all, .owner = {}, .once = Precision::pairs_once}, {}, Lanes::width);
    records.resize(all);
    records.set_frame({Vector<3>::Constant(0.5 * n), 2.0 * n});
    sums.resize(all);
    sums.set_zero(0, all);
    std::mt19937 generator(2);
    std::uniform_real_distribution<double> jitter(-0.2, 0.2);
    for (std::size_t i = 0; i < all; ++i) {
      View<3, double, Record> record;
      for (int d = 0; d < 3; ++d) {
        record.position[d] = i < size ? positions[i][d] : 1e30;  // the others are far away from everything
        record.velocity[d] = jitter(generator);
      }
      record.density = 1.0 + 0.01 * jitter(generator);
      record.pressure_term = 1e-3 * (1.0 + jitter(generator));
      records.store(i, record);
    }
    for (const auto& x : positions) {
      neighbours::Found found;
      grid.find(x, support_radius, found);
      count += static_cast<double>(found.size) - 1.0;
    }
    rates.resize(positions.size());
  }
  /// Calls sweep(i, lists of i, first row of its block, adder of the sums counted from there) for all particles. Inlined for either sweep,
  /// so that both know their constants.
  template <class Sweep>
  [[gnu::always_inline]] void for_each(const Sweep& sweep) {
    for (std::size_t block = 0; block < blocks.size(); ++block)
      for (std::size_t i = blocks.begin(block); i < blocks.end(block); ++i)
        sweep(i, pairs.of(block, i), blocks.begin(block), sums.adder().from(blocks.begin(block)));
  }
};

template <class Precision>
Sample<Precision>& sample() {
  static Sample<Precision> result(50);
  return result;
}

template <class Precision>
void report(benchmark::State& state) {
  const auto& s = sample<Precision>();
  state.counters["neighbours"] = s.count / static_cast<double>(s.positions.size());
  state.counters["ns/pair"] = benchmark::Counter(1e-9 * s.count * static_cast<double>(state.iterations()),
                                                 benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  double checksum = 0.0;
  for (const auto& rate : s.rates)
    for (const double x : rate) checksum += x * x;
  state.counters["checksum"] = checksum;
}

/// Records with the mass that all particles have in common.
template <class Precision>
struct Source {
  using Lanes = typename Sample<Precision>::Lanes;
  using Seen = View<3, Lanes, unite<Record, Fields<field::Mass>>>;
  typename Sample<Precision>::Records::Reader records;

  [[gnu::always_inline]] Source from(std::size_t row) const noexcept { return {records.from(row)}; }
  [[gnu::always_inline]] Seen gather(const std::uint32_t* index) const noexcept {
    Seen view;
    copy_fields(Record{}, view, records.gather(index));
    view.mass = mass;
    return view;
  }
  [[gnu::always_inline]] auto separation(const Components<3, Lanes>& i, const Components<3, Lanes>& j) const noexcept {
    return records.separation(i, j);
  }
};

template <class Precision>
void pair_sweep_composed(benchmark::State& state) {
  auto& s = sample<Precision>();
  using Lanes = typename Sample<Precision>::Lanes;
  using Seen = typename Source<Precision>::Seen;
  const Law law{.kernel = {.support_radius = support_radius}, .viscosity = {.alpha = alpha, .sound_speed = sound_speed}};
  const Source<Precision> source{s.records.reader()};
  for (auto _ : state)
    s.for_each([&](std::size_t i, const neighbours::PairList::Neighbours& lists, [[maybe_unused]] std::size_t first,
                   [[maybe_unused]] const auto& add) __attribute__((always_inline)) {
      Seen self;
      copy_fields(Record{}, self, s.records.template spread<Lanes>(i));
      self.mass = mass;
      View<3, Lanes, Law::writes> sums;
      sweep::set_zero(sums);
      if constexpr (Precision::pairs_once) sweep::sum_pairs_of_both<3>(self, source.from(first), lists.once, sums, add, law);
      sweep::sum_pairs<3>(self, source, lists.others, sums, law);
      const auto total = s.sums.take(i, sums);
      s.rates[i] = {total.acceleration[0], total.acceleration[1], total.acceleration[2], total.density_rate};
    });
  report<Precision>(state);
}

template <class Precision>
void pair_sweep_by_hand(benchmark::State& state) {
  auto& s = sample<Precision>();
  using Lanes = typename Sample<Precision>::Lanes;
  const double h = support_radius, gradient = -20.0 * 21.0 / (2.0 * std::numbers::pi * h * h * h) / (h * h);
  const auto records = s.records.reader();
  for (auto _ : state)
    s.for_each([&](std::size_t i, const neighbours::PairList::Neighbours& lists, [[maybe_unused]] std::size_t first,
                   [[maybe_unused]] const auto& add) __attribute__((always_inline)) {
      const auto p = s.records.template spread<Lanes>(i);
      Lanes a[3] = {0.0, 0.0, 0.0}, rate = 0.0;
      const auto sum = [&](const auto& list, const auto& from, auto of_both) __attribute__((always_inline)) {
        for (std::size_t k = 0; k < list.size(); k += Lanes::width) {
          if constexpr (std::is_same_v<Precision, precision::Single>) __builtin_prefetch(list.data() + k + 512);
          std::uint32_t rows[Lanes::width];
          unrolled<Lanes::width>([&](auto lane) __attribute__((always_inline)) { rows[lane] = list[k + lane]; });
          const auto q = from.gather(rows);
          const auto apart = records.separation(p.position, q.position);
          const Lanes x = apart[0], y = apart[1], z = apart[2];
          const Lanes u = p.velocity[0] - q.velocity[0], v = p.velocity[1] - q.velocity[1], w = p.velocity[2] - q.velocity[2];
          const Lanes r2 = x * x + y * y + z * z, t = max(h - sqrt(r2), 0.0) * (1.0 / h), factor = mass * gradient * t * t * t;
          const Lanes approach = x * u + y * v + z * w;
          const Lanes viscous = -2.0 * alpha * sound_speed * h * min(approach, 0.0) / ((r2 + 0.01 * h * h) * (p.density + q.density));
          const Lanes force = (p.pressure_term + q.pressure_term + viscous) * factor;
          a[0] -= force * x, a[1] -= force * y, a[2] -= force * z, rate += factor * approach;
          if constexpr (of_both) {
            View<3, Lanes, Law::writes> reaction;
            reaction.acceleration = {{force * x, force * y, force * z}};
            reaction.density_rate = factor * approach;
            add(rows, reaction);
          }
        }
      };
      if constexpr (Precision::pairs_once) sum(lists.once, records.from(first), std::true_type{});
      sum(lists.others, records, std::false_type{});
      View<3, Lanes, Law::writes> sums;
      sums.acceleration = {{a[0], a[1], a[2]}};
      sums.density_rate = rate;
      const auto total = s.sums.take(i, sums);
      s.rates[i] = {total.acceleration[0], total.acceleration[1], total.acceleration[2], total.density_rate};
    });
  report<Precision>(state);
}

}  // namespace

BENCHMARK(pair_sweep_composed<precision::Double>)->Unit(benchmark::kMillisecond);
BENCHMARK(pair_sweep_by_hand<precision::Double>)->Unit(benchmark::kMillisecond);
BENCHMARK(pair_sweep_composed<precision::Single>)->Unit(benchmark::kMillisecond);
BENCHMARK(pair_sweep_by_hand<precision::Single>)->Unit(benchmark::kMillisecond);
