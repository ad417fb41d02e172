// Bonds that break: when, what is kept and what is lost, and that it does not depend on the order of the bonds, on threads or on a restart.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/bond.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/forcing.hpp>
#include <dmp/integrator.hpp>
#include <dmp/particles/clamp.hpp>
#include <dmp/potential.hpp>
#include <dmp/simulation.hpp>
#include "support/random.hpp"

using namespace dmp;
using namespace dmp::simulation;
using bond::Breaking, bond::Harmonic, bond::LargestEnergy, bond::LargestStrain;
using geometry::Box, geometry::Points;
using integrator::Leapfrog;
using neighbours::Bond;
using particles::Frozen, particles::Mobile;

namespace {

struct Post {};
struct Bead {};

/// A bead of 1 kg flies from a post at x = 0, to which it is bonded over 1 m.
auto tethered(const auto& law, double speed) {
  auto result = scene<Leapfrog>(Box<1>::unbounded(), group<Post>("post", Frozen<1>{}, Points<1>{{Vector<1>(0.0)}}, 1.0),
                                group<Bead>("bead", Mobile{}, Points<1>{{Vector<1>(1.0)}}, 1.0), bonds<Bead, Post>(law, {{0, 0}}));
  result.template group<Bead>().template get<field::Velocity>()[0][0] = speed;
  return result;
}

}  // namespace

TEST_CASE("a bond breaks if the bead that stretches it is fast enough, v > eps r0 sqrt(k/m), and takes (1/2) k (eps r0)^2 of its energy") {
  constexpr double stiffness = 100.0, strain = 0.05, dt = 1e-5;
  const Breaking law{Harmonic{.stiffness = stiffness}, LargestStrain{.strain = strain}};
  const double needed = strain * std::sqrt(stiffness);
  for (const double factor : {0.2, 0.99, 1.01, 3.0}) {
    CAPTURE(factor);
    auto bead = tethered(law, factor * needed);
    bead.run({.until = 2.0, .time_step = dt});
    const bool breaks = factor > 1.0;
    CHECK(broken_bonds<Bead, Post>(bead).size() == (breaks ? 1 : 0));
    if (!breaks) continue;
    const double energy = 0.5 * square(bead.group<Bead>().get<field::Velocity>()[0][0]);
    const double one_step = stiffness * strain * factor * needed * dt;  // the work of a step at the moment of breaking
    CHECK(std::fabs(energy - (0.5 * square(factor * needed) - 0.5 * stiffness * square(strain))) <= one_step);
  }
}

TEST_CASE("a Maxwell bond that is pulled breaks above the rate sqrt(2 k U)/c, and flows for ever below it") {
  constexpr double stiffness = 4.0, damping = 2.0, energy = 0.5;
  const double rate = std::sqrt(2.0 * stiffness * energy) / damping;  // steady tension c v, energy (c v)^2/(2 k)
  for (const double factor : {0.98, 1.02}) {
    CAPTURE(factor);
    const Breaking law{bond::Maxwell{.stiffness = stiffness, .damping = damping}, LargestEnergy{.energy = energy}};
    auto pull = scene<Leapfrog>(Box<1>::unbounded(), group<Post>("post", Frozen<1>{}, Points<1>{{Vector<1>(0.0)}}, 1.0),
                                group<Bead>("bead", Mobile{}, Points<1>{{Vector<1>(1.0)}}, 1e12), bonds<Bead, Post>(law, {{0, 0}}));
    pull.group<Bead>().get<field::Velocity>()[0][0] = factor * rate;
    pull.run({.until = 20.0, .time_step = 0.01});
    CHECK(broken_bonds<Bead, Post>(pull).size() == (factor > 1.0 ? 1 : 0));
  }
}

