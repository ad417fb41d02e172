// Kelvin-Voigt bonds whose dashpots are solved for: any stiffness of them, second order, nothing created.
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/bond.hpp>
#include <dmp/core/simulation_error.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/forcing.hpp>
#include <dmp/integrator.hpp>
#include <dmp/simulation.hpp>
#include "support/random.hpp"

using namespace dmp;
using namespace dmp::simulation;
using bond::KelvinVoigt;
using geometry::Box, geometry::Points;
using integrator::Leapfrog;
using neighbours::Bond;
using particles::Driven, particles::Frozen, particles::Mobile;

namespace {

struct Left {};
struct Right {};

constexpr double rest_length = 10.0;  // [m], more than any extension

/// Two beads pulled apart by `force`; `Hold` says whether the left one may move.
template <class Hold>
auto bead_pair(const KelvinVoigt& law, double force, double mass) {
  const auto pull = [&](double f) { return forcing::Constant<1>{.uniform_acceleration = {{{f / mass}}}}; };
  return scene<Leapfrog>(Box<1>::unbounded(), group<Left>("left", Hold{}, Points<1>{{Vector<1>(0.0)}}, mass),
                         group<Right>("right", Mobile{}, Points<1>{{Vector<1>(rest_length)}}, mass),
                         implicit_bonds<Left, Right>(law, {{0, 0}}), forced_by<Left>(pull(-force)), forced_by<Right>(pull(force)));
}
double extension(const auto& scene) {
  return scene.template group<Right>().positions()[0][0] - scene.template group<Left>().positions()[0][0] - rest_length;
}

/// X(t) of m X'' + c X' + k X = F from rest, over-damped.
double creep(const KelvinVoigt& law, double force, double mass, double t) {
  const double g = law.damping / (2.0 * mass), squared = law.stiffness / mass, fast = -g - std::sqrt(g * g - squared),
               slow = squared / fast;
  return force / law.stiffness * (1.0 - (fast * std::exp(slow * t) - slow * std::exp(fast * t)) / (fast - slow));
}
/// |X - exact| over all steps, as a fraction of |X|, both as roots of mean squares.
template <class Hold>
double creep_error(const KelvinVoigt& law, double force, double mass, double until, double step) {
  auto pair = bead_pair<Hold>(law, force, mass);
  double error = 0.0, all = 0.0;
  pair.every(step, [&](const auto& scene) {
    const double exact = creep(law, force, std::is_same_v<Hold, Mobile> ? 0.5 * mass : mass, scene.time());
    error += (extension(scene) - exact) * (extension(scene) - exact);
    all += exact * exact;
  });
  pair.run({.until = until, .time_step = step});
  return std::sqrt(error / all);
}

}  // namespace

TEST_CASE(
    "A1: creep of one bond of 0.2 N s/m on beads of 1e-5 kg, at up to 180 times the step that an explicit dashpot bears: second order") {
  const KelvinVoigt law{.stiffness = 0.2, .damping = 0.2};
  const auto error = [&](double step) { return creep_error<Mobile>(law, 1.0, 1e-5, 5.0, step); };
  CHECK(error(9e-3) <= 1e-5);  // sheet 01, section 5: 6.6e-6
  CHECK(error(1e-4) <= 1e-7);
  CHECK(error(8e-6) <= 1e-9);  // 2.9e-10
  CHECK(std::log2(error(2e-5) / error(1e-5)) == doctest::Approx(2.0).epsilon(0.05));
}

TEST_CASE(
    "KV-1: over-damped creep, one bead held or both free, at ten times the explicit bound and more, with the second order of the step") {
  const KelvinVoigt law{.stiffness = 1.0, .damping = 20.0};  // explicit: stable below 0.1 s held, 0.05 s free
  const auto check = [&]<class Hold>(Hold) {
    const auto error = [&](double step) { return creep_error<Hold>(law, 1.0, 1.0, 20.0, step); };
    CHECK(error(1.0) <= 3e-3);
    CHECK(error(0.5) <= 1.5e-3);
    CHECK(std::log2(error(0.02) / error(0.01)) == doctest::Approx(2.0).epsilon(0.02));
  };
  check(Frozen<1>{});
  check(Mobile{});
}

