#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <Eigen/Eigenvalues>
#include <doctest/doctest.h>
#include <dmp/bond.hpp>
#include <dmp/core/simulation_error.hpp>
#include <dmp/forcing.hpp>
#include <dmp/integrator.hpp>
#include <dmp/simulation.hpp>
#include "support/random.hpp"
#include "support/threads.hpp"

using namespace dmp;
using namespace dmp::simulation;
using geometry::Box, geometry::Points;
using integrator::ExtrapolatedVerlet, integrator::Leapfrog, integrator::SymplecticEuler;
using neighbours::Bond;
using particles::Frozen, particles::Mobile;

// ---- Two beads and one Kelvin-Voigt bond on the line: KV-1, KV-2, KV-3, KV-5 ------------------------------------------------------

namespace {

struct Left {};
struct Right {};

/// A force along x: constant until it is switched off, or sinusoidal.
struct Pull {
  double force = 1.0;      // [N]
  double off = 1e30;       // [s]
  double frequency = 0.0;  // [rad/s], 0: constant

  [[nodiscard]] Components<1, double> acceleration(const auto& subject) const {
    const bool at_switch = std::fabs(subject.time - off) < 1e-9;  // there the mean of both sides
    const double share = at_switch ? 0.5 : subject.time < off ? 1.0 : 0.0;
    return {{share * force * (frequency > 0.0 ? std::sin(frequency * subject.time) : 1.0) / subject.mass}};
  }
};
void validate(const Pull&) {}

constexpr bond::KelvinVoigt bond_of(double damping) { return {.stiffness = 1.0, .damping = damping}; }

constexpr double rest_length = 10.0;  // [m], more than any extension: a bond cannot turn inside out

/// Both beads pulled apart, from rest at the rest length; `Hold` says whether the left one may move.
template <class Integrator, class Hold>
auto bead_pair(const bond::KelvinVoigt& law, const Pull& pull, double mass = 1.0) {
  Pull back = pull;
  back.force = -pull.force;
  return scene<Integrator>(Box<1>::unbounded(), group<Left>("left", Hold{}, Points<1>{{Vector<1>(0.0)}}, mass),
                           group<Right>("right", Mobile{}, Points<1>{{Vector<1>(rest_length)}}, mass), bonds<Left, Right>(law, {{0, 0}}),
                           forced_by<Left>(back), forced_by<Right>(pull));
}
template <class Hold>
constexpr double reduced_mass = std::is_same_v<Hold, Mobile> ? 0.5 : 1.0;

double extension(const auto& scene) {
  return scene.template group<Right>().positions()[0][0] - scene.template group<Left>().positions()[0][0] - rest_length;
}

/// X(t) for k = 1 N/m under 1 N from rest: sheet 06, section 4.1.
double creep(double damping, double mass, double t) {
  const double g = damping / (2.0 * mass), squared = 1.0 / mass;
  if (t <= 0.0) return 0.0;
  if (squared > g * g * (1.0 + 1e-12)) {
    const double w = std::sqrt(squared - g * g);
    return 1.0 - std::exp(-g * t) * (std::cos(w * t) + g / w * std::sin(w * t));
  }
  if (squared > g * g * (1.0 - 1e-12)) return 1.0 - std::exp(-g * t) * (1.0 + g * t);
  const double l2 = -g - std::sqrt(g * g - squared), l1 = squared / l2;
  return 1.0 - (l2 * std::exp(l1 * t) - l1 * std::exp(l2 * t)) / (l2 - l1);
}

/// Largest |X - exact| up to `until`, looked at every 0.01 s.
template <class Integrator, class Hold>
double creep_error(double damping, const Pull& pull, double until, double time_step) {
  auto pair = bead_pair<Integrator, Hold>(bond_of(damping), pull);
  double largest = 0.0;
  pair.every(0.01, [&](const auto& scene) {
    const double exact = creep(damping, reduced_mass<Hold>, scene.time()) - creep(damping, reduced_mass<Hold>, scene.time() - pull.off);
    largest = std::max(largest, std::fabs(extension(scene) - exact));
  });
  pair.run({.until = until, .time_step = time_step});
  return largest;
}
template <class Integrator, class Hold>
double creep_error_at_1(double time_step) {
  auto pair = bead_pair<Integrator, Hold>(bond_of(2.0), {});
  pair.run({.until = 1.0, .time_step = time_step});
  return std::fabs(extension(pair) - creep(2.0, reduced_mass<Hold>, 1.0));
}

}  // namespace

TEST_CASE("KV-1: the closed form of creep gives the sheet's table") {
  constexpr double time[5] = {0.5, 1.0, 2.0, 5.0, 10.0};
  struct Row {
    double damping, mass, extension[5];
  };
  for (const Row& row : {Row{0.2, 1.0, {0.11845360, 0.43102811, 1.25807026, 0.90144933, 1.33685168}},
                         Row{2.0, 1.0, {0.09020401, 0.26424112, 0.59399415, 0.95957232, 0.99950060}},
                         Row{20.0, 1.0, {0.02229491, 0.04649431, 0.09311127, 0.21972777, 0.39270496}},
                         Row{0.2, 0.5, {0.224669, 0.745583, 1.599512, 0.688128, 0.962343}},
                         Row{2.0, 0.5, {0.136943, 0.334857, 0.626167, 0.935475, 0.996551}},
                         Row{20.0, 0.5, {0.023497, 0.047637, 0.094141, 0.220466, 0.393089}}})
    for (int n = 0; n < 5; ++n)
      CHECK(std::fabs(creep(row.damping, row.mass, time[n]) - row.extension[n]) <= (row.mass == 1.0 ? 5.1e-9 : 6e-7));  // as printed
}

TEST_CASE(
    "KV-1: creep of one bond, one bead held or both free, under-, critically and over-damped: within 1e-6 m with the predicted velocity, "
    "3e-4 m with that of the half step") {
  for (const double damping : {0.2, 2.0, 20.0}) {
    CAPTURE(damping);
    CHECK(creep_error<ExtrapolatedVerlet, Frozen<1>>(damping, {}, 10.0, 1e-3) <= 1e-6);
    CHECK(creep_error<ExtrapolatedVerlet, Mobile>(damping, {}, 10.0, 1e-3) <= 1e-6);
    CHECK(creep_error<Leapfrog, Frozen<1>>(damping, {}, 10.0, 1e-3) <= 3e-4);
    CHECK(creep_error<Leapfrog, Mobile>(damping, {}, 10.0, 1e-3) <= 3e-4);
  }
}

TEST_CASE("KV-1: the error of creep falls with the first order of the step for half-step velocities, with the second for predicted ones") {
  const double half_step[3] = {2.45e-4, 1.23e-4, 6.1e-5}, predicted[3] = {4.8e-5, 1.2e-5, 3.1e-6};  // sheet 06, section 5.1
  for (int n = 0; n < 3; ++n) {
    CHECK(creep_error_at_1<Leapfrog, Frozen<1>>(2e-3 / (1 << n)) == doctest::Approx(half_step[n]).epsilon(0.02).scale(0.0));
    CHECK(creep_error_at_1<ExtrapolatedVerlet, Frozen<1>>(2e-2 / (1 << n)) == doctest::Approx(predicted[n]).epsilon(0.03).scale(0.0));
  }
  CHECK(std::log2(creep_error_at_1<Leapfrog, Mobile>(2e-3) / creep_error_at_1<Leapfrog, Mobile>(1e-3)) ==
        doctest::Approx(1.0).epsilon(0.02));
  CHECK(std::log2(creep_error_at_1<ExtrapolatedVerlet, Mobile>(2e-2) / creep_error_at_1<ExtrapolatedVerlet, Mobile>(1e-2)) ==
        doctest::Approx(2.0).epsilon(0.02));
}

