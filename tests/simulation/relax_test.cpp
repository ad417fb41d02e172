// relax: minima of the energy of bonds, potentials and planes, without time.
#include <cmath>
#include <random>
#include <string>
#include <vector>
#include "support/threads.hpp"
#include <Eigen/Cholesky>
#include <doctest/doctest.h>
#include <dmp/bond.hpp>
#include <dmp/core/simulation_error.hpp>
#include <dmp/forcing.hpp>
#include <dmp/integrator.hpp>
#include <dmp/lattice_spring.hpp>
#include <dmp/potential.hpp>
#include <dmp/simulation.hpp>

using namespace dmp;
using namespace dmp::simulation;
using bond::Harmonic;
using forcing::Plane;
using geometry::Box, geometry::Points;
using integrator::ExtrapolatedVerlet, integrator::Leapfrog;
using neighbours::Bond;
using particles::Driven, particles::Frozen, particles::Mobile;

namespace {

struct Beads {};
struct Ends {};
struct Others {};

Points<1> row(int count) {
  Points<1> points;
  for (int i = 0; i < count; ++i) points.positions.emplace_back(0.1 * i);
  return points;
}
std::vector<Bond> chain(std::uint32_t count) {
  std::vector<Bond> bonds;
  for (std::uint32_t i = 0; i + 1 < count; ++i) bonds.push_back({i, i + 1});
  return bonds;
}
constexpr double mass = 0.02, k = 30.0, gravity = 9.81;

struct Growing {  // weight that grows in proportion to time
  [[nodiscard]] Components<1, double> acceleration(const forcing::Subject<1>& subject) const noexcept { return {gravity * subject.time}; }
};

}  // namespace

TEST_CASE("a chain that hangs from a frozen bead has the exact sag of a chain of springs, with any integrator") {
  const auto check = [&]<class Integrator>(Integrator) {
    constexpr int count = 20;
    auto hanging =
        scene<Integrator>(Box<1>::unbounded(), group<Ends>("hook", Frozen<1>{}, Points<1>{{Vector<1>(-0.1)}}, mass),
                          group<Beads>("beads", Mobile{}, row(count), mass), bonds<Beads, Beads>(Harmonic{.stiffness = k}, chain(count)),
                          bonds<Ends, Beads>(Harmonic{.stiffness = k}, {{0, 0}}),
                          forced_by<Beads>(forcing::Constant<1>{.uniform_acceleration = {{gravity}}}));
    const auto report = relax(hanging, {.force_tolerance = 1e-11});
    CHECK(report.largest_force <= 1e-11);
    CHECK(report.evaluations < 2000);
    double sag = 0.0, worst = 0.0;  // bond i bears all beads below
    for (int i = 0; i < count; ++i) {
      sag += (count - i) * mass * gravity / k;
      worst = std::fmax(worst, std::fabs(hanging.template group<Beads>().positions()[static_cast<std::size_t>(i)][0] - 0.1 * i - sag));
    }
    CHECK(worst < 1e-9);
    CHECK(hanging.time() == 0.0);
    for (const auto& v : hanging.template group<Beads>().template get<field::Velocity>()) CHECK(v[0] == 0.0);
  };
  check(Leapfrog{});
  check(ExtrapolatedVerlet{});
}

