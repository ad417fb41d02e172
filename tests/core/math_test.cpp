#include <cmath>
#include <initializer_list>
#include <doctest/doctest.h>
#include <dmp/core/math.hpp>

TEST_CASE("a whole power is a product of factors, however many") {
  CHECK(dmp::power(2.0, 1.0) == 2.0);
  double expected = 1.0;
  for (int n = 1; n <= 40; ++n) {
    CAPTURE(n);
    expected *= 3.0;  // 3^n is exact in double up to n = 33
    CHECK(std::fabs(dmp::power(3.0, n) - expected) <= 1e-14 * expected);
  }
  CHECK(dmp::power(-2.0, 13.0) == -8192.0);
  CHECK(dmp::power(-2.0, 12.0) == 4096.0);
}

TEST_CASE("a power that is not whole, and the powers 0 and -1, are what they are on paper") {
  CHECK(dmp::power(4.0, 0.5) == doctest::Approx(2.0).epsilon(1e-15));
  CHECK(dmp::power(1024.0, 0.7) == doctest::Approx(128.0).epsilon(1e-14));
  CHECK(dmp::power(5.0, 0.0) == 1.0);
  CHECK(dmp::power(0.0, 0.0) == 1.0);
  CHECK(dmp::power(8.0, -1.0) == 0.125);
}

TEST_CASE("square and cube are products, with sign") {
  CHECK(dmp::square(-3.0) == 9.0);
  CHECK(dmp::cube(-3.0) == -27.0);
}

TEST_CASE("select, min, max and abs choose") {
  CHECK(dmp::select(true, 1.0, 2.0) == 1.0);
  CHECK(dmp::select(false, 1.0, 2.0) == 2.0);
  CHECK(dmp::min(1.0, -2.0) == -2.0);
  CHECK(dmp::max(1.0, -2.0) == 1.0);
  CHECK(dmp::abs(-2.5) == 2.5);
  CHECK(dmp::max(-INFINITY, 0.0) == 0.0);
}

TEST_CASE("exp undoes log, and sqrt undoes square") {
  for (const double x : {1e-300, 0.1, 1.0, 7.0, 1e100}) {
    CHECK(std::fabs(dmp::exp(dmp::log(x)) - x) <= 1e-12 * x);
    CHECK(std::fabs(dmp::square(dmp::sqrt(x)) - x) <= 1e-15 * x);
  }
}
