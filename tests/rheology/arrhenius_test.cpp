#include "rheology/laws.hpp"
#include <dmp/rheology/arrhenius.hpp>

namespace rheology = dmp::rheology;

namespace {
/// The liquid of the channel with one hot wall, sheet 06, sections 2.9 and 4.4.
rheology::Arrhenius liquid(double lowest = 273.0, double highest = 400.0) {
  return {.pre_exponential_factor = 1.83e-4, .activation_temperature = 1879.9, .temperature_range = {.lowest = lowest, .highest = highest}};
}
template <class Law>
concept DoesWithoutRange = requires {
  Law{1.0, 2.0};
};
}  // namespace

TEST_CASE("Arrhenius' liquid obeys the laws of a viscosity of the temperature, and thins when heated") {
  static_assert(!DoesWithoutRange<rheology::Arrhenius>);
  check_viscosity_of_temperature_laws(liquid(), Becomes::thinner);
  check_viscosity_of_temperature_laws(liquid(250.0, 251.0), Becomes::thinner);
  check_viscosity_of_temperature_laws(
      rheology::Arrhenius{
          .pre_exponential_factor = 0.1, .activation_temperature = 0.0, .temperature_range = {.lowest = 1.0, .highest = 1e4}},
      Becomes::thinner);
}

TEST_CASE("VISC-0: values of Arrhenius' liquid") {
  CHECK(test::relative_error(liquid().viscosity(295.0), 0.107154664) < 1e-5);
  CHECK(test::relative_error(liquid().viscosity(300.0), 0.0963574) < 1e-5);
  CHECK(test::relative_error(liquid().viscosity(331.0036), 0.0535773) < 1e-5);
  const rheology::Arrhenius water{// what the paper must have meant
                                  .pre_exponential_factor = 1.83e-6,
                                  .activation_temperature = 1879.9,
                                  .temperature_range = {.lowest = 273.0, .highest = 373.0}};
  CHECK(test::relative_error(water.viscosity(295.0), 1.0715e-3) < 1e-4);  // printed with 5 digits
}

TEST_CASE("VISC-0: viscosity across the channel, cold wall at 295 K, hot wall where the liquid is 1.5, 2, 3 and 5 times as thin") {
  struct Column {
    double ratio, warming, at_tenth, in_middle, at_nine_tenths;  // rows y = 0.1, 0.5, 0.9 of the table
  };
  for (const Column c : {Column{1.5, 20.0454, 1.43685, 1.21661, 1.03895}, Column{2.0, 36.0036, 1.85208, 1.38630, 1.06445},
                         Column{3.0, 61.4514, 2.63419, 1.64459, 1.09693}, Column{5.0, 99.6796, 4.05986, 1.99055, 1.13135}}) {
    CAPTURE(c.ratio);
    const auto ratio = [&](double y) { return liquid().viscosity(295.0 + y * c.warming) / liquid().viscosity(295.0 + c.warming); };
    CHECK(test::relative_error(ratio(0.0), c.ratio) < 1e-5);
    CHECK(test::relative_error(ratio(0.1), c.at_tenth) < 1e-5);
    CHECK(test::relative_error(ratio(0.5), c.in_middle) < 1e-5);
    CHECK(test::relative_error(ratio(0.9), c.at_nine_tenths) < 1e-5);
  }
}

TEST_CASE("Arrhenius' liquid does not admit 93 K, where it would be a million times as viscous as at 295 K") {
  CHECK_FALSE(liquid().admits(93.0));
  CHECK(liquid().viscosity(93.0) / liquid().viscosity(295.0) == doctest::Approx(1e6).epsilon(0.05));
  CHECK(liquid().demand() == "rheology::Arrhenius: temperature must be in [273, 400] K");
}

TEST_CASE("Arrhenius' liquid refuses ranges that reach where its viscosity is infinite, and parameters of no liquid") {
  CHECK(test::complaint_about(liquid(2.7)).empty());
  CHECK(test::complaint_about(liquid(2.6)) ==
        "rheology::Arrhenius: viscosity at 2.6 K, an end of temperature_range, must be finite and > 0 Pa s, got inf");
  auto law = liquid();
  law.pre_exponential_factor = 0.0;
  CHECK(test::complaint_about(law) == "rheology::Arrhenius: pre_exponential_factor must be finite and > 0 Pa s, got 0");
  law = liquid();
  law.activation_temperature = -1.0;
  CHECK(test::complaint_about(law) == "rheology::Arrhenius: activation_temperature must be finite and >= 0 K, got -1");
}