TEST_CASE("broken is broken: a bond that is brought back to its length stays without force, in sub-steps too") {
  const Breaking law{Harmonic{.stiffness = 100.0}, LargestStrain{.strain = 0.1}};
  const auto returns = [](auto made) {
    made.template group<Bead>().positions()[0][0] = 1.2;
    made.template group<Bead>().template get<field::Velocity>()[0][0] = -1.0;
    made.run({.until = 0.5, .time_step = 1e-3});
    CHECK(made.template group<Bead>().positions()[0][0] == doctest::Approx(0.7).epsilon(1e-12));
    CHECK(made.template group<Bead>().template get<field::Velocity>()[0][0] == -1.0);
    return broken_bonds<Bead, Post>(made);
  };
  const auto broken = returns(tethered(law, 0.0));
  REQUIRE(broken.size() == 1);
  CHECK(broken[0].rest_length == 1.0);
  CHECK(returns(scene<Leapfrog>(Box<1>::unbounded(), group<Post>("post", Frozen<1>{}, Points<1>{{Vector<1>(0.0)}}, 1.0),
                                group<Bead>("bead", Mobile{}, Points<1>{{Vector<1>(1.0)}}, 1.0),
                                substepped_bonds<Bead, Post>(law, {{0, 0}}, 3)))
            .size() == 1);
}

TEST_CASE("a bar of springs between clamps bears k eps / n until its shortest spring is strained to the limit, then nothing") {
  struct Grip {};
  constexpr std::uint32_t springs = 8;
  constexpr double stiffness = 1000.0, short_one = 0.5, limit = 0.02;  // one spring of half the length: twice the strain
  Points<1> inner, end{{Vector<1>(springs - 1.0 + short_one)}};
  std::vector<Bond> list, to_post{{0, 0}}, to_grip{{springs - 2, 0}};
  for (std::uint32_t k = 0; k + 1 < springs; ++k) inner.positions.emplace_back(k < 3 ? k + 1.0 : k + short_one);
  for (std::uint32_t k = 0; k + 2 < springs; ++k) list.push_back({k, k + 1});
  const particles::Clamp<1> pull{.direction = {{{1.0}}}, .motion = {.speed = 1e-3, .start_up = 10.0}};
  const Breaking law{bond::KelvinVoigt{.stiffness = stiffness, .damping = 30.0}, LargestStrain{.strain = limit}};
  auto bar = scene<Leapfrog>(Box<1>::unbounded(), group<Post>("post", Frozen<1>{}, Points<1>{{Vector<1>(0.0)}}, 1.0),
                             group<Bead>("bar", Mobile{}, inner, 1.0), group<Grip>("grip", particles::Driven{pull}, end, 1.0),
                             bonds<Bead, Bead>(law, list), bonds<Bead, Post>(law, to_post), bonds<Bead, Grip>(law, to_grip));
  const double moved_at_break = springs * limit * short_one, until = 10.0 + (moved_at_break - 5e-3) / 1e-3;  // the start-up covers 5 mm
  double peak = 0.0;
  bar.every(0.1, [&](auto& now) {
    const double at_post = bond_load<Post>(now)[0], at_grip = bond_load<Grip>(now)[0];
    peak = std::fmax(peak, at_post);
    if (now.time() > 20.0 && now.time() < until - 1.0) {
      const double force = stiffness * pull.motion.displacement(now.time()) / springs;
      CHECK(at_post == doctest::Approx(force).epsilon(0.01));
      CHECK(at_grip == doctest::Approx(-force).epsilon(0.01));
    }
  });
  bar.run({.until = until + 30.0, .time_step = 1e-3});
  CHECK(peak == doctest::Approx(stiffness * limit * short_one).epsilon(0.01));
  CHECK(broken_bonds<Bead, Bead>(bar).size() == 1);
  CHECK(broken_bonds<Bead, Bead>(bar)[0].i == 2);
  CHECK(std::fabs(bond_load<Post>(bar)[0]) < 1e-3 * peak);
}

// ---- Bodies ---------------------------------------------------------------------------------------------------------------------------

