// Lists are ordered by how soon a pair can act, and each particle reads its own only as far as its surroundings have moved: in a scene of
// several blocks, hot at one end and nearly at rest at the other. The oracle searches anew after every step.
#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/neighbours/cell_grid.hpp>

#include "scenes.hpp"

using namespace test;

namespace {

struct Light {};
struct Heavy {};

/// A force of the size k while two are closer than the cut-off, which a missed pair changes by all of it.
struct Step {
  double stiffness, cutoff;
  template <class T>
  T force_factor(const T& squared) const {
    return select(squared < cutoff * cutoff, T(stiffness), 0.0);
  }
  template <class T>
  T energy(const T& squared) const {
    return select(squared < cutoff * cutoff, 0.5 * stiffness * (T(cutoff * cutoff) - squared), 0.0);
  }
  double largest_stiffness() const { return stiffness; }
};
void validate(const Step&) {}

constexpr Step among_light{.stiffness = 1e-3, .cutoff = 1.0}, light_and_heavy{.stiffness = 2e-3, .cutoff = 0.6};
constexpr double length = 120.0, dt = 0.02;

/// Accelerations of masses of 1 kg at x, of those at `sources`.
void add_accelerations(const std::vector<Vector<2>>& x, const std::vector<Vector<2>>& sources, const Step& law,
                       std::vector<Vector<2>>& sum) {
  neighbours::CellGrid<2> grid;
  grid.build(sources, law.cutoff);
  for (std::size_t i = 0; i < x.size(); ++i) {
    neighbours::Found found;
    grid.find(x[i], law.cutoff, found);
    for (std::size_t k = 0; k < found.size; ++k) {
      const Vector<2> apart = x[i] - sources[found.rows[k]];
      if (apart.squaredNorm() < law.cutoff * law.cutoff) sum[i] += law.stiffness * apart;  // 0 from itself
    }
  }
}

}  // namespace

TEST_CASE("hot at one end, at rest at the other, in several blocks: after every step all who are in reach act on each other") {
  std::mt19937 generator(1);
  const auto random = [&generator] { return static_cast<double>(generator()) / 4294967296.0; };
  const auto points = [&](std::size_t count) {
    geometry::Points<2> result;
    for (std::size_t i = 0; i < count; ++i) result.positions.push_back({length * random(), length * random()});
    return result;
  };
  auto beads = scene<integrator::Leapfrog>(
      geometry::Box<2>{.lower = {-1000.0, -1000.0}, .upper = {1000.0, 1000.0}}, group<Light>("light", Mobile{}, points(24000), 1.0),
      group<Heavy>("heavy", Mobile{}, points(16000), 1.0), interaction<Light, Light>(among_light),
      interaction<Light, Heavy>(light_and_heavy));
  const auto heat = [&](auto& g) {
    for (std::size_t i = 0; i < g.size(); ++i)
      g.template get<field::Velocity>()[i] = (g.positions()[i][0] < 0.3 * length ? 2.0 : 0.05) * Vector<2>(random() - 0.5, random() - 0.5);
  };
  auto& light = beads.template group<Light>();
  auto& heavy = beads.template group<Heavy>();
  heat(light);
  heat(heavy);
  double largest = 0.0;
  std::array<bool, neighbours::PairList::levels> seen{};
  bool differ = false;  // whether blocks have been at different levels
  beads.every(dt, [&](const auto&) {
    const std::vector<Vector<2>> of_light(light.positions().begin(), light.positions().end()),
        of_heavy(heavy.positions().begin(), heavy.positions().end());
    std::vector<Vector<2>> expected(light.size(), Vector<2>::Zero()), of_heavy_ones(heavy.size(), Vector<2>::Zero());
    add_accelerations(of_light, of_light, among_light, expected);
    add_accelerations(of_light, of_heavy, light_and_heavy, expected);
    add_accelerations(of_heavy, of_light, light_and_heavy, of_heavy_ones);
    for (std::size_t i = 0; i < light.size(); ++i)
      largest = std::max(largest, (light.template get<field::Acceleration>()[i] - expected[i]).norm());
    for (std::size_t i = 0; i < heavy.size(); ++i)
      largest = std::max(largest, (heavy.template get<field::Acceleration>()[i] - of_heavy_ones[i]).norm());
    for (const auto level : light.level) seen[level] = true;
    const auto second_block = light.level.begin() + static_cast<std::ptrdiff_t>(light.blocks.begin(1));
    const auto [least, most] = std::minmax_element(second_block, light.level.end());
    differ = differ || *least < *most;
  });
  beads.run({.until = 16.0 * dt, .time_step = dt});
  CHECK(light.blocks.size() >= 3);
  CHECK(heavy.blocks.size() >= 2);
  CHECK(beads.engine().list_builds() >= 3);
  CHECK(seen == std::array<bool, neighbours::PairList::levels>{true, true, true, true});
  CHECK(differ);
  CHECK(largest < 1e-12);  // m/s^2; a pair that is missed makes 1e-3
}
