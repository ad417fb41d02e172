// Forces of bonds in vector registers, against a plain loop over the bonds that asks the same law number by number.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>
#include "neighbours/oracle.hpp"
#include <doctest/doctest.h>
#include <dmp/bond.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/neighbours/bond_list.hpp>
#include <dmp/particles/records.hpp>
#include <dmp/particles/sums.hpp>
#include <dmp/sweep/bonds.hpp>

using namespace dmp;
using dmp::neighbours::Bond;
using dmp::sweep::Lanes;

namespace {

/// Tension that is not linear, so that it matters in which lane a bond is.
struct Stiffening {
  [[nodiscard]] auto tension(const auto& bond) const noexcept { return 3.0 * bond.length * bond.length - bond.rest_length + 0.1; }
  [[nodiscard]] double largest_stiffness() const noexcept { return 6.0; }
};

template <int Dim>
struct Group {
  test::Cloud<Dim> positions, velocities;
};
template <int Dim>
Group<Dim> at_random(std::size_t count, unsigned seed) {
  Group<Dim> group{test::scattered<Dim>(count, 1.0, seed), test::scattered<Dim>(count, 2.0, seed + 1)};
  if (count > 3) group.positions[3] = group.positions[0];
  return group;
}

/// Records whose padding is not a number: what is read of it must not matter.
template <class Records, int Dim>
Records records_of(const Group<Dim>& group) {
  Records records;
  records.resize(group.positions.size());
  std::fill(records.data(), records.data() + records.size() * Records::stride, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < records.size(); ++i) {
    typename Records::template view<double> record{};
    record.position = to_components<Dim>(group.positions[i]);
    if constexpr (requires { record.velocity; }) record.velocity = to_components<Dim>(group.velocities[i]);
    if constexpr (requires { record.density; }) record.density = 1000.0;
    records.store(i, record);
  }
  return records;
}

/// Forces on the particles of one group, and for each the sum of the lengths of its terms.
template <int Dim>
struct Forces {
  test::Cloud<Dim> total;
  std::vector<double> absolute;
};

template <int Dim, class Law>
void add(Forces<Dim>& forces, std::size_t i, const Vector<Dim>& apart, const Vector<Dim>& relative_velocity, const Bond& bond,
         const Law& law) {
  const double length = apart.norm();
  if (!(length > 0.0)) return;
  double tension = 0.0;
  if constexpr (bond::UsesVelocity<Law>)
    tension = law.tension(bond::MovingStretch<double>{{length, bond.rest_length}, apart.dot(relative_velocity) / length});
  else tension = law.tension(bond::Stretch<double>{length, bond.rest_length});
  forces.total[i] -= bond.weight * tension / length * apart;
  forces.absolute[i] += std::fabs(bond.weight * tension);
}
/// On the particles of `own`, which are the ends i of the bonds, or j, or both.
template <int Dim, class Law>
Forces<Dim> one_by_one(const Group<Dim>& own, const Group<Dim>& others, bool same_group, bool own_is_j, const std::vector<Bond>& bonds,
                       const geometry::Box<Dim>& box, const Law& law) {
  Forces<Dim> forces{test::Cloud<Dim>(own.positions.size(), Vector<Dim>::Zero()), std::vector<double>(own.positions.size(), 0.0)};
  for (const Bond& bond : bonds) {
    const std::uint32_t a = own_is_j ? bond.j : bond.i, b = own_is_j ? bond.i : bond.j;
    Vector<Dim> apart = own.positions[a] - others.positions[b];
    for (int d = 0; d < Dim; ++d)
      if (box.periodic[static_cast<std::size_t>(d)]) apart[d] -= std::round(apart[d]);  // the box is 1 m wide
    const Vector<Dim> relative_velocity = own.velocities[a] - others.velocities[b];
    add<Dim>(forces, a, apart, relative_velocity, bond, law);
    if (same_group) add<Dim>(forces, b, -apart, -relative_velocity, bond, law);
  }
  return forces;
}

/// The same as a scene sums it; beside the force, a sum that is none of the bonds' affair stays as it is.
template <int Dim, bool Periodic, class Own, class Others, class Law>
test::Cloud<Dim> in_packs(const Group<Dim>& own, const Group<Dim>& others, bool same_group, bool own_is_j, const std::vector<Bond>& bonds,
                          const Blocks& blocks, const Law& law) {
  using Sums = particles::Sums<Dim, Fields<field::Force, field::DensityRate>>;
  neighbours::BondList list;
  list.build(blocks, bonds, same_group, own_is_j, Lanes::width, {Others::stride, Sums::stride});
  const auto own_records = records_of<Own>(own);
  const auto other_records = records_of<Others>(others);
  std::array<double, Dim> lengths;
  lengths.fill(Periodic ? 1.0 : 0.0);
  const sweep::Periods<Dim> periods(lengths);
  Sums sums;
  sums.resize(blocks.far_row(blocks.size()));
  sums.set_zero(0, sums.size());
  for (std::size_t i = 0; i < own.positions.size(); ++i) sums.data()[i * Sums::stride + Dim] = static_cast<double>(i);  // the density rate
  const auto plus = [&sums](std::size_t at, Lanes factor, const sweep::Row<Dim>& vector) {
    sweep::Row<Dim>::load(sums.data() + at).plus(factor, vector).store(sums.data() + at);
  };
  const auto react = [&](std::size_t at, Lanes factor, const sweep::Row<Dim>& vector) {
    if (same_group) plus(at, factor, vector);
  };
  test::Cloud<Dim> forces;
  std::size_t spoilt = 0;
  for (std::size_t i = 0; i < own.positions.size(); ++i) {
    const sweep::BondRecords records{own_records.data() + i * Own::stride, other_records.data()};
    plus(i * Sums::stride, 1.0, sweep::sum_bonds < Dim, Periodic,
         Own::numbers == Dim && Others::numbers == Dim > (records, list.of(i), periods, react, law));
  }
  for (std::size_t i = 0; i < own.positions.size(); ++i) {
    View<Dim, Lanes, Fields<field::Force, field::DensityRate>> nothing;
    sweep::set_zero(nothing);
    const auto total = sums.take(i, nothing);
    forces.push_back(to_vector<Dim>(total.force));
    spoilt += total.density_rate != static_cast<double>(i);
  }
  CHECK(spoilt == 0);
  return forces;
}

template <int Dim>
void check_equal(const test::Cloud<Dim>& forces, const Forces<Dim>& expected) {
  const double largest = *std::max_element(expected.absolute.begin(), expected.absolute.end());
  double error = 0.0;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const double one = (forces[i] - expected.total[i]).norm();
    error = std::isnan(one) ? INFINITY : std::max(error, one);
  }
  CHECK(largest > 0.0);
  CHECK(error < 1e-12 * largest);
}