TEST_CASE("KV-1: the published creep test, 1 N on two beads of 1e-5 kg, k = 0.2 N/m") {
  constexpr double time[3] = {0.5, 1.0, 2.0},
                   expected[3] = {3.160603, 4.323391, 4.908449};  // sheet 06, section 4.1; inertia changes it by < 4e-4 m
  auto pair = bead_pair<ExtrapolatedVerlet, Mobile>({.stiffness = 0.2, .damping = 0.1}, {}, 1e-5);
  for (int n = 0; n < 3; ++n) {
    pair.run({.until = time[n], .time_step = 2e-5});
    CHECK(std::fabs(extension(pair) - expected[n]) <= 4e-4);
  }
}

TEST_CASE("KV-2: recovery when the force ends at 6 s is creep minus creep 6 s later") {
  for (const double damping : {0.2, 2.0, 20.0}) {
    CAPTURE(damping);
    CHECK(creep_error<ExtrapolatedVerlet, Frozen<1>>(damping, {.off = 6.0}, 12.0, 1e-3) <= 1e-6);
    CHECK(creep_error<ExtrapolatedVerlet, Mobile>(damping, {.off = 6.0}, 12.0, 1e-3) <= 1e-6);
    CHECK(creep_error<Leapfrog, Frozen<1>>(damping, {.off = 6.0}, 12.0, 1e-3) <= 3e-4);  // KV-1's bound
    CHECK(creep_error<Leapfrog, Mobile>(damping, {.off = 6.0}, 12.0, 1e-3) <= 4e-4);  // two creeps, each within 3e-4
  }
}

TEST_CASE("KV-3: under a sinusoidal force the bond lags by the published angle and amplitude, to 0.2 %") {
  struct Row {
    double damping, frequency, amplitude, lag;
  };
  for (const Row& row : {Row{0.2, 0.5, 1.135466, 0.113792}, Row{2.0, 1.0, 0.485071, 1.325818},
                         Row{20.0, 0.1, 0.447660, 1.109151}}) {  // sheet 06, section 4.1
    CAPTURE(row.damping);
    const double period = 2.0 * std::numbers::pi / row.frequency;
    const int settled = static_cast<int>(std::ceil(150.0 / period));  // periods: 5 transients and more
    auto pair = bead_pair<ExtrapolatedVerlet, Mobile>(bond_of(row.damping), {.frequency = row.frequency});
    double in_phase = 0.0, late = 0.0;
    pair.every(period / 400.0, [&](const auto& scene) {
      const double angle = row.frequency * scene.time();
      if (scene.time() < (settled + 1e-6) * period) return;
      in_phase += extension(scene) * std::sin(angle) / 200.0;
      late -= extension(scene) * std::cos(angle) / 200.0;
    });
    pair.run({.until = (settled + 1) * period, .time_step = period / 4000.0});
    CHECK(std::hypot(in_phase, late) == doctest::Approx(row.amplitude).epsilon(0.002));
    CHECK(std::atan2(late, in_phase) == doctest::Approx(row.lag).epsilon(0.002));
  }
}

TEST_CASE(
    "KV-5: k = 2K: stock LAMMPS with K = k/2 and a dashpot on the half-step velocity gives the same extension to all digits printed") {
  auto pair = bead_pair<Leapfrog, Frozen<1>>(bond_of(2.0), {});
  pair.run({.until = 1.0, .time_step = 1e-3});
  CHECK(std::fabs(extension(pair) - 0.26436379) <= 5.1e-9);  // sheet 06, section 8

  const auto swing = [](const bond::Harmonic& law) {
    auto spring = scene<Leapfrog>(Box<1>::unbounded(), group<Right>("right", Mobile{}, Points<1>{{Vector<1>(0.0), Vector<1>(1.7)}}, 1.0),
                                  bonds<Right, Right>(law, {{0, 1, 1.0}}));
    spring.run({.until = 3.0, .time_step = 0.01});
    return spring.template group<Right>().positions()[0][0];
  };
  CHECK(swing(bond::Harmonic::from_lammps(0.15)) == swing({.stiffness = 0.3}));
  CHECK(swing(bond::Harmonic::from_lammps(0.3)) != swing({.stiffness = 0.3}));
}

TEST_CASE("a held bead: the bound of the step is that of the free bead's mass alone") {  // taken as if both moved
  auto spring = bead_pair<Leapfrog, Frozen<1>>({.stiffness = 9.0, .damping = 0.0}, {});
  CHECK(spring.step_limit().stable_time_step == doctest::Approx(2.0 / 3.0).epsilon(1e-12));
  auto dashpot = bead_pair<Leapfrog, Frozen<1>>({.stiffness = 0.0, .damping = 20.0}, {});
  CHECK(dashpot.step_limit().stable_time_step == doctest::Approx(2.0 / 20.0).epsilon(1e-12));
  auto predicted = bead_pair<ExtrapolatedVerlet, Frozen<1>>({.stiffness = 0.0, .damping = 20.0}, {});
  CHECK(predicted.step_limit().stable_time_step == doctest::Approx(1.0 / 20.0).epsilon(1e-12));
}

TEST_CASE("a dashpot alone, k = 0: beads that fly apart stop as exp(-c t/m) after v m/c, one held or both free") {
  const auto check = [&]<class Hold>(Hold) {
    constexpr double damping = 3.0, mass = reduced_mass<Hold>, speed = 1.5, time = 0.7;
    auto pair = bead_pair<ExtrapolatedVerlet, Hold>({.stiffness = 0.0, .damping = damping}, {.force = 0.0});
    pair.template group<Right>().template get<field::Velocity>()[0][0] = speed;
    pair.run({.until = time, .time_step = 1e-3});
    CHECK(extension(pair) == doctest::Approx(speed * mass / damping * (1.0 - std::exp(-damping / mass * time))).epsilon(1e-4));
    CHECK(pair.step_limit().stability_bound_by == "bond dashpot of left - right");
  };
  check(Frozen<1>{});
  check(Mobile{});
}

