// Bonds of three laws within and across groups, some of which break, with pairs that they leave out, weight and a moving contact plane, all
// in one scene: every step against plain loops that share no formula with the library; and the same bits for any number of threads and
// after a restart.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/bond.hpp>
#include <dmp/forcing.hpp>
#include <dmp/integrator.hpp>
#include <dmp/potential.hpp>
#include <dmp/simulation.hpp>

#include "io/temporary_folder.hpp"
#include "support/random.hpp"
#include "support/threads.hpp"

using namespace dmp;
using namespace dmp::simulation;
using bond::Breaking, bond::Dispersive, bond::KelvinVoigt, bond::LargestStrain, bond::Maxwell;
using integrator::Leapfrog;
using neighbours::Bond;
using particles::Frozen, particles::Mobile;
using potential::LennardJones;

namespace {

struct Soft {};   // a net that breaks, and forgets its length along one diagonal; a plate comes from below
struct Stiff {};  // rows with dashpots on top of it
struct Held {};   // what those hang on

constexpr std::uint32_t columns = 64, soft_rows = 256, stiff_rows = 16;  // four blocks of soft beads, for four threads
constexpr double width = columns, dt = 0.02, gravity = 0.5, share = 0.3;
constexpr double soft_mass = 1.0, stiff_mass = 1.5;
constexpr double well = 0.05, diameter = 0.9, soft_cutoff = 1.5, stiff_cutoff = 1.3;  // of Lennard-Jones
constexpr double plate_start = 0.43, plate_speed = 0.3;
constexpr int steps = 20;

enum Law { dispersive, maxwell, kelvin_voigt };
struct Item {
  Law law;
  double stiffness, damping = 0.0, largest_strain = std::numeric_limits<double>::infinity();
  std::size_t a = 0, b = 0;  // its groups: 0 soft, 1 stiff, 2 held
};
constexpr std::array<Item, 5> items{{{dispersive, 50.0, 0.0, 0.06, 0, 0},
                                     {maxwell, 20.0, 10.0, 0.07, 0, 0},
                                     {dispersive, 40.0, 0.0, std::numeric_limits<double>::infinity(), 0, 1},
                                     {dispersive, 30.0, 0.0, 0.05, 1, 2},
                                     {kelvin_voigt, 25.0, 2.0, std::numeric_limits<double>::infinity(), 1, 1}}};

/// Places and velocities of the groups, and the bonds of the items.
struct Body {
  std::array<std::vector<Vector<2>>, 3> places, velocities;
  std::array<std::vector<Bond>, items.size()> bonds;

