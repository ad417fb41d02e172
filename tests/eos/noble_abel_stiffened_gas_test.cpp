#include <utility>
#include "eos/laws.hpp"
#include <dmp/eos/ideal_gas.hpp>
#include <dmp/eos/noble_abel_stiffened_gas.hpp>

namespace eos = dmp::eos;
using test::Dual, test::relative_error;

namespace {

constexpr eos::NobleAbelStiffenedGas water = eos::liquid_water, steam = eos::water_vapour;

/// A state of liquid water as the sheet tabulates it; pressure and density, or pressure and temperature, are exact.
struct State {
  double pressure, density, specific_energy, temperature, sound_speed;  // [Pa], [kg/m^3], [J/kg], [K], [m/s]
};
constexpr State by_density[] = {
    {101325.0, 1000.0, 314585.143, 347.40275, 1570.7997},   {5e6, 1000.0, 323325.4105, 349.82388, 1576.2638},
    {5e7, 1000.0, 403614.8842, 372.06473, 1625.5991},       {1e9, 1000.0, 2098614.884, 841.59382, 2444.8682},
    {101325.0, 1100.0, -85622.18951, 254.24031, 1669.2545}, {-1e8, 1000.0, 135983.3053, 297.92856, 1454.6558},
};
constexpr State by_temperature[] = {
    {101325.0, 1048.499615, 110952.3377, 300.0, 1612.1615},
    {5e6, 1050.731727, 109528.4114, 300.0, 1619.9483},
    {101325.0, 975.4912811, 425190.1901, 373.15, 1553.7185},
};

void check_all_ways_round(const State& state, double density) {
  CAPTURE(state.pressure);
  CAPTURE(density);
  const double e = water.specific_energy(state.pressure, density), temperature = water.temperature(density, e);
  CHECK(relative_error(e, state.specific_energy) < 1e-9);
  CHECK(std::fabs(temperature - state.temperature) < 0.51e-5);                    // to the last digit of the table
  CHECK(std::fabs(water.sound_speed(density, e) - state.sound_speed) < 0.51e-4);  // likewise
  CHECK(std::fabs(water.pressure(density, e) - state.pressure) < 1e-9 * water.stiffening_pressure);
  CHECK(relative_error(water.density_at(state.pressure, temperature), density) < 1e-12);
  CHECK(water.admits(density, e));
}

}  // namespace

TEST_CASE("a Noble-Abel stiffened gas obeys the laws of thermal equations of state") {
  check_thermal_equation_of_state_laws(water, 700.0, 2e6);
  check_thermal_equation_of_state_laws(steam, 0.6, 6e6);
  check_thermal_equation_of_state_laws(  // stiffened gas without covolume
      eos::NobleAbelStiffenedGas{.heat_capacity_ratio = 4.4,
                                 .stiffening_pressure = 6e8,
                                 .covolume = 0.0,
                                 .heat_of_formation = 0.0,
                                 .specific_heat_capacity = 1000.0},
      1000.0, 4e6);
}

TEST_CASE("NASG-0: liquid water has the energies, temperatures and sound speeds of the table, and comes back from each") {
  for (const State& state : by_density) check_all_ways_round(state, state.density);
  for (const State& state : by_temperature) {
    const double density = water.density_at(state.pressure, state.temperature);
    CHECK(relative_error(density, state.density) < 1e-9);  // the table's 10 digits, too few to start from: e needs 11 of the density
    check_all_ways_round(state, density);
  }
}

TEST_CASE("NASG-0: dp/drho at constant entropy is c^2, in the table's states and in its parts at 5 MPa") {
  const auto slopes = [](double density, double e) {
    return std::pair{test::slope([&](Dual rho) { return water.pressure(rho, Dual(e)); }, density),
                     test::slope([&](Dual x) { return water.pressure(Dual(density), x); }, e)};
  };
  for (const State& state : by_density) {
    CAPTURE(state.pressure);
    const double rho = state.density, e = water.specific_energy(state.pressure, rho), c = water.sound_speed(rho, e);
    const auto [by_rho, by_e] = slopes(rho, e);
    CHECK(relative_error(by_rho + state.pressure / (rho * rho) * by_e, c * c) < 1e-12);
  }
  const auto [by_rho, by_e] = slopes(1000.0, water.specific_energy(5e6, 1000.0));
  CHECK(std::fabs(by_rho - 2481805.0) < 0.5);
  CHECK(std::fabs(5.0 * by_e - 2802.0) < 0.5);
}

TEST_CASE("NASG-0: adiabatic compression, de = -p dv, heats by the Grueneisen relation d ln T/dv = -(gamma - 1)/(v - b)") {
  const double v = 1e-3, dv = 1e-9, p = 5e7, e = water.specific_energy(p, 1.0 / v);  // central difference
  const double hotter = water.temperature(1.0 / (v - dv), e + p * dv), colder = water.temperature(1.0 / (v + dv), e - p * dv);
  CHECK((hotter - colder) / (2.0 * dv * water.temperature(1.0 / v, e)) == doctest::Approx(0.19 / (1e-3 - 6.61e-4)).epsilon(1e-5));
}