TEST_CASE("two beads of unequal mass: the lighter one sets the bound of the step, at most that of the reduced mass, whichever end it is") {
  const auto bound = [](double left, double right, const bond::KelvinVoigt& law) {
    auto pair =
        scene<Leapfrog>(Box<1>::unbounded(), group<Left>("left", Mobile{}, Points<1>{{Vector<1>(0.0)}}, left),
                        group<Right>("right", Mobile{}, Points<1>{{Vector<1>(rest_length)}}, right), bonds<Left, Right>(law, {{0, 0}}));
    const double dt = pair.step_limit().stable_time_step;
    CHECK_THROWS_WITH_AS(pair.run({.until = 1.0, .time_step = 1.01 * dt}), doctest::Contains("left - right"), ParameterError);
    return dt;
  };
  for (const double heavy : {1.0, 3.0, 1e6}) {
    const double reduced = heavy / (1.0 + heavy);  // beside 1 kg
    const double spring = bound(1.0, heavy, {.stiffness = 9.0, .damping = 0.0}),
                 dashpot = bound(1.0, heavy, {.stiffness = 0.0, .damping = 20.0});
    CHECK(spring == doctest::Approx(2.0 / std::sqrt(2.0 * 9.0)).epsilon(1e-12));
    CHECK(dashpot == doctest::Approx(2.0 / (2.0 * 20.0)).epsilon(1e-12));
    CHECK(spring <= 2.0 / std::sqrt(9.0 / reduced) * (1.0 + 1e-12));  // sheet 06, section 6
    CHECK(dashpot <= 2.0 * reduced / 20.0 * (1.0 + 1e-12));
    CHECK(bound(heavy, 1.0, {.stiffness = 9.0, .damping = 0.0}) == spring);
    CHECK(bound(heavy, 1.0, {.stiffness = 0.0, .damping = 20.0}) == dashpot);
  }
}

// ---- Nets of bonds in space: KV-4, faces, limits, threads -------------------------------------------------------------------------

namespace {

struct Net {};

/// Kelvin-Voigt that admits to only a part of its stiffness and damping, so that a scene takes steps that it should refuse.
struct Modest {
  bond::KelvinVoigt law;
  double admitted = 1.0;

  [[nodiscard]] auto tension(const auto& bond) const noexcept { return law.tension(bond); }
  [[nodiscard]] auto energy(const auto& bond) const noexcept { return law.energy(bond); }
  [[nodiscard]] double largest_stiffness() const noexcept { return admitted * law.largest_stiffness(); }
  [[nodiscard]] double largest_damping() const noexcept { return admitted * law.largest_damping(); }
};
void validate(const Modest& law) { validate(law.law); }

using Beads = std::vector<Vector<3>>;

auto net(const Beads& beads, const std::vector<Bond>& list, const Modest& law, const Box<3>& box = Box<3>::unbounded(), double mass = 1.0) {
  return scene<Leapfrog>(box, group<Net>("net", Mobile{}, Points<3>{beads}, mass), bonds<Net, Net>(law, list));
}

struct Invariants {
  Vector<3> momentum = Vector<3>::Zero(), spin = Vector<3>::Zero();
  double energy = 0.0;
};
/// Of a net in open space with beads of 1 kg; `frame` [m/s] is taken off the velocities that make the energy.
Invariants invariants(const auto& scene, const std::vector<Bond>& list, const Modest& law, const Vector<3>& frame = Vector<3>::Zero()) {
  const auto& x = scene.template group<Net>().positions();
  const auto& v = scene.template group<Net>().template get<field::Velocity>();
  Invariants result;
  for (std::size_t i = 0; i < x.size(); ++i) {
    result.momentum += v[i];
    const Vector<3> relative = v[i] - frame;
    result.spin +=
        Vector<3>(x[i][1] * v[i][2] - x[i][2] * v[i][1], x[i][2] * v[i][0] - x[i][0] * v[i][2], x[i][0] * v[i][1] - x[i][1] * v[i][0]);
    result.energy += 0.5 * relative.squaredNorm();
  }
  for (const Bond& bond : list)
    result.energy += law.energy(bond::MovingStretch<double>{{(x[bond.i] - x[bond.j]).norm(), bond.rest_length}, 0.0});
  return result;
}

/// A ring of beads through the periodic face, a metre apart, every second one displaced: the fastest of its motions, of frequency
/// sqrt(4 k/m) and damping rate 4 c/m exactly.
auto zigzag(const Modest& law, double displacement = 1e-3) {
  Beads beads;
  std::vector<Bond> list;
  for (std::uint32_t k = 0; k < 16; ++k) {
    beads.push_back({k + 0.5 + (k % 2 == 0 ? displacement : -displacement), 0.5, 0.5});
    list.push_back({k, (k + 1) % 16, 1.0});
  }
  return net(beads, list, law, {.lower = {0.0, 0.0, 0.0}, .upper = {16.0, 8.0, 8.0}, .periodic = {true, true, true}});
}
double largest_displacement(const auto& scene) {
  double largest = 0.0;
  const auto& x = scene.template group<Net>().positions();
  for (std::size_t k = 0; k < x.size(); ++k) largest = std::max(largest, std::fabs(x[k][0] - static_cast<double>(k) - 0.5));
  return largest;
}

}  // namespace

TEST_CASE(
    "KV-4: a net of springs and dashpots at random, in frames moving at random: momentum and angular momentum are kept, energy only "
    "falls") {
  test::RandomVectors random;
  Beads beads;
  std::vector<Bond> list;
  for (std::uint32_t k = 0; k < 12; ++k) {
    beads.push_back(random.vector(1.0));
    for (std::uint32_t other = 0; other < k; ++other)
      if ((k + other) % 3 != 0) list.push_back({k, other, 0.5 + 0.02 * (k + other)});
  }
  const Modest law{{.stiffness = 100.0, .damping = 0.5}};
  const double step = 0.02 * std::sqrt(0.5 / 100.0);
  for (int run = 0; run < 3; ++run) {
    auto tangle = net(beads, list, law);
    const Vector<3> frame = random.vector(30.0);
    tangle.group<Net>().set<field::Velocity>([&](const auto&) { return Vector<3>(frame + random.vector(2.0)); });
    Vector<3> drift = Vector<3>::Zero();  // mean velocity; what the net loses does not depend on it
    for (const auto& v : tangle.group<Net>().get<field::Velocity>()) drift += v / 12.0;
    const Invariants start = invariants(tangle, list, law, drift);
    double before = start.energy;
    int rises = 0;
    tangle.every(step, [&](const auto& scene) {
      const Invariants now = invariants(scene, list, law, drift);
      rises += now.energy > before;
      before = now.energy;
      CHECK((now.momentum - start.momentum).norm() <= 1e-12 * start.momentum.norm());
      CHECK((now.spin - start.spin).norm() <= 1e-12 * start.spin.norm());
    });
    tangle.run({.until = 2.0, .time_step = step});
    CHECK(rises == 0);
    CHECK(before < 0.7 * start.energy);
  }
}

