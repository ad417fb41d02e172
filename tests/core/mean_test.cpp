#include <cmath>
#include <doctest/doctest.h>
#include <dmp/core/pack.hpp>
#include <dmp/core/mean.hpp>


TEST_CASE("both means of a viscosity with itself are that viscosity") {
  CHECK(dmp::ArithmeticMean::twice(3.0, 3.0) == doctest::Approx(6.0).epsilon(1e-15));
  CHECK(dmp::HarmonicMean::twice(3.0, 3.0) == doctest::Approx(6.0).epsilon(1e-15));
}

TEST_CASE("the harmonic mean keeps the stress of two layers in series: the fluid one decides") {
  // Layers of equal thickness: velocity jumps add, u = tau d/mu_a + tau d/mu_b = tau 2d/mu.
  constexpr double a = 1e-3, b = 5.0;
  CHECK(2.0 / dmp::HarmonicMean::twice(a, b) == doctest::Approx(0.5 * (1.0 / a + 1.0 / b)).epsilon(1e-14));
  CHECK(dmp::HarmonicMean::twice(a, 1e12) == doctest::Approx(4.0 * a).epsilon(1e-12));
}

TEST_CASE("the mean of two inviscid fluids is inviscid, in double and in single precision") {
  CHECK(dmp::ArithmeticMean::twice(0.0, 0.0) == 0.0);
  CHECK(dmp::HarmonicMean::twice(0.0, 0.0) == 0.0);
  const dmp::Pack<double, 2> zero = 0.0;
  CHECK(dmp::HarmonicMean::twice(zero, zero)[0] == 0.0);
  const dmp::Pack<float, 4> single_zero = 0.0;
  CHECK(static_cast<double>(dmp::HarmonicMean::twice(single_zero, single_zero)[0]) == 0.0);
}
