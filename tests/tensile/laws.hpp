#pragma once
#include <cmath>
#include "support/compare.hpp"
#include "support/particles.hpp"
#include <doctest/doctest.h>
#include <dmp/core/pack.hpp>
#include <dmp/kernel/lucy.hpp>
#include <dmp/tensile/concept.hpp>

/// What every correction of the tensile instability must obey in Dim dimensions: it repels, alike on both, within the support.
template <int Dim, class C>
void check_tensile_laws(const C& law) {
  static_assert(dmp::tensile::explain_tensile_correction<C>() && dmp::tensile::Corrects<C>);
  static_assert(test::is_plain<C>);
  const dmp::kernel::Lucy<Dim> kernel{.support_radius = 1.0};
  validate(law);
  test::ParticleSource source;
  const auto correction = [&](const auto& i, const auto& j) { return law.correction(test::pair_of<Dim>(i, j), i, j, kernel); };
  for (int n = 0; n < 300; ++n) {
    auto i = source.next<Dim>(), j = source.next<Dim>();
    const double R = correction(i, j);
    CHECK(R >= 0.0);
    CHECK(test::relative_error(correction(j, i), R) < 1e-14);
    auto turned_i = i, turned_j = j;
    turned_i.position = test::rotate(turned_i.position);
    turned_j.position = test::rotate(turned_j.position);
    turned_i.velocity[0] += 10.0;
    CHECK(std::fabs(correction(turned_i, turned_j) - R) <= 1e-12 * (1.0 + R));
    i.pressure_term = j.pressure_term = 0.0;
    CHECK(correction(i, j) == 0.0);
  }
  auto i = source.next<Dim>(), j = source.next<Dim>();
  i.pressure_term = j.pressure_term = -1e12;
  j.position = i.position;
  CHECK(std::isfinite(correction(i, j)));
  CHECK(correction(i, j) > 0.0);
  i.position[0] = 0.0;
  j.position = i.position;
  j.position[0] = 1.0;
  CHECK(correction(i, j) == 0.0);
  const auto packed = [&](const auto& pair, const auto& a, const auto& b) { return law.correction(pair, a, b, kernel); };
  CHECK(test::pair_lane_error<double, dmp::native_width<double>, Dim>(packed) < 1e-13);
  CHECK(test::pair_lane_error<float, dmp::native_width<float>, Dim>(packed) < 1e-4);
}