TEST_CASE("KV-4: rigid rotation is free of damping: 1 rad/s with k = 1e4 N/m keeps 0.25 J and 0.5 kg m^2/s") {
  for (const double damping : {1.0, 100.0}) {
    CAPTURE(damping);
    const Modest law{{.stiffness = 1e4, .damping = damping}};
    const std::vector<Bond> list{{0, 1, 1.0 - 0.5e-4}};  // stretched by what the centripetal force m w^2 r/2 = 0.5 N asks for
    auto dumbbell = net({{0.0, 0.0, 0.0}, {0.6, 0.0, 0.8}}, list, law);
    dumbbell.group<Net>().set<field::Velocity>(
        [](const Vector<3>& x) { return Vector<3>(0.5 * (x.norm() > 0.5 ? 1.0 : -1.0) * Vector<3>(0.8, 0.0, -0.6)); });
    const Invariants start = invariants(dumbbell, list, law);
    CHECK(start.energy == doctest::Approx(0.25).epsilon(1e-4));
    CHECK(start.spin.norm() == doctest::Approx(0.5).epsilon(1e-14));
    dumbbell.run({.until = 1.0, .time_step = 1e-4});
    const Invariants end = invariants(dumbbell, list, law);
    // Half a step before the positions, velocities seem to stretch the bond at w^2 r dt/2; the dashpot answers with a little swing.
    const double pull = damping * 1e-4 / 2.0;
    CHECK(std::fabs(end.energy - start.energy) <= 1.1 * pull * pull / 2e4 + 1e-12);
    CHECK((end.spin - start.spin).norm() <= 1e-13);
    const Vector<3> axis = dumbbell.group<Net>().positions()[1] - dumbbell.group<Net>().positions()[0];
    CHECK(axis.dot(Vector<3>(0.6, 0.0, 0.8)) == doctest::Approx(std::cos(1.0)).epsilon(1e-6));  // it did turn, by 1 rad
  }
}

TEST_CASE("a bond of length zero has no direction: no force, everything finite, the other bonds as ever") {
  const Modest law{{.stiffness = 4.0, .damping = 0.3}};
  auto coincident = net({{0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}}, {{0, 1, 0.5}}, law);
  coincident.run({.until = 1.0, .time_step = 0.01});
  for (const auto& x : coincident.group<Net>().positions()) CHECK(x == Vector<3>(0.1, 0.2, 0.3));
  CHECK(count_zero_length_bonds(coincident) == 1);

  // Three more bonds fill the vector register of bead 0, whose other bonds hold it: nothing leaks from lane to lane.
  const Beads star{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  const std::vector<Bond> rays{{0, 2, 0.9}, {0, 3, 0.9}, {0, 4, 0.9}}, all{{0, 2, 0.9}, {0, 1, 0.5}, {0, 3, 0.9}, {0, 4, 0.9}};
  auto without = net(star, rays, law), with = net(star, all, law);
  CHECK(std::isfinite(with.step_limit().time_step));
  CHECK(std::isfinite(without.step_limit().time_step));
  CHECK(count_zero_length_bonds(with) == 1);
  CHECK(count_zero_length_bonds(without) == 0);
  for (std::size_t k = 0; k < 5; ++k)
    CHECK((with.group<Net>().get<field::Acceleration>()[k] - without.group<Net>().get<field::Acceleration>()[k]).norm() <= 1e-15);
  CHECK(with.group<Net>().get<field::Acceleration>()[0].norm() == doctest::Approx(4.0 * 0.1 * std::numbers::sqrt3));
}

TEST_CASE("a bond of rest length zero is a linear spring through the point where its ends meet") {
  auto pair = net({{-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}}, {{0, 1, 0.0}}, {{.stiffness = 2.0, .damping = 0.0}});  // omega = sqrt(2k/m) = 2
  double largest = 0.0;
  pair.every(0.01, [&](const auto& scene) {
    largest = std::max(largest, std::fabs(scene.template group<Net>().positions()[1][0] - 0.5 * std::cos(2.0 * scene.time())));
  });
  pair.run({.until = 10.0, .time_step = 1e-3});
  CHECK(largest <= 0.5 * 10.0 * 2.0 * 4e-6 / 24.0 * 1.1);  // phase error (omega dt)^2/24 of omega t
}

TEST_CASE("a bond across periodic faces acts like one inside, and goes on so while it drifts through the box") {
  const Box<3> box{.lower = {0.0, 0.0, 0.0}, .upper = {1.0, 1.5, 2.0}, .periodic = {true, true, true}};
  const Modest law{{.stiffness = 30.0, .damping = 0.2}};
  const Beads inside{{0.4, 0.4, 0.4}, {0.5, 0.45, 0.6}, {0.55, 0.6, 0.5}};
  const std::vector<Bond> list{{0, 1, 0.2}, {1, 2, 0.2}, {0, 2, 0.2}};
  const auto velocity = [](const Vector<3>& x) { return Vector<3>(0.1 * (x[0] > 0.45 ? 1.0 : -1.0), 0.0, 0.0); };
  auto reference = net(inside, list, law);
  reference.group<Net>().set<field::Velocity>(velocity);
  reference.run({.until = 2.0, .time_step = 1e-3});
  for (const Vector<3>& shift :
       {Vector<3>(0.55, 0.0, 0.0), Vector<3>(0.0, 1.07, 0.0), Vector<3>(0.0, 0.0, 1.5), Vector<3>(0.55, 1.07, 1.5)})
    for (const Vector<3>& drift : {Vector<3>(0.0, 0.0, 0.0), Vector<3>(1.7, -2.3, 3.1)}) {
      Beads across;
      for (const auto& x : inside) across.push_back(box.wrap(x + shift));
      auto moved = net(across, list, law, box);
      for (std::size_t k = 0; k < 3; ++k) moved.group<Net>().get<field::Velocity>()[k] = velocity(inside[k]) + drift;
      moved.run({.until = 1.0, .time_step = 1e-3});
      moved.engine().build_lists();  // back into the box, as when lists are rebuilt or a checkpoint is written
      moved.run({.until = 2.0, .time_step = 1e-3});
      const auto &x = moved.group<Net>().positions(), &y = reference.group<Net>().positions();
      for (std::size_t k = 0; k < 3; ++k) {
        Vector<3> apart = x[k] - y[k] - shift - 2.0 * drift;
        for (int d = 0; d < 3; ++d) apart[d] -= (box.upper[d] - box.lower[d]) * std::round(apart[d] / (box.upper[d] - box.lower[d]));
        CHECK(apart.norm() <= 1e-12);
      }
    }
}

namespace {
/// When a scene says that a bond has become too long [s]; -1 if it does not before 2 s. The right bead starts 0.1 m beside the left one in
/// a box that is periodic along x, 1 m.
template <class Hold, bool FromTheRight>
[[nodiscard]] double too_long_at(const auto& law, const Vector<2>& velocity) {
  const auto bead = [](double x) { return Points<2>{.positions = {{x, 0.5}}, .spacing = 0.0, .volume = 1.0}; };
  const auto bond = [&] {
    if constexpr (FromTheRight) return bonds<Right, Left>(law, {{0, 0}});
    else return bonds<Left, Right>(law, {{0, 0}});
  };
  auto pair = scene<Leapfrog>(Box<2>{.lower = {0.0, -10.0}, .upper = {1.0, 10.0}, .periodic = {true, false}},
                              group<Left>("left", Hold{}, bead(0.9), 1.0), group<Right>("right", Mobile{}, bead(0.0), 1.0), bond());
  pair.template group<Right>().template set<field::Velocity>([&](const auto&) { return velocity; });
  try {
    pair.run({.until = 2.0, .time_step = 1e-3, .check_every = 1});
  } catch (const SimulationError& error) {
    CHECK(std::string(error.what()).find("a bond has become longer than 0.45 of the periodic box") != std::string::npos);
    return error.where.time;
  }
  return -1.0;
}
}  // namespace

TEST_CASE_TEMPLATE("a bond that outgrows a periodic box is found, whichever end lists it, unless it has broken", Hold, Mobile, Frozen<2>) {
  const bond::Harmonic weak{.stiffness = 1e-12};
  const bond::Breaking breaks{weak, bond::LargestStrain{.strain = 1.0}};
  for (const double toward : {1.0, -1.0}) {  // the latter through the other bead
    CAPTURE(toward);
    const double expected = toward > 0.0 ? 0.35 : 0.55;
    for (const double found : {too_long_at<Hold, false>(weak, {toward, 0.0}), too_long_at<Hold, true>(weak, {toward, 0.0})}) {
      CHECK(found >= expected - 1e-12);
      CHECK(found <= expected + 2e-3);
    }
    CHECK(too_long_at<Hold, false>(weak, {0.0, toward}) == -1.0);
    CHECK(too_long_at<Hold, false>(breaks, {toward, 0.0}) == -1.0);
    CHECK(too_long_at<Hold, true>(breaks, {toward, 0.0}) == -1.0);
  }
}

TEST_CASE("whichever of many bonds outgrows a periodic box, along whichever axis, is found") {
  const bond::Harmonic weak{.stiffness = 1e-12};
  int wrong = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const std::uint32_t leaves : {1u, 3u, 4u, 5u, 9u})  // of one hub; less than a pack, packs and a part of one
      for (std::uint32_t leaving = 0; leaving < leaves; ++leaving) {
        geometry::Points<3> beads{.positions = {Vector<3>::Constant(0.5)}, .spacing = 0.0, .volume = 1.0};
        std::vector<neighbours::Bond> list;
        for (std::uint32_t leaf = 0; leaf < leaves; ++leaf) {
          beads.positions.push_back(beads.positions[0] + 0.01 * (leaf + 1) * Vector<3>::Unit((axis + 1) % 3));
          list.push_back({0, leaf + 1});
        }
        geometry::Box<3> box{.lower = Vector<3>::Constant(-10.0), .upper = Vector<3>::Constant(10.0)};
        box.lower[axis] = 0.0;
        box.upper[axis] = 1.0;
        box.periodic[static_cast<std::size_t>(axis)] = true;
        auto scene = simulation::scene<integrator::Leapfrog>(box, simulation::group<Net>("star", particles::Mobile{}, beads, 1.0),
                                                             simulation::bonds<Net, Net>(weak, list));
        scene.group<Net>().get<field::Velocity>()[leaving + 1] = Vector<3>::Unit(axis);  // gone 0.45 of the box at 0.45 s
        double found = -1.0;
        try {
          scene.run({.until = 0.6, .time_step = 1e-2, .check_every = 1});
        } catch (const SimulationError& error) {
          found = error.where.time;
        }
        wrong += found >= 0.45 - 1e-9 && found <= 0.48 ? 0 : 1;
      }
  CHECK(wrong == 0);
}

