#pragma once
#include <cmath>
#include <limits>
#include <string>
#include <vector>
#include "support/compare.hpp"
#include "support/dual.hpp"
#include <doctest/doctest.h>
#include <dmp/core/field.hpp>
#include <dmp/core/pack.hpp>
#include <dmp/rheology/concept.hpp>
#include <dmp/rheology/temperature_range.hpp>

/// What every law of the dynamic viscosity must obey: it writes that, a number >= 0, on double and on packs alike.
template <class R>
void check_rheology_laws(const R& law) {
  static_assert(test::is_plain<R>);
  static_assert(dmp::contains<dmp::field::DynamicViscosity, typename R::writes>);
  validate(law);
  using List = dmp::unite<typename R::reads, typename R::writes>;
  dmp::View<3, double, List> particle{};
  law.apply(particle);
  CHECK(particle.dynamic_viscosity >= 0.0);
  CHECK(std::isfinite(particle.dynamic_viscosity));
  dmp::View<3, dmp::Pack<double, 2>, List> pack{};
  law.apply(pack);
  CHECK(test::relative_error(pack.dynamic_viscosity[0], particle.dynamic_viscosity) < 1e-14);
  CHECK(test::relative_error(pack.dynamic_viscosity[1], particle.dynamic_viscosity) < 1e-14);
}

/// What heating a fluid, or shearing it faster, does to its viscosity.
enum class Becomes { thinner, thicker };

namespace test {
/// mu goes one way, or stays, from each number of x to the next.
template <class Function>
void check_monotone(const Function& mu, const std::vector<double>& x, Becomes becomes) {
  for (std::size_t n = 1; n < x.size(); ++n) {
    CAPTURE(x[n - 1]);
    CAPTURE(x[n]);
    const double before = mu(x[n - 1]), after = mu(x[n]), rounding = 1e-14 * before;
    CHECK((becomes == Becomes::thinner ? after <= before + rounding : after >= before - rounding));
  }
}
template <class Function>
void check_lanes(const Function& mu, const std::vector<double>& x) {
  CHECK(lane_error<double, 2>(mu, x) < 1e-14);
  CHECK(lane_error<double, 4>(mu, x) < 1e-14);
  CHECK(lane_error<double, dmp::native_width<double>>(mu, x) < 1e-14);
  CHECK(lane_error<float, 4>(mu, x) < 1e-5);
  CHECK(lane_error<float, dmp::native_width<float>>(mu, x) < 1e-5);
}

/// `law` is rid of its range, gets other ones that are none, and must complain of what is wrong.
template <class Law>
void check_refuses_ranges(Law law) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto complaint = [&law](double lowest, double highest) {
    law.temperature_range = {.lowest = lowest, .highest = highest};
    return complaint_about(law);
  };
  const std::string type = law.demand().substr(0, law.demand().find(": "));
  for (const double wrong : {0.0, -1.0, infinity, std::nan("")})
    CHECK(complaint(wrong, 300.0) == type + ": temperature_range.lowest must be finite and > 0 K, got " + dmp::to_text(wrong));
  for (const double wrong : {300.0, 299.0, -1.0, infinity, std::nan("")})
    CHECK(complaint(300.0, wrong) ==
          type + ": temperature_range.highest must be finite and > temperature_range.lowest = 300 K, got " + dmp::to_text(wrong));
}
}  // namespace test

/// What every law mu(T) must obey over the range that it states: finite and > 0, the same on packs, moving as `heated` says, with a
/// derivative; and it admits that range, both ends of it, and nothing else.
template <dmp::rheology::ViscosityOfTemperature L>
void check_viscosity_of_temperature_laws(const L& law, Becomes heated) {
  static_assert(test::is_plain<L>);
  static_assert(requires(const L l) { l.admits(1.0), l.demand(); });
  static_assert(!L::name.empty());
  constexpr double infinity = std::numeric_limits<double>::infinity();
  validate(law);
  const double low = law.temperature_range.lowest, high = law.temperature_range.highest;
  const auto mu = [&law](const auto& temperature) { return law.viscosity(temperature); };
  const auto range = test::evenly(low, high, 256);
  for (const double temperature : range) {
    CAPTURE(temperature);
    CHECK(mu(temperature) > 0.0);
    CHECK(std::isfinite(mu(temperature)));
    CHECK(law.admits(temperature));
  }
  test::check_monotone(mu, range, heated);
  test::check_lanes(mu, range);
  for (const double temperature : {low, 0.5 * (low + high), high}) {  // mu is smooth, also seen through another number type
    const double step = 1e-5 * temperature;
    CHECK(test::relative_error(test::slope(mu, temperature), (mu(temperature + step) - mu(temperature - step)) / (2.0 * step)) < 1e-6);
  }
  for (const double outside : {std::nextafter(low, 0.0), std::nextafter(high, infinity), 0.0, -300.0, infinity, -infinity, std::nan("")})
    CHECK_FALSE(law.admits(outside));
  CHECK(std::string(law.demand()).ends_with(": temperature must be in [" + dmp::to_text(low) + ", " + dmp::to_text(high) + "] K"));
  test::check_refuses_ranges(law);
}

/// What every law mu(shear rate) must obey: finite at every shear rate, rest included, within [lowest, highest]; the same on packs;
/// moving as `sheared` says.
template <dmp::rheology::ViscosityOfShearRate L>
void check_viscosity_of_shear_rate_laws(const L& law, Becomes sheared, double lowest, double highest) {
  static_assert(test::is_plain<L>);
  static_assert(!L::name.empty());
  validate(law);
  const auto mu = [&law](const auto& shear_rate) { return law.apparent_viscosity(shear_rate); };
  std::vector<double> rates{0.0, std::numeric_limits<double>::denorm_min(), 1e-200};
  for (const double power_of_ten : test::evenly(-12.0, 12.0, 97)) rates.push_back(std::pow(10.0, power_of_ten));
  for (const double rate : {1e30, 1e200, std::numeric_limits<double>::max()}) rates.push_back(rate);
  for (const double rate : rates) {
    CAPTURE(rate);
    CHECK(mu(rate) >= lowest * (1.0 - 1e-14));
    CHECK(mu(rate) <= highest * (1.0 + 1e-14));
  }
  test::check_monotone(mu, rates, sheared);
  CHECK(test::relative_error(mu(0.0), mu(1e-200)) < 1e-12);  // no jump at rest

  std::vector<double> in_float(rates.begin() + 3, rates.end() - 2);  // 1e-12 to 1e30, and zeros, in lanes beside each other
  for (int n = 0; n < 30; ++n) in_float.insert(in_float.begin() + 2 * n, 0.0);
  test::check_lanes(mu, in_float);

  const test::Dual at_rest = mu(test::Dual(0.0, 1.0));
  CHECK(at_rest.value == mu(0.0));
  CHECK_FALSE(std::isnan(at_rest.derivative));
}
