#pragma once
#include <cmath>
#include "support/compare.hpp"
#include "support/particles.hpp"
#include <doctest/doctest.h>
#include <dmp/core/pack.hpp>
#include <dmp/diffusion/concept.hpp>

/// What every law that smooths the density must obey in Dim dimensions.
template <int Dim, class D>
void check_diffusion_laws(const D& law) {
  static_assert(dmp::diffusion::explain_diffusion<D>() && dmp::diffusion::Diffuses<D>);
  static_assert(test::is_plain<D>);
  constexpr double h = 2.0;
  validate(law);
  test::ParticleSource source;
  const auto flux = [&](const auto& i, const auto& j) { return law.flux(test::pair_of<Dim>(i, j), i, j, h); };
  for (int n = 0; n < 300; ++n) {
    auto i = source.next<Dim>(), j = source.next<Dim>();
    const double there = flux(i, j), back = flux(j, i);
    CHECK(std::fabs(j.density * there + i.density * back) <= 1e-13 * std::fabs(j.density * there));  // the sum of V rho is kept
    CHECK(there * (i.density - j.density) > 0.0);                                                    // F < 0: the denser one loses
    auto moving_i = i, moving_j = j;
    moving_i.position = test::rotate(moving_i.position);
    moving_j.position = test::rotate(moving_j.position);
    moving_i.velocity[0] += 10.0;
    moving_j.velocity[0] += 10.0;
    CHECK(test::relative_error(flux(moving_i, moving_j), there) < 1e-12);
    j.density = i.density;
    CHECK(flux(i, j) == 0.0);
  }
  auto i = source.next<Dim>(), j = source.next<Dim>();
  j.position = i.position;
  CHECK(std::isfinite(flux(i, j)));
  const auto packed = [&](const auto& pair, const auto& a, const auto& b) { return law.flux(pair, a, b, h); };
  CHECK(test::pair_lane_error<double, dmp::native_width<double>, Dim>(packed) < 1e-14);
  CHECK(test::pair_lane_error<float, dmp::native_width<float>, Dim>(packed) < 1e-5);
}