namespace {
struct Plate {};
/// 1 m/s to the right.
struct Tow {
  [[nodiscard]] Vector<2> position(const Vector<2>& start, double time) const { return start + Vector<2>(time, 0.0); }
  [[nodiscard]] Vector<2> velocity(const Vector<2>&, double) const { return {1.0, 0.0}; }
};
}  // namespace

TEST_CASE("a driven plate tows a bead through the periodic box, several times round, as if it were at rest") {
  auto scene = simulation::scene<integrator::Leapfrog>(
      geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {true, false}},
      simulation::group<Plate>("plate", particles::Driven<Tow>{},
                               geometry::Points<2>{.positions = {{0.3, 0.5}}, .spacing = 0.0, .volume = 1.0}, 1.0),
      simulation::group<Net>("bead", particles::Mobile{}, geometry::Points<2>{.positions = {{0.4, 0.5}}, .spacing = 0.0, .volume = 1.0},
                             1.0),
      simulation::bonds<Plate, Net>(bond::KelvinVoigt{.stiffness = 100.0, .damping = 5.0}, {{0, 0}}));
  scene.template group<Net>().template set<field::Velocity>([](const auto&) { return Vector<2>(1.0, 0.0); });
  double slowest = 1.0, fastest = 1.0;
  scene.every(0.01, [&](const auto& s) {
    const double speed = s.template group<Net>().template get<field::Velocity>()[0][0];
    slowest = std::min(slowest, speed);
    fastest = std::max(fastest, speed);
  });
  scene.run({.until = 3.7, .time_step = 1e-3});
  CHECK(slowest == doctest::Approx(1.0).epsilon(1e-9));
  CHECK(fastest == doctest::Approx(1.0).epsilon(1e-9));
}

TEST_CASE(
    "the stiffness bound is where it ends: a ring is stable at 0.95 of it, a larger step is refused, and one taken nevertheless blows up") {
  auto ring = zigzag({{.stiffness = 100.0, .damping = 0.0}});
  const auto limit = ring.step_limit();
  CHECK(limit.stable_time_step == doctest::Approx(2.0 / std::sqrt(4.0 * 100.0)).epsilon(1e-14));
  CHECK(limit.stability_bound_by == "bond stiffness of net - net");
  double largest = 0.0;
  ring.every(limit.time_step, [&](const auto& scene) { largest = std::max(largest, largest_displacement(scene)); });
  ring.run({.until = 10000.0 * limit.time_step, .time_step = 0.95 * limit.time_step});
  CHECK(largest <= 1e-3 / std::sqrt(1.0 - 0.95 * 0.95) * 1.01);  // shadow energy

  CHECK_THROWS_WITH_AS(zigzag({{.stiffness = 100.0, .damping = 0.0}}).run({.until = 1e3, .time_step = 0.101}),
                       "scene: time_step must be <= 0.1 s, the bound of bond stiffness of net - net, got 0.101", ParameterError);

  auto careless = zigzag({{.stiffness = 100.0, .damping = 0.0}, 0.5});
  std::string text;
  SimulationError::Where where;
  try {
    careless.run({.until = 1e3, .time_step = 1.05 * limit.time_step, .check_every = 50});
  } catch (const SimulationError& error) {
    text = error.what();
    where = error.where;
  }
  CHECK(where.step > 0);
  CHECK(where.step < 5000);
  CHECK(where.step % 50 == 0);
  CHECK(where.time == doctest::Approx(static_cast<double>(where.step) * 1.05 * limit.time_step).epsilon(1e-12));
  CHECK(where.group == "net");
  CHECK(where.particle >= 0);
  CHECK(where.particle < 16);
  for (const std::string& part :
       {std::string("a bond has become longer than 0.45 of the periodic box"), " at t = " + to_text(where.time) + " s",
        ", step " + std::to_string(where.step), std::string(", group net"), ", particle " + std::to_string(where.particle)})
    CHECK(text.find(part) != std::string::npos);
}

TEST_CASE("the dashpot bound is where it ends") {
  const bond::KelvinVoigt dashpot{.stiffness = 0.0, .damping = 100.0};
  auto ring = zigzag({dashpot});
  const auto kick = [](auto& scene) {  // opposite velocities of neighbours: damped at the rate 4 c/m
    auto& v = scene.template group<Net>().template get<field::Velocity>();
    for (std::size_t k = 0; k < v.size(); ++k) v[k] = {k % 2 == 0 ? 1.0 : -1.0, 0.0, 0.0};
  };
  kick(ring);
  const auto limit = ring.step_limit();
  CHECK(limit.stable_time_step == doctest::Approx(2.0 / 400.0).epsilon(1e-14));
  CHECK(limit.stability_bound_by == "bond dashpot of net - net");
  ring.run({.until = 400.0 * limit.time_step, .time_step = 0.95 * limit.time_step});
  CHECK(ring.group<Net>().get<field::Velocity>()[0].norm() < 1e-12);
  auto careless = zigzag({dashpot, 0.5});
  kick(careless);
  CHECK_THROWS_AS(careless.run({.until = 1e6, .time_step = 1.05 * limit.time_step}), SimulationError);
}