  Body() {
    test::RandomVectors random;
    const auto fill = [&](std::size_t group, std::uint32_t rows, double bottom, double shake) {
      for (std::uint32_t y = 0; y < rows; ++y)
        for (std::uint32_t x = 0; x < columns; ++x) {
          places[group].push_back(Vector<2>(x + 0.5, bottom + y) + random.vector(shake).head<2>());
          velocities[group].push_back(random.vector(group == 2 ? 0.0 : 0.4).head<2>());
        }
    };
    fill(0, soft_rows, 0.5, 0.05);
    fill(1, stiff_rows, soft_rows + 0.5, 0.05);
    fill(2, 1, soft_rows + stiff_rows + 0.5, 0.0);
    const auto row = [](std::uint32_t x, std::uint32_t y) { return x % columns + columns * y; };
    for (std::uint32_t y = 0; y < soft_rows; ++y)
      for (std::uint32_t x = 0; x < columns; ++x) {
        bonds[0].push_back({row(x, y), row(x + 1, y), -1.0, 1.0 + 0.1 * (x % 3)});
        if (y + 1 == soft_rows) continue;
        bonds[0].push_back({row(x, y + 1), row(x, y)});
        bonds[0].push_back({row(x, y), row(x + 1, y + 1), 1.41});
        bonds[1].push_back({row(x + 1, y), row(x, y + 1), -1.0, 1.0 + 0.2 * (y % 2)});
      }
    for (std::uint32_t x = 0; x < columns; ++x) {
      bonds[2].push_back({row(x, soft_rows - 1), row(x, 0)});
      bonds[3].push_back({row(x, stiff_rows - 1), x, 0.99});
      for (std::uint32_t y = 0; y < stiff_rows; ++y) bonds[4].push_back({row(x, y), row(x + 1, y)});
    }
  }
};

const forcing::ContactPlane<2> plate{.normal = {{0.0, 1.0}}, .position = plate_start, .motion = {.speed = plate_speed}};

auto scene_of(const Body& body) {
  const auto points = [&](std::size_t group) { return geometry::Points<2>{.positions = body.places[group]}; };
  const auto breaking = [](const auto& law, const Item& item) { return Breaking{law, LargestStrain{.strain = item.largest_strain}}; };
  const auto dispersive_law = [](const Item& item) { return Dispersive{.stiffness = item.stiffness, .dispersive_share = share}; };
  const auto pairs = [](double cutoff) { return LennardJones{.energy_scale = well, .diameter = diameter, .cutoff = cutoff}; };
  const double infinity = std::numeric_limits<double>::infinity();
  auto result = scene<Leapfrog>(
      geometry::Box<2>{.lower = {0.0, -infinity}, .upper = {width, infinity}, .periodic = {true, false}},
      group<Soft>("soft", Mobile{}, points(0), soft_mass), group<Stiff>("stiff", Mobile{}, points(1), stiff_mass),
      group<Held>("held", Frozen<2>{}, points(2), 1.0),
      bonds<Soft, Soft>(breaking(dispersive_law(items[0]), items[0]), body.bonds[0]),
      bonds<Soft, Soft>(breaking(Maxwell{.stiffness = items[1].stiffness, .damping = items[1].damping}, items[1]), body.bonds[1]),
      bonds<Soft, Stiff>(dispersive_law(items[2]), body.bonds[2]),
      bonds<Stiff, Held>(breaking(dispersive_law(items[3]), items[3]), body.bonds[3]),
      bonds<Stiff, Stiff>(KelvinVoigt{.stiffness = items[4].stiffness, .damping = items[4].damping}, body.bonds[4]),
      interaction<Soft, Soft>(pairs(soft_cutoff)).excluding_bonded(1), interaction<Soft, Stiff>(pairs(soft_cutoff)).excluding_bonded(1),
      interaction<Stiff, Stiff>(pairs(stiff_cutoff)), interaction<Stiff, Held>(pairs(stiff_cutoff)).excluding_bonded(1),
      forced_by<Soft, Stiff>(forcing::Constant<2>{.uniform_acceleration = {{0.0, -gravity}}}), confined_by<Soft>(plate));
  std::copy(body.velocities[0].begin(), body.velocities[0].end(), result.template group<Soft>().template get<field::Velocity>().begin());
  std::copy(body.velocities[1].begin(), body.velocities[1].end(), result.template group<Stiff>().template get<field::Velocity>().begin());
  return result;
}

/// The same scene, one bead, one bond and one pair after the other: kick, drift, kick.
class Plain {
 public:
  struct Bead {
    std::size_t group;
    Vector<2> place, velocity, acceleration = Vector<2>::Zero();
    double theta = 0.0, sum = 0.0;        // of the dispersive bonds: sum of k r0 (r - r0) and of k r0^2
    std::vector<std::size_t> bonded = {};  // to these
  };
  std::array<std::size_t, 4> first{};  ///< of the beads, for each group
  std::vector<Bead> beads;
  std::array<std::size_t, items.size()> broken{};  ///< bonds of each item
  double load = 0.0;                               ///< upward force of the plate
  int touching = 0;                                ///< beads that bear it

  explicit Plain(const Body& body) {
    for (std::size_t g = 0; g < 3; ++g) {
      first[g] = beads.size();
      for (std::size_t i = 0; i < body.places[g].size(); ++i) beads.push_back({g, body.places[g][i], body.velocities[g][i]});
    }
    first[3] = beads.size();
    for (std::size_t n = 0; n < items.size(); ++n)
      for (const Bond& one : body.bonds[n]) {
        const std::size_t i = first[items[n].a] + one.i, j = first[items[n].b] + one.j;
        const double length = apart(i, j).norm();
        links_.push_back({n, i, j, one.rest_length < 0.0 ? length : one.rest_length, one.weight, length});
        beads[i].bonded.push_back(j);
        beads[j].bonded.push_back(i);
      }
    find_accelerations(0.0);
  }
  void step() {
    load = 0.0;
    ++step_;
    for (Bead& bead : beads) {
      if (bead.group == 2) continue;
      bead.velocity += 0.5 * dt * bead.acceleration;
      bead.place += dt * bead.velocity;
      const double behind = plate_start + plate_speed * step_ * dt - bead.place[1];
      if (bead.group != 0 || behind <= 0.0) continue;  // of the first step alone
      bead.place[1] += behind;
      bead.velocity[1] += behind / dt;
      load += soft_mass * behind / (dt * dt);
    }
    find_accelerations(dt);
    for (Bead& bead : beads)
      if (bead.group != 2) bead.velocity += 0.5 * dt * bead.acceleration;
  }
  /// Vector from the second of two places to the first, by the shortest way.
  [[nodiscard]] static Vector<2> nearest(Vector<2> apart) {
    if (std::fabs(apart[0]) > 0.5 * width) apart[0] -= std::copysign(width, apart[0]);
    return apart;
  }

