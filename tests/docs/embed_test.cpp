// docs/embed.md: one header at a time over arrays of one's own.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <span>
#include <utility>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/core/threads.hpp>
#include <dmp/eos/tait.hpp>
#include <dmp/geometry/box.hpp>
#include <dmp/kernel/wendland_c2.hpp>
#include <dmp/neighbours.hpp>
#include <dmp/particles/precision.hpp>
#include <dmp/particles/records.hpp>
#include <dmp/potential/lennard_jones.hpp>
#include <dmp/sph/weakly_compressible.hpp>
#include <dmp/sweep/gather.hpp>
#include <dmp/sweep/pair_law.hpp>
#include <dmp/viscosity/morris.hpp>

namespace kernel_program {

// doc: embed-kernel
#include <cmath>
#include <cstdio>
#include <vector>
#include <dmp/kernel/wendland_c2.hpp>

int main() {
  const int edge = 20;
  const double spacing = 0.01, mass = 1000.0 * spacing * spacing * spacing;  // [m], [kg]
  const dmp::kernel::WendlandC2<3> kernel{.support_radius = 2.6 * spacing};
  validate(kernel);  // throws dmp::ParameterError, if you want the check

  std::vector<double> x, y, z;  // your arrays
  for (int n = 0; n < edge * edge * edge; ++n) {
    x.push_back(spacing * (n % edge));
    y.push_back(spacing * (n / edge % edge));
    z.push_back(spacing * (n / edge / edge));
  }
  const std::size_t i = 10 + 20 * 10 + 400 * 10;  // in the middle
  double density = 0.0, gradient_x = 0.0;         // sum of m W and of m dW/dx, [kg/m^3] and [kg/m^4]
  for (std::size_t j = 0; j < x.size(); ++j) {
    const double r = std::hypot(x[i] - x[j], y[i] - y[j], z[i] - z[j]);
    density += mass * kernel.value(r);
    gradient_x += mass * kernel.radial_factor(r) * (x[i] - x[j]);
  }
  std::printf("density %.2f kg/m^3, gradient %.1e kg/m^4\n", density, gradient_x);
  return std::fabs(density - 1000.0) < 20.0 && std::fabs(gradient_x) < 1e-6 ? 0 : 1;
}
// end

}  // namespace kernel_program

TEST_CASE("a kernel over one's own arrays: the density of a lattice is that of the lattice") { CHECK(kernel_program::main() == 0); }

namespace {

// doc: embed-eos
/// Pressures of your densities, and the largest stable step for a resolution h = support radius.
double update_pressures(const std::vector<double>& density, std::vector<double>& pressure, double support_radius) {
  const dmp::eos::Tait water{.rest_density = 1000.0, .sound_speed_0 = 40.0};
  double fastest = 0.0;  // sound [m/s]
  for (std::size_t i = 0; i < density.size(); ++i) {
    pressure[i] = water.pressure(density[i]);
    fastest = std::max(fastest, water.sound_speed(density[i]));
  }
  return 0.25 * support_radius / fastest;
}
// end

// doc: embed-grid
/// Number of neighbours of each of your points within `radius`.
std::vector<std::size_t> count_neighbours(const std::vector<double>& xyz, double radius) {
  std::vector<dmp::Vector<3>> positions;
  for (std::size_t i = 0; i < xyz.size(); i += 3) positions.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);

  dmp::neighbours::CellGrid<3> grid;
  grid.build(positions, radius);  // width of the cells: the radius or somewhat less
  std::vector<std::size_t> count;
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    found.clear();
    grid.find(positions[i], radius, i, found);  // appends the rows of all points closer than radius, except row i
    count.push_back(found.size());
  }
  return count;
}
// end