TEST_CASE("implicit bonds: the springs alone bound the step, whatever the dashpots") {
  for (const double damping : {0.0, 1.0, 1e12}) {
    auto pair = bead_pair<Frozen<1>>({.stiffness = 9.0, .damping = damping}, 1.0, 1.0);
    CHECK(pair.step_limit().stable_time_step == doctest::Approx(2.0 / 3.0).epsilon(1e-12));
    CHECK(pair.step_limit().stability_bound_by == "bond stiffness of left - right");
    CHECK(describe(pair).find("dashpots implicit") != std::string::npos);
    pair.run({.until = 2000.0, .time_step = 0.95 * 2.0 / 3.0});
    CHECK(std::fabs(extension(pair)) < 1.0);
  }
}

TEST_CASE("implicit bonds: a dashpot alone drifts at F/c, and the acceleration is that of all forces, the dashpot among them") {
  auto turning = bead_pair<Frozen<1>>({.stiffness = 0.0, .damping = 50.0}, 1.0, 1.0);
  turning.run({.until = 50.0, .time_step = 0.25});
  CHECK(turning.group<Right>().get<field::Acceleration>()[0][0] == doctest::Approx(0.0).epsilon(1e-9));
  CHECK(turning.group<Right>().get<field::Velocity>()[0][0] == doctest::Approx(0.02).epsilon(1e-9));
  CHECK(extension(turning) == doctest::Approx(50.0 / 50.0 - 1.0 / 2500.0).epsilon(1e-4));
}

// ---- Nets ---------------------------------------------------------------------------------------------------------------------------

namespace {

struct Net {};
struct Other {};
struct Plate {};

/// A tangle of two groups in open space or across the faces of a box; `make_bonds` says how they are bonded.
template <class MakeBonds>
auto tangle(const Box<3>& box, double damping, const MakeBonds& make_bonds, const Vector<3>& shift = Vector<3>::Zero()) {
  test::RandomVectors random;
  Points<3> beads, others;
  std::vector<Bond> within, between;
  for (std::uint32_t k = 0; k < 14; ++k) {
    const Vector<3> x = random.vector(1.0);
    (k < 9 ? beads : others).positions.push_back(x + shift);
    const std::uint32_t row = k < 9 ? k : k - 9;
    for (std::uint32_t other = 0; other < std::min(k, 9u); ++other)
      if ((k + other) % 3 != 0)
        (k < 9 ? within : between).push_back(k < 9 ? Bond{row, other, 0.5 + 0.05 * other, 1.0 + 0.2 * (k % 2)} : Bond{other, row});
  }
  for (auto* const points : {&beads, &others})
    for (auto& x : points->positions) x = box.wrap(x);
  const KelvinVoigt law{.stiffness = 20.0, .damping = damping};
  auto result =
      scene<Leapfrog>(box, group<Net>("net", Mobile{}, beads, 1.0), group<Other>("others", Mobile{}, others, 2.0),
                      make_bonds.template operator()<Net, Net>(law, within), make_bonds.template operator()<Net, Other>(law, between));
  result.template group<Net>().template set<field::Velocity>([&](const auto&) { return random.vector(1.0); });
  result.template group<Other>().template set<field::Velocity>([&](const auto&) { return random.vector(1.0); });
  return result;
}
constexpr auto implicitly = []<class A, class B>(const KelvinVoigt& law, const std::vector<Bond>& list) {
  return implicit_bonds<A, B>(law, list);
};
constexpr auto explicitly = []<class A, class B>(const KelvinVoigt& law, const std::vector<Bond>& list) { return bonds<A, B>(law, list); };

std::vector<double> state(auto& scene) {
  std::vector<double> all;
  scene.engine().for_each_group([&](auto& g) {
    for (const auto& column : g.view().columns) all.insert(all.end(), column.values.begin(), column.values.end());
  });
  return all;
}
std::size_t differences(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return a.size() + b.size();
  std::size_t count = 0;
  for (std::size_t k = 0; k < a.size(); ++k) count += a[k] != b[k];
  return count;
}
struct Sums {
  Vector<3> momentum = Vector<3>::Zero(), spin = Vector<3>::Zero();
  double energy = 0.0;  // kinetic
};
Sums sums_of(const auto& scene) {
  Sums sums;
  scene.engine().for_each_group([&](const auto& g) {
    for (std::size_t i = 0; i < g.size(); ++i) {
      const auto &x = g.positions()[i], &v = g.template get<field::Velocity>()[i];
      sums.momentum += g.mass * v;
      sums.spin += g.mass * Vector<3>(x[1] * v[2] - x[2] * v[1], x[2] * v[0] - x[0] * v[2], x[0] * v[1] - x[1] * v[0]);
      sums.energy += 0.5 * g.mass * v.squaredNorm();
    }
  });
  return sums;
}
/// Distance of two scenes in the places of their net.
double apart(const auto& a, const auto& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.template group<Net>().size(); ++i)
    largest = std::max(largest, (a.template group<Net>().positions()[i] - b.template group<Net>().positions()[i]).norm());
  return largest;
}

}  // namespace

