#include "bond/laws.hpp"
#include <dmp/bond/breaking.hpp>
#include <dmp/bond/dispersive.hpp>
#include <dmp/bond/harmonic.hpp>

namespace bond = dmp::bond;
using Seen = bond::Dispersing<bond::Stretch<double>, double>;

TEST_CASE("a dispersive bond that is alone obeys the laws of bonds: a spring k (1 - |D| + D)") {
  static_assert(sizeof(bond::Dispersive) == 2 * sizeof(double) && !bond::UsesVelocity<bond::Dispersive>);
  static_assert(bond::IsDispersive<bond::Dispersive> && !bond::IsDispersive<bond::Harmonic>);
  static_assert(bond::IsDispersive<bond::Breaking<bond::Dispersive, bond::LargestStrain>>);
  for (const double share : {-0.25, 0.0, 0.3, 0.97}) {
    CAPTURE(share);
    check_bond_laws(bond::Dispersive{.stiffness = 10.0, .dispersive_share = share});
    check_bond_laws(bond::Dispersive{.stiffness = 1e12, .dispersive_share = share});
  }
  check_bond_laws(bond::Dispersive{.stiffness = 0.0, .dispersive_share = 0.3});
  const bond::Dispersive limp{.stiffness = 10.0, .dispersive_share = -0.5};  // alone it stretches as its volume does, which nothing resists
  for (const double length : {0.5, 0.8, 1.3}) CHECK(std::fabs(limp.tension(Seen{{length, 0.8}, 2.0 * (length / 0.8 - 1.0)})) <= 1e-14);
}

TEST_CASE("two dispersive bonds in a row share half of what either resists: forces by hand from the energy") {
  // Beads 0, 1, 2 with r0 = 1 and 2, k = 3, D = 0.4, stretched by 0.1 and -0.1: theta = 0.3, -0.3, -0.6 and S = 3, 15, 12 (beads 0, 1, 2)
  // U = (1/2) 0.6 3 (0.01 + 0.01) + 0.1 (0.03 + 0.006 + 0.03): dU/dl0 = 0.18 + 0.2 (0.3 - 0.06), dU/dl1 = -0.18 + 0.2 (-0.12 - 0.3)
  const bond::Dispersive law{.stiffness = 3.0, .dispersive_share = 0.4};
  const Seen first{{1.1, 1.0}, 0.3 / 3.0 - 0.3 / 15.0}, second{{1.9, 2.0}, -0.3 / 15.0 - 0.6 / 12.0};
  CHECK(law.tension(first) == doctest::Approx(0.228).epsilon(1e-12));
  CHECK(law.tension(second) == doctest::Approx(-0.264).epsilon(1e-12));
  CHECK(law.energy(first) + law.energy(second) == doctest::Approx(0.018 + 0.1 * (0.09 / 3.0 + 0.09 / 15.0 + 0.36 / 12.0)).epsilon(1e-12));
}

TEST_CASE("a dispersive bond refuses a stiffness or a share that is none") {
  const auto complaint = [](double stiffness, double share) {
    return test::complaint_about(bond::Dispersive{.stiffness = stiffness, .dispersive_share = share});
  };
  CHECK(complaint(-1.0, 0.0) == "bond::Dispersive: stiffness must be finite and >= 0 N/m, got -1");
  CHECK(complaint(1.0, -0.51) == "bond::Dispersive: dispersive_share must be >= -0.5 and < 1, got -0.51");
  CHECK(complaint(1.0, 1.0) == "bond::Dispersive: dispersive_share must be >= -0.5 and < 1, got 1");
  CHECK(complaint(1.0, NAN) == "bond::Dispersive: dispersive_share must be >= -0.5 and < 1, got nan");
  CHECK(complaint(1.0, -0.5) == "");
}