namespace {

struct Net {};

constexpr double stiffness = 50.0, strain = 0.06, mass = 1.0;
constexpr std::uint32_t side = 22;  // 10648 beads: two blocks

std::vector<Vector<3>> beads() {
  std::vector<Vector<3>> result;
  for (std::uint32_t z = 0; z < side; ++z)
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t x = 0; x < side; ++x) result.emplace_back(0.1 * x + 0.05, 0.1 * y + 0.05, 0.1 * z + 0.05);
  return result;
}
std::vector<Bond> edges() {
  std::vector<Bond> result;
  for (std::uint32_t row = 0; row < side * side * side; ++row) {
    if (row % side != 0) result.push_back({row, row - 1});
    if (row / side % side != 0) result.push_back({row, row - side});
    if (row / side / side != 0) result.push_back({row, row - side * side});
  }
  return result;
}
auto body(const std::vector<Bond>& list, const Box<3>& box = Box<3>::unbounded()) {
  auto result = scene<Leapfrog>(box, group<Net>("net", Mobile{}, Points<3>{beads()}, mass),
                                bonds<Net, Net>(Breaking{Harmonic{.stiffness = stiffness}, LargestStrain{.strain = strain}}, list));
  test::RandomVectors random;
  result.template group<Net>().template set<field::Velocity>([&](const auto&) { return random.vector(0.06); });
  return result;
}
std::vector<Vector<3>> places(const auto& scene) {
  return {scene.template group<Net>().positions().begin(), scene.template group<Net>().positions().end()};
}

}  // namespace

TEST_CASE("a body in which bonds break keeps momentum and angular momentum, and loses with each bond what it had stored") {
  const auto list = edges();
  auto net = body(list);
  constexpr double dt = 1e-3;
  struct Sums {
    Vector<3> momentum = Vector<3>::Zero(), spin = Vector<3>::Zero();
    double energy = 0.0, speed = 0.0;
  };
  const auto look = [&] {
    Sums sums;
    const auto& g = net.group<Net>();
    for (std::size_t i = 0; i < g.size(); ++i) {
      const Vector<3>& v = g.get<field::Velocity>()[i];
      sums.momentum += mass * v;
      sums.spin += mass * g.positions()[i].cross(v);
      sums.energy += 0.5 * mass * v.squaredNorm();
      sums.speed = std::fmax(sums.speed, v.norm());
    }
    const auto gone = broken_bonds<Net, Net>(net);
    auto next = gone.begin();
    for (const Bond& one : list) {
      if (next != gone.end() && next->i == one.i && next->j == one.j) ++next;
      else sums.energy += 0.5 * stiffness * square((g.positions()[one.i] - g.positions()[one.j]).norm() - 0.1);
    }
    CHECK(next == gone.end());
    return sums;
  };
  const Sums start = look();
  std::size_t before = 0;
  for (int part = 1; part <= 5; ++part) {
    net.run({.until = 0.1 * part, .time_step = dt});
    const auto count = broken_bonds<Net, Net>(net).size();
    CHECK(count >= before);
    before = count;
    const Sums now = look();
    CHECK((now.momentum - start.momentum).norm() <= 1e-12 * mass * 0.06 * side * side * side);
    CHECK((now.spin - start.spin).norm() <= 1e-12 * mass * 0.06 * side * side * side);
    const double least = 0.5 * stiffness * square(strain * 0.1), one_step = 2.0 * stiffness * strain * 0.1 * 2.0 * now.speed * dt;
    const double drift = 2.0 * square(dt) * 12.0 * stiffness / mass * start.energy / 4.0;  // (omega dt)^2/4 of the energy, twice
    CHECK(start.energy - now.energy >= static_cast<double>(count) * least - drift);
    CHECK(start.energy - now.energy <= static_cast<double>(count) * (least + one_step) + drift);
  }
  CHECK(before > list.size() / 100);
  CHECK(before < list.size() / 2);
}

