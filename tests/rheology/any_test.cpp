#include "rheology/laws.hpp"
#include <dmp/rheology/any.hpp>

namespace rheology = dmp::rheology;

namespace {
constexpr rheology::TemperatureRange range{.lowest = 273.0, .highest = 373.0};

/// mu of the law of this name at this temperature [K].
double viscosity(std::string_view name, const std::vector<double>& coefficients, double temperature) {
  return std::visit(
      [&](const auto& law) -> double {
        if constexpr (rheology::ViscosityOfTemperature<std::decay_t<decltype(law)>>) return law.viscosity(temperature);
        else return law.dynamic_viscosity;
      },
      rheology::by_name(name, coefficients, range));
}
std::string complaint(std::string_view name, const std::vector<double>& coefficients) {
  try {
    static_cast<void>(rheology::by_name(name, coefficients, range));
  } catch (const dmp::ParameterError& error) {
    return error.what();
  }
  return {};
}
}  // namespace

TEST_CASE("VISC-0: values of the laws, chosen by our names and by those of the LAMMPS command") {
  static_assert(std::is_trivially_copyable_v<rheology::Any>);
  for (const auto name : {"arrhenius", "Arrhenius"})
    CHECK(test::relative_error(viscosity(name, {1.83e-4, 1879.9}, 295.0), 0.107154664) < 1e-5);
  for (const auto name : {"andrade", "FourParameterExp"})
    CHECK(test::relative_error(viscosity(name, {1e-6, 1000.0, 1e-3, 1e-6}, 300.0), 4.1402e-5) < 1e-5);
  for (const auto name : {"sutherland", "SutherlandViscosityLaw"})
    CHECK(test::relative_error(viscosity(name, {1.458e-6, 110.4}, 300.0), 1.84600e-5) < 1e-5);
  for (const auto name : {"power-law gas", "PowerLawGas"})
    CHECK(test::relative_error(viscosity(name, {4.093e-7, 2.0 / 3.0}, 300.0), 1.83424e-5) < 1e-5);
  for (const auto name : {"constant", "Constant"}) CHECK(viscosity(name, {0.003}, 300.0) == 0.003);
}

TEST_CASE("a law chosen by name has the range that it was given") {
  const auto law = std::get<rheology::Andrade>(rheology::by_name("andrade", std::vector{1.0, 2.0, 3e-3, 4e-6}, range));
  CHECK(law.pre_exponential_factor == 1.0);
  CHECK(law.inverse_coefficient == 2.0);
  CHECK(law.linear_coefficient == 3e-3);
  CHECK(law.quadratic_coefficient == 4e-6);
  CHECK(law.demand() == "rheology::Andrade: temperature must be in [273, 373] K");
}

TEST_CASE("an unknown name is refused with all names that are known") {
  CHECK(complaint("Newton", {1.0}) ==
        "rheology::by_name: no law is called 'Newton'; known names (and those of LAMMPS) are constant (Constant), andrade "
        "(FourParameterExp), arrhenius (Arrhenius), sutherland (SutherlandViscosityLaw), power-law gas (PowerLawGas)");
  CHECK(complaint("", {}).starts_with("rheology::by_name: no law is called ''; known names"));
}

TEST_CASE("a wrong number of coefficients is refused, and so is what the law itself refuses") {
  CHECK(complaint("PowerLawGas", {4.093e-7}) == "rheology::by_name: the number of coefficients of PowerLawGas must be 2, got 1");
  CHECK(complaint("arrhenius", {1.0, 2.0, 3.0}) == "rheology::by_name: the number of coefficients of arrhenius must be 2, got 3");
  CHECK(complaint("andrade", {}) == "rheology::by_name: the number of coefficients of andrade must be 4, got 0");
  CHECK(complaint("constant", {}) == "rheology::by_name: the number of coefficients of constant must be 1, got 0");
  CHECK(complaint("Arrhenius", {-1.0, 2.0}) == "rheology::Arrhenius: pre_exponential_factor must be finite and > 0 Pa s, got -1");
  CHECK(complaint("constant", {-1.0}) == "rheology::Constant: dynamic_viscosity must be finite and >= 0 Pa s, got -1");
}