/// Bonds of 0 to 9 partners each, one of length zero among them, one of rest length zero.
std::vector<Bond> net(std::uint32_t first, std::uint32_t second, bool same_group, bool weighted) {
  test::Random random(5);
  std::vector<Bond> bonds{{0, 3, 0.2}, {3, 1, 0.0}};
  for (std::uint32_t i = 1; i < first; ++i)
    for (std::uint32_t n = 0; n < i % 10; ++n)
      if (const auto j = static_cast<std::uint32_t>(second * random()); !same_group || j != i) bonds.push_back({i, j, random()});
  if (weighted)
    for (Bond& bond : bonds) bond.weight = random() < 0.5 ? 1.0 : 2.0 * random();
  return bonds;
}

template <int Dim, bool Periodic, class Law>
void check_law(const Law& law) {
  CAPTURE(Dim);
  CAPTURE(Periodic);
  constexpr std::uint32_t count = 40, others = 23;
  using Bare =
      particles::Records<Dim,
                         std::conditional_t<bond::UsesVelocity<Law>, Fields<field::Position, field::Velocity>, Fields<field::Position>>>;
  using Wide = particles::Records<Dim, Fields<field::Position, field::Velocity, field::Density>>;
  std::array<bool, Dim> faces;
  faces.fill(Periodic);
  const auto box = test::cube<Dim>(1.0, faces);
  auto own = at_random<Dim>(count, 1), other = at_random<Dim>(others, 3);
  other.positions[1] = own.positions[3];  // a bond of length zero between the groups
  if (Periodic)
    for (std::size_t i = 5; i < count; i += 3)
      own.positions[i] += Vector<Dim>::Constant(static_cast<double>(i % 7) - 3.0);  // anywhere outside the box
  for (const bool weighted : {false, true}) {
    const auto within = net(count, count, true, weighted), across = net(count, others, false, weighted);
    for (const std::vector<std::size_t>& bounds : {std::vector<std::size_t>{0, count}, {0, 1, 7, 30, count}}) {
      Blocks blocks;
      blocks.set_bounds(bounds);
      const auto expected = one_by_one<Dim>(own, own, true, false, within, box, law);
      const auto bare = in_packs<Dim, Periodic, Bare, Bare>(own, own, true, false, within, blocks, law);
      check_equal<Dim>(bare, expected);
      check_equal<Dim>(in_packs<Dim, Periodic, Wide, Wide>(own, own, true, false, within, blocks, law), expected);
      check_equal<Dim>(in_packs<Dim, Periodic, Bare, Wide>(own, other, false, false, across, blocks, law),
                       one_by_one<Dim>(own, other, false, false, across, box, law));
      Vector<Dim> momentum = Vector<Dim>::Zero();
      double all = 0.0;
      for (std::size_t i = 0; i < count; ++i) {
        momentum += bare[i];
        all += expected.absolute[i];
      }
      CHECK(momentum.norm() < 1e-15 * all);
    }
    check_equal<Dim>(in_packs<Dim, Periodic, Wide, Bare>(other, own, false, true, across, Blocks(others), law),
                     one_by_one<Dim>(other, own, false, true, across, box, law));
  }
}

