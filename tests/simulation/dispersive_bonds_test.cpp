// Springs with dispersion in scenes: forces, conservation, threads, groups, breaking, restart. Elasticity: dispersive_solids_test.cpp.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>
#include <doctest/doctest.h>

#include "io/temporary_folder.hpp"
#include "support/dispersion.hpp"
#include "support/random.hpp"
#include "support/threads.hpp"

using namespace dmp;
using namespace dmp::simulation;
using bond::Breaking, bond::Dispersive, bond::Harmonic, bond::LargestStrain;
using geometry::Box;
using integrator::Leapfrog;
using lattice_spring::Body;
using neighbours::Bond;
using particles::Driven, particles::Frozen, particles::Mobile;

namespace {

struct Beads {};
struct Others {};
struct Held {};
struct Moved {};

constexpr double k = 3.0, mass = 0.7;

/// A random net in the unit cube with random weights, bent and stretched by some per cent.
template <int Dim>
struct Net {
  Box<Dim> box = Box<Dim>::unbounded();
  Body<Dim> body;

  explicit Net(bool periodic, double least_distance) {
    if (periodic) {
      box.periodic.fill(true);
      box.lower.setZero();
      box.upper.setOnes();
    }
    body = lattice_spring::network(
        lattice_spring::random_points<Dim>({.least_distance = least_distance, .most_failures = 3000},
                                           geometry::Cuboid<Dim>{.lower = Vector<Dim>::Zero(), .upper = Vector<Dim>::Ones()}),
        1.9 * least_distance);
    auto& x = body.points.positions;
    if (periodic)  // bonds through the faces
      for (std::uint32_t i = 0; i < x.size(); ++i)
        for (std::uint32_t j = i + 1; j < x.size(); ++j) {
          const Vector<Dim> apart = x[i] - x[j], nearest = neighbours::minimum_image<Dim>(apart, box);
          if (nearest != apart && nearest.norm() < 1.9 * least_distance) body.bonds.push_back({i, j});
        }
    lattice_spring::measure_rest_lengths<Dim>(body.bonds, x, box);
    test::RandomVectors random;
    for (Bond& bond : body.bonds) bond.weight = 0.6 + random.vector(0.5)[0];
    for (auto& one : x) one += random.vector(0.05 * least_distance).template head<Dim>();
  }
};

template <int Dim>
auto scene_of(const Net<Dim>& net, double share) {
  return scene<Leapfrog>(net.box, group<Beads>("beads", Mobile{}, net.body.points, mass),
                         bonds<Beads, Beads>(Dispersive{.stiffness = k, .dispersive_share = share}, net.body.bonds));
}
/// Forces [N] on the beads of a group.
template <class Tag, class Scene>
auto forces_on(Scene& scene) {
  (void)scene.step_limit();  // evaluates
  std::vector<Vector<Scene::dimension>> result;
  for (const auto& a : scene.template group<Tag>().template get<field::Acceleration>())
    result.push_back(scene.template group<Tag>().mass * a);
  return result;
}
template <int Dim>
double largest(const std::vector<Vector<Dim>>& vectors) {
  double result = 0.0;
  for (const auto& v : vectors) result = std::fmax(result, v.norm());
  return result;
}
template <int Dim>
double difference(const std::vector<Vector<Dim>>& a, const std::vector<Vector<Dim>>& b) {
  double result = 0.0;
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) result = std::fmax(result, (a[i] - b[i]).norm());
  return result;
}
/// Forces of bonds with these tensions.
template <int Dim>
std::vector<Vector<Dim>> forces_of(const Body<Dim>& body, const std::vector<double>& tension) {
  const auto& x = body.points.positions;
  std::vector<Vector<Dim>> result(x.size(), Vector<Dim>::Zero());
  for (std::size_t b = 0; b < tension.size(); ++b) {
    const Vector<Dim> pull = tension[b] * (x[body.bonds[b].j] - x[body.bonds[b].i]).normalized();
    result[body.bonds[b].i] += pull;
    result[body.bonds[b].j] -= pull;
  }
  return result;
}