TEST_CASE("a bound of bonds names the groups that they join, and of several items between the same two that which pulls hardest") {
  const Beads beads{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  const auto named = [&](const bond::KelvinVoigt& second, const bond::KelvinVoigt& third) {
    auto mesh = scene<Leapfrog>(Box<3>::unbounded(), group<Net>("net", Mobile{}, Points<3>{beads}, 1.0),
                                group<Right>("post", Frozen<3>{}, Points<3>{{Vector<3>(2.0, 0.0, 0.0)}}, 1.0),
                                bonds<Net, Net>(bond::Harmonic{.stiffness = 10.0}, {{0, 1}, {0, 2}}), bonds<Net, Net>(second, {{1, 2}}),
                                bonds<Net, Right>(third, {{1, 0}}));
    const std::string name = mesh.step_limit().stability_bound_by;
    CHECK_THROWS_WITH_AS(mesh.run({.until = 1e3, .time_step = 100.0}), doctest::Contains(("s, the bound of " + name + ", got 100").c_str()),
                         ParameterError);
    return name;
  };
  CHECK(named({.stiffness = 1.0, .damping = 0.0}, {.stiffness = 1.0, .damping = 0.0}) == "bond stiffness of net - net (number 1 of 2)");
  CHECK(named({.stiffness = 25.0, .damping = 0.0}, {.stiffness = 1.0, .damping = 0.0}) == "bond stiffness of net - net (number 2 of 2)");
  CHECK(named({.stiffness = 1.0, .damping = 0.0}, {.stiffness = 60.0, .damping = 0.0}) == "bond stiffness of net - post");
  CHECK(named({.stiffness = 1.0, .damping = 30.0}, {.stiffness = 1.0, .damping = 0.0}) == "bond dashpot of net - net (number 2 of 2)");
  CHECK(named({.stiffness = 1.0, .damping = 30.0}, {.stiffness = 1.0, .damping = 70.0}) == "bond dashpot of net - post");

  auto pulled = scene<Leapfrog>(Box<3>::unbounded(), group<Net>("net", Mobile{}, Points<3>{beads}, 1.0),
                                bonds<Net, Net>(bond::Harmonic{.stiffness = 1.0}, {{0, 1}, {0, 2}}),
                                forced_by<Net>(forcing::Drag{.coefficient = 100.0}));
  CHECK(pulled.step_limit().stability_bound_by == "drag on net");  // springs without dashpots
}

TEST_CASE(
    "spring and dashpot together: stable at 0.95 of the bound, and its 1.5-fold blows up") {  // true: (omega dt/2)^2 + lambda dt/2 < 1
  for (const double damping : {1.0, 5.0, 20.0}) {  // lambda = 4 c/m below, at and above omega = 20/s
    CAPTURE(damping);
    const bond::KelvinVoigt law{.stiffness = 100.0, .damping = damping};
    auto ring = zigzag({law});
    const double bound = ring.step_limit().stable_time_step;
    CHECK_NOTHROW(ring.run({.until = 3000.0 * bound, .time_step = 0.95 * bound}));
    CHECK(largest_displacement(ring) < 1e-2);
    auto careless = zigzag({law, 0.1});
    CHECK_THROWS_AS(careless.run({.until = 1e4, .time_step = 1.5 * bound}), SimulationError);
  }
}

TEST_CASE(
    "the cubic lattice of edge and diagonal springs oscillates with omega^2 = 12 k/m at most, as the bound says: beyond it blows up and is "
    "caught") {
  // The fastest plane wave moves neighbouring layers against each other. Periodic, so that all beads are alike.
  constexpr std::uint32_t side = 4;
  constexpr double k = 100.0;
  Beads beads;
  std::vector<Bond> list;
  const auto row = [](std::uint32_t x, std::uint32_t y, std::uint32_t z) { return x % side + side * (y % side + side * (z % side)); };
  for (std::uint32_t z = 0; z < side; ++z)
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t x = 0; x < side; ++x) {
        beads.push_back({x + 0.5, y + 0.5, z + 0.5});
        for (const auto& [a, b, c] :
             {std::array{1u, 0u, 0u}, {0u, 1u, 0u}, {0u, 0u, 1u}, {1u, 1u, 0u}, {1u, side - 1, 0u},
              {1u, 0u, 1u}, {1u, 0u, side - 1}, {0u, 1u, 1u}, {0u, 1u, side - 1}})
          list.push_back({row(x, y, z), row(x + a, y + b, z + c)});
      }
  const Box<3> box{.lower = {0.0, 0.0, 0.0}, .upper = {4.0, 4.0, 4.0}, .periodic = {true, true, true}};
  const auto shaken = [&](double admitted) {
    auto lattice = net(beads, list, {{.stiffness = k, .damping = 0.0}, admitted}, box);
    test::RandomVectors random;
    lattice.group<Net>().set<field::Velocity>([&](const auto&) { return random.vector(1e-6); });
    return lattice;
  };
  const double bound = 2.0 / std::sqrt(12.0 * k);
  auto lattice = shaken(1.0);
  CHECK(lattice.step_limit().stable_time_step == doctest::Approx(bound).epsilon(1e-7));
  lattice.run({.until = 3000.0 * bound, .time_step = 0.95 * bound});
  double largest = 0.0;
  for (const auto& v : lattice.group<Net>().get<field::Velocity>()) largest = std::fmax(largest, v.norm());
  CHECK(largest < 1e-4);
  auto careless = shaken(0.5);
  CHECK_THROWS_AS(careless.run({.until = 3000.0 * bound, .time_step = 1.02 * bound}), SimulationError);
}

TEST_CASE("1, 2, 3 and 4 threads give the same bits for 17576 beads in four blocks and their bonds") {
  Beads beads;
  std::vector<Bond> list;
  constexpr std::uint32_t side = 26;
  for (std::uint32_t z = 0; z < side; ++z)
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t x = 0; x < side; ++x) {
        const std::uint32_t row = x + side * (y + side * z);
        beads.push_back({0.1 * x + 0.05, 0.1 * y + 0.05, 0.1 * z + 0.05});
        list.push_back({row, (x + 1) % side + side * (y + side * z)});
        list.push_back({row, x + side * ((y + 1) % side + side * z)});
        if (z > 0) list.push_back({row, row - side * side});
      }
  const Box<3> box{.lower = {0.0, 0.0, 0.0}, .upper = {2.6, 2.6, 2.6}, .periodic = {true, true, true}};
  const int before = available_threads();
  Beads first;
  for (const int threads : {1, 2, 3, 4}) {
    use_threads(threads);
    auto block = net(beads, list, {{.stiffness = 50.0, .damping = 0.1}}, box);
    test::RandomVectors random;
    block.group<Net>().set<field::Velocity>([&](const auto&) { return random.vector(0.2); });
    block.run({.until = 0.2, .time_step = 0.01});
    CHECK(block.group<Net>().blocks.size() == 4);
    CHECK(block.group<Net>().blocks.ranges().size() == static_cast<std::size_t>(threads));
    const Beads x(block.group<Net>().positions().begin(), block.group<Net>().positions().end());
    if (first.empty()) first = x;
    std::size_t different = 0;
    for (std::size_t k = 0; k < x.size(); ++k) different += x[k] != first[k];
    CHECK(different == 0);
  }
  CHECK((first[0] - beads[0]).norm() > 1e-3);
  use_threads(before);
}

