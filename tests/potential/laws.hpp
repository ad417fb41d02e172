#pragma once
#include <cmath>
#include "support/compare.hpp"
#include "support/dual.hpp"
#include <doctest/doctest.h>
#include <dmp/core/pack.hpp>
#include <dmp/potential/concept.hpp>

/// What every pair potential must obey at distances from `closest` [m], the smallest one it is meant for, to beyond its cut-off.
template <class P>
void check_pair_potential_laws(const P& law, double closest) {
  static_assert(dmp::potential::explain_pair_potential<P>());
  static_assert(test::is_plain<P>);
  validate(law);
  const double cutoff = law.cutoff;
  CAPTURE(cutoff);
  const auto energy = [&](const auto& r) { return law.energy(r * r); };
  const auto force = [&](const auto& r) { return law.force_factor(r * r) * r; };  // on i along n_ij
  double largest = 0.0;
  for (const double r : test::evenly(closest, 0.999 * cutoff, 501)) largest = std::fmax(largest, std::fabs(force(r)));

  double stiffest = 0.0;
  for (const double r : test::evenly(closest, 0.999 * cutoff, 501)) {
    CAPTURE(r);
    CHECK(std::fabs(force(r) + test::slope(energy, r)) <= 1e-13 * largest);  // force = -dU/dr
    CHECK(std::isfinite(force(r)));
    stiffest = std::fmax(stiffest, -test::slope(force, r));
  }
  CHECK(stiffest <= law.largest_stiffness() * (1.0 + 1e-12));
  for (const double r : {cutoff, 1.1 * cutoff, 1e3 * cutoff}) {
    CAPTURE(r);
    CHECK(law.force_factor(r * r) == 0.0);
    CHECK(law.energy(r * r) == 0.0);
  }

  auto squares = test::evenly(closest, 1.2 * cutoff, 256);
  for (double& r : squares) r *= r;
  const auto U = [&](const auto& square) { return law.energy(square); };
  const auto f = [&](const auto& square) { return law.force_factor(square); };
  CHECK(test::lane_error<double, dmp::native_width<double>>(U, squares) < 1e-13);
  CHECK(test::lane_error<double, dmp::native_width<double>>(f, squares) < 1e-13);
  CHECK(test::lane_error<float, dmp::native_width<float>>(U, squares) < 1e-4);
  CHECK(test::lane_error<float, dmp::native_width<float>>(f, squares) < 1e-4);
}