template <int Dim>
void check_forces(bool periodic, double least_distance) {
  const Net<Dim> net(periodic, least_distance);
  CAPTURE(Dim);
  CAPTURE(periodic);
  CHECK(net.body.bonds.size() > 2 * net.body.points.positions.size());
  for (const double share : {-0.5, -0.3, 0.0, 0.4, 0.96}) {
    CAPTURE(share);
    auto scene = scene_of(net, share);
    const auto force = forces_on<Beads>(scene);
    auto x = net.body.points.positions;
    double worst = 0.0;
    constexpr double step = 0x1p-21;
    for (std::size_t i = 0; i < x.size(); i += 1 + x.size() / 40)
      for (int d = 0; d < Dim; ++d) {
        const double there = x[i][d];
        const auto energy_at = [&](double offset) {
          x[i][d] = there + offset;
          return test::dispersive_energy<Dim>(k, share, net.body.bonds, x, net.box);
        };
        const long double numerical = (energy_at(-step) - energy_at(step)) / (2.0L * static_cast<long double>(step));
        x[i][d] = there;
        worst = std::fmax(worst, std::fabs(force[i][d] - static_cast<double>(numerical)));
      }
    CHECK(worst <= 1e-8 * largest(force));
    Vector<Dim> sum = Vector<Dim>::Zero();
    double torque = 0.0, scale = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      sum += force[i];
      torque += x[i][0] * force[i][1] - x[i][1] * force[i][0];
      scale += force[i].norm();
    }
    CHECK(sum.norm() <= 1e-15 * scale);
    if (!periodic) CHECK(std::fabs(torque) <= 1e-15 * scale);
    const auto tensions =
        lattice_spring::tensions<Dim>(Dispersive{.stiffness = k, .dispersive_share = share}, net.body.bonds, x, {}, net.box);
    double energy = 0.0;  // that of bonds, asked of the law: half of tension times elongation
    for (std::size_t b = 0; b < tensions.size(); ++b) {
      const Bond& bond = net.body.bonds[b];
      energy += 0.5 * tensions[b] * (neighbours::minimum_image<Dim>(x[bond.i] - x[bond.j], net.box).norm() - bond.rest_length);
    }
    CHECK(energy ==
          doctest::Approx(static_cast<double>(test::dispersive_energy<Dim>(k, share, net.body.bonds, x, net.box))).epsilon(1e-12));
  }
}

}  // namespace

TEST_CASE("dispersive bonds: forces are the negative gradient of the energy, and keep momentum and angular momentum, in random nets") {
  check_forces<2>(false, 0.07);
  check_forces<2>(true, 0.07);
  check_forces<3>(false, 0.16);
  check_forces<3>(true, 0.16);
}

TEST_CASE("dispersive bonds with D = 0 move as harmonic bonds do, bit for bit") {
  const Net<3> net(false, 0.16);
  auto dispersive = scene_of(net, 0.0);
  auto harmonic = scene<Leapfrog>(net.box, group<Beads>("beads", Mobile{}, net.body.points, mass),
                                  bonds<Beads, Beads>(Harmonic{.stiffness = k}, net.body.bonds));
  CHECK(dispersive.step_limit().time_step == harmonic.step_limit().time_step);
  dispersive.run({.until = 20.0});
  harmonic.run({.until = 20.0});
  CHECK(dispersive.step() == harmonic.step());
  CHECK(dispersive.group<Beads>().positions() == harmonic.group<Beads>().positions());
  CHECK((dispersive.group<Beads>().positions()[7] - net.body.points.positions[7]).norm() > 1e-3);
}

namespace {

/// A block of lattice large enough for four blocks of rows, stretched and disturbed, with some bonds listed from either end.
Body<3> large_block() {
  auto body =
      lattice_spring::lattice_block(lattice_spring::CubicLattice{.spacing = 1.0}, {25, 25, 25}, lattice_spring::SurfaceBonds::shared);
  lattice_spring::measure_rest_lengths<3>(body.bonds, body.points.positions);
  test::RandomVectors random;
  for (auto& x : body.points.positions) x = 1.02 * x + random.vector(0.05);
  for (std::size_t b = 0; b < body.bonds.size(); b += 3) std::swap(body.bonds[b].i, body.bonds[b].j);
  return body;
}

}  // namespace

