#include "support/compare.hpp"
#include <doctest/doctest.h>
#include <dmp/core/field.hpp>
#include <dmp/core/pack.hpp>
#include <dmp/eos/concept.hpp>
#include <dmp/eos/constant_density.hpp>

namespace eos = dmp::eos;

TEST_CASE("a constant density is a material law that reads nothing, and no equation of state") {
  static_assert(test::is_plain<eos::ConstantDensity> && sizeof(eos::ConstantDensity) == sizeof(double));
  static_assert(eos::ConstantDensity::reads::count == 0);
  static_assert(std::is_same_v<eos::ConstantDensity::writes, dmp::Fields<dmp::field::Density>>);
  static_assert(!eos::EquationOfState<eos::ConstantDensity> && !eos::ThermalEquationOfState<eos::ConstantDensity>);
}

TEST_CASE("copper of 8960 kg/m^3 has 8960 kg/m^3 everywhere, in numbers and in packs") {
  const eos::ConstantDensity copper{.density = 8960.0};
  validate(copper);
  dmp::View<2, double, dmp::Fields<dmp::field::Density>> particle{};
  copper.apply(particle);
  CHECK(particle.density == 8960.0);
  dmp::View<2, dmp::Pack<double, 2>, dmp::Fields<dmp::field::Density>> particles{};
  copper.apply(particles);
  CHECK(particles.density[0] == 8960.0);
  CHECK(particles.density[1] == 8960.0);
}

TEST_CASE("a constant density refuses to be none") {
  CHECK(test::complaint_about(eos::ConstantDensity{.density = 0.0}) ==
        "eos::ConstantDensity: density must be finite and > 0 kg/m^3, got 0");
  CHECK(test::complaint_about(eos::ConstantDensity{.density = NAN}) ==
        "eos::ConstantDensity: density must be finite and > 0 kg/m^3, got nan");
}
