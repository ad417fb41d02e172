#pragma once
#include <cmath>
#include "support/compare.hpp"
#include "support/dual.hpp"
#include "support/quadrature.hpp"
#include <doctest/doctest.h>
#include <dmp/core/pack.hpp>
#include <dmp/kernel/concept.hpp>

/// What every smoothing kernel must obey, at one support radius.
template <class K>
void check_kernel_laws(const K& kernel) {
  static_assert(dmp::kernel::explain_kernel<K>());
  static_assert(test::is_plain<K> && sizeof(K) == sizeof(double));
  constexpr int dimension = K::dimension;
  const double h = kernel.support_radius;
  CAPTURE(dimension);
  CAPTURE(h);
  const auto W = [&](const auto& r) { return kernel.value(r); };
  const auto F = [&](const auto& r) { return kernel.radial_factor(r); };

  validate(kernel);
  // Partition of unity: the integral of W is 1. Gradients of linear fields are exact: the integral of |F| r^2 is Dim.
  CHECK(test::relative_error(test::ball_integral(dimension, h, W), 1.0) < 1e-12);
  CHECK(test::relative_error(test::ball_integral(dimension, h, [&](double r) { return -F(r) * r * r; }), dimension) < 1e-12);
  CHECK(test::relative_error(dmp::kernel::radial_factor_integral(kernel),
                             test::ball_integral(dimension, h, [&](double r) { return -F(r); })) < 1e-5);

  double before = W(0.0);
  for (const double r : test::evenly(0.0, 1.1 * h, 1237)) {
    CAPTURE(r);
    CHECK(std::fabs(test::slope(W, r) - r * F(r)) <= 1e-13 * -F(0.0) * h);  // F = (1/r) dW/dr
    CHECK(W(r) >= 0.0);
    CHECK(W(r) <= before);
    CHECK(F(r) <= 0.0);
    if (r < 0.999 * h) CHECK(W(r) > 0.0);
    before = W(r);
  }
  CHECK(F(0.0) < 0.0);
  CHECK(std::isfinite(F(0.0)));
  CHECK(test::relative_error(F(1e-9 * h), F(0.0)) < 1e-7);
  for (const double r : {h, std::nextafter(h, INFINITY), 1.5 * h, 1e3 * h, 1e30 * h}) {
    CAPTURE(r);
    CHECK(W(r) == 0.0);
    CHECK(F(r) == 0.0);
  }

  const auto r = test::evenly(0.0, 1.2 * h, 1024);
  CHECK(test::lane_error<double, dmp::native_width<double>>(W, r) < 1e-14);
  CHECK(test::lane_error<double, dmp::native_width<double>>(F, r) < 1e-14);
  CHECK(test::lane_error<double, 1>(W, r) < 1e-14);
  CHECK(test::lane_error<float, dmp::native_width<float>>(W, r) < 1e-6);
  CHECK(test::lane_error<float, dmp::native_width<float>>(F, r) < 1e-6);
}

/// All of them in 1D, 2D and 3D, from micrometres to kilometres.
template <template <int> class K>
void check_kernel_laws() {
  for (const double h : {1e-6, 1.3e-3, 0.1, 1.0, 49.0, 2.6e3}) {
    check_kernel_laws(K<1>{.support_radius = h});
    check_kernel_laws(K<2>{.support_radius = h});
    check_kernel_laws(K<3>{.support_radius = h});
  }
}

/// W and F are exactly 0 at r = h for every h, not for most: no pair at the rim of a neighbour list makes a difference.
template <template <int> class K>
void check_kernel_ends_at_its_support() {
  int reaches_beyond = 0;
  for (int n = 1; n <= 1000; ++n) {
    const double h = 0.01 * n;
    const K<2> kernel{.support_radius = h};
    if (kernel.value(h) != 0.0 || kernel.radial_factor(h) != 0.0) ++reaches_beyond;
  }
  CHECK(reaches_beyond == 0);
}

/// The text that names `type`, the parameter, the rule and the value.
template <template <int> class K>
void check_kernel_refuses_bad_support(const std::string& type) {
  const std::string rule = type + ": support_radius must be finite and > 0 m, got ";
  CHECK(test::complaint_about(K<2>{.support_radius = -1.0}) == rule + "-1");
  CHECK(test::complaint_about(K<3>{.support_radius = 0.0}) == rule + "0");
  CHECK(test::complaint_about(K<1>{.support_radius = INFINITY}) == rule + "inf");
  CHECK(test::complaint_about(K<2>{.support_radius = NAN}) == rule + "nan");
}

/// Standard deviation of W along one axis, the width that Dehnen & Aly (2012) call sigma.
template <class K>
[[nodiscard]] double standard_deviation(const K& kernel) {
  const double moment =
      test::ball_integral(K::dimension, kernel.support_radius, [&](double r) { return r * r * kernel.value(r); }) / K::dimension;
  return std::sqrt(moment);
}
