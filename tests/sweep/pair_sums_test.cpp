// Sums over pairs in vector registers, against a plain loop over all pairs and their images that asks the same law number by number.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>
#include "neighbours/oracle.hpp"
#include "support/particles.hpp"
#include <doctest/doctest.h>
#include <dmp/core/threads.hpp>
#include <dmp/diffusion.hpp>
#include <dmp/kernel.hpp>
#include <dmp/neighbours/ghosts.hpp>
#include <dmp/neighbours/pair_list.hpp>
#include <dmp/particles/precision.hpp>
#include <dmp/particles/records.hpp>
#include <dmp/particles/sums.hpp>
#include <dmp/potential.hpp>
#include <dmp/sph/weakly_compressible.hpp>
#include <dmp/sweep/gather.hpp>
#include <dmp/sweep/pair_law.hpp>
#include <dmp/tensile.hpp>
#include <dmp/viscosity.hpp>

using namespace dmp;

namespace {

using All = Fields<field::Position, field::Velocity, field::Mass, field::Density, field::PressureTerm, field::DynamicViscosity,
                   field::SoundSpeed>;

/// The sums of all particles, and for each number of a particle the sum of the absolute values of its terms.
template <int Dim, class Writes>
struct Totals {
  std::vector<std::vector<double>> total, absolute;
  std::size_t listed_once = 0;  // entries of such lists
};
template <class View>
std::vector<double> numbers(View view) {
  std::vector<double> result;
  particles::detail::for_each_number(view, [&](int, double& number) { result.push_back(number); });
  return result;
}

/// Particles in a box, in blocks, with lists as a scene makes them.
template <int Dim>
struct Sample {
  std::vector<test::Particle<Dim>> particles;
  geometry::Box<Dim> box;
  Blocks blocks{};
  double skin = 0.02;

  /// By the law on packs of numbers; in double, each pair within a wide block is listed once. `level` of the lists.
  template <class Precision = precision::Double, class... Law>
  [[nodiscard]] auto in_packs(std::size_t level, const Law&... law) const {
    using Writes = unite<typename Law::writes...>;
    using Records = particles::Records<Dim, All, Precision>;
    using Lanes = typename Records::Lanes;
    const double cutoff = std::max({law.cutoff()...});
    const auto count = static_cast<std::uint32_t>(particles.size());
    const auto first_ghost = static_cast<std::uint32_t>(blocks.far_row(blocks.size()));
    test::Cloud<Dim> positions;
    for (const auto& particle : particles) positions.push_back(to_vector<Dim>(particle.position));
    neighbours::Ghosts<Dim> ghosts;
    ghosts.build(positions, box, cutoff + skin);
    auto all = positions;
    for (std::size_t k = 0; k < ghosts.size(); ++k) all.push_back(positions[ghosts.owner[k]] + ghosts.shift[k]);
    neighbours::CellGrid<Dim> grid;
    grid.build(all, 0.5 * (cutoff + skin));
    neighbours::PairList pairs;
    pairs.template build<Dim>(blocks, positions, grid, cutoff, skin, {true, count, first_ghost, ghosts.owner, Precision::pairs_once}, {},
                             Lanes::width);

    Records records;
    particles::Sums<Dim, Writes> sums;
    records.set_frame(typename Records::Frame(Vector<Dim>::Zero(), 2.0 * (1.0 + 4.0 * (cutoff + skin))));  // as a scene has it
    records.resize(first_ghost + ghosts.size());
    sums.resize(first_ghost);
    sums.set_zero(0, first_ghost);
    for (std::size_t row = 0; row < records.size(); ++row) {
      View<Dim, double, All> record;
      const std::size_t original = row < count ? row : row < first_ghost ? 0 : ghosts.owner[row - first_ghost];
      copy_fields(All{}, record, particles[original]);
      for (int d = 0; d < Dim; ++d) {
        if (row >= first_ghost) record.position[d] += ghosts.shift[row - first_ghost][d];
        else if (row >= count) record.position[d] = 1e30;
      }
      records.store(row, record);
    }

    Totals<Dim, Writes> result;
    for (std::size_t block = 0; block < blocks.size(); ++block)
      for (std::size_t i = blocks.begin(block); i < blocks.end(block); ++i) {
        View<Dim, Lanes, Writes> lanes;
        sweep::set_zero(lanes);
        const auto self = records.template spread<Lanes>(i);
        const auto lists = pairs.of(block, i, level);
        if constexpr (Precision::pairs_once) {
          const std::size_t first = blocks.begin(block);
          result.listed_once += lists.once.size();
          sweep::sum_pairs_of_both<Dim>(self, records.reader().from(first), lists.once, lanes, sums.adder().from(first), law...);
        }
        sweep::sum_pairs<Dim>(self, records.reader(), lists.others, lanes, law...);
        result.total.push_back(numbers(sums.take(i, lanes)));
      }
    View<Dim, Lanes, Writes> nothing;
    sweep::set_zero(nothing);
    for (std::size_t row = 0; row < count; ++row)
      for (const double number : numbers(sums.take(row, nothing))) CHECK(number == 0.0);  // ready for the next sweep
    return result;
  }