 private:
  struct Link {
    std::size_t item, i, j;
    double rest, weight, length, force = 0.0;  // force: of the branch of a Maxwell bond
    bool whole = true;
  };

  [[nodiscard]] Vector<2> apart(std::size_t i, std::size_t j) const { return nearest(beads[i].place - beads[j].place); }
  void push(std::size_t i, std::size_t j, const Vector<2>& force) {
    constexpr std::array<double, 3> mass{soft_mass, stiff_mass, std::numeric_limits<double>::infinity()};
    beads[i].acceleration += force / mass[beads[i].group];
    beads[j].acceleration -= force / mass[beads[j].group];
  }

  void find_accelerations(double since_last) {
    for (Bead& bead : beads) {
      bead.acceleration = Vector<2>(0.0, bead.group == 2 ? 0.0 : -gravity);
      bead.theta = bead.sum = 0.0;
    }
    std::vector<Link*> newly_broken;
    for (Link& link : links_) {
      if (!link.whole) continue;
      const Item& item = items[link.item];
      const double length = apart(link.i, link.j).norm(), change = length - link.length;
      link.length = length;
      if ((length - link.rest) / link.rest > item.largest_strain) {
        link.whole = false;
        ++broken[link.item];
        newly_broken.push_back(&link);
      } else if (item.law == dispersive) {
        const double k = link.weight * item.stiffness;
        for (const std::size_t end : {link.i, link.j}) {
          beads[end].theta += k * link.rest * (length - link.rest);
          beads[end].sum += k * link.rest * link.rest;
        }
      } else if (item.law == maxwell && since_last > 0.0) {
        const double h = since_last * item.stiffness / item.damping, decay = std::exp(-h);
        link.force = decay * link.force + item.stiffness * change * (1.0 - decay) / h;
      }
    }
    for (const Link& link : links_) {
      if (!link.whole) continue;
      const Item& item = items[link.item];
      const Vector<2> along = apart(link.i, link.j) / link.length;
      const auto strain = [this](std::size_t end) { return beads[end].sum > 0.0 ? beads[end].theta / beads[end].sum : 0.0; };
      double tension = 0.0;
      switch (item.law) {
        case dispersive:
          tension = item.stiffness *
                    ((1.0 - share) * (link.length - link.rest) + share / 2.0 * link.rest * (strain(link.i) + strain(link.j)));
          break;
        case maxwell: tension = link.force; break;
        case kelvin_voigt:
          tension = item.stiffness * (link.length - link.rest) +
                    item.damping * along.dot(beads[link.i].velocity - beads[link.j].velocity);
      }
      push(link.i, link.j, -link.weight * tension * along);
    }
    add_pairs();
    for (const Link* link : newly_broken) {  // a pair from the next evaluation on
      std::erase(beads[link->i].bonded, link->j);
      std::erase(beads[link->j].bonded, link->i);
    }
    touching = 0;
    if (since_last > 0.0) add_contact();
  }
  void add_pairs() {
    std::vector<std::size_t> upwards(beads.size());
    std::iota(upwards.begin(), upwards.end(), 0);
    std::sort(upwards.begin(), upwards.end(), [this](std::size_t i, std::size_t j) { return beads[i].place[1] < beads[j].place[1]; });
    for (std::size_t n = 0; n < upwards.size(); ++n)
      for (std::size_t m = n + 1; m < upwards.size(); ++m) {
        const std::size_t i = upwards[n], j = upwards[m], a = beads[i].group, b = beads[j].group;
        if (beads[j].place[1] - beads[i].place[1] > soft_cutoff) break;
        if (a + b == 4 || (a != b && a + b == 2)) continue;  // held beads, and soft ones with them: no interaction
        const Vector<2> separation = apart(i, j);
        const double r = separation.norm();
        if (r >= (a == 0 || b == 0 ? soft_cutoff : stiff_cutoff)) continue;
        const bool are_left_out = std::find(beads[i].bonded.begin(), beads[i].bonded.end(), j) != beads[i].bonded.end();
        if (are_left_out && !(a == 1 && b == 1)) continue;
        const double minus_slope = 4.0 * well * (12.0 * std::pow(diameter / r, 12) - 6.0 * std::pow(diameter / r, 6)) / r;
        push(i, j, minus_slope / r * separation);
      }
  }
  /// What keeps soft beads from being behind the plate at the end of the next step.
  void add_contact() {
    for (Bead& bead : beads) {
      if (bead.group != 0) continue;
      const double next = bead.place[1] + dt * (bead.velocity[1] + dt * bead.acceleration[1]);
      const double behind = plate_start + plate_speed * (step_ + 1) * dt - next;
      if (behind <= 0.0) continue;
      bead.acceleration[1] += behind / (dt * dt);
      load += soft_mass * behind / (dt * dt);
      ++touching;
    }
  }

