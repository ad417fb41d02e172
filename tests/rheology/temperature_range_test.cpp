#include "rheology/laws.hpp"
#include <dmp/rheology/temperature_range.hpp>

namespace {
constexpr dmp::rheology::TemperatureRange range{.lowest = 273.0, .highest = 373.0};
}  // namespace

TEST_CASE("a range of temperatures contains its ends, and the nearest temperature of it is an end or the temperature itself") {
  for (const double inside : {273.0, 300.0, 373.0}) {
    CHECK(range.contains(inside));
    CHECK(range.nearest(inside) == inside);
  }
  CHECK_FALSE(range.contains(272.99));
  CHECK_FALSE(range.contains(373.01));
  CHECK_FALSE(range.contains(std::nan("")));
  CHECK(range.nearest(-5.0) == 273.0);
  CHECK(range.nearest(1e9) == 373.0);
  CHECK(std::isnan(range.nearest(std::nan(""))));
  CHECK(dmp::rheology::demand_of("own::Law", range) == "own::Law: temperature must be in [273, 373] K");
}
