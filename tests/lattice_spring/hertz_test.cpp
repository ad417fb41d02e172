// The elastic sphere between plates: formulas against each other and against the numbers of sheet 01, sections 2 to 4.
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/lattice_spring.hpp>
#include "support/compare.hpp"
#include "support/quadrature.hpp"

using namespace dmp::lattice_spring;
using test::relative_error;
using test::complaint;

namespace {

const double l = 12.5e-6;                                                             // [m], edge of the lattice of the sheet's sphere
const Hertz sphere{.radius = 32 * l, .youngs_modulus = 40e6, .poisson_ratio = 0.25};  // sheet 01

}  // namespace

TEST_CASE("A4: force and contact radius of the sphere of sheet 01 at 1, 2, 5 and 10 per cent") {
  CHECK(sphere.prefactor() == doctest::Approx(4.0227e5).epsilon(2e-5));
  const std::array<std::array<double, 3>, 4> table{
      {{0.01, 9.10e-3, 3.2}, {0.02, 25.7e-3, 4.5}, {0.05, 101.8e-3, 7.2}, {0.10, 287.8e-3, 10.1}}};
  for (const auto& [fraction, force, radius] : table) {
    const double approach = fraction * 2.0 * sphere.radius;
    CHECK(sphere.force(approach) == doctest::Approx(force).epsilon(2e-3).scale(0.0));
    CHECK(std::fabs(sphere.contact_radius(approach) / l - radius) < 0.06);
  }
  // In lattice units E = 2.5, R = 32: the column "Hertz" of A4.
  const Hertz unit{.radius = 32.0, .youngs_modulus = 2.5, .poisson_ratio = 0.25};
  const std::array<std::array<double, 2>, 4> column{{{0.025, 14.39}, {0.05, 40.71}, {0.075, 74.79}, {0.10, 115.1}}};
  for (const auto& [fraction, force] : column) CHECK(unit.force(64.0 * fraction) == doctest::Approx(force).epsilon(5e-4));
}

TEST_CASE("Hertz: the formulas agree with each other and with the theory of one contact") {
  const double modulus = sphere.youngs_modulus / (1.0 - 0.25 * 0.25);  // of the contact with a rigid flat
  for (const double approach : {1e-9, 1e-6, 4e-5}) {
    const double a = sphere.contact_radius(approach), p0 = sphere.peak_pressure(approach), F = sphere.force(approach);
    CHECK(F == doctest::Approx(4.0 / 3.0 * modulus * std::sqrt(double(sphere.radius)) * std::pow(0.5 * approach, 1.5))
                   .epsilon(1e-13));  // half on each side
    CHECK(F == doctest::Approx(4.0 / 3.0 * modulus * a * a * a / sphere.radius).epsilon(1e-13));
    CHECK(p0 == doctest::Approx(2.0 * modulus * a / (std::numbers::pi * sphere.radius)).epsilon(1e-13));
    // The pressure p0 sqrt(1 - (r/a)^2) adds up to the force; r/a = sin t.
    const double sum =
        test::integral([&](double t) { return 2.0 * std::numbers::pi * a * a * p0 * std::sin(t) * std::cos(t) * std::cos(t); }, 0.0,
                       0.5 * std::numbers::pi);
    CHECK(sum == doctest::Approx(F).epsilon(1e-12));
    CHECK(sphere.stiffness(approach) == doctest::Approx(modulus * a).epsilon(1e-13));  // two springs 2 E' a in series
    CHECK(sphere.approach(F) == doctest::Approx(approach).epsilon(1e-13));
    const double tau = 5e-9, rate = 0.1;  // B = (3/2) A tau
    CHECK(sphere.viscoelastic_force(approach, rate, tau) ==
          doctest::Approx(F + 1.5 * sphere.prefactor() * tau * std::sqrt(approach) * rate).epsilon(1e-13));
  }
  for (const double apart : {0.0, -1e-6})
    CHECK((sphere.force(apart) == 0.0 && sphere.stiffness(apart) == 0.0 && sphere.contact_radius(apart) == 0.0 &&
           sphere.peak_pressure(apart) == 0.0));
}