  std::vector<Link> links_;
  int step_ = 0;
};

struct Differences {
  double acceleration = 0.0, velocity = 0.0, place = 0.0;
};
template <class Tag, class Scene>
void compare(const Scene& scene, const Plain& plain, std::size_t group, Differences& largest) {
  const auto& g = scene.template group<Tag>();
  REQUIRE(g.size() == plain.first[group + 1] - plain.first[group]);
  for (std::size_t i = 0; i < g.size(); ++i) {
    const auto& bead = plain.beads[plain.first[group] + g.id[i]];
    const auto include = [](double& worst, const Vector<2>& difference) { worst = std::fmax(worst, difference.norm()); };
    include(largest.acceleration, g.template get<field::Acceleration>()[i] - bead.acceleration);
    include(largest.velocity, g.template get<field::Velocity>()[i] - bead.velocity);
    include(largest.place, Plain::nearest(g.positions()[i] - bead.place));
  }
}

}  // namespace

TEST_CASE("bonds with dispersion, memory and dashpots, breaking, pairs, weight and contact: each step is that of plain loops") {
  const Body body;
  const test::Threads threads(4);
  auto whole = scene_of(body);
  CHECK(whole.group<Soft>().blocks.size() == 4);
  Plain plain(body);
  Differences largest;
  double largest_load = 0.0, load_error = 0.0;
  int most_touching = 0;
  whole.every(dt, [&](const auto& now) {
    if (now.step() > 0) plain.step();
    compare<Soft>(now, plain, 0, largest);
    compare<Stiff>(now, plain, 1, largest);
    largest_load = std::fmax(largest_load, plain.load);
    load_error = std::fmax(load_error, std::fabs(load_on<Soft>(now, plate).force[1] - plain.load));
    most_touching = std::max(most_touching, plain.touching);
  });
  whole.run({.until = steps * dt, .time_step = dt});
  CHECK(whole.step() == steps);
  CHECK(largest.acceleration < 1e-10);  // rounding of places up to 270 m, times k/m, or over dt^2 at the plate
  CHECK(largest.velocity < 1e-11);
  CHECK(largest.place < 1e-12);
  CHECK(load_error < 1e-12 * largest_load);
  CHECK(most_touching > static_cast<int>(columns) / 2);
  for (const std::size_t n : {0u, 1u, 3u}) CHECK(plain.broken[n] > 10);
  CHECK(broken_bonds<Soft, Soft>(whole).size() == plain.broken[0] + plain.broken[1]);
  CHECK(broken_bonds<Stiff, Held>(whole).size() == plain.broken[3]);
}

TEST_CASE("all of that to the same bits for 1, 2 and 4 threads, and after a restart in the middle") {
  const Body body;
  const test::TemporaryFolder folder;
  const std::string path = (folder / "middle.checkpoint").string(), end = (folder / "end.checkpoint").string();
  const auto finish = [&](auto& one) {  // everything that a scene knows
    one.run({.until = steps * dt, .time_step = dt});
    one.checkpoint(end);
    return test::read_bytes(end);
  };
  std::string middle, all;
  for (const int count : {1, 2, 4}) {
    CAPTURE(count);
    const test::Threads threads(count);
    auto whole = scene_of(body);
    whole.run({.until = 0.5 * steps * dt, .time_step = dt});
    whole.checkpoint(path);
    const auto gone = broken_bonds<Soft, Soft>(whole).size();
    const std::string at_middle = test::read_bytes(path), at_end = finish(whole);
    if (count == 1) {
      middle = at_middle;
      all = at_end;
      CHECK(gone > 100);
      CHECK(broken_bonds<Soft, Soft>(whole).size() > gone + 100);
    }
    CHECK((at_middle == middle && at_end == all));
  }
  auto restarted = scene_of(body);
  restarted.restart(path);
  CHECK(finish(restarted) == all);
}