TEST_CASE("steps that fold too much are taken back and halved, and go on from where the last one ended; what folds anyway is kept") {
  constexpr int count = 5;
  auto hanging =
      scene<Leapfrog>(Box<1>::unbounded(), group<Ends>("hook", Frozen<1>{}, Points<1>{{Vector<1>(-0.1)}}, mass),
                      group<Beads>("beads", Mobile{}, row(count), mass), bonds<Beads, Beads>(Harmonic{.stiffness = k}, chain(count)),
                      bonds<Ends, Beads>(Harmonic{.stiffness = k}, {{0, 0}}),
                      forced_by<Beads>(Growing{}));
  const auto lowest = [&] { return hanging.group<Beads>().positions()[count - 1][0]; };
  struct Step {
    double from, to, start;
  };
  std::vector<Step> tried;
  double longest = 0.3;  // of the steps that do not fold
  std::size_t for_good = 0;
  const auto folded = [&]() -> std::size_t { return for_good + (!tried.empty() && tried.back().to - tried.back().from > longest ? 1 : 0); };
  const auto guess = [&](double from, double to) { tried.push_back({from, to, lowest()}); };
  const StepsOptions options{.until = 2.0, .largest_step = 1.0, .relax = {.force_tolerance = 1e-12}};
  const auto report = relax_in_steps(hanging, options, folded, guess);
  const std::vector<std::pair<double, double>> expected{{0.0, 1.0}, {0.0, 0.5}, {0.0, 0.25}, {0.25, 0.5}, {0.5, 1.0}, {0.5, 0.75},
                                                        {0.75, 1.0}, {1.0, 2.0}, {1.0, 1.5}, {1.0, 1.25}, {1.25, 1.5}, {1.5, 2.0},
                                                        {1.5, 1.75}, {1.75, 2.0}};
  REQUIRE(tried.size() == expected.size());
  const auto sag = [](double time) { return 0.1 * (count - 1) + 0.5 * count * (count + 1) * mass * gravity * time / k; };
  for (std::size_t n = 0; n < tried.size(); ++n) {
    CHECK(tried[n].from == expected[n].first);
    CHECK(tried[n].to == expected[n].second);
    CHECK(tried[n].start == doctest::Approx(sag(tried[n].from)).epsilon(1e-9));
  }
  CHECK(lowest() == doctest::Approx(sag(2.0)).epsilon(1e-9));
  CHECK((report.steps == 8 && report.halvings == 6 && report.folded == 0));

  tried.clear();
  longest = 0.0;  // all of them fold
  StepsOptions once = options;
  once.from = 2.0, once.until = 3.0, once.most_halvings = 2;
  const auto given_way = relax_in_steps(hanging, once, folded, guess);
  CHECK((given_way.steps == 3 && given_way.folded == 1));  // 2 to 2.25, 2.5, 3: nothing more folds after the first
  CHECK(given_way.halvings == 2);
  CHECK(lowest() == doctest::Approx(sag(3.0)).epsilon(1e-9));

  tried.clear();
  longest = 1.0;
  StepsOptions in_vain = once;  // no time to come to rest: the last state of rest is kept
  in_vain.from = 3.0, in_vain.until = 4.0, in_vain.relax.most_evaluations = 3;
  const double at_rest = lowest();
  CHECK_THROWS_AS((void)relax_in_steps(hanging, in_vain, folded, guess), SimulationError);
  CHECK(lowest() == at_rest);
}