TEST_CASE("A5: on the axis the shear stress is largest at 0.464 a with 0.3217 p0 for nu = 0.25, at 0.481 a with 0.310 p0 for nu = 0.30") {
  const auto quarter = hertz_largest_shear(0.25), third = hertz_largest_shear(0.30);
  CHECK(std::fabs(quarter.zeta - 0.464) < 5e-4);
  CHECK(std::fabs(quarter.shear - 0.3217) < 5e-5);
  CHECK(std::fabs(third.zeta - 0.481) < 5e-4);
  CHECK(std::fabs(third.shear - 0.310) < 5e-4);
  for (const double zeta : test::evenly(0.0, 5.0, 501)) CHECK(hertz_axis_stress(zeta, 0.25).shear() <= quarter.shear + 1e-12);
}

TEST_CASE("stress on the axis of a Hertz contact is that of the half space under its pressure: Boussinesq's, added up over rings") {
  for (const double nu : {0.0, 0.25, 0.4})
    for (const double z : {0.2, 0.464, 1.0, 3.0}) {
      // A ring of radius r under pressure p: sigma_z = -3 p z^3/R^5 r dr, sigma_r = p/2 [(1 - 2 nu)/... ] as below;
      // R^2 = r^2 + z^2, r = sin t.
      const auto ring = [&](double t, bool axial) {
        const double r = std::sin(t), R = std::sqrt(r * r + z * z), dP = 2.0 * std::numbers::pi * r * std::cos(t) * std::cos(t);
        if (axial) return -dP * 3.0 * z * z * z / (2.0 * std::numbers::pi * std::pow(R, 5));
        // Mean of sigma_r and sigma_theta of a point force P at distance r, depth z (Johnson, eq. 3.19).
        const double radial = (1.0 - 2.0 * nu) * (1.0 / (R * (R + z))) - 3.0 * z * r * r / std::pow(R, 5);
        const double hoop = -(1.0 - 2.0 * nu) * (1.0 / (R * (R + z)) - z / (R * R * R));
        return dP / (2.0 * std::numbers::pi) * 0.5 * (radial + hoop);
      };
      const auto stress = hertz_axis_stress(z, nu);
      CHECK(stress.axial ==
            doctest::Approx(test::integral([&](double t) { return ring(t, true); }, 0.0, 0.5 * std::numbers::pi)).epsilon(1e-10));
      CHECK(stress.radial ==
            doctest::Approx(test::integral([&](double t) { return ring(t, false); }, 0.0, 0.5 * std::numbers::pi)).epsilon(1e-10));
    }
  CHECK(hertz_axis_stress(0.0, 0.25).radial == doctest::Approx(-0.75));  // -(1 + 2 nu)/2 in the middle of the contact
}

TEST_CASE("fit: a Hertz curve with a shifted zero gives back E, A and the zero; with a fixed zero it does not") {
  std::vector<double> approach, force;
  const double shift = 0.35 * l;
  for (const double fraction : test::evenly(0.0125, 0.10, 8)) {
    approach.push_back(fraction * 2.0 * sphere.radius);
    force.push_back(sphere.force(approach.back() - shift));
  }
  const auto fit = fit_hertz(approach, force, sphere.radius, 0.25);
  CHECK(relative_error(fit.youngs_modulus, 40e6) < 1e-12);
  CHECK(relative_error(fit.zero, -shift) < 1e-11);
  CHECK(relative_error(fit.prefactor, sphere.prefactor()) < 1e-12);
  CHECK(fit.residual < 1e-14);
  const auto fixed = fit_hertz(approach, force, sphere.radius, 0.25, HertzZero::fixed);
  CHECK(fixed.zero == 0.0);
  CHECK(fixed.youngs_modulus < 0.92 * 40e6);
  CHECK(fixed.residual > 1e-2);
  const std::array<double, 2> two{1e-6, 2e-6}, exact{sphere.force(1e-6), sphere.force(2e-6)};
  CHECK(relative_error(fit_hertz(two, exact, sphere.radius, 0.25, HertzZero::fixed).youngs_modulus, 40e6) < 1e-13);
}