TEST_CASE("dispersive bonds across blocks of rows: the forces of a plain loop, and the same bits for 1 to 4 threads") {
  const auto body = large_block();
  const Dispersive law{.stiffness = k, .dispersive_share = 0.7};
  const auto expected = forces_of<3>(body, lattice_spring::tensions<3>(law, body.bonds, body.points.positions));
  std::vector<Vector<3>> first;
  for (const int count : {1, 2, 3, 4}) {
    const test::Threads threads(count);
    auto scene = simulation::scene<Leapfrog>(Box<3>::unbounded(), group<Beads>("beads", Mobile{}, body.points, mass),
                                             bonds<Beads, Beads>(law, body.bonds));
    CHECK(scene.group<Beads>().blocks.size() > 2);
    CHECK(difference<3>(forces_on<Beads>(scene), expected) <= 1e-14 * largest<3>(expected));
    scene.run({.until = 1.0});
    const auto& x = scene.group<Beads>().positions();
    if (first.empty()) first.assign(x.begin(), x.end());
    CHECK(std::equal(first.begin(), first.end(), x.begin()));
  }
}

TEST_CASE("dispersive bonds of a body in four groups, mobile, frozen and driven: the forces of the body in one") {
  auto body = large_block();
  const Dispersive law{.stiffness = k, .dispersive_share = 0.7};
  const particles::Clamp<3> still{.direction = {{1.0, 0.0, 0.0}}};
  const auto expected = forces_of<3>(body, lattice_spring::tensions<3>(law, body.bonds, body.points.positions));
  const test::Divided<3, 4> parts(body, [](const Vector<3>& x) -> std::size_t {
    return x[0] < 2.5 ? 2 : x[0] > 22.5 ? 3 : x[1] < 12.0 ? 0 : 1;
  });
  const auto& list = parts.bonds;
  std::vector<Vector<3>> first;
  for (const int count : {1, 3}) {
    const test::Threads threads(count);
    auto scene = simulation::scene<Leapfrog>(
        Box<3>::unbounded(), group<Beads>("beads", Mobile{}, parts.points[0], mass),
        group<Others>("others", Mobile{}, parts.points[1], 2.0 * mass), group<Held>("held", Frozen<3>{}, parts.points[2], mass),
        group<Moved>("moved", Driven{still}, parts.points[3], mass), bonds<Beads, Beads>(law, list[0][0]),
        bonds<Beads, Others>(law, list[0][1]), bonds<Beads, Held>(law, list[0][2]), bonds<Beads, Moved>(law, list[0][3]),
        bonds<Others, Others>(law, list[1][1]), bonds<Others, Held>(law, list[1][2]), bonds<Others, Moved>(law, list[1][3]),
        bonds<Held, Held>(law, list[2][2]), bonds<Moved, Moved>(law, list[3][3]));
    const auto beads = forces_on<Beads>(scene), others = forces_on<Others>(scene);
    double worst = 0.0;
    Vector<3> load_of_held = Vector<3>::Zero(), load_of_moved = load_of_held;  // of all bonds that end there: those within cancel
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (parts.part[i] == 0) worst = std::fmax(worst, (expected[i] - beads[parts.row[i]]).norm());
      if (parts.part[i] == 1) worst = std::fmax(worst, (expected[i] - others[parts.row[i]]).norm());
      if (parts.part[i] == 2) load_of_held += expected[i];
      if (parts.part[i] == 3) load_of_moved += expected[i];
    }
    CHECK(worst <= 1e-14 * largest<3>(expected));
    CHECK((bond_load<Held>(scene) - load_of_held).norm() <= 1e-12 * load_of_held.norm());
    CHECK((bond_load<Moved>(scene) - load_of_moved).norm() <= 1e-12 * load_of_moved.norm());
    scene.run({.until = 2.0});
    const auto& x = scene.group<Others>().positions();
    if (first.empty()) first.assign(x.begin(), x.end());
    CHECK(std::equal(first.begin(), first.end(), x.begin()));
  }
}

TEST_CASE("dispersive bonds: who looks on changes nothing, and a run goes on from a checkpoint bit for bit; the strain is a column") {
  const Net<3> net(true, 0.16);
  const test::TemporaryFolder folder;
  const std::string path = (folder / "saved.checkpoint").string();
  auto through = scene_of(net, 0.8), watched = scene_of(net, 0.8), second = scene_of(net, 0.8);
  int looks = 0;
  watched.every(0.01, [&looks](auto& scene) {
    ++looks;
    (void)scene.step_limit();
  });
  through.run({.until = 5.0, .time_step = 0.01});
  watched.run({.until = 5.0, .time_step = 0.01});
  CHECK(looks == 501);
  CHECK(through.group<Beads>().positions() == watched.group<Beads>().positions());
  through.checkpoint(path);
  second.restart(path);
  CHECK(second.group<Beads>().get<field::BondStrain>() == through.group<Beads>().get<field::BondStrain>());
  for (auto* scene : {&through, &second}) scene->run({.until = 10.0, .time_step = 0.01});
  CHECK(through.group<Beads>().positions() == second.group<Beads>().positions());
  double strain = 0.0;
  for (const double one : through.group<Beads>().get<field::BondStrain>()) strain = std::fmax(strain, std::fabs(one));
  CHECK(strain > 1e-4);
  CHECK(strain < 0.1);
}

