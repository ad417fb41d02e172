#include "rheology/laws.hpp"
#include <dmp/rheology/carreau.hpp>

namespace rheology = dmp::rheology;

namespace {
rheology::Carreau fluid(double at_rest, double in_fast_shear, double index) {
  return {.zero_shear_viscosity = at_rest, .infinite_shear_viscosity = in_fast_shear, .time_constant = 0.25, .power_law_index = index};
}
}  // namespace

TEST_CASE("Carreau's fluid obeys the laws of a viscosity of the shear rate, and stays between its plateaus") {
  check_viscosity_of_shear_rate_laws(fluid(0.056, 0.00345, 0.3568), Becomes::thinner, 0.00345, 0.056);  // blood
  check_viscosity_of_shear_rate_laws(fluid(10.0, 0.0, 0.01), Becomes::thinner, 0.0, 10.0);
  check_viscosity_of_shear_rate_laws(fluid(1.0, 10.0, 0.5), Becomes::thicker, 1.0, 10.0);
  check_viscosity_of_shear_rate_laws(fluid(10.0, 1.0, 1.0), Becomes::thinner, 10.0, 10.0);
}

TEST_CASE("Carreau's fluid has its plateaus at rest and in very fast shear") {
  CHECK(fluid(9.0, 1.0, 0.5).apparent_viscosity(0.0) == 9.0);
  CHECK(fluid(9.0, 1.0, 0.5).apparent_viscosity(1e30) == doctest::Approx(1.0));
  CHECK(fluid(9.0, 1.0, 0.5).apparent_viscosity(4.0 * std::sqrt(15.0)) == doctest::Approx(5.0));  // 16^(-1/4) = 1/2: half-way
  CHECK(test::slope([](const auto& rate) { return fluid(9.0, 1.0, 0.5).apparent_viscosity(rate); }, 0.0) == 0.0);
}

TEST_CASE("Carreau's fluid approaches the fast plateau as the power n - 1 of the shear rate, the slow one as the square") {
  const auto above = [](double rate) { return fluid(9.0, 1.0, 0.5).apparent_viscosity(rate) - 1.0; };
  CHECK(above(1e8) / above(4e8) == doctest::Approx(2.0).epsilon(1e-6));
  const auto below = [](double rate) { return 9.0 - fluid(9.0, 1.0, 0.5).apparent_viscosity(rate); };
  CHECK(below(2e-3) / below(1e-3) == doctest::Approx(4.0).epsilon(1e-5));
}

TEST_CASE("Carreau's fluid refuses parameters that are none, and n > 1, which has no bound") {
  CHECK(test::complaint_about(fluid(0.0, 1.0, 1.0)) == "rheology::Carreau: zero_shear_viscosity must be finite and > 0 Pa s, got 0");
  CHECK(test::complaint_about(fluid(1.0, -1.0, 1.0)) == "rheology::Carreau: infinite_shear_viscosity must be finite and >= 0 Pa s, got -1");
  CHECK(test::complaint_about(fluid(1.0, 0.0, 1.1)) == "rheology::Carreau: power_law_index must be > 0 and <= 1, got 1.1");
  CHECK(test::complaint_about(fluid(1.0, 0.0, 0.0)) == "rheology::Carreau: power_law_index must be > 0 and <= 1, got 0");
  auto law = fluid(1.0, 0.0, 1.0);
  law.time_constant = 0.0;
  CHECK(test::complaint_about(law) == "rheology::Carreau: time_constant must be finite and > 0 s, got 0");
}