template <class Law>
void check_in_all_dimensions(const Law& law) {
  check_law<1, false>(law);
  check_law<1, true>(law);
  check_law<2, false>(law);
  check_law<2, true>(law);
  check_law<3, false>(law);
  check_law<3, true>(law);
}

}  // namespace

TEST_CASE("bonds in packs pull as in a plain loop over the bonds: springs") { check_in_all_dimensions(bond::Harmonic{.stiffness = 7.0}); }
TEST_CASE("bonds in packs pull as in a plain loop over the bonds: springs and dashpots") {
  check_in_all_dimensions(bond::KelvinVoigt{.stiffness = 7.0, .damping = 0.3});
}
TEST_CASE("bonds in packs pull as in a plain loop over the bonds: a law of one's own") { check_in_all_dimensions(Stiffening{}); }

TEST_CASE("KV-4: spring and dashpot pull the two ends of a bond alike, exactly, and along it") {
  using Moving = particles::Records<3, Fields<field::Position, field::Velocity>>;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto group = at_random<3>(5, seed);
    const auto forces = in_packs<3, false, Moving, Moving>(group, group, true, false, {{1, 2, 0.1}}, Blocks(5),
                                                           bond::KelvinVoigt{.stiffness = 1.0, .damping = 0.7});
    CHECK(forces[1] == -forces[2]);
    CHECK(forces[1].norm() > 0.0);
    const Vector<3> apart = group.positions[1] - group.positions[2], along = apart / apart.norm();
    CHECK((forces[1] - forces[1].dot(along) * along).norm() <= 1e-12 * forces[1].norm());  // no torque
  }
}
TEST_CASE("a Kelvin-Voigt bond without damping pulls exactly as a spring, which looks at no velocity") {
  using Still = particles::Records<3, Fields<field::Position>>;
  using Moving = particles::Records<3, Fields<field::Position, field::Velocity>>;
  static_assert(!bond::UsesVelocity<bond::Harmonic> && bond::UsesVelocity<bond::KelvinVoigt>);
  const std::vector<Bond> list{{0, 1, 0.1}, {0, 2, 0.4}, {1, 2, 0.3}, {3, 4, 0.0}, {2, 4, 0.2}, {0, 5, 0.9}, {0, 6, 0.8}};
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto group = at_random<3>(7, seed);
    const auto spring = in_packs<3, false, Still, Still>(group, group, true, false, list, Blocks(7), bond::Harmonic{.stiffness = 7.0});
    CHECK(in_packs<3, false, Moving, Moving>(group, group, true, false, list, Blocks(7),
                                             bond::KelvinVoigt{.stiffness = 7.0, .damping = 0.0}) == spring);
    CHECK(in_packs<3, false, Moving, Moving>(group, group, true, false, list, Blocks(7),
                                             bond::KelvinVoigt{.stiffness = 7.0, .damping = 0.01}) != spring);
  }
}
TEST_CASE("a particle without bonds feels nothing, exactly") {
  const auto group = at_random<3>(5, 1);
  const auto forces = in_packs<3, false, particles::Records<3, Fields<field::Position>>, particles::Records<3, Fields<field::Position>>>(
      group, group, true, false, {{1, 2, 0.1}}, Blocks(5), bond::Harmonic{.stiffness = 1.0});
  for (const std::size_t i : {0u, 3u, 4u}) CHECK(forces[i] == Vector<3>(0.0, 0.0, 0.0));
  CHECK(forces[1] == -forces[2]);
}
