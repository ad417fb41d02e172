// Bonds with memory in a scene: Maxwell and standard linear solid, against closed forms, a plain loop, and themselves after a restart.
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/bond.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/forcing.hpp>
#include <dmp/integrator.hpp>
#include <dmp/simulation.hpp>
#include "support/random.hpp"

using namespace dmp;
using namespace dmp::simulation;
using bond::Maxwell, bond::StandardLinearSolid;
using geometry::Box, geometry::Points;
using integrator::ExtrapolatedVerlet, integrator::Leapfrog;
using neighbours::Bond;
using particles::Driven, particles::Mobile;

namespace {

struct Left {};
struct Right {};

constexpr double rest_length = 10.0;  // [m], more than any extension
constexpr double held = 1e30;         // [kg], which no force moves

struct Pair {
  double force = 0.0, mass = held, extension = 0.0, speed = 0.0;  // of the right bead [N, kg, m, m/s]; the left one is held
};
template <class Integrator = Leapfrog, class Law>
auto pair_of(const Law& law, const Pair& with) {
  auto result =
      scene<Integrator>(Box<1>::unbounded(), group<Left>("left", particles::Frozen<1>{}, Points<1>{{Vector<1>(0.0)}}, 1.0),
                        group<Right>("right", Mobile{}, Points<1>{{Vector<1>(rest_length)}}, with.mass), bonds<Left, Right>(law, {{0, 0}}),
                        forced_by<Right>(forcing::Constant<1>{.uniform_acceleration = {{{with.force / with.mass}}}}));
  result.template group<Right>().positions()[0][0] += with.extension;
  result.template group<Right>().template get<field::Velocity>()[0][0] = with.speed;
  return result;
}
double extension(const auto& scene) { return scene.template group<Right>().positions()[0][0] - rest_length; }
double tension(const auto& scene, double mass) { return -mass * scene.template group<Right>().template get<field::Acceleration>()[0][0]; }

}  // namespace

TEST_CASE("relaxation at a held extension is k X e^(-k t/c), and X (k_e + k_m e^(-t/tau)): to rounding, whatever the step") {
  for (const double step : {1.0 / 1024, 1.0 / 8, 1.0}) {
    CAPTURE(step);
    auto liquid = pair_of(Maxwell{.stiffness = 3.0, .damping = 6.0}, {.extension = 0.5});
    auto solid = pair_of(StandardLinearSolid{.stiffness = 2.0, .branch_stiffness = 6.0, .branch_damping = 3.0}, {.extension = 0.5});
    double worst = 0.0;
    liquid.every(1.0,
                 [&](const auto& s) { worst = std::max(worst, std::fabs(tension(s, held) / (1.5 * std::exp(-0.5 * s.time())) - 1.0)); });
    solid.every(1.0, [&](const auto& s) {
      worst = std::max(worst, std::fabs(tension(s, held) / (0.5 * (2.0 + 6.0 * std::exp(-2.0 * s.time()))) - 1.0));
    });
    liquid.run({.until = 5.0, .time_step = step});
    solid.run({.until = 5.0, .time_step = step});
    CHECK(worst <= 1e-12);
  }
}

TEST_CASE("pulled at a steady rate v a Maxwell bond comes to c v (1 - e^(-k t/c)), whatever the step") {
  for (const double step : {1.0 / 1024, 1.0 / 8, 1.0}) {
    auto liquid = pair_of(Maxwell{.stiffness = 3.0, .damping = 6.0}, {.speed = 0.25});
    liquid.run({.until = 3.0, .time_step = step});
    CHECK(tension(liquid, held) == doctest::Approx(6.0 * 0.25 * -std::expm1(-0.5 * 3.0)).epsilon(1e-12));
  }
}

TEST_CASE("creep of a Maxwell bond is F (1/k + t/c), with a mass too if it starts so") {
  auto liquid = pair_of(Maxwell{.stiffness = 3.0, .damping = 6.0}, {.force = 1.5, .mass = 1.0, .extension = 0.5, .speed = 0.25});
  double worst = 0.0;
  liquid.every(0.5, [&](const auto& s) { worst = std::max(worst, std::fabs(extension(s) - 1.5 * (1.0 / 3.0 + s.time() / 6.0))); });
  liquid.run({.until = 10.0, .time_step = 0.01});
  CHECK(worst <= 1e-12);
}