  /// By the law on double, over all pairs and their images.
  template <class... Law>
  [[nodiscard]] auto one_by_one(const Law&... law) const {
    using Writes = unite<typename Law::writes...>;
    Totals<Dim, Writes> result;
    for (std::uint32_t i = 0; i < particles.size(); ++i) {
      View<Dim, double, Writes> nothing{};
      std::vector<double> total = numbers(nothing), absolute = total;
      for (std::uint32_t j = 0; j < particles.size(); ++j)
        test::for_each_image<Dim>(j, box, [&](const test::Image<Dim>& image) {
          if (image == test::Image<Dim>{i, {}}) return;
          test::Particle<Dim> other = particles[j];
          for (int d = 0; d < Dim; ++d)
            if (const int boxes = image.second[static_cast<std::size_t>(d)]; boxes != 0)
              other.position[d] += boxes * (box.upper[d] - box.lower[d]);
          View<Dim, double, Writes> term{};
          (law.add(test::pair_of<Dim>(particles[i], other), particles[i], other, term), ...);
          const auto terms = numbers(term);
          for (std::size_t n = 0; n < terms.size(); ++n) {
            total[n] += terms[n];
            absolute[n] += std::fabs(terms[n]);
          }
        });
      result.total.push_back(total);
      result.absolute.push_back(absolute);
    }
    return result;
  }
};

/// Largest difference of any number of any particle, as a fraction of the largest sum of terms of that number.
template <class S>
double difference(const S& in_packs, const S& one_by_one) {
  double result = 0.0;
  for (std::size_t n = 0; n < one_by_one.total[0].size(); ++n) {
    double largest = 0.0, error = 0.0;
    for (std::size_t i = 0; i < one_by_one.total.size(); ++i) {
      largest = std::max(largest, one_by_one.absolute[i][n]);
      const double one = std::fabs(in_packs.total.at(i).at(n) - one_by_one.total[i][n]);
      error = std::isnan(one) ? INFINITY : std::max(error, one);
    }
    CHECK(largest > 0.0);  // something acts
    result = std::max(result, error / largest);
  }
  return result;
}

/// Particles at random, of different masses, two of them in one place.
template <int Dim>
Sample<Dim> at_random(const std::array<bool, Dim>& periodic, std::size_t count) {
  test::ParticleSource source;
  Sample<Dim> sample{.particles = {}, .box = test::cube<Dim>(1.0, periodic)};
  for (std::size_t k = 0; k < count; ++k) {
    sample.particles.push_back(source.next<Dim>());
    for (int d = 0; d < Dim; ++d) sample.particles.back().position[d] -= 0.5;
  }
  sample.particles[count - 1].position = sample.particles[0].position;
  sample.particles[1].position = sample.particles[0].position;
  return sample;
}
/// Particles near the points of a lattice of `side` to the power Dim.
template <int Dim>
Sample<Dim> near_lattice(const std::array<bool, Dim>& periodic, int side) {
  test::ParticleSource source;
  Sample<Dim> sample{.particles = {}, .box = test::cube<Dim>(1.0, periodic)};
  for (const auto& x : test::lattice<Dim>(side, 1.0)) {
    sample.particles.push_back(source.next<Dim>());
    for (int d = 0; d < Dim; ++d) sample.particles.back().position[d] = x[d] + (0.5 + source.between(-0.15, 0.15)) / side;
  }
  return sample;
}

/// f(sample) for the sample in one and in four blocks, in an open and in a periodic box.
template <int Dim, class Make, class Function>
void for_each_sample(const Make& make, const Function& f) {
  for (const bool periodic : {false, true}) {
    CAPTURE(periodic);
    std::array<bool, Dim> faces;
    faces.fill(periodic);
    Sample<Dim> sample = make(faces);
    const std::size_t count = sample.particles.size();
    for (const std::vector<std::size_t>& bounds : {std::vector<std::size_t>{0, count}, {0, 1, count / 3, count - 2, count}}) {
      sample.blocks.set_bounds(bounds);
      f(sample);
    }
  }
}
template <int Dim, class... Law>
void check_sums(const Law&... law) {
  CAPTURE(Dim);
  for_each_sample<Dim>([](const auto& faces) { return at_random<Dim>(faces, Dim == 1 ? 41 : 83); },
                       [&](const Sample<Dim>& sample) {
                         const auto expected = sample.one_by_one(law...);
                         const auto in_packs = sample.in_packs(neighbours::PairList::levels - 1, law...);
                         CHECK(difference(in_packs, expected) < 1e-12);
                         if (Dim > 1) CHECK(in_packs.listed_once > 0);  // on the line, blocks may be too narrow
                         CHECK(difference(sample.in_packs(0, law...), expected) < 1e-12);  // nothing has moved: all who act are at level 0
                       });
}

constexpr double support = 0.31;

template <int Dim, class V = viscosity::None, class D = diffusion::None, class C = tensile::None>
auto flow(V v = {}, D d = {}, C c = {}) {
  return sph::WeaklyCompressible<kernel::WendlandC2<Dim>, V, D, C>{
      .kernel = {.support_radius = support}, .viscosity = v, .diffusion = d, .tensile = c};
}
constexpr viscosity::Artificial artificial{.alpha = 0.5, .sound_speed = 20.0};
constexpr viscosity::ShockCapturing shock_capturing{.alpha = 0.5, .beta = 1.0};
constexpr diffusion::MolteniColagrossi molteni{.sound_speed = 20.0};
constexpr tensile::Monaghan repulsion{.spacing = 0.12};

template <int Dim>
void check_kernels() {
  check_sums<Dim>(sph::WeaklyCompressible<kernel::Lucy<Dim>>{.kernel = {.support_radius = support}});
  check_sums<Dim>(sph::WeaklyCompressible<kernel::CubicSpline<Dim>>{.kernel = {.support_radius = support}});
  check_sums<Dim>(sph::WeaklyCompressible<kernel::Quartic<Dim>>{.kernel = {.support_radius = support}});
  check_sums<Dim>(sph::WeaklyCompressible<kernel::WendlandC2<Dim>>{.kernel = {.support_radius = support}});
  check_sums<Dim>(sph::WeaklyCompressible<kernel::WendlandC4<Dim>>{.kernel = {.support_radius = support}});
}

}  // namespace

