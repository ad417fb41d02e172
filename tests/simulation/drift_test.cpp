// Long runs: what is conserved does not drift. The fast cases are the slow ones cut short.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <doctest/doctest.h>

#include "scenes.hpp"
#include "support/random.hpp"

using namespace test;
using integrator::ExtrapolatedVerlet, integrator::Leapfrog;

namespace {

struct Beads {};

/// Momentum that a liquid in a periodic square has come to in `steps` steps, over the sum of |m v| at the start; it starts from none.
double momentum_gained(std::uint64_t steps) {
  constexpr double side = 8.0;
  auto sea = scene<ExtrapolatedVerlet>(
      geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {side, side}, .periodic = {true, true}},
      group<Water>("water", Mobile{}, geometry::fill(geometry::Cubic<2>{.spacing = 1.0}, {.lower = {0.0, 0.0}, .upper = {side, side}}),
                   1.0),
      interaction<Water, Water>(sph::WeaklyCompressible<kernel::WendlandC2<2>>{.kernel = {.support_radius = 2.6}}),
      material<Water>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 10.0}));
  auto& water = sea.group<Water>();
  RandomVectors random;
  water.set<field::Velocity>([&](const auto&) { return Vector<2>(random.vector(1.0).head<2>()); });
  auto& v = water.get<field::Velocity>();
  Vector<2> mean = Vector<2>::Zero();
  for (const auto& one : v) mean += one / 64.0;
  double start = 0.0;
  for (auto& one : v) one -= mean, start += one.norm();
  const double step = 0.5 * sea.step_limit().stable_time_step;
  sea.run({.until = static_cast<double>(steps) * step, .time_step = step});
  Vector<2> gained = Vector<2>::Zero();
  double moving = 0.0;
  for (const auto& one : water.get<field::Velocity>()) gained += one, moving += one.norm();
  CHECK(moving > 1e-2 * start);  // it has not come to rest
  return gained.norm() / start;
}

/// Largest |change| of the energy over the kinetic energy of the start, in the first and in the last tenth of a run.
struct Drift {
  double early = 0.0, late = 0.0, momentum = 0.0;
};
template <class Scene, class Energy>
Drift drift_of(Scene& scene, std::uint64_t steps, double step, const Energy& potential) {
  Drift drift;
  const auto& g = scene.template group<Beads>();
  const auto kinetic = [&] {
    double sum = 0.0;
    for (const auto& v : g.template get<field::Velocity>()) sum += 0.5 * g.mass * v.squaredNorm();
    return sum;
  };
  const auto momentum = [&] {
    Vector<Scene::dimension> sum = Vector<Scene::dimension>::Zero();
    for (const auto& v : g.template get<field::Velocity>()) sum += v;
    return sum;
  };
  const double scale = kinetic(), start = scale + potential();
  const Vector<Scene::dimension> before = momentum();
  const double end = static_cast<double>(steps) * step;
  scene.every(end / 1000.0, [&](const auto& s) {
    const double change = std::fabs(kinetic() + potential() - start) / scale;
    if (s.time() < 0.1 * end) drift.early = std::max(drift.early, change);
    if (s.time() > 0.9 * end) drift.late = std::max(drift.late, change);
  });
  scene.run({.until = end, .time_step = step});
  drift.momentum = (momentum() - before).norm();
  return drift;
}

/// 32 beads that repel each other, in a periodic cube.
Drift colliding(std::uint64_t steps, double step) {
  constexpr double side = 4.0;
  const potential::LennardJones law{.energy_scale = 1.0, .diameter = 1.0, .cutoff = 1.1224620483093730};  // 2^(1/6): where the force is 0
  const geometry::Box<3> box{.lower = {0.0, 0.0, 0.0}, .upper = {side, side, side}, .periodic = {true, true, true}};
  const auto lattice =
      geometry::fill(geometry::FaceCentredCubic{.lattice_constant = 2.0}, {.lower = {0.0, 0.0, 0.0}, .upper = {side, side, side}});
  auto gas = scene<Leapfrog>(box, group<Beads>("beads", Mobile{}, geometry::Points<3>{.positions = lattice.positions}, 1.0),
                             interaction<Beads, Beads>(law));
  RandomVectors random;
  gas.group<Beads>().set<field::Velocity>([&](const auto&) { return random.vector(1.5); });
  return drift_of(gas, steps, step, [&] {
    const auto& x = gas.group<Beads>().positions();
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double r2 = neighbours::minimum_image<3>(x[i] - x[j], box).squaredNorm();
        if (r2 < law.cutoff * law.cutoff) sum += law.energy(r2) + 1.0;  // the well is eps = 1 deep where it is cut off
      }
    return sum;
  });
}