// ---- Soft and stiff groups: sub-steps -----------------------------------------------------------------------------------------------

namespace {

struct Soft {};
struct Stiff {};

constexpr double soft_stiffness = 1.0, stiff_stiffness = 1e6;  // [N/m]; all beads 1 kg

/// Four soft bonds in a row and a stiff one at the end: S0 - S1 - S2 - S3 - T0 = T1, a metre apart on the line.
auto chain(const auto& stiff_bonds) {
  Points<1> soft, stiff;
  for (int k = 0; k < 4; ++k) soft.positions.emplace_back(k);
  for (int k = 4; k < 6; ++k) stiff.positions.emplace_back(k);
  const bond::Harmonic spring{.stiffness = soft_stiffness};
  auto result = scene<Leapfrog>(Box<1>::unbounded(), group<Soft>("soft", Mobile{}, soft, 1.0), group<Stiff>("stiff", Mobile{}, stiff, 1.0),
                                bonds<Soft, Soft>(spring, {{0, 1}, {1, 2}, {2, 3}}), bonds<Soft, Stiff>(spring, {{3, 0}}), stiff_bonds);
  result.template group<Soft>().positions()[0][0] -= 0.3;
  result.template group<Soft>().positions()[2][0] += 0.2;
  return result;
}
auto plain() { return chain(bonds<Stiff, Stiff>(bond::Harmonic{.stiffness = stiff_stiffness}, {{0, 1}})); }
auto substepped(int substeps) {
  return chain(substepped_bonds<Stiff, Stiff>(bond::Harmonic{.stiffness = stiff_stiffness}, {{0, 1}}, substeps));
}

Eigen::Matrix<double, 6, 6> stiffness_matrix() {
  Eigen::Matrix<double, 6, 6> k = Eigen::Matrix<double, 6, 6>::Zero();
  for (int n = 0; n < 5; ++n) {
    const double stiffness = n < 4 ? soft_stiffness : stiff_stiffness;
    k.block<2, 2>(n, n) += stiffness * (Eigen::Matrix2d() << 1.0, -1.0, -1.0, 1.0).finished();
  }
  return k;
}
Eigen::Matrix<double, 6, 1> displacements(const auto& scene) {
  Eigen::Matrix<double, 6, 1> u;
  for (int k = 0; k < 4; ++k) u[k] = scene.template group<Soft>().positions()[static_cast<std::size_t>(k)][0] - k;
  for (int k = 4; k < 6; ++k) u[k] = scene.template group<Stiff>().positions()[static_cast<std::size_t>(k - 4)][0] - k;
  return u;
}
Eigen::Matrix<double, 6, 1> velocities(const auto& scene) {
  Eigen::Matrix<double, 6, 1> v;
  for (int k = 0; k < 4; ++k) v[k] = scene.template group<Soft>().template get<field::Velocity>()[static_cast<std::size_t>(k)][0];
  for (int k = 4; k < 6; ++k) v[k] = scene.template group<Stiff>().template get<field::Velocity>()[static_cast<std::size_t>(k - 4)][0];
  return v;
}
/// By the modes of the chain, from rest at the start of `chain`.
Eigen::Matrix<double, 6, 1> exact_displacements(double t) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> modes(stiffness_matrix());
  const Eigen::Matrix<double, 6, 1> start{-0.3, 0.0, 0.2, 0.0, 0.0, 0.0};
  Eigen::Matrix<double, 6, 1> u = modes.eigenvectors().transpose() * start;
  for (int n = 0; n < 6; ++n) u[n] *= std::cos(std::sqrt(std::max(0.0, modes.eigenvalues()[n])) * t);
  return modes.eigenvectors() * u;
}
double chain_energy(const auto& scene) {
  const auto u = displacements(scene), v = velocities(scene);
  return 0.5 * v.squaredNorm() + 0.5 * u.dot(stiffness_matrix() * u);
}
double error_at_5(auto scene, double time_step) {
  scene.run({.until = 5.0, .time_step = time_step});
  return (displacements(scene) - exact_displacements(5.0)).norm();
}

}  // namespace

TEST_CASE("sub-stepped bonds: the step of the scene follows the soft bonds, the number of sub-steps the stiff ones") {
  auto soft = substepped(0);
  CHECK(soft.step_limit().bound_by == "bond stiffness of soft - soft");
  const auto report = soft.run({.until = 1.0, .time_step = 0.1});
  CHECK(report.limit.stable_time_step == doctest::Approx(1.0).epsilon(1e-12));  // 2/sqrt(4 k/m) of the soft bonds
  const double bound = 2.0 / std::sqrt(2.0 * stiff_stiffness);
  CHECK(substeps_for(soft.engine(), 0.1) >= 0.1 / bound);
  CHECK(substeps_for(soft.engine(), 0.1) <= 1.5 * 0.1 / bound);
  CHECK_THROWS_WITH_AS(substepped(10).run({.until = 1.0, .time_step = 0.1}),
                       "substepped_bonds: substeps must be >= 71 for a step of 0.1 s, got 10", ParameterError);
  CHECK_THROWS_AS(plain().run({.until = 1.0, .time_step = 0.1}), ParameterError);
}

TEST_CASE("sub-stepped bonds agree with the modes of the chain to second order of the step of the soft bonds, as does a plain small step") {
  const double plain_error = error_at_5(plain(), 1e-4);
  CHECK(plain_error <= 1e-6);
  const double coarse = error_at_5(substepped(400), 0.1), fine = error_at_5(substepped(200), 0.05);
  CHECK(fine <= 1e-3);
  CHECK(coarse / fine == doctest::Approx(4.0).epsilon(0.1));
}

TEST_CASE("sub-stepped bonds keep the energy over 10000 steps though one bond is a million times as stiff as the others") {
  auto soft = substepped(200);
  const double start = chain_energy(soft);
  double early = 0.0, late = 0.0;
  soft.every(0.05, [&](const auto& scene) {
    const double error = std::fabs(chain_energy(scene) / start - 1.0);
    if (scene.time() <= 50.0) early = std::max(early, error);
    if (scene.time() >= 450.0) late = std::max(late, error);
  });
  soft.run({.until = 500.0, .time_step = 0.05});
  CHECK(soft.step() == 10000);
  CHECK(early <= 0.25 * 4.0 * 0.05 * 0.05);  // (omega dt/2)^2 of the fastest soft motion
  CHECK(late <= 1.2 * early);                // and no drift
  CHECK(velocities(soft).sum() == doctest::Approx(0.0).epsilon(1e-10));
}