TEST_CASE("steps that lead nowhere are refused") {
  auto bead = scene<Leapfrog>(Box<1>::unbounded(), group<Beads>("beads", Mobile{}, row(2), mass),
                              bonds<Beads, Beads>(Harmonic{.stiffness = k}, chain(2)));
  const auto complaint = [&](const StepsOptions& options) {
    try {
      relax_in_steps(bead, options, [] { return std::size_t{0}; });
    } catch (const ParameterError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const RelaxOptions rest{.force_tolerance = 1e-9};
  CHECK(complaint({.until = 1.0, .largest_step = 1.0, .from = 1.0, .relax = rest}) ==
        "relax_in_steps: until must be finite and > from [s], got 1");
  CHECK(complaint({.until = 1.0, .largest_step = 0.0, .relax = rest}) == "relax_in_steps: largest_step must be finite and > 0 s, got 0");
  CHECK(complaint({.until = 1.0, .largest_step = 1.0, .from = -1.0, .relax = rest}).starts_with("relax_in_steps: from must be"));
  CHECK(complaint({.until = 1.0, .largest_step = 1.0, .most_halvings = -1, .relax = rest}) ==
        "relax_in_steps: most_halvings must be >= 0, got -1");
}

namespace {

struct Turning {  // all of the group about the origin, by 0.01 rad per second
  static Vector<3> position(const Vector<3>& start, double time) {
    const double c = std::cos(0.01 * time), s = std::sin(0.01 * time);
    return {c * start[0] - s * start[1], s * start[0] + c * start[1], start[2]};
  }
  static Vector<3> velocity(const Vector<3>& start, double time) {
    const Vector<3> x = position(start, time);
    return {-0.01 * x[1], 0.01 * x[0], 0.0};
  }
};

/// A net of springs in two groups, the beads at its bottom frozen and those at its top driven.
struct Net {
  lattice_spring::Body<3> body = lattice_spring::lattice_block(lattice_spring::CubicLattice{.spacing = 1.0}, {5, 5, 7});
  [[nodiscard]] double height(std::size_t i) const { return body.points.positions[i][2]; }
};

}  // namespace

TEST_CASE("a net between frozen and driven beads relaxes to the solution of its linear equations, for a small displacement") {
  const Net net;
  Points<3> bottom, middle, top;
  std::vector<std::uint32_t> row_of(net.body.points.positions.size());
  for (std::size_t i = 0; i < row_of.size(); ++i) {
    Points<3>& points = net.height(i) < 0.5 ? bottom : net.height(i) > 6.5 ? top : middle;
    row_of[i] = static_cast<std::uint32_t>(points.positions.size());
    points.positions.push_back(net.body.points.positions[i]);
  }
  std::vector<Bond> of_middle, to_bottom, to_top;
  for (const Bond& bond : net.body.bonds) {
    const auto kind = [&](std::uint32_t i) { return net.height(i) < 0.5 ? 0 : net.height(i) > 6.5 ? 2 : 1; };
    const std::uint32_t i = row_of[bond.i], j = row_of[bond.j];
    const int a = kind(bond.i), b = kind(bond.j);
    if (a == 1 && b == 1) of_middle.push_back({i, j});
    else if (a == 1 && b == 0) to_bottom.push_back({i, j});
    else if (a == 0 && b == 1) to_bottom.push_back({j, i});
    else if (a == 1 && b == 2) to_top.push_back({i, j});
    else if (a == 2 && b == 1) to_top.push_back({j, i});
  }
  const Harmonic spring{.stiffness = 2.0};
  auto scene = simulation::scene<Leapfrog>(Box<3>::unbounded(), group<Ends>("bottom", Frozen<3>{}, bottom, 1.0),
                                           group<Beads>("middle", Mobile{}, middle, 1.0), group<Others>("top", Driven<Turning>{}, top, 1.0),
                                           bonds<Beads, Beads>(spring, of_middle), bonds<Beads, Ends>(spring, to_bottom),
                                           bonds<Beads, Others>(spring, to_top));
  constexpr double time = 1e-4;  // turned by 1e-6 rad
  relax(scene, {.force_tolerance = 2e-13, .time = time});

  const auto n = static_cast<Eigen::Index>(middle.positions.size());
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * n);
  const auto block = [&](std::uint32_t i) { return Eigen::seqN(3 * static_cast<Eigen::Index>(i), 3); };
  const auto add = [&](const Vector<3>& a, const Vector<3>& b) -> Eigen::Matrix3d {
    const Vector<3> direction = (b - a).normalized();
    return spring.stiffness * (direction * direction.transpose());
  };
  for (const Bond& bond : of_middle) {
    const Eigen::Matrix3d one = add(middle.positions[bond.i], middle.positions[bond.j]);
    stiffness(block(bond.i), block(bond.i)) += one;
    stiffness(block(bond.j), block(bond.j)) += one;
    stiffness(block(bond.i), block(bond.j)) -= one;
    stiffness(block(bond.j), block(bond.i)) -= one;
  }
  for (const Bond& bond : to_bottom) stiffness(block(bond.i), block(bond.i)) += add(middle.positions[bond.i], bottom.positions[bond.j]);
  for (const Bond& bond : to_top) {
    const Eigen::Matrix3d one = add(middle.positions[bond.i], top.positions[bond.j]);
    stiffness(block(bond.i), block(bond.i)) += one;
    force.segment<3>(3 * static_cast<Eigen::Index>(bond.i)) +=
        one * (Turning::position(top.positions[bond.j], time) - top.positions[bond.j]);
  }
  const Eigen::VectorXd exact = stiffness.ldlt().solve(force);
  double difference = 0.0;
  for (Eigen::Index i = 0; i < n; ++i)
    difference = std::fmax(difference, (scene.group<Beads>().positions()[static_cast<std::size_t>(i)] -
                                        middle.positions[static_cast<std::size_t>(i)] - exact.segment<3>(3 * i))
                                           .norm());
  CHECK(exact.norm() > 1e-5);
  CHECK(difference < 1e-5 * exact.lpNorm<Eigen::Infinity>());  // the rest: strain squared
}

namespace {

/// A random network, squeezed to 0.8 of its height between two planes, in two groups that repel each other a little as well.
auto squeezed(double strength = 100.0) {
  auto body =
      lattice_spring::network(lattice_spring::random_points<3>({.least_distance = 0.14, .most_failures = 2000},
                                                               geometry::Cuboid<3>{.lower = {0.0, 0.0, 0.0}, .upper = {2.0, 2.0, 2.0}}),
                              0.14 * 1.924);
  Points<3> dust;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) dust.positions.emplace_back(0.1 + 0.45 * i, 0.1 + 0.45 * j, 2.2);
  const potential::LennardJones sticky{.energy_scale = 1e-3, .diameter = 0.2, .cutoff = 0.5};
  return scene<Leapfrog>(
      Box<3>::unbounded(), group<Beads>("beads", Mobile{}, body.points, 1.0), group<Others>("dust", Mobile{}, dust, 0.3),
      interaction<Beads, Others>(sticky), interaction<Others, Others>(sticky), bonds<Beads, Beads>(Harmonic{.stiffness = 5.0}, body.bonds),
      forced_by<Beads, Others>(Plane<3>{.normal = {{0.0, 0.0, 1.0}}, .position = 0.0, .strength = strength, .motion = {.speed = 0.2}},
                               Plane<3>{.normal = {{0.0, 0.0, -1.0}}, .position = -2.25, .strength = strength, .motion = {.speed = 0.2}}));
}

}  // namespace

