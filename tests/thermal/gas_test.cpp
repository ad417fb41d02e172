#include "thermal/laws.hpp"
#include <dmp/eos/ideal_gas.hpp>
#include <dmp/thermal/gas.hpp>

namespace thermal = dmp::thermal;

TEST_CASE("a gas obeys the laws of thermal laws") {
  check_thermal_laws(thermal::Gas{.molar_mass = 0.018}, 200.0, 2000.0);
  check_thermal_laws(thermal::Gas{.molar_mass = 0.004002602, .heat_capacity_ratio = 5.0 / 3.0}, 1.0, 1e6);
}

TEST_CASE("the gas constant is that of the SI: Boltzmann's times Avogadro's") {
  CHECK(test::relative_error(thermal::Gas::gas_constant, 1.380649e-23 * 6.02214076e23) < 1e-15);
}

TEST_CASE("steam of 18 g/mol and gamma 1.4, as the code of Albano et al. has it, takes 1154.8 J/(kg K)") {
  CHECK(std::fabs(thermal::Gas{.molar_mass = 0.018}.specific_heat() - 1154.8) < 0.05);
}

TEST_CASE("air of the standard atmosphere at sea level, 101325 Pa and 1.2250 kg/m^3, has 288.15 K") {
  const thermal::Gas air{.molar_mass = 0.02896442};  // ISO 2533, whose gas constant is 8.31432 J/(mol K)
  const double e = dmp::eos::IdealGas{}.specific_energy(101325.0, 1.2250);
  CHECK(air.temperature(e) == doctest::Approx(288.15).epsilon(3e-5));
}

TEST_CASE("an atom of a monatomic gas has the energy (3/2) k T") {
  const double atom = 6.6464731e-27;  // helium [kg]
  const thermal::Gas helium{.molar_mass = atom * 6.02214076e23, .heat_capacity_ratio = 5.0 / 3.0};
  CHECK(test::relative_error(helium.specific_energy(300.0) * atom, 1.5 * 1.380649e-23 * 300.0) < 1e-14);
}

TEST_CASE("a gas does not admit energies of 0 and less") {
  const thermal::Gas steam{.molar_mass = 0.018};
  CHECK(steam.admits(1e-9));
  for (const double nothing : {0.0, -1.0, double(NAN)}) CHECK_FALSE(steam.admits(nothing));
  CHECK(steam.demand() == "thermal::Gas: temperature must be > 0 K, that is specific_energy > 0 J/kg");
}

TEST_CASE("a gas refuses parameters that are none, and a molar mass in g/mol") {
  CHECK(test::complaint_about(thermal::Gas{.molar_mass = 18.0}) ==
        "thermal::Gas: molar_mass must be > 0 and < 1 kg/mol (not g/mol or kg/kmol), got 18");
  CHECK(test::complaint_about(thermal::Gas{.molar_mass = 0.0}) ==
        "thermal::Gas: molar_mass must be > 0 and < 1 kg/mol (not g/mol or kg/kmol), got 0");
  CHECK(test::complaint_about(thermal::Gas{.molar_mass = 0.018, .heat_capacity_ratio = 1.0}) ==
        "thermal::Gas: heat_capacity_ratio must be > 1 and < 1000, got 1");
}
