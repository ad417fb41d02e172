#include "bond/laws.hpp"
#include <dmp/bond/harmonic.hpp>

namespace bond = dmp::bond;

TEST_CASE("a harmonic bond obeys the laws of bonds") {
  static_assert(sizeof(bond::Harmonic) == sizeof(double) && !bond::UsesVelocity<bond::Harmonic>);
  check_bond_laws(bond::Harmonic{.stiffness = 10.0});
  check_bond_laws(bond::Harmonic{.stiffness = 14500.0});
  check_bond_laws(bond::Harmonic{.stiffness = 1e12});
  check_bond_laws(bond::Harmonic{.stiffness = 0.0});
}

TEST_CASE("a weight of 1 N hangs 0.1 m deep on a spring of 10 N/m, which then holds half its lost height") {
  const bond::Harmonic spring{.stiffness = 10.0};
  const bond::Stretch<double> hanging{.length = 0.6, .rest_length = 0.5};
  CHECK(spring.tension(hanging) == doctest::Approx(1.0).epsilon(1e-12));
  CHECK(spring.energy(hanging) == doctest::Approx(0.5 * 1.0 * 0.1).epsilon(1e-12));
}

TEST_CASE("a harmonic bond pulls when stretched and pushes when squeezed") {
  const bond::Harmonic spring{.stiffness = 3.0};
  CHECK(spring.tension(bond::Stretch<double>{1.1, 1.0}) > 0.0);
  CHECK(spring.tension(bond::Stretch<double>{0.9, 1.0}) < 0.0);
}

TEST_CASE("a harmonic bond refuses a stiffness that is none") {
  CHECK(test::complaint_about(bond::Harmonic{.stiffness = -1.0}) == "bond::Harmonic: stiffness must be finite and >= 0 N/m, got -1");
  CHECK(test::complaint_about(bond::Harmonic{.stiffness = NAN}) == "bond::Harmonic: stiffness must be finite and >= 0 N/m, got nan");
  CHECK(test::complaint_about(bond::Harmonic{.stiffness = INFINITY}) == "bond::Harmonic: stiffness must be finite and >= 0 N/m, got inf");
}