TEST_CASE("relax: bonds, a potential and planes on two groups; the same bits for 1 to 4 threads, and the planes bear the same force") {
  std::vector<Vector<3>> first;
  std::uint64_t evaluations = 0;
  for (const int count : {1, 2, 3, 4}) {
    const test::Threads threads(count);
    auto scene = squeezed();
    CHECK(scene.particles() > 1900);
    const auto report = relax(scene, {.force_tolerance = 1e-7, .time = 1.0});
    const auto floor = load_on<Beads>(scene, Plane<3>{.normal = {{0.0, 0.0, 1.0}}, .position = 0.2, .strength = 100.0});
    const auto lid = load_on<Beads>(scene, Plane<3>{.normal = {{0.0, 0.0, -1.0}}, .position = -2.05, .strength = 100.0});
    const auto lid_of_dust = load_on<Others>(scene, Plane<3>{.normal = {{0.0, 0.0, -1.0}}, .position = -2.05, .strength = 100.0});
    CHECK(floor.force[2] > 0.01);
    CHECK(floor.force[2] == doctest::Approx(-lid.force[2] - lid_of_dust.force[2]).epsilon(1e-3));
    const auto& x = scene.group<Beads>().positions();
    if (first.empty()) {
      first.assign(x.begin(), x.end());
      evaluations = report.evaluations;
    }
    CHECK(report.evaluations == evaluations);
    CHECK(std::equal(first.begin(), first.end(), x.begin()));
  }
}