TEST_CASE("creep of a standard linear solid is (F/k_e) [1 - k_m/(k_e + k_m) e^(-t/t_c)]") {
  const StandardLinearSolid law{.stiffness = 2.0, .branch_stiffness = 6.0, .branch_damping = 3.0};
  const double slow = 3.0 * 8.0 / 12.0, force = 1.6, mass = 1e-7;  // t_c = 2 s; inertia changes the extension by about m/(k t_c^2)
  const auto exact = [&](double t) { return force / 2.0 * (1.0 - 0.75 * std::exp(-t / slow)); };
  auto solid = pair_of(law, {.force = force, .mass = mass, .extension = exact(0.0), .speed = force / 2.0 * 0.75 / slow});
  double worst = 0.0;
  solid.every(0.1, [&](const auto& s) { worst = std::max(worst, std::fabs(extension(s) - exact(s.time()))); });
  solid.run({.until = 5.0, .time_step = 1e-4});
  CHECK(worst <= 2e-8);
}

TEST_CASE("bonds with memory are of second order, whatever shows laws the velocity") {
  const StandardLinearSolid law{.stiffness = 2.0, .branch_stiffness = 6.0, .branch_damping = 3.0};
  const auto at_2 = [&]<class Integrator>(Integrator, double step) {
    auto solid = pair_of<Integrator>(law, {.force = 1.0, .mass = 1.0, .extension = 0.3});
    solid.run({.until = 2.0, .time_step = step});
    return extension(solid);
  };
  const auto order = [&](auto integrator) {
    const double exact = (4.0 * at_2(integrator, 1.0 / 4096) - at_2(integrator, 1.0 / 2048)) / 3.0;
    return std::log2((at_2(integrator, 1.0 / 32) - exact) / (at_2(integrator, 1.0 / 64) - exact));
  };
  CHECK(order(Leapfrog{}) == doctest::Approx(2.0).epsilon(0.01));
  CHECK(order(ExtrapolatedVerlet{}) == doctest::Approx(2.0).epsilon(0.01));
}

TEST_CASE("limits of a standard linear solid: no branch, a dashpot too stiff to yield, one that does not resist") {
  const auto at_3 = [](const auto& law) {
    auto pair = pair_of(law, {.force = 1.0, .mass = 1.0});
    pair.run({.until = 3.0, .time_step = 1.0 / 256});
    return extension(pair);
  };
  const double soft = at_3(bond::Harmonic{.stiffness = 2.0}), stiff = at_3(bond::Harmonic{.stiffness = 8.0});
  CHECK(std::fabs(soft - stiff) > 0.1);
  CHECK(std::fabs(at_3(StandardLinearSolid{.stiffness = 2.0, .branch_stiffness = 0.0, .branch_damping = 3.0}) - soft) <= 1e-13);
  CHECK(std::fabs(at_3(StandardLinearSolid{.stiffness = 2.0, .branch_stiffness = 6.0, .branch_damping = 0.0}) - soft) <= 1e-13);
  CHECK(std::fabs(at_3(StandardLinearSolid{.stiffness = 2.0, .branch_stiffness = 6.0, .branch_damping = 1e-300}) - soft) <= 1e-13);
  CHECK(std::fabs(at_3(StandardLinearSolid{.stiffness = 2.0, .branch_stiffness = 6.0, .branch_damping = 1e100}) - stiff) <= 1e-12);
}

TEST_CASE("the bound of the step of a standard linear solid is that of both its springs, and it is stable at 0.95 of it") {
  for (const double damping : {1e-3, 0.3, 3.0, 1e3}) {
    CAPTURE(damping);
    auto solid =
        pair_of(StandardLinearSolid{.stiffness = 2.0, .branch_stiffness = 6.0, .branch_damping = damping}, {.mass = 1.0, .extension = 0.1});
    const double bound = 2.0 / std::sqrt(8.0);
    CHECK(solid.step_limit().stable_time_step == doctest::Approx(bound).epsilon(1e-14));
    solid.run({.until = 5000.0 * bound, .time_step = 0.95 * bound});
    CHECK(std::fabs(extension(solid)) < 0.5);
  }
}

// ---- Nets ---------------------------------------------------------------------------------------------------------------------------