TEST_CASE("implicit bonds in a net: the solution is that of explicit ones with small steps, to second order") {
  const auto run = [](auto scene, double step) {
    scene.run({.until = 1.0, .time_step = step});
    return scene;
  };
  const auto box = Box<3>::unbounded();
  const auto exact = run(tangle(box, 2.0, implicitly), 1.0 / 8192);
  CHECK(apart(run(tangle(box, 2.0, explicitly), 1.0 / 8192), exact) <= 1e-3);  // of first order
  const double coarse = apart(run(tangle(box, 2.0, implicitly), 1.0 / 128), exact),
               fine = apart(run(tangle(box, 2.0, implicitly), 1.0 / 256), exact);
  CHECK(fine <= 1e-3);
  CHECK(std::log2(coarse / fine) == doctest::Approx(2.0).epsilon(0.05));
}

TEST_CASE("implicit bonds of any damping, between groups too: momentum and angular momentum are kept, the net comes to rest") {
  for (const double damping : {0.5, 50.0, 1e6}) {
    CAPTURE(damping);
    auto net = tangle(Box<3>::unbounded(), damping, implicitly);
    const Sums start = sums_of(net);
    net.run({.until = 5.0, .time_step = 0.02});
    const Sums now = sums_of(net);
    CHECK((now.momentum - start.momentum).norm() <= 1e-12 * 20.0);
    CHECK((now.spin - start.spin).norm() <= 1e-11 * 20.0);
    CHECK(now.energy < start.energy);
  }
}

TEST_CASE("implicit bonds across the faces of a periodic box do what they do inside it") {
  const Box<3> box{.lower = {-4.0, -4.0, -4.0}, .upper = {4.0, 4.0, 4.0}, .periodic = {true, true, true}};
  auto inside = tangle(box, 5.0, implicitly), across = tangle(box, 5.0, implicitly, Vector<3>(3.9, -4.0, 4.1));
  inside.run({.until = 1.0, .time_step = 0.01});
  across.run({.until = 0.5, .time_step = 0.01});
  across.engine().build_lists();
  across.run({.until = 1.0, .time_step = 0.01});
  for (std::size_t i = 0; i < 9; ++i) {
    const Vector<3> difference = across.group<Net>().positions()[i] - inside.group<Net>().positions()[i] - Vector<3>(3.9, -4.0, 4.1);
    CHECK(neighbours::minimum_image<3>(difference, box).norm() <= 1e-11);
  }
}

TEST_CASE("implicit bonds: rigid rotation is free of damping") {
  for (const double damping : {1.0, 1e8}) {
    auto dumbbell = scene<Leapfrog>(Box<3>::unbounded(), group<Net>("net", Mobile{}, Points<3>{{{0.0, 0.0, 0.0}, {0.6, 0.0, 0.8}}}, 1.0),
                                    implicit_bonds<Net, Net>({.stiffness = 1e4, .damping = damping}, {{0, 1, 1.0 - 0.5e-4}}));
    dumbbell.group<Net>().set<field::Velocity>(
        [](const Vector<3>& x) { return Vector<3>(0.5 * (x.norm() > 0.5 ? 1.0 : -1.0) * Vector<3>(0.8, 0.0, -0.6)); });
    const Sums start = sums_of(dumbbell);
    dumbbell.run({.until = 2.0, .time_step = 1e-3});
    const Sums now = sums_of(dumbbell);
    CHECK(now.energy == doctest::Approx(0.25).epsilon(1e-6));
    CHECK((now.spin - start.spin).norm() <= 1e-12);
  }
}