TEST_CASE(
    "relax: a bead that a soft spring lets fall on a stiff plane comes to rest on it, though the plane is felt only when it is reached") {
  for (const double strength : {1e4, 1e8, 1e12}) {
    CAPTURE(strength);
    auto pressed = scene<Leapfrog>(Box<1>::unbounded(), group<Ends>("hook", Frozen<1>{}, Points<1>{{Vector<1>(1.0)}}, mass),
                                   group<Beads>("beads", Mobile{}, Points<1>{{Vector<1>(0.01)}}, mass),
                                   bonds<Ends, Beads>(Harmonic{.stiffness = k}, {{0, 0, 0.99}}),
                                   forced_by<Beads>(Plane<1>{.normal = {{1.0}}, .position = 0.0, .strength = strength},
                                                    forcing::Constant<1>{.uniform_acceleration = {{-1e3 * gravity}}}));
    const auto report = relax(pressed, {.force_tolerance = 1e-9, .most_evaluations = 10000});
    CHECK(report.largest_force <= 1e-9);
    const double depth = -pressed.group<Beads>().positions()[0][0];
    CHECK(depth > 0.0);
    CHECK(strength * depth * depth == doctest::Approx(1e3 * mass * gravity - k * (0.01 + depth)).epsilon(1e-6));
  }
}

TEST_CASE("relax: the energy goes down, and a body that is at rest stays as it is") {
  std::mt19937 random(3);
  auto body = lattice_spring::lattice_block(lattice_spring::CubicLattice{.spacing = 1.0}, {6, 6, 6});
  lattice_spring::measure_rest_lengths<3>(body.bonds, body.points.positions);
  auto scene = simulation::scene<Leapfrog>(Box<3>::unbounded(), group<Beads>("beads", Mobile{}, body.points, 1.0),
                                           bonds<Beads, Beads>(Harmonic{.stiffness = 1.0}, body.bonds));
  CHECK(relax(scene, {.force_tolerance = 1e-12}).evaluations == 1);
  CHECK(scene.group<Beads>().positions()[17] == body.points.positions[17]);
  for (auto& x : scene.group<Beads>().positions())
    for (int d = 0; d < 3; ++d) x[d] += 0.1 * (static_cast<double>(random()) / 4294967296.0 - 0.5);
  const auto energy = [&] {
    double sum = 0.0;
    for (const Bond& bond : body.bonds) {
      const double stretch =
          (scene.group<Beads>().positions()[bond.i] - scene.group<Beads>().positions()[bond.j]).norm() - bond.rest_length;
      sum += 0.5 * stretch * stretch;
    }
    return sum;
  };
  double before = energy();
  CHECK(before > 0.1);
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-6, 1e-9}) {
    relax(scene, {.force_tolerance = tolerance});
    CHECK(energy() < before);
    before = energy();
  }
  CHECK(before < 1e-15);
}

TEST_CASE("relax: Kelvin-Voigt bonds come to the rest of their springs") {
  auto pair = [](const auto& law) {
    auto result = scene<Leapfrog>(Box<1>::unbounded(), group<Beads>("beads", Mobile{}, row(3), mass), bonds<Beads, Beads>(law, chain(3)));
    result.template group<Beads>().positions()[0][0] = -0.05;
    return result;
  };
  auto damped = pair(bond::KelvinVoigt{.stiffness = k, .damping = 5.0});
  relax(damped, {.force_tolerance = 1e-10});
  auto elastic = pair(Harmonic{.stiffness = k});
  relax(elastic, {.force_tolerance = 1e-10});
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(damped.group<Beads>().positions()[i][0] == doctest::Approx(elastic.group<Beads>().positions()[i][0]).epsilon(1e-9));
}