namespace {

struct Net {};
struct Other {};
struct Plate {};

constexpr StandardLinearSolid solid{.stiffness = 50.0, .branch_stiffness = 100.0, .branch_damping = 10.0};
constexpr std::uint32_t side = 22;

/// 10648 beads in two blocks, bonded to their neighbours through the periodic faces too; a second group and a driven plate bonded to some.
template <bool Substepped = false>
auto lattice() {
  Points<3> beads, others, plate;
  std::vector<Bond> list, between, to_plate;
  for (std::uint32_t z = 0; z < side; ++z)
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t x = 0; x < side; ++x) {
        const std::uint32_t row = x + side * (y + side * z);
        beads.positions.push_back({0.1 * x + 0.05, 0.1 * y + 0.05, 0.1 * z + 0.05});
        list.push_back({row, (x + 1) % side + side * (y + side * z)});
        list.push_back({row, x + side * ((y + 1) % side + side * z)});
        list.push_back({row, x + side * (y + side * ((z + 1) % side))});
        if (row % 5 == 0) {
          others.positions.push_back(Vector<3>(beads.positions.back() + Vector<3>(0.03, 0.04, 0.02)));
          between.push_back({row, static_cast<std::uint32_t>(others.positions.size() - 1)});
          between.push_back({(row + 1) % (side * side * side), static_cast<std::uint32_t>(others.positions.size() - 1)});
        }
        if (row % 400 == 0) {
          plate.positions.push_back(Vector<3>(beads.positions.back() + Vector<3>(0.0, 0.0, 0.05)));
          to_plate.push_back({row, static_cast<std::uint32_t>(plate.positions.size() - 1), -1.0, 0.5});
        }
      }
  std::erase_if(between, [&](const Bond& bond) {  // not across the whole box
    return (beads.positions[bond.i] - others.positions[bond.j]).norm() > 0.2;
  });
  struct Shake {
    Vector<3> position(const Vector<3>& start, double time) const { return start + Vector<3>(0.02 * std::sin(3.0 * time), 0.0, 0.0); }
    Vector<3> velocity(const Vector<3>&, double time) const { return {0.06 * std::cos(3.0 * time), 0.0, 0.0}; }
  };
  const double length = 0.1 * side;
  auto within = [&] {
    if constexpr (Substepped) return substepped_bonds<Net, Net>(solid, list);
    else return bonds<Net, Net>(solid, list);
  }();
  auto result = scene<Leapfrog>(Box<3>{.lower = {0.0, 0.0, 0.0}, .upper = {length, length, length}, .periodic = {true, true, true}},
                                group<Net>("net", Mobile{}, beads, 1.0), group<Other>("others", Mobile{}, others, 0.5),
                                group<Plate>("plate", Driven<Shake>{}, plate, 1.0), within,
                                bonds<Net, Other>(Maxwell{.stiffness = 30.0, .damping = 2.0}, between), bonds<Plate, Net>(solid, [&] {
                                  for (Bond& bond : to_plate) std::swap(bond.i, bond.j);
                                  return to_plate;
                                }()));
  test::RandomVectors random;
  result.template group<Net>().template set<field::Velocity>(
      [&](const auto&) { return Vector<3>(random.vector(0.2) + Vector<3>(0.5, 0.0, -0.3)); });
  result.template group<Other>().template set<field::Velocity>([&](const auto&) { return random.vector(0.2); });
  return result;
}

/// Everything that a scene with bonds remembers.
std::vector<double> state(auto& scene) {
  std::vector<double> all;
  scene.engine().for_each_group([&](auto& g) {
    for (const auto& column : g.view().columns) all.insert(all.end(), column.values.begin(), column.values.end());
  });
  scene.engine().for_each_item([&](auto& active) {
    if constexpr (requires { active.recall; })
      for (auto* list : {&active.of_a, &active.of_b})
        for (const auto& column : list->view("").columns) all.insert(all.end(), column.values.begin(), column.values.end());
  });
  return all;
}
std::size_t differences(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return a.size() + b.size();
  std::size_t count = 0;
  for (std::size_t k = 0; k < a.size(); ++k) count += a[k] != b[k];
  return count;
}
/// Calls function(own row, partner, number, length) for what the entries of a list remember.
void for_each_memory(neighbours::BondList& list, std::size_t particles, auto&& function) {
  for (std::size_t i = 0; !list.empty() && i < particles; ++i) {
    const auto entries = list.of(i);
    const auto memory = list.memory_of(i);
    for (std::size_t k = 0; k < entries.size; ++k)
      if (entries.rest_length[k] >= 0.0)
        function(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(list.partner_of(i, k)), memory.memory[k], memory.length[k]);
  }
}

}  // namespace