TEST_CASE("the same bonds break, to the same bits, for any number of threads; the order of the bonds changes nothing but rounding") {
  auto list = edges();
  const int threads_before = available_threads();
  auto first = body(list);
  first.run({.until = 0.4, .time_step = 2e-3});
  const auto gone = broken_bonds<Net, Net>(first);
  CHECK(gone.size() > 100);
  for (const int threads : {2, 3}) {
    use_threads(threads);
    auto again = body(list);
    again.run({.until = 0.4, .time_step = 2e-3});
    CHECK(places(again) == places(first));
    CHECK(broken_bonds<Net, Net>(again).size() == gone.size());
  }
  use_threads(threads_before);
  const auto& blocks = first.group<Net>().blocks;
  REQUIRE(blocks.size() == 2);
  std::size_t across = 0, whole_there = 0, different = 0;
  first.engine().for_each_item([&](const auto& active) {  // a bond across two blocks is listed at both ends
    if constexpr (requires { active.recall; })
      for (const Bond& one : active.item.bonds) {
        const auto broken = [&](std::uint32_t i, std::uint32_t j) { return active.of_a.of(i).rest_length[active.of_a.find(i, j)] < 0.0; };
        if ((one.i < blocks.end(0)) == (one.j < blocks.end(0))) continue;
        ++across;
        whole_there += broken(one.i, one.j) ? 0 : 1;
        different += broken(one.i, one.j) != broken(one.j, one.i) ? 1 : 0;
      }
  });
  CHECK(across == side * side);
  CHECK(whole_there < across);
  CHECK(whole_there > 0);
  CHECK(different == 0);
  std::reverse(list.begin(), list.end());
  for (Bond& one : list) std::swap(one.i, one.j);
  auto reversed = body(list);
  reversed.run({.until = 0.4, .time_step = 2e-3});
  CHECK(broken_bonds<Net, Net>(reversed).size() == gone.size());
  double largest = 0.0;
  const auto x = places(first), y = places(reversed);
  for (std::size_t i = 0; i < x.size(); ++i) largest = std::fmax(largest, (x[i] - y[i]).norm());
  CHECK(largest < 1e-12);
}

TEST_CASE("a restart knows which bonds have broken") {
  const auto list = edges();
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "dmp_breaking_test.checkpoint";
  auto whole = body(list);
  whole.run({.until = 0.2, .time_step = 2e-3});
  whole.checkpoint(path.string());
  whole.run({.until = 0.4, .time_step = 2e-3});
  auto restarted = body(list);
  restarted.restart(path.string());
  CHECK(broken_bonds<Net, Net>(restarted).size() > 10);
  restarted.run({.until = 0.4, .time_step = 2e-3});
  CHECK(places(restarted) == places(whole));
  CHECK(broken_bonds<Net, Net>(restarted).size() == broken_bonds<Net, Net>(whole).size());
  std::filesystem::remove(path);
}

TEST_CASE("what a broken bond had kept apart from a pair law is a pair again") {
  // Two beads fly at each other. Their bond breaks on the way, by its energy in compression; the repulsion then turns them back.
  const potential::LennardJones repulsion{.energy_scale = 1.0, .diameter = 0.5, .cutoff = 0.55};
  for (const double energy : {0.01, 1e9}) {
    CAPTURE(energy);
    auto pair = scene<Leapfrog>(Box<2>::unbounded(), group<Bead>("beads", Mobile{}, Points<2>{{{0.0, 0.0}, {2.0, 0.0}}}, 1.0),
                                bonds<Bead, Bead>(Breaking{Harmonic{.stiffness = 0.1}, LargestEnergy{.energy = energy}}, {{0, 1}}),
                                interaction<Bead, Bead>(repulsion).excluding_bonded(1));
    pair.group<Bead>().get<field::Velocity>()[0][0] = 1.0;
    pair.group<Bead>().get<field::Velocity>()[1][0] = -1.0;
    pair.run({.until = 1.5, .time_step = 1e-4});
    const bool breaks = energy < 1.0;
    CHECK(broken_bonds<Bead, Bead>(pair).size() == (breaks ? 1 : 0));
    const double distance = pair.group<Bead>().positions()[1][0] - pair.group<Bead>().positions()[0][0];
    CHECK((distance > 0.0) == breaks);  // a spring alone lets them through each other
    const double left = breaks ? 1.0 - energy : 1.0;  // of the energy; both beads share what the bond has taken
    if (breaks) CHECK(square(pair.group<Bead>().get<field::Velocity>()[1][0]) == doctest::Approx(left).epsilon(2e-3));
  }
}

