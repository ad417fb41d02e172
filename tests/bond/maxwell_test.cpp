#include "bond/laws.hpp"
#include <limits>
#include <dmp/bond/maxwell.hpp>

namespace bond = dmp::bond;

namespace {

using Bond = bond::Remembering<bond::Stretch<double>, double>;

/// Force after `steps` of dt [s] at the rate [m/s], from a force at the start.
double pulled(const bond::Maxwell& law, double force, double rate, double dt, int steps) {
  const auto after = law.memory_after(dt);
  for (int n = 0; n < steps; ++n) force = after(Bond{{1.0, 1.0}, rate * dt, force});
  return force;
}

}  // namespace

TEST_CASE("a Maxwell bond obeys the laws of bonds, when stretched suddenly those of a spring") {
  static_assert(sizeof(bond::Maxwell) == 2 * sizeof(double) && bond::HasMemory<bond::Maxwell> && !bond::UsesVelocity<bond::Maxwell>);
  check_bond_laws(bond::Maxwell{.stiffness = 10.0, .damping = 0.3});
  check_bond_laws(bond::Maxwell{.stiffness = 1e12, .damping = 1e9});
  check_bond_laws(bond::Maxwell{.stiffness = 1e-6, .damping = 1e-12});
}

TEST_CASE("a Maxwell bond relaxes as k X e^(-k t/c), and pulled at a rate v it comes to c v (1 - e^(-k t/c)), whatever the step") {
  const bond::Maxwell law{.stiffness = 4.0, .damping = 2.0};  // tau = 0.5 s
  for (const int steps : {1, 2, 7, 1000, 100000})
    for (const double time : {1e-9, 0.1, 0.5, 3.0}) {
      CAPTURE(steps);
      CAPTURE(time);
      const double dt = time / steps, rounding = 2e-16 * (steps + 4);
      CHECK(std::fabs(pulled(law, 8.0, 0.0, dt, steps) / (8.0 * std::exp(-2.0 * time)) - 1.0) <= rounding);
      CHECK(std::fabs(pulled(law, 0.0, 3.0, dt, steps) / (2.0 * 3.0 * -std::expm1(-2.0 * time)) - 1.0) <= rounding);
    }
}

TEST_CASE(
    "a Maxwell bond in the limits: a spring for short steps and stiff dashpots, a dashpot for long steps, nothing without a dashpot") {
  const double k = 3.0, stretch = 0.2;
  const auto force = [&](double damping, double dt) {
    return bond::Maxwell{.stiffness = k, .damping = damping}.memory_after(dt)(Bond{{1.0, 1.0}, stretch, 0.0});
  };
  CHECK(force(1.0, 0.0) == k * stretch);
  CHECK(force(1e300, 1.0) == k * stretch);
  for (const double h : {1e-300, 1e-17, 1e-12, 1e-8, 1e-5}) {
    CAPTURE(h);
    CHECK(std::fabs(force(1.0, h / k) / (k * stretch * (1.0 - 0.5 * h + h * h / 6.0)) - 1.0) <= 4e-16);
  }
  for (const double dt : {20.0, 1e3, 1e100}) CHECK(force(1.0, dt) == doctest::Approx(stretch / dt).epsilon(1e-14).scale(0.0));  // c dX/dt
  CHECK(force(1.0, std::numeric_limits<double>::max()) >= 0.0);
  for (const double dt : {0.0, 1e-9, 1.0}) {
    CHECK(force(0.0, dt) == 0.0);
    CHECK(bond::Maxwell{.stiffness = 0.0, .damping = 1.0}.memory_after(dt)(Bond{{1.0, 1.0}, stretch, 0.0}) == 0.0);
    CHECK(bond::Maxwell{.stiffness = 0.0, .damping = 0.0}.memory_after(dt)(Bond{{1.0, 1.0}, stretch, 0.0}) == 0.0);
  }
  CHECK(bond::Maxwell{.stiffness = 0.0, .damping = 1.0}.energy(Bond{{1.0, 1.0}, 0.0, 0.0}) == 0.0);
}

TEST_CASE("whatever is done to a Maxwell bond, what it stores is at most the work done on it") {
  test::ParticleSource source;
  for (int n = 0; n < 200; ++n) {
    const bond::Maxwell law{.stiffness = 5.0, .damping = source.between(0.01, 1.0)};
    double force = source.between(-1.0, 1.0), balance = 0.5 * force * force / 5.0;  // work done, less what is stored
    for (int part = 0; part < 20; ++part) {
      const double change = source.between(-0.5, 0.5), dt = source.between(0.0, 0.3);
      constexpr int fine = 400;
      const auto after = law.memory_after(dt / fine);
      for (int k = 0; k < fine; ++k) {
        const double next = after(Bond{{1.0, 1.0}, change / fine, force});
        balance += 0.5 * (force + next) * change / fine;
        force = next;
      }
      CHECK(balance - law.energy(Bond{{1.0, 1.0}, 0.0, force}) >= -1e-5);
    }
  }
}

TEST_CASE("a Maxwell bond refuses parameters that would feed energy") {
  CHECK(test::complaint_about(bond::Maxwell{.stiffness = -1.0, .damping = 0.0}) ==
        "bond::Maxwell: stiffness must be finite and >= 0 N/m, got -1");
  CHECK(test::complaint_about(bond::Maxwell{.stiffness = 1.0, .damping = -0.5}) ==
        "bond::Maxwell: damping must be finite and >= 0 N s/m, got -0.5");
}