namespace {
struct Tow {  // 1 m/s to the right
  Vector<3> position(const Vector<3>& start, double time) const { return start + Vector<3>(time, 0.0, 0.0); }
  Vector<3> velocity(const Vector<3>&, double) const { return {1.0, 0.0, 0.0}; }
};
constexpr std::uint32_t side = 22;

/// 10648 beads in two blocks through the periodic faces, some bonded to a driven plate.
auto lattice() {
  Points<3> beads, plate;
  std::vector<Bond> list, to_plate;
  for (std::uint32_t z = 0; z < side; ++z)
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t x = 0; x < side; ++x) {
        const std::uint32_t row = x + side * (y + side * z);
        beads.positions.push_back({0.1 * x + 0.05, 0.1 * y + 0.05, 0.1 * z + 0.05});
        list.push_back({row, (x + 1) % side + side * (y + side * z)});
        list.push_back({row, x + side * ((y + 1) % side + side * z)});
        if (z > 0) list.push_back({row, row - side * side});
        if (z == 0) {
          plate.positions.push_back(Vector<3>(beads.positions.back() + Vector<3>(0.0, 0.0, -0.05)));
          to_plate.push_back({static_cast<std::uint32_t>(plate.positions.size() - 1), row});
        }
      }
  const double length = 0.1 * side;
  const KelvinVoigt law{.stiffness = 50.0, .damping = 100.0};
  auto result = scene<Leapfrog>(Box<3>{.lower = {0.0, 0.0, 0.0}, .upper = {length, length, length}, .periodic = {true, true, false}},
                                group<Net>("net", Mobile{}, beads, 1.0), group<Plate>("plate", Driven<Tow>{}, plate, 1.0),
                                implicit_bonds<Net, Net>(law, list), implicit_bonds<Plate, Net>(law, to_plate));
  test::RandomVectors random;
  result.template group<Net>().template set<field::Velocity>(
      [&](const auto&) { return Vector<3>(random.vector(0.02) + Vector<3>(1.0, 0.0, 0.0)); });
  return result;
}
}  // namespace

TEST_CASE("implicit bonds: 1, 2 and 4 threads give the same bits, and so does a restart") {
  const int before = available_threads();
  std::vector<double> first;
  for (const int threads : {1, 2, 4}) {
    use_threads(threads);
    auto scene = lattice();
    CHECK(scene.group<Net>().blocks.size() == 2);
    scene.run({.until = 0.1, .time_step = 0.02});
    if (first.empty()) first = state(scene);
    CHECK(differences(first, state(scene)) == 0);
  }
  use_threads(before);
  const auto path = (std::filesystem::temp_directory_path() / "dmp_implicit_bonds_test.checkpoint").string();
  auto whole = lattice(), again = lattice(), from_start = lattice();
  whole.checkpoint(path);
  from_start.restart(path);
  whole.run({.until = 0.1, .time_step = 0.02});
  from_start.run({.until = 0.1, .time_step = 0.02});
  CHECK(differences(state(whole), state(from_start)) == 0);
  whole.checkpoint(path);
  again.restart(path);
  whole.run({.until = 0.2, .time_step = 0.02});
  again.run({.until = 0.2, .time_step = 0.02});
  CHECK(differences(state(whole), state(again)) == 0);
  std::filesystem::remove(path);
}

TEST_CASE("a net that moves with its driven plate feels no dashpot; one that does not is taken along") {
  auto scene = lattice();
  scene.group<Net>().set<field::Velocity>([](const auto&) { return Vector<3>(1.0, 0.0, 0.0); });
  scene.run({.until = 0.5, .time_step = 0.02});
  double worst = 0.0;
  for (const auto& v : scene.group<Net>().get<field::Velocity>()) worst = std::max(worst, (v - Vector<3>(1.0, 0.0, 0.0)).norm());
  CHECK(worst <= 1e-11);
}

TEST_CASE("dashpots that cannot be solved for end the run with an error that says so") {
  auto pair = bead_pair<Mobile>({.stiffness = 1.0, .damping = 1e308}, 1e5, 1.0);
  std::string text;
  try {
    pair.run({.until = 1.0, .time_step = 0.1});
  } catch (const SimulationError& error) {
    text = error.what();
  }
  CHECK(text.find("implicit_bonds") != std::string::npos);
  CHECK(text.find("did not converge") != std::string::npos);
  CHECK(text.find("step 1") != std::string::npos);
  CHECK_THROWS_WITH_AS((void(implicit_bonds<Left, Right>({.stiffness = 1.0, .damping = 1.0}, {}, 0.0))),
                       "implicit_bonds: tolerance must be > 0 and < 1, got 0", ParameterError);
}
