#include "rheology/laws.hpp"
#include <dmp/rheology/arrhenius.hpp>
#include <dmp/rheology/clamped.hpp>
#include <dmp/rheology/sutherland.hpp>

namespace rheology = dmp::rheology;

namespace {
constexpr rheology::Arrhenius liquid{
    .pre_exponential_factor = 1.83e-4, .activation_temperature = 1879.9, .temperature_range = {.lowest = 295.0, .highest = 331.0036}};
}  // namespace

TEST_CASE("a clamped law is its law within the range, and stays at the ends outside of it") {
  const rheology::Clamped clamped{liquid};
  static_assert(rheology::ViscosityOfTemperature<rheology::Clamped<rheology::Arrhenius>>);
  static_assert(requires(const rheology::Clamped<rheology::Arrhenius> law) { law.demand(); });
  static_assert(sizeof clamped == sizeof liquid && test::is_plain<rheology::Clamped<rheology::Arrhenius>>);
  validate(clamped);
  for (const double temperature : test::evenly(295.0, 331.0036, 33)) CHECK(clamped.viscosity(temperature) == liquid.viscosity(temperature));
  for (const double cold : {294.999, 93.0, 2.0, 1e-300}) CHECK(test::relative_error(clamped.viscosity(cold), 0.107154664) < 1e-5);
  for (const double hot : {331.1, 1000.0, 1e300}) CHECK(test::relative_error(clamped.viscosity(hot), 0.0535773) < 1e-5);
  const auto mu = [&clamped](const auto& temperature) { return clamped.viscosity(temperature); };
  test::check_lanes(mu, test::evenly(1.0, 1000.0, 128));
  test::check_monotone(mu, test::evenly(1.0, 1000.0, 128), Becomes::thinner);
  CHECK(test::slope(mu, 300.0) == test::slope([](const auto& temperature) { return liquid.viscosity(temperature); }, 300.0));
  CHECK(test::slope(mu, 200.0) == 0.0);
}

TEST_CASE("a clamped law admits every temperature that is one") {
  const rheology::Clamped clamped{liquid};
  for (const double temperature : {1e-300, 93.0, 300.0, 1e300}) CHECK(clamped.admits(temperature));
  for (const double none : {0.0, -110.4, static_cast<double>(INFINITY), static_cast<double>(NAN)}) CHECK_FALSE(clamped.admits(none));
  CHECK(std::isnan(clamped.viscosity(std::nan(""))));  // nothing is made up
  CHECK(clamped.demand() == "rheology::Clamped: temperature must be finite and > 0 K");
}

TEST_CASE("a clamped law refuses what its law refuses") {
  auto wrong = liquid;
  wrong.temperature_range = {.lowest = 300.0, .highest = 200.0};
  CHECK(test::complaint_about(rheology::Clamped{wrong}) ==
        "rheology::Arrhenius: temperature_range.highest must be finite and > temperature_range.lowest = 300 K, got 200");
  CHECK(test::complaint_about(rheology::Clamped{rheology::Sutherland{
            .coefficient = -1.0, .sutherland_temperature = 0.0, .temperature_range = {.lowest = 1.0, .highest = 2.0}}}) ==
        "rheology::Sutherland: coefficient must be finite and > 0 Pa s K^(-1/2), got -1");
}