TEST_CASE("the flow equations in packs are those of a plain loop over all pairs: every kernel, on the line, in the plane and in space") {
  check_kernels<1>();
  check_kernels<2>();
  check_kernels<3>();
}

TEST_CASE("the flow equations in packs are those of a plain loop over all pairs: every viscosity") {
  check_sums<2>(flow<2>(viscosity::Morris<>{}));
  check_sums<3>(flow<3>(viscosity::Morris<dmp::HarmonicMean>{}));
  check_sums<2>(flow<2>(viscosity::Monaghan<2>{}));
  check_sums<3>(flow<3>(viscosity::Monaghan<3, dmp::HarmonicMean>{}));
  check_sums<1>(flow<1>(artificial));
  check_sums<2>(flow<2>(artificial));
  check_sums<3>(flow<3>(artificial));
  check_sums<2>(flow<2>(shock_capturing));
  check_sums<3>(flow<3>(shock_capturing));
}

namespace {

template <int Dim, class V>
void check_with_energy(const V& viscosity) {
  check_sums<Dim>(sph::Compressible<kernel::WendlandC2<Dim>, V, diffusion::None, tensile::Monaghan>{
      .kernel = {.support_radius = support}, .viscosity = viscosity, .tensile = repulsion});
}

}  // namespace

TEST_CASE("the flow equations in packs are those of a plain loop over all pairs: with the energy equation") {
  check_with_energy<1>(shock_capturing);
  check_with_energy<2>(viscosity::Morris<>{});
  check_with_energy<2>(viscosity::Monaghan<2>{});
  check_with_energy<3>(shock_capturing);
}