TEST_CASE("relax without_rotation: a leaning brick between two planes is squeezed where it stands, and does not fall over") {
  const auto brick = [](auto dimension, auto lattice, const auto& cells, double angle) {
    constexpr int dim = decltype(dimension)::value;
    lattice.orientation.template topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    auto body = lattice_spring::lattice_block(lattice, cells);
    double lowest = 1e9, highest = -1e9;
    for (const auto& x : body.points.positions) lowest = std::fmin(lowest, x[1]), highest = std::fmax(highest, x[1]);
    Components<dim, double> up{}, down{};
    up[1] = 1.0, down[1] = -1.0;
    return simulation::scene<Leapfrog>(Box<dim>::unbounded(), group<Beads>("beads", Mobile{}, body.points, 1.0),
                                       bonds<Beads, Beads>(Harmonic{.stiffness = 1.0}, body.bonds),
                                       forced_by<Beads>(Plane<dim>{.normal = up, .position = lowest + 0.05, .strength = 10.0},
                                                        Plane<dim>{.normal = down, .position = -highest + 0.05, .strength = 10.0}));
  };
  const auto check = [](auto scene, bool without_rotation) {
    const auto& x = scene.template group<Beads>().positions();
    const std::vector start(x.begin(), x.end());
    relax(scene, {.force_tolerance = 1e-9, .without_rotation = without_rotation});
    double turned = 0.0, arms = 0.0;
    auto centre = start[0], before = start[0];
    centre.setZero(), before.setZero();
    for (std::size_t i = 0; i < start.size(); ++i)
      centre += x[i] / static_cast<double>(start.size()), before += start[i] / static_cast<double>(start.size());
    for (std::size_t i = 0; i < start.size(); ++i) {
      const auto a = (start[i] - before).eval(), b = (x[i] - centre).eval();
      turned += a[0] * b[1] - a[1] * b[0];
      arms += a[0] * a[0] + a[1] * a[1];
    }
    return std::fabs(turned / arms);
  };
  using Two = std::integral_constant<int, 2>;
  using Three = std::integral_constant<int, 3>;
  const auto flat = [&] { return brick(Two{}, lattice_spring::SquareLattice{.spacing = 1.0}, std::array{8, 8}, 0.3); };
  const auto solid = [&] { return brick(Three{}, lattice_spring::CubicLattice{.spacing = 1.0}, std::array{6, 6, 3}, 0.3); };
  CHECK(check(flat(), false) > 1e-2);
  CHECK(check(flat(), true) < 2e-3);
  CHECK(check(solid(), false) > 1e-2);
  CHECK(check(solid(), true) < 2e-3);
}

TEST_CASE("relax says what is wrong: no convergence, nothing that holds, a tolerance of nothing") {
  auto hanging = scene<Leapfrog>(Box<1>::unbounded(), group<Beads>("beads", Mobile{}, row(20), mass),
                                 bonds<Beads, Beads>(Harmonic{.stiffness = k}, chain(20)),
                                 forced_by<Beads>(Plane<1>{.normal = {{1.0}}, .position = 0.5, .strength = 1.0},
                                                  Plane<1>{.normal = {{-1.0}}, .position = -0.6, .strength = 1.0}));
  CHECK_THROWS_WITH_AS(relax(hanging, {.force_tolerance = 1e-12, .most_evaluations = 10}),
                       doctest::Contains("relax: not at rest after 10 evaluations"), SimulationError);
  CHECK_THROWS_WITH_AS(relax(hanging, {.force_tolerance = 0.0}), "relax: force_tolerance must be finite and > 0 N, got 0", ParameterError);
  auto falling = scene<Leapfrog>(Box<1>::unbounded(), group<Beads>("beads", Mobile{}, row(2), mass),
                                 forced_by<Beads>(forcing::Constant<1>{.uniform_acceleration = {{1.0}}}));
  CHECK_THROWS_WITH_AS(relax(falling, {.force_tolerance = 1e-9}),
                       "relax: no law of this scene bounds the time step, so nothing comes to rest", ParameterError);
}