TEST_CASE("pieces may fly apart as far as they like in a periodic box, bonded beads may not") {
  const Box<1> box{.lower = Vector<1>(0.0), .upper = Vector<1>(10.0), .periodic = {true}};
  const auto flying = [&](double limit) {
    auto pair = scene<Leapfrog>(box, group<Bead>("beads", Mobile{}, Points<1>{{Vector<1>(2.0), Vector<1>(3.0)}}, 1.0),
                                bonds<Bead, Bead>(Breaking{Harmonic{.stiffness = 1e-3}, LargestStrain{.strain = limit}}, {{0, 1}}));
    pair.group<Bead>().get<field::Velocity>()[1][0] = 1.0;
    pair.run({.until = 8.0, .time_step = 0.01});
  };
  CHECK_NOTHROW(flying(0.1));
  CHECK_THROWS_AS(flying(1e9), SimulationError);
}

TEST_CASE("a restart leaves out the pairs that are still bonded and no others, whatever the scene knew before") {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "dmp_breaking_exclusions.checkpoint";
  const potential::LennardJones repulsion{.energy_scale = 1.0, .diameter = 0.5, .cutoff = 0.55};
  const auto two_pairs = [&](double first, double second) {  // each flies together at this speed; its bond breaks on the way
    auto made = scene<Leapfrog>(Box<2>::unbounded(),
                                group<Bead>("beads", Mobile{}, Points<2>{{{0.0, 0.0}, {2.0, 0.0}, {0.0, 50.0}, {2.0, 50.0}}}, 1.0),
                                bonds<Bead, Bead>(Breaking{Harmonic{.stiffness = 0.1}, LargestEnergy{.energy = 0.01}}, {{0, 1}, {2, 3}}),
                                interaction<Bead, Bead>(repulsion).excluding_bonded(1));
    auto& v = made.template group<Bead>().template get<field::Velocity>();
    v[0][0] = first, v[1][0] = -first, v[2][0] = second, v[3][0] = -second;
    return made;
  };
  auto whole = two_pairs(1.0, 0.0), other = two_pairs(0.0, 1.0);
  whole.run({.until = 0.5, .time_step = 1e-3});
  whole.checkpoint(path.string());
  whole.run({.until = 1.5, .time_step = 1e-3});
  other.run({.until = 0.5, .time_step = 1e-3});
  other.restart(path.string());
  other.run({.until = 1.5, .time_step = 1e-3});
  const auto x = [](const auto& of, std::size_t row) { return of.template group<Bead>().positions()[row][0]; };
  CHECK(x(whole, 1) - x(whole, 0) > 0.5);
  for (const std::size_t row : {0u, 1u, 2u, 3u}) CHECK(x(other, row) == x(whole, row));
  std::filesystem::remove(path);
}

TEST_CASE("a pair whose bond breaks attracts at once, however rarely lists are built") {
  const potential::LennardJones attraction{.energy_scale = 1.0, .diameter = 0.5, .cutoff = 1.25};
  std::vector<double> distances;
  for (const double skin : {0.0, 0.25, 0.5}) {
    auto pair = scene<Leapfrog>(Box<2>::unbounded(), group<Bead>("beads", Mobile{}, Points<2>{{{0.0, 0.0}, {0.56, 0.0}}}, 1.0),
                                bonds<Bead, Bead>(Breaking{Harmonic{.stiffness = 1e-6}, LargestStrain{.strain = 0.01}}, {{0, 1}}),
                                interaction<Bead, Bead>(attraction).excluding_bonded(1));
    pair.set_skin(skin);
    pair.group<Bead>().get<field::Velocity>()[0][0] = -0.1;
    pair.group<Bead>().get<field::Velocity>()[1][0] = 0.1;
    pair.run({.until = 1.0, .time_step = 1e-3});
    distances.push_back(pair.group<Bead>().positions()[1][0] - pair.group<Bead>().positions()[0][0]);
  }
  CHECK(distances[0] < 0.7);  // 0.76 without attraction
  CHECK(distances[1] == doctest::Approx(distances[0]).epsilon(1e-12));
  CHECK(distances[2] == doctest::Approx(distances[0]).epsilon(1e-12));
}

