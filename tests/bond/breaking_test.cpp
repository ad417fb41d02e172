#include "bond/laws.hpp"
#include <dmp/bond/breaking.hpp>
#include <dmp/bond/harmonic.hpp>
#include <dmp/bond/kelvin_voigt.hpp>
#include <dmp/bond/standard_linear_solid.hpp>

namespace bond = dmp::bond;

TEST_CASE("a bond that may break obeys the laws of the bond inside of it, and adds one number") {
  const bond::Breaking spring{bond::Harmonic{.stiffness = 10.0}, bond::LargestStrain{.strain = 0.1}};
  static_assert(bond::CanBreak<decltype(spring)> && !bond::CanBreak<bond::Harmonic> && !bond::UsesVelocity<decltype(spring)>);
  static_assert(sizeof spring == 2 * sizeof(double));
  check_bond_laws(spring);
  check_bond_laws(bond::Breaking{bond::KelvinVoigt{.stiffness = 10.0, .damping = 2.0}, bond::LargestEnergy{.energy = 0.1}});
  check_bond_laws(bond::Breaking{bond::StandardLinearSolid{.stiffness = 10.0, .branch_stiffness = 5.0, .branch_damping = 1.0},
                                 bond::LargestStrain{.strain = 1.0}});
}

TEST_CASE("a strain is of tension, an energy of either sign") {
  const bond::Harmonic spring{.stiffness = 8.0};
  const auto by_strain = [&](double length) {
    return bond::Breaking{spring, bond::LargestStrain{.strain = 0.25}}.breaks(bond::Stretch<double>{length, 2.0});
  };
  CHECK(!by_strain(2.5));
  CHECK(by_strain(2.5 + 1e-12));
  CHECK(!by_strain(0.0));
  const auto by_energy = [&](double length) {
    return bond::Breaking{spring, bond::LargestEnergy{.energy = 1.0}}.breaks(bond::Stretch<double>{length, 2.0});
  };
  CHECK(!by_energy(2.5));  // (1/2) 8 0.5^2 = 1
  CHECK(by_energy(2.5 + 1e-12));
  CHECK(!by_energy(1.5));
  CHECK(by_energy(1.5 - 1e-12));
}

TEST_CASE("parameters of breaking are checked, and those of the bond inside") {
  const auto strained = [](double stiffness, double strain) {
    return bond::Breaking{bond::Harmonic{.stiffness = stiffness}, bond::LargestStrain{.strain = strain}};
  };
  CHECK(test::complaint_about(strained(1.0, -0.1)) == "bond::LargestStrain: strain must be finite and >= 0, got -0.1");
  CHECK(test::complaint_about(strained(-1.0, 0.1)) == "bond::Harmonic: stiffness must be finite and >= 0 N/m, got -1");
  CHECK(test::complaint_about(bond::Breaking{bond::Harmonic{.stiffness = 1.0}, bond::LargestEnergy{.energy = -1.0}}) ==
        "bond::LargestEnergy: energy must be finite and >= 0 J, got -1");
  CHECK(test::complaint_about(strained(1.0, 0.1)).empty());
}