/// A block of springs that tumbles and trembles.
Drift tumbling(std::uint64_t steps, double step) {
  const auto body = lattice_spring::lattice_block(lattice_spring::CubicLattice{.spacing = 1.0}, {2, 2, 2});
  const bond::Harmonic law{.stiffness = 100.0};
  auto block = scene<Leapfrog>(geometry::Box<3>::unbounded(), group<Beads>("beads", Mobile{}, body.points, 1.0),
                               bonds<Beads, Beads>(law, body.bonds));
  RandomVectors random;
  block.group<Beads>().set<field::Velocity>(
      [&](const Vector<3>& x) { return Vector<3>(random.vector(0.5) + Vector<3>(-x[1], x[0], 0.0)); });
  return drift_of(block, steps, step, [&] {
    const auto& x = block.group<Beads>().positions();
    double sum = 0.0;
    for (const auto& bond : body.bonds) {
      const double rest = (body.points.positions[bond.j] - body.points.positions[bond.i]).norm(), length = (x[bond.j] - x[bond.i]).norm();
      sum += 0.5 * law.stiffness * bond.weight * square(length - rest);
    }
    return sum;
  });
}

constexpr double rounding = std::numeric_limits<double>::epsilon();

void check_momentum(std::uint64_t steps) {
  const double gained = momentum_gained(steps);
  MESSAGE("momentum gained in ", steps, " steps, of the sum of |m v|: ", gained);
  CHECK(gained <= 1e-2 * rounding * static_cast<double>(steps) + 1e-14);
}
/// Leapfrog's energy wavers by (omega dt)^2/4 of an oscillator's, however long the run is.
void check_energy(const char* what, const Drift& drift, std::uint64_t steps, double omega_squared, double step) {
  MESSAGE(std::string(what), ": energy wavers by ", drift.early, " early, ", drift.late, " late; momentum gained ", drift.momentum);
  const double bound = 0.25 * omega_squared * step * step;
  CHECK(drift.early < bound);
  CHECK(drift.early > 1e-3 * bound);
  CHECK(drift.late < bound);
  CHECK(drift.momentum < 10.0 * rounding * static_cast<double>(steps));
}
void check_beads(std::uint64_t steps) {
  constexpr double step = 1e-3;
  check_energy("beads", colliding(steps, step), steps, 2.0 * 456.0, step);  // two beads in contact at r = sigma: U'' = 456
}
void check_block(std::uint64_t steps) {
  constexpr double step = 0.01;
  check_energy("block", tumbling(steps, step), steps, 12.0 * 100.0, step);  // the cubic lattice: 12 k/m
}

}  // namespace

TEST_CASE("a liquid in a periodic box gains no momentum in 20 000 steps, to rounding") { check_momentum(20000); }
TEST_CASE("colliding beads: the energy wavers and does not drift in 50 000 steps") { check_beads(50000); }
TEST_CASE("a tumbling block of springs: the energy wavers and does not drift in 100 000 steps") { check_block(100000); }

TEST_CASE("slow: a liquid in a periodic box gains no momentum in 10^6 steps, to rounding") { check_momentum(1000000); }
TEST_CASE("slow: colliding beads: the energy wavers and does not drift in 10^6 steps") { check_beads(1000000); }
TEST_CASE("slow: a tumbling block of springs: the energy wavers and does not drift in 10^6 steps") { check_block(1000000); }