TEST_CASE("A4: fits to the force curves that sheet 01 tabulates come near the moduli that it fits to twice as many points") {
  const std::array<double, 4> approach{64 * 0.025, 64 * 0.05, 64 * 0.075, 64 * 0.10};  // lattice units, R = 32
  const auto fitted = [&](const std::array<double, 4>& force) { return fit_hertz(approach, force, 32.0, 0.25); };
  const auto q1 = fitted({9.474, 32.83, 65.23, 105.39}), q2 = fitted({9.972, 33.48, 65.79, 105.50}),
             q3 = fitted({10.070, 33.61, 67.08, 108.69});
  const auto facet = fitted({35.42, 66.89, 112.4, 159.0});
  CHECK(std::fabs(q1.youngs_modulus / 2.5 - 0.982) < 0.05);
  CHECK(std::fabs(q2.youngs_modulus / 2.5 - 0.979) < 0.05);
  CHECK(std::fabs(q3.youngs_modulus / 2.5 - 0.992) < 0.05);
  CHECK(std::fabs(facet.youngs_modulus / 2.5 - 1.14) < 0.07);
  CHECK((q1.zero < 0.0 && q1.zero > -0.6 && facet.zero > 0.5));
  CHECK(q1.residual < 0.02);
}

TEST_CASE("A8c: the relaxation integral I(x) has the sheet's six values, and is its integral for any x") {
  const std::array<std::array<double, 2>, 6> table{
      {{0.1, 0.9611}, {0.5, 0.8257}, {1.0, 0.6929}, {2.0, 0.5100}, {5.0, 0.2653}, {10.0, 0.1420}}};
  for (const auto& [x, value] : table) CHECK(std::fabs(ramp_relaxation(x) - value) <= 0.5001e-4);
  CHECK(ramp_relaxation(0.0) == 1.0);
  for (const double x : {1e-12, 1e-3, 0.3, 3.0, 20.0, 49.9, 50.1, 80.0, 300.0}) {  // u = s^2
    CAPTURE(x);
    const auto part = [x](double s) { return 3.0 * s * s * std::exp(-(1.0 - s * s) * x); };
    const double expected = test::integral(part, 0.0, 0.8) + test::integral(part, 0.8, 1.0);
    CHECK(relative_error(ramp_relaxation(x), expected) < 1e-12);
  }
  CHECK(ramp_relaxation(1e6) == doctest::Approx(1.5e-6).epsilon(1e-6).scale(0.0));
  CHECK(ramp_relaxation(1e300) > 0.0);
}

TEST_CASE("Hertz: bad parameters are told by name and value") {
  CHECK(test::complaint_about(sphere).empty());
  CHECK(test::complaint_about(Hertz{.radius = 0.0, .youngs_modulus = 1.0, .poisson_ratio = 0.2}) ==
        "lattice_spring::Hertz: radius must be finite and > 0 m, got 0");
  CHECK(test::complaint_about(Hertz{.radius = 1.0, .youngs_modulus = -1.0, .poisson_ratio = 0.2}) ==
        "lattice_spring::Hertz: youngs_modulus must be finite and > 0 Pa, got -1");
  CHECK(test::complaint_about(Hertz{.radius = 1.0, .youngs_modulus = 1.0, .poisson_ratio = 0.6}) ==
        "lattice_spring::Hertz: poisson_ratio must be > -1 and <= 0.5, got 0.6");
  const std::vector<double> one{1.0}, two{1.0, 2.0}, fall{2.0, 1.0}, same{1.0, 1.0};
  CHECK(complaint([&] { return fit_hertz(one, one, 1.0, 0.25); }) ==
        "lattice_spring::fit_hertz: points must number 2 or more, 1 with a fixed zero, got 1");
  CHECK(complaint([&] { return fit_hertz(two, one, 1.0, 0.25); }) == "lattice_spring::fit_hertz: forces must number 2, got 1");
  CHECK(complaint([&] { return fit_hertz(same, two, 1.0, 0.25); }) ==
        "lattice_spring::fit_hertz: approaches must not all be the same, or 0, sum of squares > 0 m^2, got 0");
  CHECK(complaint([&] { return fit_hertz(two, fall, 1.0, 0.25); })
            .starts_with("lattice_spring::fit_hertz: the force must grow with the approach, slope of F^(2/3) > 0 N^(2/3)/m, got -0.58"));
  CHECK(complaint([] { return ramp_relaxation(-1.0); }) == "lattice_spring::ramp_relaxation: x must be finite and >= 0 T/tau, got -1");
  CHECK(complaint([] { return hertz_axis_stress(-1.0, 0.2); }) ==
        "lattice_spring::hertz_axis_stress: zeta must be finite and >= 0 contact radii, got -1");
}
