#include "bond/laws.hpp"
#include <dmp/bond/standard_linear_solid.hpp>

namespace bond = dmp::bond;

TEST_CASE("a standard linear solid obeys the laws of bonds, when stretched suddenly those of both its springs") {
  static_assert(sizeof(bond::StandardLinearSolid) == 3 * sizeof(double) && bond::HasMemory<bond::StandardLinearSolid>);
  check_bond_laws(bond::StandardLinearSolid{.stiffness = 10.0, .branch_stiffness = 5.0, .branch_damping = 0.3});
  check_bond_laws(bond::StandardLinearSolid{.stiffness = 0.0, .branch_stiffness = 5.0, .branch_damping = 0.3});
  check_bond_laws(bond::StandardLinearSolid{.stiffness = 1e9, .branch_stiffness = 0.0, .branch_damping = 0.0});
  check_bond_laws(bond::StandardLinearSolid{.stiffness = 1e9, .branch_stiffness = 1e12, .branch_damping = 1e6});
}

TEST_CASE("a standard linear solid relaxes from k_e + k_m to k_e with the time c_m/k_m") {
  using Bond = bond::Remembering<bond::Stretch<double>, double>;
  const bond::StandardLinearSolid law{.stiffness = 2.0, .branch_stiffness = 6.0, .branch_damping = 3.0};  // tau = 0.5 s
  Bond bond = test::bond_of(law, 1.25, 1.0, 0.0);
  CHECK(law.tension(bond) == 0.25 * 8.0);
  CHECK(law.energy(bond) == 0.5 * 8.0 * 0.25 * 0.25);
  bond.length_change = 0.0;
  const auto after = law.memory_after(0.1);
  for (int n = 1; n <= 100; ++n) {
    bond.memory = after(bond);
    CHECK(law.tension(bond) == doctest::Approx(0.25 * (2.0 + 6.0 * std::exp(-0.1 * n / 0.5))).epsilon(1e-14));
  }
}

TEST_CASE("a standard linear solid refuses parameters that would feed energy") {
  CHECK(test::complaint_about(bond::StandardLinearSolid{.stiffness = -1.0, .branch_stiffness = 1.0, .branch_damping = 0.0}) ==
        "bond::StandardLinearSolid: stiffness must be finite and >= 0 N/m, got -1");
  CHECK(test::complaint_about(bond::StandardLinearSolid{.stiffness = 1.0, .branch_stiffness = -2.0, .branch_damping = 0.0}) ==
        "bond::StandardLinearSolid: branch_stiffness must be finite and >= 0 N/m, got -2");
  CHECK(test::complaint_about(bond::StandardLinearSolid{.stiffness = 1.0, .branch_stiffness = 1.0, .branch_damping = NAN}) ==
        "bond::StandardLinearSolid: branch_damping must be finite and >= 0 N s/m, got nan");
}