TEST_CASE("the flow equations in packs are those of a plain loop over all pairs: diffusion, tensile correction, and all together") {
  check_sums<2>(flow<2>(viscosity::None{}, molteni));
  check_sums<3>(flow<3>(viscosity::None{}, molteni));
  check_sums<2>(flow<2>(viscosity::None{}, diffusion::None{}, repulsion));
  check_sums<3>(flow<3>(viscosity::None{}, diffusion::None{}, repulsion));
  check_sums<1>(flow<1>(viscosity::Morris<>{}, molteni, repulsion));
  check_sums<2>(flow<2>(artificial, molteni, repulsion));
  check_sums<3>(flow<3>(viscosity::Morris<>{}, molteni, repulsion));
}

namespace {

template <int Dim>
void check_potentials(int side) {
  const double spacing = 1.0 / side;
  const auto make = [&](const auto& faces) { return near_lattice<Dim>(faces, side); };
  for (const double cutoff : {1.12 * 0.9 * spacing, 2.5 * spacing}) {
    const auto law = sweep::as_pair_law(potential::LennardJones{.energy_scale = 2.0, .diameter = 0.9 * spacing, .cutoff = cutoff});
    for_each_sample<Dim>(make,
                         [&](const Sample<Dim>& sample) { CHECK(difference(sample.in_packs(3, law), sample.one_by_one(law)) < 1e-12); });
    const auto of_both = flow<Dim>(artificial);
    for_each_sample<Dim>(make, [&](const Sample<Dim>& sample) {
      CHECK(difference(sample.in_packs(3, of_both, law), sample.one_by_one(of_both, law)) < 1e-12);
    });
  }
}

}  // namespace

TEST_CASE("every pair potential in packs is that of a plain loop over all pairs, alone and beside the flow equations") {
  check_potentials<1>(20);
  check_potentials<2>(7);
  check_potentials<3>(4);
}

namespace {

/// |sum of m a + sum of f| over a closed set, as a fraction of the sum of the terms.
template <int Dim, class... Law>
void check_momentum(const Law&... law) {
  for_each_sample<Dim>([](const auto& faces) { return near_lattice<Dim>(faces, Dim == 1 ? 30 : Dim == 2 ? 9 : 5); },
                       [&](const Sample<Dim>& sample) {
                         const auto sums = sample.in_packs(3, law...), terms = sample.one_by_one(law...);
                         for (std::size_t d = 0; d < Dim; ++d) {
                           double momentum = 0.0, all = 0.0;
                           for (std::size_t i = 0; i < sample.particles.size(); ++i) {
                             const double mass =
                                 (std::is_same_v<typename Law::writes, Fields<field::Force>> && ...) ? 1.0 : sample.particles[i].mass;
                             momentum += mass * sums.total[i][d];
                             all += mass * terms.absolute[i][d];
                           }
                           CHECK(std::fabs(momentum) < 1e-15 * all);
                         }
                       });
}

}  // namespace

TEST_CASE("momentum: what a closed set does to itself adds up to nothing, to rounding") {
  check_momentum<1>(flow<1>(viscosity::Morris<>{}, molteni, repulsion));
  check_momentum<2>(flow<2>(viscosity::Monaghan<2>{}));
  check_momentum<3>(flow<3>(artificial));
  check_momentum<2>(sweep::as_pair_law(potential::LennardJones{.energy_scale = 2.0, .diameter = 0.1, .cutoff = 0.3}));
  check_momentum<3>(sweep::as_pair_law(potential::LennardJones{.energy_scale = 2.0, .diameter = 0.18, .cutoff = 0.4}));
}

namespace {

/// Single precision, to the seven digits it has; the sum of the terms is in single precision too.
template <int Dim, class Make, class... Law>
void check_single(const Make& make, const Law&... law) {
  for_each_sample<Dim>(make, [&](const Sample<Dim>& sample) {
    CHECK(difference(sample.template in_packs<precision::Single>(3, law...), sample.one_by_one(law...)) < 1e-5);
    CHECK(difference(sample.template in_packs<precision::Single>(0, law...), sample.one_by_one(law...)) < 1e-5);
  });
}

}  // namespace