TEST_CASE("a run goes on with its last step when the last bond has broken; bonds between posts are never asked") {
  auto bead = tethered(Breaking{Harmonic{.stiffness = 100.0}, LargestStrain{.strain = 0.05}}, 2.0);
  bead.run({.until = 5.0});
  CHECK(broken_bonds<Bead, Post>(bead).size() == 1);
  CHECK(bead.group<Bead>().positions()[0][0] > 5.0);
  auto posts = scene<Leapfrog>(Box<1>::unbounded(), group<Post>("posts", Frozen<1>{}, Points<1>{{Vector<1>(0.0), Vector<1>(9.0)}}, 1.0),
                               group<Bead>("bead", Mobile{}, Points<1>{{Vector<1>(1.0)}}, 1.0),
                               bonds<Post, Post>(Breaking{Harmonic{.stiffness = 1.0}, LargestStrain{.strain = 0.1}}, {{0, 1}}));
  posts.run({.until = 1.0, .time_step = 0.1});
  CHECK(broken_bonds<Post, Post>(posts).empty());
}

TEST_CASE(
    "a bound of the step is named after the bonds that are left: stiffer ones that have broken no longer count, listed at either end") {
  const Breaking brittle{Harmonic{.stiffness = 100.0}, LargestStrain{.strain = 0.05}};
  const Harmonic soft{.stiffness = 30.0};
  const auto check = [](auto scene, const std::string& both) {
    scene.template group<Bead>().template get<field::Velocity>()[0] = Vector<1>(2.0);
    CHECK(scene.step_limit().stability_bound_by == "bond stiffness of " + both + " (number 1 of 2)");
    const auto report = scene.run({.until = 0.2, .time_step = 0.01});
    CHECK(report.limit.stability_bound_by == "bond stiffness of " + both + " (number 1 of 2)");
    CHECK(scene.step_limit().stability_bound_by == "bond stiffness of " + both + " (number 2 of 2)");
  };
  const auto beads = group<Bead>("beads", Mobile{}, Points<1>{{Vector<1>(1.0), Vector<1>(0.0)}}, 1.0);
  check(scene<Leapfrog>(Box<1>::unbounded(), beads, bonds<Bead, Bead>(brittle, {{0, 1}}), bonds<Bead, Bead>(soft, {{0, 1}})),
        "beads - beads");
  check(scene<Leapfrog>(Box<1>::unbounded(), beads, bonds<Bead, Bead>(brittle, {{1, 0}}), bonds<Bead, Bead>(soft, {{1, 0}})),
        "beads - beads");
  check(scene<Leapfrog>(Box<1>::unbounded(), beads, group<Post>("post", Frozen<1>{}, Points<1>{{Vector<1>(-1.0)}}, 1.0),
                        bonds<Post, Bead>(brittle, {{0, 0}, {0, 1, 1.0, 0.01}}), bonds<Post, Bead>(soft, {{0, 0}})),
        "post - beads");
}

// ---- Bonds that turn, and the step --------------------------------------------------------------------------------------------------