TEST_CASE("bonds that are listed at both ends remember the same, bit for bit: across blocks, between groups, through periodic faces") {
  auto scene = lattice();
  CHECK(scene.group<Net>().blocks.size() == 2);
  scene.run({.until = 0.5, .time_step = 0.005});
  scene.engine().build_lists();
  scene.run({.until = 1.0, .time_step = 0.005});
  std::size_t twice = 0, different = 0;
  double largest = 0.0;
  scene.engine().for_each_item([&](auto& active) {
    if constexpr (requires { active.recall; }) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      constexpr bool same = std::is_same_v<typename I::A, typename I::B>;
      std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<double, double>> seen;
      for_each_memory(active.of_a, scene.template group<typename I::A>().size(),
                      [&](std::uint32_t i, std::uint32_t j, double memory, double length) {
                        largest = std::max(largest, std::fabs(memory));
                        if (const auto other = seen.find({j, i}); same && other != seen.end()) {
                          ++twice;
                          different += other->second != std::pair(memory, length);
                        }
                        seen[{i, j}] = {memory, length};
                      });
      if (!same)
        for_each_memory(active.of_b, scene.template group<typename I::B>().size(),
                        [&](std::uint32_t i, std::uint32_t j, double memory, double length) {
                          if (const auto other = seen.find({j, i}); other != seen.end()) {
                            ++twice;
                            different += other->second != std::pair(memory, length);
                          }
                        });
    }
  });
  CHECK(twice > 3000);
  CHECK(different == 0);
  CHECK(largest > 0.1);
}

TEST_CASE("bonds with memory: 1, 2 and 4 threads give the same bits") {
  const int before = available_threads();
  std::vector<double> first;
  for (const int threads : {1, 2, 4}) {
    use_threads(threads);
    auto scene = lattice();
    scene.run({.until = 0.2, .time_step = 0.005});
    if (first.empty()) first = state(scene);
    CHECK(differences(first, state(scene)) == 0);
  }
  use_threads(before);
}

TEST_CASE("bonds with memory: a run that is restarted from a checkpoint goes on as the one that wrote it, bit for bit; so with sub-steps") {
  const auto path = (std::filesystem::temp_directory_path() / "dmp_bond_memory_test.checkpoint").string();
  const auto check = [&](auto made) {
    auto whole = made();
    whole.run({.until = 0.3, .time_step = 0.01});
    whole.checkpoint(path);
    auto again = made();
    again.restart(path);
    CHECK(differences(state(whole), state(again)) == 0);
    whole.run({.until = 0.6, .time_step = 0.01});
    again.run({.until = 0.6, .time_step = 0.01});
    CHECK(differences(state(whole), state(again)) == 0);
    auto fresh = made();
    CHECK(differences(state(whole), state(fresh)) > 10000);
  };
  check([] { return lattice(); });
  check([] { return lattice<true>(); });
  std::filesystem::remove(path);
}

TEST_CASE("memories step once per step of the scene: evaluating the forces between steps changes none") {
  auto once = lattice(), often = lattice();
  once.run({.until = 0.1, .time_step = 0.005});
  often.run({.until = 0.1, .time_step = 0.005});
  once.engine().build_lists();  // as evaluate does: positions go back into the box
  often.engine().evaluate(often.time(), often.step());
  const auto after_first = state(often);
  often.engine().evaluate(often.time(), often.step());
  CHECK(differences(after_first, state(often)) == 0);
  const auto a = state(once), b = state(often);
  double worst = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) worst = std::max(worst, std::fabs(a[k] - b[k]));
  CHECK(worst <= 1e-12);  // lengths have other rounding errors in other places of the box
}

TEST_CASE("bonds with memory in packs do what a plain loop over the bonds does") {
  test::RandomVectors random;
  std::vector<Vector<3>> x, v;
  std::vector<Bond> list;
  for (std::uint32_t k = 0; k < 30; ++k) {
    x.push_back(random.vector(1.0));
    v.push_back(random.vector(1.0));
    for (std::uint32_t other = 0; other < k; ++other)
      if ((7 * k + 3 * other) % 4 == 0) list.push_back({k, other, (x[k] - x[other]).norm() * 0.9, 1.0 + 0.1 * (k % 3)});
  }
  auto net = scene<Leapfrog>(Box<3>::unbounded(), group<Net>("net", Mobile{}, Points<3>{x}, 1.0), bonds<Net, Net>(solid, list));
  for (std::size_t k = 0; k < x.size(); ++k) net.group<Net>().get<field::Velocity>()[k] = v[k];
  constexpr double dt = 0.002;
  net.run({.until = 200 * dt, .time_step = dt});

  std::vector<double> memory(list.size(), 0.0), length;
  for (const Bond& bond : list) length.push_back((x[bond.i] - x[bond.j]).norm());
  std::vector<Vector<3>> a(x.size());
  const auto evaluate = [&](double step) {
    std::fill(a.begin(), a.end(), Vector<3>::Zero());
    const auto after = solid.memory_after(step);
    for (std::size_t b = 0; b < list.size(); ++b) {
      const Vector<3> apart = x[list[b].i] - x[list[b].j];
      bond::Remembering<bond::Stretch<double>, double> now{{apart.norm(), list[b].rest_length}, apart.norm() - length[b], memory[b]};
      length[b] = now.length;
      memory[b] = now.memory = after(now);
      const Vector<3> force = list[b].weight * solid.tension(now) / now.length * apart;
      a[list[b].i] -= force;
      a[list[b].j] += force;
    }
  };
  evaluate(0.0);
  for (int n = 0; n < 200; ++n) {
    for (std::size_t k = 0; k < x.size(); ++k) {
      v[k] += 0.5 * dt * a[k];
      x[k] += dt * v[k];
    }
    evaluate(dt);
    for (std::size_t k = 0; k < x.size(); ++k) v[k] += 0.5 * dt * a[k];
  }
  double worst = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) worst = std::max(worst, (x[k] - net.group<Net>().positions()[k]).norm());
  CHECK(worst <= 1e-11);
}