TEST_CASE("in single precision the sums have six digits") {
  const auto anywhere = [](const auto& faces) { return at_random<2>(faces, 83); };
  const auto in_space = [](const auto& faces) { return at_random<3>(faces, 83); };
  check_single<2>(anywhere, flow<2>(viscosity::Morris<>{}, molteni, repulsion));
  check_single<3>(in_space, flow<3>(artificial, molteni, repulsion));
  const auto law = sweep::as_pair_law(potential::LennardJones{.energy_scale = 2.0, .diameter = 0.225, .cutoff = 0.6});
  check_single<3>([](const auto& faces) { return near_lattice<3>(faces, 4); }, law);
}

TEST_CASE("two groups: each sums over the other's particles at its own end, and what the one gains the other loses") {
  auto sample = at_random<3>({false, false, false}, 90);
  sample.blocks.set_bounds(std::vector<std::size_t>{0, 90});
  const auto law = flow<3>(viscosity::Morris<>{}, molteni);
  using sweep::Lanes;
  constexpr std::uint32_t middle = 37;
  const auto cloud = [&](std::size_t first, std::size_t last) {
    test::Cloud<3> positions;
    for (std::size_t k = first; k < last; ++k) positions.push_back(to_vector<3>(sample.particles[k].position));
    return positions;
  };
  const auto records_of = [&](std::size_t first, std::size_t last) {
    particles::Records<3, All> records;
    records.resize(last - first + Blocks::far_rows);
    for (std::size_t row = 0; row < records.size(); ++row) {
      View<3, double, All> record;
      copy_fields(All{}, record, sample.particles[std::min(first + row, last - 1)]);
      if (first + row >= last)
        for (int d = 0; d < 3; ++d) record.position[d] = 1e30;
      records.store(row, record);
    }
    return records;
  };
  const auto a = cloud(0, middle), b = cloud(middle, 90);
  const auto sums_of = [&](const test::Cloud<3>& own, const auto& own_records, const test::Cloud<3>& other, const auto& other_records) {
    neighbours::CellGrid<3> grid;
    grid.build(other, support);
    const auto count = static_cast<std::uint32_t>(other.size());
    const Blocks blocks(own.size());
    neighbours::PairList pairs;
    pairs.build<3>(blocks, own, grid, law.cutoff(), 0.0, {false, count, count + static_cast<std::uint32_t>(Blocks::far_rows), {}}, {},
                   Lanes::width);
    std::vector<std::vector<double>> result;
    for (std::size_t i = 0; i < own.size(); ++i) {
      View<3, Lanes, decltype(law)::writes> lanes;
      sweep::set_zero(lanes);
      sweep::sum_pairs<3>(own_records.template spread<Lanes>(i), other_records.reader(), pairs.of(0, i).others, lanes, law);
      result.push_back(numbers(particles::Sums<3, decltype(law)::writes>::totals(lanes)));
    }
    return result;
  };
  const auto records_a = records_of(0, middle), records_b = records_of(middle, 90);
  auto of_both = sums_of(a, records_a, b, records_b);
  for (const auto& sums : sums_of(b, records_b, a, records_a)) of_both.push_back(sums);
  const auto everybody = sample.one_by_one(law);
  double error = 0.0;
  for (const bool first : {true, false}) {  // those of one group alone; the rest is what the groups do to each other
    Sample<3> alone{.particles = {}, .box = sample.box};
    for (std::size_t k = first ? 0 : middle; k < (first ? middle : 90); ++k) alone.particles.push_back(sample.particles[k]);
    const auto within = alone.one_by_one(law);
    for (std::size_t i = 0; i < within.total.size(); ++i)
      for (std::size_t n = 0; n < 4; ++n) {
        const std::size_t k = first ? i : i + middle;
        error = std::max(error, std::fabs(of_both[k][n] - (everybody.total[k][n] - within.total[i][n])) / everybody.absolute[k][n]);
      }
  }
  CHECK(error < 1e-13);
  for (std::size_t d = 0; d < 3; ++d) {
    double momentum = 0.0, all = 0.0;
    for (std::size_t i = 0; i < 90; ++i) {
      momentum += sample.particles[i].mass * of_both[i][d];
      all += sample.particles[i].mass * everybody.absolute[i][d];
    }
    CHECK(std::fabs(momentum) < 1e-15 * all);
  }
}
