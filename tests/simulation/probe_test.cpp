#include <doctest/doctest.h>

#include "scenes.hpp"

using namespace test;

TEST_CASE("a probe reads a constant field exactly, also across a periodic face, and a smooth one to second order in the support") {
  double before = 0.0;
  for (const int columns : {24, 48}) {
    auto scene = vortex({.columns = columns});
    const kernel::WendlandC2<2> kernel{.support_radius = 2.6 / columns};
    for (const Vector<2>& point : {Vector<2>(0.3, 0.6), Vector<2>(0.0, 0.0), Vector<2>(0.999, 0.5)})
      CHECK(*probe<Water, field::Density>(scene, kernel, point) == doctest::Approx(1.0).epsilon(1e-14));
    const Vector<2> point(0.21, 0.06);
    constexpr double k = 2.0 * std::numbers::pi;
    const double error =
        std::fabs((*probe<Water, field::Velocity>(scene, kernel, point))[0] - std::sin(k * point[0]) * std::cos(k * point[1]));
    const double smoothing = 0.5 * k * k * 5.0 / 36.0 * square(2.6 / columns);  // (1/4) <r^2> laplacian(u), <r^2> = 5 h^2/36 of this kernel
    CHECK(error < 1.2 * smoothing);
    if (before > 0.0) CHECK(error < before / 3.0);
    before = error;
  }
}

TEST_CASE("a probe with no particle in its support is dry") {
  auto scene = vortex({});
  scene.group<Water>().positions().assign(scene.group<Water>().size(), Vector<2>(0.1, 0.1));
  CHECK_FALSE(probe<Water, field::Density>(scene, kernel::WendlandC2<2>{.support_radius = 0.1}, Vector<2>(0.6, 0.6)).has_value());
  CHECK(probe<Water, field::Density>(scene, kernel::WendlandC2<2>{.support_radius = 0.1}, Vector<2>(0.12, 0.1)).has_value());
}

TEST_CASE("a probe reads the fluid that has come to it through the periodic box, however far that has drifted") {
  auto scene = vortex({});
  scene.group<Water>().set<field::Velocity>([](const Vector<2>&) { return Vector<2>(100.0, -70.0); });
  scene.run({.until = 0.03, .time_step = 1e-4});  // three boxes along, two down
  const auto velocity = probe<Water, field::Velocity>(scene, kernel::WendlandC2<2>{.support_radius = 0.1}, {0.3, 0.6});
  REQUIRE(velocity.has_value());
  CHECK((*velocity - Vector<2>(100.0, -70.0)).norm() < 1e-9);
}