// doc: embed-ghosts
/// Positions with their images behind the periodic faces; owner[k] is the row of the original of row positions.size() + k.
std::vector<dmp::Vector<3>> with_images(const std::vector<dmp::Vector<3>>& positions, const dmp::geometry::Box<3>& box, double radius,
                                        std::vector<std::uint32_t>& owner) {
  dmp::neighbours::Ghosts<3> ghosts;
  ghosts.build(positions, box, radius);
  std::vector<dmp::Vector<3>> all = positions;
  for (std::size_t k = 0; k < ghosts.size(); ++k) all.push_back(positions[ghosts.owner[k]] + ghosts.shift[k]);
  owner = ghosts.owner;
  return all;
}
// end

// doc: embed-pair
using Seen = dmp::Fields<dmp::field::Position, dmp::field::Velocity, dmp::field::Mass, dmp::field::Density, dmp::field::PressureTerm,
                         dmp::field::DynamicViscosity>;
using Particle = dmp::View<3, double, Seen>;
using Sums = dmp::View<3, double, dmp::Fields<dmp::field::Acceleration, dmp::field::DensityRate>>;

/// What particle j does to the acceleration and the density rate of particle i.
void add_pair(const Particle& i, const Particle& j, double support_radius, Sums& sums) {
  const dmp::sph::WeaklyCompressible<dmp::kernel::WendlandC2<3>, dmp::viscosity::Morris<>> flow{.kernel = {.support_radius = support_radius}};
  const dmp::precision::Double::Frame<3> metres;  // what positions are in
  flow.add(dmp::sweep::pair_of<flow.uses_velocity, 3>(metres, i, j), i, j, sums);
}
// end

// doc: embed-sweep
/// Forces [N] of a pair potential between all points, in vector registers.
std::vector<std::array<double, 3>> forces(const std::vector<dmp::Vector<3>>& positions, const dmp::potential::LennardJones& potential) {
  using dmp::sweep::Lanes;  // as many doubles as a vector register holds
  using Force = dmp::Fields<dmp::field::Force>;
  const auto law = dmp::sweep::as_pair_law(potential);
  const auto count = static_cast<std::uint32_t>(positions.size());

  // Lists: the rows of the neighbours, filled up to whole registers with rows beyond those of the points.
  const dmp::Blocks blocks(count);  // of rows, shared among the threads
  const auto rows = static_cast<std::uint32_t>(blocks.far_row(blocks.size()));
  dmp::neighbours::CellGrid<3> grid;
  grid.build(positions, law.cutoff());
  dmp::neighbours::PairList pairs;
  pairs.build<3>(blocks, positions, grid, law.cutoff(), 0.0,
                 {.same_group = true, .owned = count, .first_ghost = rows, .owner = {}, .once = false}, {}, Lanes::width);

  // Records: what the law reads, side by side. The rows beyond lie far away.
  dmp::particles::Records<3, dmp::Fields<dmp::field::Position>> records;
  records.resize(rows);
  for (std::uint32_t i = 0; i < rows; ++i) {
    dmp::View<3, double, dmp::Fields<dmp::field::Position>> record;
    for (int d = 0; d < 3; ++d) record.position[d] = i < count ? positions[i][d] : 1e30;
    records.store(i, record);
  }

  std::vector<std::array<double, 3>> result(count);
  dmp::for_each_block(blocks, [&](std::size_t, std::size_t block) {
    for (std::size_t i = blocks.begin(block); i < blocks.end(block); ++i) {
      dmp::View<3, Lanes, Force> sums{};
      dmp::sweep::sum_pairs<3>(records.spread<Lanes>(i), records.reader(), pairs.of(block, i).others, sums, law);
      for (int d = 0; d < 3; ++d) result[i][static_cast<std::size_t>(d)] = sum(sums.force[d]);
    }
  });
  return result;
}
// end

/// A jittered lattice of edge^3 points, one apart.
std::vector<dmp::Vector<3>> points(int edge) {
  std::vector<dmp::Vector<3>> result;
  for (int n = 0; n < edge * edge * edge; ++n) {
    const auto jitter = [n](int k) { return 0.05 * std::sin(12.9898 * n + 78.233 * k); };
    result.emplace_back(n % edge + jitter(1), n / edge % edge + jitter(2), n / edge / edge + jitter(3));
  }
  return result;
}

}  // namespace

