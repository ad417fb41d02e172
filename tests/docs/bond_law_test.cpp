// docs/write-a-law.md, first part: a new bond law of the library, its test, and the same law in a program of one's own.
#include <cmath>
#include <cstdio>
#include <doctest/doctest.h>
#include <dmp/dmp.hpp>

// doc: bond-header
// shown: #pragma once
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::bond {

/// Spring of finite extension (FENE), about its rest length: linear when weak, ever stiffer towards the largest extension R.
///   T(r) = k d/(1 - (d/R)^2)  [N],   d = r - r0,   U = -(1/2) k R^2 ln(1 - (d/R)^2)  [J]       |d| <= s R
///   T goes on along its tangent for |d| > s R: a bond that is pulled too far stays finite, and the time step has a bound.
/// H. R. Warner, Ind. Eng. Chem. Fundam. 11 (1972) 379-387, doi:10.1021/i160043a017 (there r0 = 0); the tangent is ours.
struct FiniteExtension {
  Required<double> stiffness;          ///< k [N/m], >= 0: dT/dr at rest
  Required<double> largest_extension;  ///< R [m], > 0
  double linear_beyond = 0.9;          ///< s [-], > 0 and < 1; at 0.9 the tangent is 50 times as steep as the spring at rest

  [[nodiscard]] auto tension(const auto& bond) const noexcept {
    const auto x = extension(bond), inside = within(x);
    return stiffness * largest_extension * inside / (1.0 - square(inside)) + largest_stiffness() * largest_extension * (x - inside);
  }
  [[nodiscard]] auto energy(const auto& bond) const noexcept {
    const auto x = extension(bond), inside = within(x), beyond = x - inside;
    const double scale = stiffness * square<double>(largest_extension);
    return scale * (beyond * inside / (1.0 - square(inside)) - 0.5 * log(1.0 - square(inside))) +
           0.5 * largest_stiffness() * square(largest_extension * beyond);
  }
  [[nodiscard]] double largest_stiffness() const noexcept {  // of the tangent
    return stiffness * (1.0 + square(linear_beyond)) / square(1.0 - square(linear_beyond));
  }

 private:
  [[nodiscard]] auto extension(const auto& bond) const noexcept { return (bond.length - bond.rest_length) * (1.0 / largest_extension); }
  [[nodiscard]] auto within(const auto& x) const noexcept { return min(max(x, -linear_beyond), linear_beyond); }
};

inline void validate(const FiniteExtension& law) {
  require_not_negative("bond::FiniteExtension: stiffness", law.stiffness, "N/m");
  require_positive("bond::FiniteExtension: largest_extension", law.largest_extension, "m");
  require(law.linear_beyond > 0.0 && law.linear_beyond < 1.0, "bond::FiniteExtension: linear_beyond must be > 0 and < 1", law.linear_beyond);
}

}  // namespace dmp::bond
// end

#include "bond/laws.hpp"

// doc: bond-test
// shown: #include "bond/laws.hpp"
// shown: #include <dmp/bond/finite_extension.hpp>

namespace bond = dmp::bond;

TEST_CASE("a spring of finite extension obeys the laws of bonds") {
  check_bond_laws(bond::FiniteExtension{.stiffness = 10.0, .largest_extension = 0.5});
  check_bond_laws(bond::FiniteExtension{.stiffness = 1e9, .largest_extension = 0.1, .linear_beyond = 0.5});
}

TEST_CASE("a spring of finite extension, half of it used, pulls 4/3 as strongly as a linear one") {
  const bond::FiniteExtension spring{.stiffness = 3.0, .largest_extension = 0.2};
  CHECK(spring.tension(bond::Stretch<double>{.length = 1.1, .rest_length = 1.0}) == doctest::Approx(4.0 / 3.0 * 3.0 * 0.1));
}

TEST_CASE("a spring of finite extension refuses what is none") {
  CHECK(test::complaint_about(bond::FiniteExtension{.stiffness = 1.0, .largest_extension = 0.0}) ==
        "bond::FiniteExtension: largest_extension must be finite and > 0 m, got 0");
  CHECK(test::complaint_about(bond::FiniteExtension{.stiffness = 1.0, .largest_extension = 0.2, .linear_beyond = 1.0}) ==
        "bond::FiniteExtension: linear_beyond must be > 0 and < 1, got 1");
}
// end

namespace own_bond_program {

// doc: own-bond
#include <cmath>
#include <cstdio>
#include <dmp/dmp.hpp>

using namespace dmp;
using namespace dmp::simulation;

struct FiniteExtension {
  double k, R;  // stiffness at rest [N/m], largest extension [m]
  static constexpr double s = 0.9;  // beyond s R: along the tangent
  auto tension(const auto& bond) const {
    const auto x = (bond.length - bond.rest_length) * (1.0 / R);
    const auto inside = min(max(x, -s), s);
    return k * R * inside / (1.0 - inside * inside) + largest_stiffness() * R * (x - inside);
  }
  double largest_stiffness() const { return k * (1.0 + s * s) / ((1.0 - s * s) * (1.0 - s * s)); }
};

struct Bead {};
struct Post {};

int main() {
  const double mass = 0.1, gravity = 9.81, rest_length = 1.0;  // [kg], [m/s^2], [m]
  const FiniteExtension spring{.k = 5.0, .R = 0.2};
  auto pendulum = scene<integrator::Leapfrog>(
      geometry::Box<2>::unbounded(),
      group<Bead>("bead", particles::Mobile{}, geometry::Points<2>{.positions = {{0.0, -rest_length}}}, mass),
      group<Post>("post", particles::Frozen<2>{}, geometry::Points<2>{.positions = {{0.0, 0.0}}}, mass),
      bonds<Bead, Post>(spring, {{.i = 0, .j = 0}}),
      forced_by<Bead>(forcing::Constant<2>{.uniform_acceleration = {{{0.0, -gravity}}}}, forcing::Drag{.coefficient = 1.0}));
  pendulum.run({.until = 20.0});

  const double extension = -pendulum.group<Bead>().positions()[0][1] - rest_length;
  const double weight = mass * gravity, ratio = spring.k * spring.R / weight;  // k d/(1 - (d/R)^2) = weight
  const double exact = spring.R * (std::sqrt(0.25 * ratio * ratio + 1.0) - 0.5 * ratio);
  std::printf("extension %.6f m, exact %.6f m\n", extension, exact);
  return std::fabs(extension - exact) < 1e-6 ? 0 : 1;
}
// end

}  // namespace own_bond_program

TEST_CASE("the bond law of a program of one's own holds the weight that it should") { CHECK(own_bond_program::main() == 0); }