namespace {
/// Two bonds under pressure hold a bead at right angles; as it flies off they come to pull along one line, and hold it twice as hard.
auto turning(const auto& held, double drag) {
  return scene<Leapfrog>(Box<2>::unbounded(), group<Post>("posts", Frozen<2>{}, Points<2>{{{-5.0, 0.0}, {0.0, -5.0}}}, 1.0),
                         group<Bead>("bead", Mobile{}, Points<2>{{{0.0, 0.0}}}, 1.0), held,
                         forced_by<Bead>(forcing::Drag{.coefficient = drag}));
}
std::vector<Bond> pressed(double rest_length) { return {{0, 0, rest_length}, {0, 1, rest_length}}; }
}  // namespace

TEST_CASE("sub-steps are as many as the bonds need now, also in a step that is given; a given step that no longer holds is caught") {
  auto fast = turning(substepped_bonds<Bead, Post>(Harmonic{.stiffness = 100.0}, pressed(5.5)), 0.01);
  fast.run({.until = 60.0, .time_step = 0.17});  // one sub-step at first, two later
  CHECK(fast.engine().substeps() == 2);
  const double stored = 2.0 * 0.5 * 100.0 * square(0.5);
  CHECK(0.5 * fast.group<Bead>().get<field::Velocity>()[0].squaredNorm() <= stored);
  for (const int steps : {90, 110}) {
    auto slow = turning(bonds<Bead, Post>(Harmonic{.stiffness = 100.0}, pressed(50.0)), 0.5);
    CHECK_THROWS_AS(slow.run({.until = 0.18 * steps, .time_step = 0.18}), SimulationError);
  }
}

TEST_CASE("a restart in mid-run takes the sub-steps that the run had") {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "dmp_substeps.checkpoint";
  for (const double time_step : {0.0, 0.5}) {
    const auto made = [] {
      auto loose = scene<Leapfrog>(
          Box<1>::unbounded(), group<Post>("post", Frozen<1>{}, Points<1>{{Vector<1>(0.0), Vector<1>(2.0)}}, 1.0),
          group<Bead>("bead", Mobile{}, Points<1>{{Vector<1>(1.0)}}, 1.0),
          substepped_bonds<Bead, Post>(Breaking{Harmonic{.stiffness = 100.0}, LargestStrain{.strain = 0.05}}, {{0, 0}}),
          substepped_bonds<Bead, Post>(Harmonic{.stiffness = 20.0}, {{0, 1}}), bonds<Bead, Post>(Harmonic{.stiffness = 1.0}, {{0, 1}}));
      loose.template group<Bead>().template get<field::Velocity>()[0][0] = 2.0;
      return loose;
    };
    auto whole = made();
    bool saved = false;
    whole.every(1.5, [&](auto& now) {
      if (saved || now.step() == 0) return;
      saved = true;
      now.checkpoint(path.string());
    });
    whole.run({.until = 20.0, .time_step = time_step});
    REQUIRE(saved);
    auto restarted = made();
    restarted.restart(path.string());
    restarted.run({.until = 20.0, .time_step = time_step});
    CHECK(broken_bonds<Bead, Post>(whole).size() == 1);
    CHECK(restarted.group<Bead>().positions()[0][0] == whole.group<Bead>().positions()[0][0]);
  }
  std::filesystem::remove(path);
}

namespace {
struct Cable {  // a force that does not depend on the length
  double force;
  [[nodiscard]] auto tension(const auto& bond) const noexcept { return force + 0.0 * bond.length; }
  [[nodiscard]] double largest_stiffness() const noexcept { return 0.0; }
};
}  // namespace

TEST_CASE("a tensioned cable without stiffness holds across, T/r: the step has a bound") {
  const auto cable =
      scene<Leapfrog>(Box<2>::unbounded(), group<Post>("posts", Frozen<2>{}, Points<2>{{{-1.0, 0.0}, {1.0, 0.0}}}, 1.0),
                      group<Bead>("bead", Mobile{}, Points<2>{{{0.0, 0.0}}}, 1.0), bonds<Bead, Post>(Cable{50.0}, {{0, 0}, {0, 1}}));
  auto made = cable;
  CHECK(made.step_limit().stable_time_step == doctest::Approx(2.0 / std::sqrt(2.0 * 50.0)).epsilon(1e-12));
}