TEST_CASE("an equation of state over one's own arrays") {
  std::vector<double> density{1000.0, 1010.0}, pressure(2);
  const double step = update_pressures(density, pressure, 0.026);
  CHECK(pressure[0] == 0.0);
  CHECK(pressure[1] == doctest::Approx(40.0 * 40.0 * 1000.0 / 7.0 * (std::pow(1.01, 7) - 1.0)));
  CHECK(step == doctest::Approx(0.25 * 0.026 / (40.0 * std::pow(1.01, 3))));
}

TEST_CASE("the cell grid over one's own points: 26 neighbours within 1.9 spacings inside a lattice; also at its faces once periodic") {
  const auto lattice = points(6);
  std::vector<double> xyz;
  for (const auto& x : lattice) xyz.insert(xyz.end(), x.data(), x.data() + 3);
  const auto count = count_neighbours(xyz, 1.9);
  CHECK(count[2 + 6 * 2 + 36 * 2] == 26);
  CHECK(count[0] == 7);

  std::vector<dmp::Vector<3>> inside;
  const dmp::geometry::Box<3> box{.lower = {0.0, 0.0, 0.0}, .upper = {6.0, 6.0, 6.0}, .periodic = {true, true, true}};
  for (const auto& x : lattice) inside.push_back(box.wrap(x));
  std::vector<std::uint32_t> owner;
  const auto all = with_images(inside, box, 1.9, owner);
  CHECK(all.size() == inside.size() + owner.size());
  std::vector<double> all_xyz;
  for (const auto& x : all) all_xyz.insert(all_xyz.end(), x.data(), x.data() + 3);
  const auto periodic_count = count_neighbours(all_xyz, 1.9);
  for (std::size_t i = 0; i < inside.size(); ++i) CHECK(periodic_count[i] == 26);
}

TEST_CASE("one pair of one's own: momentum is kept, approaching particles gain density") {
  Particle i{}, j{};
  for (auto* particle : {&i, &j}) {
    particle->mass = 2.0;
    particle->density = 1000.0;
    particle->pressure_term = 1e-3;
    particle->dynamic_viscosity = 0.1;
  }
  j.position[0] = 0.5;
  i.velocity[0] = 0.3;
  Sums on_i{}, on_j{};
  add_pair(i, j, 1.0, on_i);
  add_pair(j, i, 1.0, on_j);
  CHECK(on_i.acceleration[0] < 0.0);
  CHECK(on_i.acceleration[0] == doctest::Approx(-on_j.acceleration[0]).epsilon(1e-14));
  CHECK(on_i.acceleration[1] == 0.0);
  CHECK(on_i.density_rate > 0.0);
}

TEST_CASE("the vector sweep over one's own points agrees with all pairs one by one, also when they fill several blocks") {
  const dmp::potential::LennardJones potential{.energy_scale = 1.0, .diameter = 0.9, .cutoff = 2.5};
  for (const int edge : {8, 21}) {
    const auto positions = points(edge);
    const auto result = forces(positions, potential);
    double error = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < positions.size(); i += edge == 8 ? 1 : 37) {
      dmp::Vector<3> force = dmp::Vector<3>::Zero();
      for (std::size_t j = 0; j < positions.size(); ++j)
        if (i != j) force += potential.force_factor((positions[i] - positions[j]).squaredNorm()) * (positions[i] - positions[j]);
      for (int d = 0; d < 3; ++d) error = std::max(error, std::fabs(force[d] - result[i][static_cast<std::size_t>(d)]));
      largest = std::max(largest, force.norm());
    }
    CHECK(dmp::Blocks(positions.size()).size() == (edge == 8 ? 1 : 2));
    CHECK(largest > 1.0);
    CHECK(error < 1e-12 * largest);
  }
}