TEST_CASE(
    "a net of bonds with memory: momentum and angular momentum are kept, energy is given off and never gained; rigid motion is free") {
  test::RandomVectors random;
  std::vector<Vector<3>> beads;
  std::vector<Bond> list;
  for (std::uint32_t k = 0; k < 12; ++k) {
    beads.push_back(random.vector(1.0));
    for (std::uint32_t other = 0; other < k; ++other) list.push_back({k, other});
  }
  const StandardLinearSolid law{.stiffness = 50.0, .branch_stiffness = 50.0, .branch_damping = 5.0};
  auto net = scene<Leapfrog>(Box<3>::unbounded(), group<Net>("net", Mobile{}, Points<3>{beads}, 1.0), bonds<Net, Net>(law, list));
  net.group<Net>().set<field::Velocity>([&](const auto&) { return random.vector(1.0); });
  struct Sums {
    Vector<3> momentum = Vector<3>::Zero(), spin = Vector<3>::Zero();
    double energy = 0.0;
  };
  const auto sums_of = [&](auto& scene) {
    Sums sums;
    const auto& x = scene.template group<Net>().positions();
    const auto& v = scene.template group<Net>().template get<field::Velocity>();
    for (std::size_t i = 0; i < x.size(); ++i) {
      sums.momentum += v[i];
      sums.spin +=
          Vector<3>(x[i][1] * v[i][2] - x[i][2] * v[i][1], x[i][2] * v[i][0] - x[i][0] * v[i][2], x[i][0] * v[i][1] - x[i][1] * v[i][0]);
      sums.energy += 0.5 * v[i].squaredNorm();
    }
    scene.engine().for_each_item([&](auto& active) {
      if constexpr (requires { active.recall; })
        for_each_memory(active.of_a, x.size(), [&](std::uint32_t i, std::uint32_t j, double memory, double length) {
          sums.energy += law.energy(bond::Remembering<bond::Stretch<double>, double>{{length, (beads[i] - beads[j]).norm()}, 0.0, memory});
        });
    });
    return sums;
  };
  const Sums start = sums_of(net);
  double before = start.energy, rise = 0.0;
  net.every(0.01, [&](auto& scene) {
    const Sums now = sums_of(scene);
    CHECK((now.momentum - start.momentum).norm() <= 1e-13);
    CHECK((now.spin - start.spin).norm() <= 1e-13);
    rise = std::max(rise, now.energy - before);
    before = now.energy;
  });
  net.run({.until = 3.0, .time_step = 1e-3});
  CHECK(rise <= 1e-6 * start.energy);
  CHECK(before < 0.7 * start.energy);
}

TEST_CASE("laws without memory have none: no byte in lists, items and checkpoints; laws with one say so") {
  static_assert(std::is_empty_v<sweep::Recall<bond::Harmonic>> && std::is_empty_v<sweep::Recall<bond::KelvinVoigt>>);
  const auto bytes = [](const auto& law) {
    auto scene = pair_of(law, {});
    return bytes_per_particle(scene);
  };
  const double without = bytes(bond::Harmonic{.stiffness = 1.0}), with = bytes(Maxwell{.stiffness = 1.0, .damping = 1.0});
  CHECK(with - without == 0.5 * 2 * sizeof(double) * sweep::Lanes::width);  // one pack of bonds for two particles
  auto spring = pair_of(bond::Harmonic{.stiffness = 1.0}, {});
  auto liquid = pair_of(Maxwell{.stiffness = 1.0, .damping = 1.0}, {});
  CHECK(spring.signature().find("memory") == std::string::npos);
  CHECK(liquid.signature().find("memory") != std::string::npos);
  CHECK(describe(spring).find("memory") == std::string::npos);
  CHECK(describe(liquid).find("1 bonds, with memory") != std::string::npos);
}