TEST_CASE("NASG-0: pressures near 1 atm, the difference of two terms of 8.4e8 Pa, come back to 1e-9 p_inf in double precision") {
  double largest = 0.0;
  for (const double rho : test::evenly(700.0, 1400.0, 57))
    for (const double p : test::evenly(-1e6, 1e6, 41))
      largest = std::fmax(largest, std::fabs(water.pressure(rho, water.specific_energy(p, rho)) - p));
  CHECK(largest < 1e-9 * 7.028e8);
  CHECK(largest < 2e-5);  // [Pa]: a few roundings of 8.4e8 Pa, 1.2e-7 Pa each
}

TEST_CASE("NASG-0: liquid water at 1000 kg/m^3 exists above -939538.8 J/kg, where it reaches 0 K, -p_inf and no sound at once") {
  const double edge = -939538.8, rho = 1000.0;
  CHECK(std::fabs(water.theta(rho, edge)) < 1e-6);
  CHECK(water.admits(rho, edge + 1e-3));
  CHECK_FALSE(water.admits(rho, edge - 1e-3));
  CHECK(std::fabs(water.temperature(rho, edge)) < 1e-9);
  CHECK(water.pressure(rho, edge) == doctest::Approx(-7.028e8).epsilon(1e-12));
  CHECK(water.sound_speed(rho, edge + 1e-3) < 0.1);
  CHECK(water.sound_speed(rho, edge + 1e-3) > 0.0);
  for (const double nonsense : {double(NAN), double(-INFINITY)}) CHECK_FALSE(water.admits(rho, nonsense));
  for (const double nonsense : {double(NAN), -1.0, 0.0, 1e-320}) CHECK_FALSE(water.admits(nonsense, 1e5));
  for (const double nonsense : {double(NAN), -1.0, 0.0}) CHECK_FALSE(steam.admits(nonsense, 3e6));
}

TEST_CASE("NASG-0: a negative energy is normal, at 254 K and 1100 kg/m^3") {
  CHECK(water.specific_energy(101325.0, 1100.0) < 0.0);
  CHECK(water.admits(1100.0, -85622.18951));
}

TEST_CASE("NASG-0: sound grows without bound towards the density 1/b, which is refused") {
  const double closest = 1.0 / 6.61e-4;
  CHECK(closest == doctest::Approx(1512.859).epsilon(1e-6));
  const double densities[] = {1000.0, 1400.0, 1500.0, 1512.0}, speeds[] = {1571.0, 2830.0, 8100.0, 31208.0};  // at 1 bar
  for (int n = 0; n < 4; ++n) {
    CAPTURE(densities[n]);
    const double e = water.specific_energy(1e5, densities[n]);
    CHECK(std::fabs(water.sound_speed(densities[n], e) - speeds[n]) < 0.5);
    CHECK(water.admits(densities[n], e));
  }
  CHECK(water.admits(closest * (1.0 - 1.1e-6), 1e6));
  CHECK_FALSE(water.admits(closest * (1.0 - 0.9e-6), 1e6));
  CHECK_FALSE(water.admits(closest, 1e6));
  CHECK_FALSE(water.admits(2.0 * closest, 1e6));
}

TEST_CASE("NASG-0: near vacuum p tends to -gamma p_inf = -8.36e8 Pa, which is not admitted; steam may be as thin as it likes") {
  const double e = water.specific_energy(101325.0, 1000.0);
  CHECK(water.pressure(1e-6, e) == doctest::Approx(-836332000.0).epsilon(1e-8));
  CHECK_FALSE(water.admits(1e-6, e));
  CHECK_FALSE(water.admits(100.0, e));
  CHECK(steam.admits(1e-12, 3e6));
}

TEST_CASE("NASG-0: the tension cut-off holds p up and leaves all the rest as it is") {
  eos::NobleAbelStiffenedGas cut = water;
  cut.least_pressure = 0.0;
  validate(cut);
  const double stretched = water.specific_energy(-1e8, 1000.0), pressed = water.specific_energy(5e6, 1000.0);
  CHECK(water.pressure(1000.0, stretched) < -0.99e8);
  CHECK(cut.pressure(1000.0, stretched) == 0.0);
  CHECK(cut.pressure(1e-6, pressed) == 0.0);
  CHECK(cut.pressure(1000.0, pressed) == water.pressure(1000.0, pressed));
  CHECK(cut.sound_speed(1000.0, stretched) == water.sound_speed(1000.0, stretched));
  CHECK(cut.temperature(1000.0, stretched) == water.temperature(1000.0, stretched));
  CHECK(std::isnan(cut.pressure(1000.0, double(NAN))));  // a lost number is not mended
}