namespace {

/// Two free beads of 1 kg, thrown together by 1e-3 m/s: their dashpot c stops them with lambda = 2 c, of which leapfrog stands
/// dt < 2/lambda = 1/c.
template <class Integrator>
auto damped_pair(const Modest& law, int substeps) {
  auto pair = scene<Integrator>(Box<1>::unbounded(), group<Stiff>("stiff", Mobile{}, Points<1>{{Vector<1>(0.0), Vector<1>(1.0)}}, 1.0),
                                substepped_bonds<Stiff, Stiff>(law, {{0, 1}}, substeps));
  pair.template group<Stiff>().template get<field::Velocity>() = {Vector<1>(1e-3), Vector<1>(-1e-3)};
  return pair;
}

}  // namespace

TEST_CASE(
    "sub-steps of damped bonds are those of leapfrog, dt/(0.9/c), under every integrator: stable at 0.95 of 1/c, and beyond it the beads "
    "fly apart") {
  const auto check = []<class Integrator>(Integrator) {
    constexpr double c = 50.0;
    const Modest law{.law = {.stiffness = 0.0, .damping = c}}, modest{.law = law.law, .admitted = 1e-3};
    for (const double dt : {0.01, 0.1, 1.0}) {
      auto pair = damped_pair<Integrator>(law, 0);
      pair.run({.until = 10.0 * dt, .time_step = dt});
      CHECK(pair.engine().substeps() == static_cast<int>(std::ceil(dt * c / 0.9)));
      CHECK(std::fabs(pair.template group<Stiff>().template get<field::Velocity>()[0][0]) < 1e-3);
    }
    const auto left = [&](double share, const Modest& bond) {  // of the speed, after 1000 steps of 20 sub-steps
      auto pair = damped_pair<Integrator>(bond, 20);
      const double dt = 20.0 * share / c;
      pair.run({.until = 1000.0 * dt, .time_step = dt});
      return std::fabs(pair.template group<Stiff>().template get<field::Velocity>()[0][0]) / 1e-3;
    };
    CHECK(left(0.95, law) < 1e-9);
    CHECK_THROWS_AS(left(1.05, law), ParameterError);
    CHECK_THROWS_AS(left(1.05, modest), SimulationError);
  };
  check(Leapfrog{});
  check(ExtrapolatedVerlet{});
  check(SymplecticEuler{});
}

TEST_CASE("bonds declared by several items: stable at 0.95 of the bound") {  // each item's bound is taken alone
  // A ring of four, S0 - S1 - T1 - T0 - S0: one bond per bead in each item, two in all. Its fastest motion has omega^2 = 4 k/m.
  const bond::Harmonic spring{.stiffness = 1.0};
  auto ring = scene<Leapfrog>(Box<1>::unbounded(), group<Soft>("soft", Mobile{}, Points<1>{{Vector<1>(0.0), Vector<1>(1.0)}}, 1.0),
                              group<Stiff>("stiff", Mobile{}, Points<1>{{Vector<1>(3.0), Vector<1>(2.0)}}, 1.0),
                              bonds<Soft, Soft>(spring, {{0, 1}}), bonds<Soft, Stiff>(spring, {{0, 0}, {1, 1}}),
                              bonds<Stiff, Stiff>(spring, {{0, 1}}));  // the type of plain()
  ring.group<Soft>().positions()[0][0] += 1e-3;
  const double bound = ring.step_limit().stable_time_step;
  CHECK(bound <= 1.0 + 1e-12);
  CHECK(bound >= 1.0 / 1.5);
  ring.run({.until = 3000.0 * bound, .time_step = 0.95 * bound});
  CHECK(std::fabs(ring.group<Stiff>().positions()[0][0] - 3.0) < 1e-2);
}

// Not half of them, as once with symplectic Euler.
TEST_CASE("beside sub-stepped bonds the other forces act in full, whatever the integrator: a bonded pair falls with g") {
  const auto fallen = []<class Integrator>(Integrator) {
    auto pair = scene<Integrator>(Box<1>::unbounded(), group<Stiff>("stiff", Mobile{}, Points<1>{{Vector<1>(0.0), Vector<1>(1.0)}}, 1.0),
                                  substepped_bonds<Stiff, Stiff>(bond::Harmonic{.stiffness = 1e4}, {{0, 1}}),
                                  forced_by<Stiff>(forcing::Constant<1>{.uniform_acceleration = {{{-10.0}}}}));
    pair.run({.until = 1.0, .time_step = 1.0 / 64.0});
    return pair.template group<Stiff>().template get<field::Velocity>()[0][0];
  };
  CHECK(fallen(SymplecticEuler{}) == doctest::Approx(-10.0).epsilon(1e-12));
}

namespace {
/// A rope that is pulled by a winch: the same force at any length.
struct Taut {
  double pull;
  auto tension(const auto& bond) const { return 0.0 * bond.length + pull; }
  double largest_stiffness() const { return 0.0; }
};
[[maybe_unused]] void validate(const Taut&) {}
}  // namespace

TEST_CASE("a bound of bonds is named after those that by themselves hold the particle most, by stiffness or by tension") {
  const geometry::Points<2> two{.positions = {{0.0, 0.0}, {1.0, 0.0}}};
  const auto bound_by = [&two](double stiffness, double pull) {
    auto scene = simulation::scene<integrator::Leapfrog>(geometry::Box<2>::unbounded(), group<Stiff>("b", Mobile{}, two, 1.0),
                                                         bonds<Stiff, Stiff>(bond::Harmonic{.stiffness = stiffness}, {{0, 1}}),
                                                         bonds<Stiff, Stiff>(Taut{pull}, {{0, 1}}));
    return scene.step_limit().stability_bound_by;
  };
  CHECK(bound_by(0.1, 100.0) == "bond stiffness of b - b (number 2 of 2)");
  CHECK(bound_by(100.0, 0.1) == "bond stiffness of b - b (number 1 of 2)");
}

TEST_CASE("the bound of a flat sheet of equal bonds in space is the same bits for 1 to 4 threads") {
  constexpr int n = 96;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    geometry::Points<3> points;
    std::vector<neighbours::Bond> list;
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> jitter(-3e-10, 3e-10);
    const auto row = [](int i, int j) { return static_cast<std::uint32_t>(j * n + i); };
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        points.positions.emplace_back(i + 0.5 * j + jitter(generator), std::sqrt(0.75) * j + jitter(generator), 0.0);
        if (i + 1 < n) list.push_back({row(i, j), row(i + 1, j), 1.0});
        if (j + 1 < n) list.push_back({row(i, j), row(i, j + 1), 1.0});
        if (i > 0 && j + 1 < n) list.push_back({row(i, j), row(i - 1, j + 1), 1.0});
      }
    std::vector<double> bound;
    for (int threads = 1; threads <= 4; ++threads) {
      const test::Threads some(threads);
      auto scene = simulation::scene<integrator::Leapfrog>(geometry::Box<3>::unbounded(), group<Stiff>("sheet", Mobile{}, points, 1.0),
                                                           bonds<Stiff, Stiff>(bond::Harmonic{.stiffness = 1.7}, list));
      bound.push_back(scene.step_limit().stable_time_step);
    }
    CHECK(bound == std::vector<double>(4, bound[0]));
  }
}