TEST_CASE("dispersive bonds that break: from that evaluation on, strains and forces are those of a net without them") {
  const Net<3> net(false, 0.16);
  const Dispersive law{.stiffness = k, .dispersive_share = 0.6};
  const LargestStrain criterion{.strain = 0.03};
  std::vector<Bond> whole;
  for (const Bond& bond : net.body.bonds)
    if ((net.body.points.positions[bond.i] - net.body.points.positions[bond.j]).norm() <= 1.03 * bond.rest_length) whole.push_back(bond);
  CHECK(whole.size() < 0.9 * static_cast<double>(net.body.bonds.size()));
  CHECK(whole.size() > 0.5 * static_cast<double>(net.body.bonds.size()));
  const auto make = [&](const auto& bond_law, const std::vector<Bond>& list) {
    return scene<Leapfrog>(net.box, group<Beads>("beads", Mobile{}, net.body.points, mass), bonds<Beads, Beads>(bond_law, list));
  };
  auto breaking = make(Breaking{law, criterion}, net.body.bonds);
  auto rest = make(Breaking{law, criterion}, whole);
  const auto forces = forces_on<Beads>(breaking), expected = forces_on<Beads>(rest);
  CHECK((broken_bonds<Beads, Beads>(breaking).size()) == net.body.bonds.size() - whole.size());
  CHECK((broken_bonds<Beads, Beads>(rest).size()) == 0);
  CHECK(difference<3>(forces, expected) <= 1e-14 * largest<3>(expected));
  breaking.run({.until = 5.0, .time_step = 0.01});
  rest.run({.until = 5.0, .time_step = 0.01});
  CHECK((broken_bonds<Beads, Beads>(rest).size()) > 5);
  CHECK((broken_bonds<Beads, Beads>(breaking).size()) == (broken_bonds<Beads, Beads>(rest).size()) + net.body.bonds.size() - whole.size());
  std::vector<Vector<3>> a, b;
  for (const auto& x : breaking.group<Beads>().positions()) a.push_back(x);
  for (const auto& x : rest.group<Beads>().positions()) b.push_back(x);
  CHECK(difference<3>(a, b) <= 1e-11);
}

TEST_CASE("dispersive bonds all of which break leave beads that fly on alone") {
  const Net<3> net(false, 0.16);
  auto scene = simulation::scene<Leapfrog>(
      net.box, group<Beads>("beads", Mobile{}, net.body.points, mass),
      bonds<Beads, Beads>(Breaking{Dispersive{.stiffness = k, .dispersive_share = 0.6}, LargestStrain{.strain = 0.0}}, net.body.bonds));
  for (auto& x : scene.group<Beads>().positions()) x *= 1.2;
  CHECK(largest<3>(forces_on<Beads>(scene)) == 0.0);
  for (const double strain : scene.group<Beads>().get<field::BondStrain>()) CHECK(strain == 0.0);
}

TEST_CASE("dispersive shares that differ at one group, or are none, are refused") {
  const geometry::Points<3> points{.positions = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}};
  const auto message = [&](double first, double second) -> std::string {
    try {
      (void)scene<Leapfrog>(Box<3>::unbounded(), group<Beads>("beads", Mobile{}, points, mass),
                            group<Others>("others", Mobile{}, points, mass),
                            bonds<Beads, Beads>(Dispersive{.stiffness = k, .dispersive_share = first}, {{0, 1}}),
                            bonds<Beads, Beads>(Harmonic{.stiffness = k}, {{0, 2}}),
                            bonds<Beads, Others>(Dispersive{.stiffness = 2.0 * k, .dispersive_share = second}, {{1, 2}}));
    } catch (const ParameterError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(message(0.2, 0.2) == "");
  CHECK(message(0.2, 0.3).find("bonds of beads: dispersive_share must be the same of all bonds of a group that have one, 0.2, got 0.3") !=
        std::string::npos);
  CHECK(message(0.2, 1.0).find("bond::Dispersive: dispersive_share must be >= -0.5 and < 1, got 1") != std::string::npos);
}