TEST_CASE("a Noble-Abel stiffened gas without p_inf, b and q is the ideal gas") {
  const eos::IdealGas ideal{};
  const eos::NobleAbelStiffenedGas same{
      .heat_capacity_ratio = 1.4, .stiffening_pressure = 0.0, .covolume = 0.0, .heat_of_formation = 0.0, .specific_heat_capacity = 717.6};
  for (const double e : {1e3, 2e5, 3e8}) {
    CHECK(relative_error(same.pressure(1.2, e), ideal.pressure(1.2, e)) < 1e-14);
    CHECK(relative_error(same.sound_speed(1.2, e), ideal.sound_speed(1.2, e)) < 1e-14);
    CHECK(relative_error(same.specific_energy(e, 1.2), ideal.specific_energy(e, 1.2)) < 1e-14);
  }
}

TEST_CASE("water and its vapour at 1 atm and 373.15 K are near the steam tables: 958.4 and 0.598 kg/m^3, latent heat 2.2565 MJ/kg") {
  const double p = 101325.0, temperature = 373.15;
  const auto enthalpy = [&](const auto& phase, double rho) { return phase.specific_energy(p, rho) + p / rho; };
  const double liquid = water.density_at(p, temperature), vapour = steam.density_at(p, temperature);
  CHECK(liquid == doctest::Approx(958.4).epsilon(0.02));
  CHECK(relative_error(vapour, 0.598) < 0.015);
  CHECK(enthalpy(steam, vapour) - enthalpy(water, liquid) == doctest::Approx(2.2565e6).epsilon(0.04));
  CHECK(water.density_at(p, 300.0) == doctest::Approx(996.5).epsilon(0.06));
}

TEST_CASE("a Noble-Abel stiffened gas gives in packs what it gives in numbers") {
  eos::NobleAbelStiffenedGas cut = water;
  cut.least_pressure = 0.0;
  const auto densities = test::evenly(950.0, 1450.0, 256);
  const double e = 3e5;
  const auto same = [&](const auto& f) {
    CHECK(test::lane_error<double, dmp::native_width<double>>(f, densities) < 1e-13);
    CHECK(test::lane_error<float, dmp::native_width<float>>(f, densities) < 1e-5);
  };
  same([&](const auto& rho) { return water.pressure(rho, std::decay_t<decltype(rho)>(e)); });
  same([&](const auto& rho) { return cut.pressure(rho, std::decay_t<decltype(rho)>(e)); });
  same([&](const auto& rho) { return water.theta(rho, std::decay_t<decltype(rho)>(e)); });
  same([&](const auto& rho) { return water.temperature(rho, std::decay_t<decltype(rho)>(e)); });
  same([&](const auto& rho) { return water.sound_speed(rho, std::decay_t<decltype(rho)>(e)); });
  same([&](const auto& rho) { return water.specific_energy(std::decay_t<decltype(rho)>(1e5), rho); });
  same([&](const auto& temperature) { return water.density_at(std::decay_t<decltype(temperature)>(1e5), temperature); });
}

TEST_CASE("a Noble-Abel stiffened gas says what it demands, and what it refuses") {
  CHECK(water.demand() ==
        "eos::NobleAbelStiffenedGas: theta = e - q - p_inf (1/rho - b) must be > 0 and b rho < 1 - 1e-6, with q = -1177788 J/kg, "
        "p_inf = 702800000 Pa, b = 0.000661 m^3/kg");
  CHECK(water.specific_heat() == 3610.0);
  const auto complaint_about = [](auto change) {
    eos::NobleAbelStiffenedGas law = water;
    change(law);
    return test::complaint_about(law);
  };
  CHECK(complaint_about([](auto&) {}) == "");
  CHECK(complaint_about([](auto& law) { law.heat_capacity_ratio = 1.0; }) ==
        "eos::NobleAbelStiffenedGas: heat_capacity_ratio must be > 1 and < 1000, got 1");
  CHECK(complaint_about([](auto& law) { law.stiffening_pressure = -1.0; }) ==
        "eos::NobleAbelStiffenedGas: stiffening_pressure must be finite and >= 0 Pa, got -1");
  CHECK(complaint_about([](auto& law) { law.covolume = NAN; }) ==
        "eos::NobleAbelStiffenedGas: covolume must be finite and >= 0 m^3/kg, got nan");
  CHECK(complaint_about([](auto& law) { law.heat_of_formation = INFINITY; }) ==
        "eos::NobleAbelStiffenedGas: heat_of_formation must be finite [J/kg], got inf");
  CHECK(complaint_about([](auto& law) { law.specific_heat_capacity = 0.0; }) ==
        "eos::NobleAbelStiffenedGas: specific_heat_capacity must be finite and > 0 J/(kg K), got 0");
  CHECK(complaint_about([](auto& law) { law.least_pressure = INFINITY; }) ==
        "eos::NobleAbelStiffenedGas: least_pressure must be finite, or -infinity for none [Pa], got inf");
  CHECK(complaint_about([](auto& law) { law.least_pressure = NAN; }) ==
        "eos::NobleAbelStiffenedGas: least_pressure must be finite, or -infinity for none [Pa], got nan");
}
