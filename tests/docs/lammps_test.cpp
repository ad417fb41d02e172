// docs/coming-from-lammps.md: the five extensions of A. Albano et al., ChemEngineering 5 (2021) 30, doi:10.3390/chemengineering5020030,
// as a user of the library writes them: compiled, counted, and run against exact solutions.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <variant>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/dmp.hpp>

#include "docs/pages.hpp"

namespace extension {

using namespace dmp;
using namespace dmp::simulation;
using particles::Frozen, particles::Mobile, particles::Stationary;

// doc: lammps-bond
struct KelvinVoigt {
  double k, b;  // [N/m], [N s/m]
  auto tension(const auto& bond) const { return k * (bond.length - bond.rest_length) + b * bond.length_rate; }
  double largest_stiffness() const { return k; }
  double largest_damping() const { return b; }
};
// end

// doc: lammps-eos
struct Nasg {
  double gamma, p_inf, b, q, Cv;  // [-], [Pa], [m^3/kg], [J/kg], [J/(kg K)]
  auto theta(auto rho, auto e) const { return (e - q) - p_inf * (1.0 / rho - b); }
  auto pressure(auto rho, auto e) const { return (gamma - 1.0) * theta(rho, e) / (1.0 / rho - b) - p_inf; }
  auto temperature(auto rho, auto e) const { return theta(rho, e) / Cv; }
  auto sound_speed(auto rho, auto e) const { return sqrt(gamma * (pressure(rho, e) + p_inf) / (rho * (1.0 - b * rho))); }
  auto specific_energy(auto p, auto rho) const { return q + (p + gamma * p_inf) * (1.0 / rho - b) / (gamma - 1.0); }
  bool admits(double rho, double e) const { return b * rho < 1.0 && theta(rho, e) > 0.0; }
  std::string demand() const { return "Nasg: density must be < 1/b, and the temperature > 0 K"; }
};
// end

// doc: lammps-heat
struct Caloric {
  double c, T0 = 0.0, e0 = 0.0;  // [J/(kg K)]; T0 [K] at e0 [J/kg]
  auto temperature(auto e) const { return T0 + (e - e0) / c; }
  auto specific_energy(auto T) const { return e0 + c * (T - T0); }
  double specific_heat() const { return c; }
};
Caloric gas(double M, double gamma) { return {.c = 8.31446 / (M * (gamma - 1.0))}; }  // M [kg/mol]
struct Mean { static auto twice(auto a, auto b) { return 4.0 * a * b / (a + b); } };   // the paper has a + b
// end

// doc: lammps-viscosity-constant
struct Constant { double mu; auto viscosity(auto) const { return mu; } };
// end
// doc: lammps-viscosity-andrade
struct Andrade { double A, B, C, D; auto viscosity(auto T) const { return A * exp(B / T + C * T + D * T * T); } };
// end
// doc: lammps-viscosity-arrhenius
struct Arrhenius { double C1, C2; auto viscosity(auto T) const { return C1 * exp(C2 / T); } };
// end
// doc: lammps-viscosity-sutherland
struct Sutherland { double C1, C2; auto viscosity(auto T) const { return C1 * T * sqrt(T) / (T + C2); } };
// end
// doc: lammps-viscosity-power
struct PowerLawGas { double B, n; auto viscosity(auto T) const { return B * pow(T, n); } };
// end

struct Bead {};
struct Post {};
struct Water {};
struct Plates {};
struct LiquidSide {};
struct GasSide {};
using Viscosity = std::variant<Constant, Andrade, Arrhenius, Sutherland, PowerLawGas>;

/// Lines of code of a region: without blank lines and comments.
int lines_of_code(const std::string& text) {
  int lines = 0;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = text.find('\n', from), first = text.find_first_not_of(' ', from);
    if (first < to && !text.substr(first).starts_with("//")) ++lines;
    from = to + 1;
  }
  return lines;
}

}  // namespace extension

using namespace extension;

TEST_CASE("docs/coming-from-lammps.md: no extension takes more lines than its bound, and the page states how many it takes") {
  const auto regions = docs::regions_of(docs::repository() / "tests/docs/lammps_test.cpp");
  const std::string page = docs::text_of(docs::repository() / "docs/coming-from-lammps.md");
  struct Extension {
    std::string row;  // of the table of the page
    std::vector<std::string> regions;
    int bound;
  };
  for (const Extension& each : {Extension{"Kelvin-Voigt bond", {"lammps-bond"}, 6},
                                Extension{"Noble-Abel stiffened gas", {"lammps-eos"}, 10},
                                Extension{"heat between gas and liquid", {"lammps-heat"}, 8},
                                Extension{"full stationary", {"lammps-stationary"}, 1},
                                Extension{"viscosity, constant", {"lammps-viscosity-constant"}, 3},
                                Extension{"viscosity, four parameters", {"lammps-viscosity-andrade"}, 3},
                                Extension{"viscosity, Arrhenius", {"lammps-viscosity-arrhenius"}, 3},
                                Extension{"viscosity, Sutherland", {"lammps-viscosity-sutherland"}, 3},
                                Extension{"viscosity, power law of a gas", {"lammps-viscosity-power"}, 3},
                                Extension{"viscosity, the choice of one", {"lammps-select"}, 1}}) {
    CAPTURE(each.row);
    int lines = 0;
    for (const auto& region : each.regions) lines += lines_of_code(regions.at(region));
    CHECK(lines >= 1);
    CHECK(lines <= each.bound);
    const std::size_t at = page.find("\n| " + each.row + " |");
    CHECK(at != std::string::npos);
    if (at == std::string::npos) continue;
    const std::string row = page.substr(at + 1, page.find('\n', at + 1) - at - 1);
    CHECK(row.ends_with("| " + std::to_string(lines) + " |"));
  }
  CHECK(lines_of_code("\n  // comment\na;  // b\n\n  /// c\n  d;\n") == 2);
}

TEST_CASE("docs/coming-from-lammps.md: what the table of the membrane quotes stands in the example") {
  const auto without_blanks = [](std::string text) {
    std::erase_if(text, [](char letter) { return letter == ' ' || letter == '\n'; });
    return text;
  };
  const std::string example = without_blanks(docs::text_of(docs::repository() / "examples/membrane.cpp"));
  bool in_table = false;
  int quoted = 0;
  for (const auto& line : docs::lines_of(docs::repository() / "docs/coming-from-lammps.md")) {
    if (line == "| script | `membrane.cpp` |") in_table = true;
    else if (line.empty()) in_table = false;
    else if (in_table && !line.starts_with("|---")) {
      const std::string cell = line.substr(line.rfind("| ", line.size() - 3));  // the last one
      for (std::size_t from = cell.find('`'); from != std::string::npos; from = cell.find('`', from)) {
        const std::size_t to = cell.find('`', from + 1);
        const std::string code = cell.substr(from + 1, to - from - 1);
        CAPTURE(code);
        CHECK(example.find(without_blanks(code)) != std::string::npos);
        ++quoted;
        from = to + 1;
      }
    }
  }
  CHECK(quoted > 20);
}

TEST_CASE("Kelvin-Voigt bond: creep under a constant force, one end held, against the exact solution") {
  struct Case {
    double damping, after_1, after_5;  // [N s/m], extensions [m] after 1 and 5 s
  };
  for (const Case& c : {Case{0.2, 0.43102811, 0.90144933}, Case{2.0, 0.26424112, 0.95957232}, Case{20.0, 0.04649431, 0.21972777}}) {
    CAPTURE(c.damping);
    auto creep = scene<integrator::ExtrapolatedVerlet>(
        geometry::Box<2>::unbounded(), group<Bead>("bead", Mobile{}, geometry::Points<2>{.positions = {{1.0, 0.0}}}, 1.0),
        group<Post>("post", Frozen<2>{}, geometry::Points<2>{.positions = {{0.0, 0.0}}}, 1.0),
        bonds<Bead, Post>(KelvinVoigt{.k = 1.0, .b = c.damping}, {{.i = 0, .j = 0}}),
        forced_by<Bead>(forcing::Constant<2>{.uniform_acceleration = {{{1.0, 0.0}}}}));
    creep.run({.until = 1.0, .time_step = 1e-3});
    CHECK(std::fabs(creep.group<Bead>().positions()[0][0] - 1.0 - c.after_1) <= 1e-6);
    creep.run({.until = 5.0, .time_step = 1e-3});
    CHECK(std::fabs(creep.group<Bead>().positions()[0][0] - 1.0 - c.after_5) <= 1e-6);
  }
}

TEST_CASE("Kelvin-Voigt bond: two beads that move on together at 1 and 2 m/s keep their momentum and lose energy") {
  auto pair = scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>::unbounded(), group<Bead>("beads", Mobile{}, geometry::Points<2>{.positions = {{0.0, 0.0}, {1.0, 0.0}}}, 1.0),
      bonds<Bead, Bead>(KelvinVoigt{.k = 1.0, .b = 1.0}, {{.i = 0, .j = 1}}));
  auto& beads = pair.group<Bead>();
  beads.set<field::Velocity>([](const Vector<2>& x) { return Vector<2>(1.0 + x[0], 0.0); });
  pair.run({.until = 1.0, .time_step = 1e-3});
  const auto& v = beads.get<field::Velocity>();
  const double extension = beads.positions()[1][0] - beads.positions()[0][0] - 1.0;
  CHECK(v[0][0] + v[1][0] == doctest::Approx(3.0).epsilon(1e-12));
  CHECK(0.5 * v[0].squaredNorm() + 0.5 * v[1].squaredNorm() + 0.5 * extension * extension == doctest::Approx(2.30).epsilon(3e-3));
}

namespace extension {
constexpr Nasg liquid_water{.gamma = 1.19, .p_inf = 7.028e8, .b = 6.61e-4, .q = -1177788.0, .Cv = 3610.0};
}

TEST_CASE("Noble-Abel stiffened gas: states of liquid water") {
  static_assert(eos::ThermalEquationOfState<Nasg>);
  struct State {
    double pressure, density, energy, temperature, sound_speed;
  };
  for (const State& s : {State{101325.0, 1000.0, 314585.143, 347.40275, 1570.7997},
                         State{1e9, 1000.0, 2098614.884, 841.59382, 2444.8682},
                         State{101325.0, 1100.0, -85622.18951, 254.24031, 1669.2545},
                         State{-1e8, 1000.0, 135983.3053, 297.92856, 1454.6558}}) {
    CAPTURE(s.pressure);
    const double energy = liquid_water.specific_energy(s.pressure, s.density);
    CHECK(std::fabs(energy - s.energy) <= 3e-3);
    CHECK(liquid_water.temperature(s.density, energy) == doctest::Approx(s.temperature).epsilon(3e-8));
    CHECK(liquid_water.sound_speed(s.density, energy) == doctest::Approx(s.sound_speed).epsilon(3e-8));
    CHECK(std::fabs(liquid_water.pressure(s.density, energy) - s.pressure) <= 1e-9 * liquid_water.p_inf);
  }
}

TEST_CASE("Noble-Abel stiffened gas: a shock tube of water, 10 000 bar against 1 bar, follows the exact solution") {
  const double spacing = 1.0 / 200.0, support_radius = 2.6 * spacing, height = 6.0 * spacing, end = 0.5 + 4.0 * spacing;
  const auto block = [&](double first, double last) {
    return geometry::fill(geometry::Cubic<2>{.spacing = spacing, .origin = {-0.5, 0.0}},
                          geometry::Cuboid<2>{.lower = {first, 0.0}, .upper = {last, height}});
  };
  const sph::Compressible<kernel::Lucy<2>, viscosity::ShockCapturing> law{.kernel = {.support_radius = support_radius},
                                                                          .viscosity = {.alpha = 1.0}};
  auto tube = scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>{.lower = {-end, 0.0}, .upper = {end, height}, .periodic = {false, true}},
      group<Water>("water", Mobile{}, block(-0.5, 0.5), 1000.0 * spacing * spacing),
      group<Plates>("ends", Frozen<2>{}, geometry::merge(block(-end, -0.5), block(0.5, end)), 1000.0 * spacing * spacing),
      interaction<Water, Water>(law), interaction<Water, Plates>(law), material<Water, Plates>(liquid_water));
  const auto energy_at = [](const auto& x) { return liquid_water.specific_energy(x[0] < 0.0 ? 1e9 : 1e5, 1000.0); };
  tube.group<Water>().set<field::Density>([](const auto&) { return 1000.0; });
  tube.group<Plates>().set<field::Density>([](const auto&) { return 1000.0; });
  tube.group<Water>().set<field::SpecificEnergy>(energy_at);
  tube.group<Plates>().set<field::SpecificEnergy>(energy_at);
  tube.run({.until = 1.5e-4, .time_step = 0.2 * support_radius / 2700.0});

  const double contact = 243.85094153 * tube.time(), shock = 2013.24637 * tube.time();  // exact
  double p = 0.0, u = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < tube.group<Water>().size(); ++i) {
    const auto& liquid = tube.group<Water>();
    const double x = liquid.positions()[i][0];
    if (x < contact + 0.04 || x > shock - 0.05) continue;
    p += liquid_water.pressure(liquid.get<field::Density>()[i], liquid.get<field::SpecificEnergy>()[i]);
    u += liquid.get<field::Velocity>()[i][0];
    ++count;
  }
  CHECK(count > 100);
  CHECK(p / count == doctest::Approx(491032023.785).epsilon(0.025));
  CHECK(u / count == doctest::Approx(243.85094153).epsilon(0.02));

  tube.group<Water>().get<field::SpecificEnergy>()[0] = -2e6;  // colder than 0 K
  CHECK_THROWS_WITH_AS(tube.run({.until = 1.6e-4}), doctest::Contains("Nasg: density must be < 1/b, and the temperature > 0 K"),
                       dmp::SimulationError);
}

namespace extension {

/// Largest error of the temperature [K] 15.6 s after a liquid at 301 K and a gas at 300 K met, each 0.1 m deep; and the heat that has got
/// lost, over that which has passed.
template <class PairMean>
std::array<double, 2> errors_of_contact() {
  constexpr double spacing = 0.01, support_radius = 2.6 * spacing, height = 6.0 * spacing, length = 0.1;
  const Caloric liquid{.c = 1000.0, .T0 = 300.0, .e0 = 0.0};
  const Caloric vapour = gas(0.018, 1.0 + 8.31446 / (0.018 * 1000.0));  // 1000 J/(kg K) too, and so the same diffusivity
  const sph::HeatConduction<kernel::Lucy<2>, PairMean> conduction{.kernel = {.support_radius = support_radius}};
  const auto block = [&](double first, double last) {
    return geometry::fill(geometry::Cubic<2>{.spacing = spacing}, geometry::Cuboid<2>{.lower = {first, 0.0}, .upper = {last, height}});
  };
  const double liquid_mass = 1000.0 * spacing * spacing, gas_mass = 100.0 * spacing * spacing;
  auto contact = scene<integrator::LammpsVerlet>(
      geometry::Box<2>{.lower = {-length, 0.0}, .upper = {length, height}, .periodic = {false, true}},
      group<LiquidSide>("liquid", Stationary{}, block(-length, 0.0), liquid_mass),
      group<GasSide>("gas", Stationary{}, block(0.0, length), gas_mass),
      interaction<LiquidSide, LiquidSide>(conduction), interaction<GasSide, GasSide>(conduction),
      interaction<LiquidSide, GasSide>(conduction),
      material<LiquidSide>(liquid, eos::ConstantDensity{.density = 1000.0}, thermal::Conductivity{.thermal_conductivity = 10.0}),
      material<GasSide>(vapour, eos::ConstantDensity{.density = 100.0}, thermal::Conductivity{.thermal_conductivity = 1.0}));
  auto& left = contact.template group<LiquidSide>();
  auto& right = contact.template group<GasSide>();
  const double hot = liquid.specific_energy(301.0), cold = vapour.specific_energy(300.0), diffusivity = 1e-5;
  left.template set<field::SpecificEnergy>([&](const auto&) { return hot; });
  right.template set<field::SpecificEnergy>([&](const auto&) { return cold; });
  contact.run({.until = 15.625, .time_step = 0.01 * support_radius * support_radius / diffusivity});

  const double joint = 10.0 / 11.0;  // above 300 K; the effusivities are as 10 to 1
  double largest = 0.0, lost = 0.0, passed = 0.0;
  const auto compare = [&](const auto& side, const auto& law, double start, double mass) {
    for (std::size_t i = 0; i < side.size(); ++i) {
      const double x = side.positions()[i][0], e = side.template get<field::SpecificEnergy>()[i];
      const double exact = joint + ((x < 0.0 ? 1.0 : 0.0) - joint) * std::erf(std::fabs(x) / std::sqrt(4.0 * diffusivity * contact.time()));
      largest = std::max(largest, std::fabs(law.temperature(e) - 300.0 - exact));
      lost += mass * (e - start);
      if (x > 0.0) passed += mass * (e - start);
    }
  };
  compare(left, liquid, hot, liquid_mass);
  compare(right, vapour, cold, gas_mass);
  return {largest, std::fabs(lost) / passed};
}

}  // namespace extension

TEST_CASE("heat between gas and liquid: two half-spaces in contact follow the error functions, and what one loses the other gains") {
  const auto [largest, lost] = errors_of_contact<Mean>();
  CHECK(largest <= 1.2 * 0.029);
  CHECK(lost < 1e-9);
  CHECK(errors_of_contact<ArithmeticMean>()[0] > 0.1);  // the mean matters
  CHECK(gas(0.018, 1.4).specific_heat() == doctest::Approx(1154.8).epsilon(1e-4));  // what the listing's constants amount to
}

namespace extension {

/// Speeds of the liquid over the wanted largest one at y/H = 0, 0.1, ..., 1 in a channel whose plates are kept at 295 K and at
/// 295 + 61.4514 K, the viscosity of the hot one being that of the cold one over 3.
struct Channel {
  std::array<double, 11> speed{};
  double highest_at = 0.0;      // y/H
  bool plates_are_kept = true;  // bit for bit
};
constexpr int rows = 20;

template <class... Extra>
Channel channel_flow(const Viscosity& law, double acceleration, double highest_viscosity, double duration, const Extra&... extra) {
  constexpr double gap = 1e-3, spacing = gap / rows, density = 1000.0, top_speed = 0.01;
  constexpr double support_radius = 2.6 * spacing, length = 10.0 * spacing;
  const geometry::Cubic<2> lattice{.spacing = spacing, .origin = {0.0, 0.5 * spacing}};
  const geometry::Cuboid<2> everywhere{.lower = {0.0, -2.5 * spacing}, .upper = {length, gap + 2.5 * spacing}};
  const geometry::Cuboid<2> between{.lower = {0.0, 0.5 * spacing}, .upper = {length, gap - 0.5 * spacing}};
  const auto water_points = geometry::fill(lattice, between), plate_points = geometry::fill(lattice, everywhere, everywhere - between);
  const double mass = density * spacing * spacing;
  const sph::WeaklyCompressible<kernel::Lucy<2>, viscosity::Morris<>> flow{.kernel = {.support_radius = support_radius}};
  const eos::Tait tait{.rest_density = density, .sound_speed_0 = 10.0 * top_speed};
  auto channel = scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>{.lower = everywhere.lower, .upper = everywhere.upper, .periodic = {true, false}},
      group<Water>("water", Mobile{}, water_points, mass),
      // doc: lammps-stationary
      group<Plates>("plates", Frozen<2>{}, plate_points, mass),
      // end
      interaction<Water, Water>(flow), interaction<Water, Plates>(flow), material<Water, Plates>(tait, law),
      forced_by<Water>(forcing::Constant<2>{.uniform_acceleration = {{{acceleration, 0.0}}}}), extra...);
  auto& water = channel.template group<Water>();
  auto& plates = channel.template group<Plates>();
  const auto temperature = [](const Vector<2>& x) { return 295.0 + 61.4514 * std::clamp(x[1] / gap, 0.0, 1.0); };
  water.template set<field::Temperature>(temperature);
  plates.template set<field::Temperature>(temperature);
  plates.template set<field::Density>([](const Vector<2>& x) { return density + x[1]; });  // any number, to be kept
  const auto positions = plates.positions();
  const auto densities = plates.template get<field::Density>();
  const auto temperatures = plates.template get<field::Temperature>();
  channel.run({.until = duration, .time_step = 0.03 * support_radius * support_radius * density / highest_viscosity});

  Channel result;
  result.plates_are_kept = plates.positions() == positions && plates.template get<field::Density>() == densities &&
                           plates.template get<field::Temperature>() == temperatures;
  std::array<double, rows + 1> sum{};
  for (std::size_t i = 0; i < water.size(); ++i) {
    const auto row = static_cast<std::size_t>(std::lround(water.positions()[i][1] / spacing));
    sum[row] += water.template get<field::Velocity>()[i][0] / (10.0 * top_speed);
  }
  for (std::size_t k = 0; k < result.speed.size(); ++k) result.speed[k] = sum[2 * k];
  result.highest_at = static_cast<double>(std::max_element(sum.begin(), sum.end()) - sum.begin()) / rows;
  return result;
}

}  // namespace extension

TEST_CASE("viscosity: the laws of the command give their values, and the library finds its own by the names of the command") {
  CHECK(Constant{.mu = 0.01}.viscosity(300.0) == 0.01);
  CHECK(Andrade{.A = 1e-6, .B = 1000.0, .C = 1e-3, .D = 1e-6}.viscosity(300.0) == doctest::Approx(4.1402e-5).epsilon(1e-4).scale(0.0));
  CHECK(Arrhenius{.C1 = 1.83e-4, .C2 = 1879.9}.viscosity(295.0) == doctest::Approx(0.107154664).epsilon(1e-5));
  CHECK(Sutherland{.C1 = 1.458e-6, .C2 = 110.4}.viscosity(300.0) == doctest::Approx(1.84600e-5).epsilon(1e-5).scale(0.0));
  CHECK(PowerLawGas{.B = 4.093e-7, .n = 2.0 / 3.0}.viscosity(300.0) == doctest::Approx(1.83424e-5).epsilon(1e-5).scale(0.0));
  const std::vector<double> coefficients{1.83e-4, 1879.9};
  // doc: lammps-by-name
  const rheology::Any law = rheology::by_name("Arrhenius", coefficients, {.lowest = 273.0, .highest = 373.0});
  // end
  CHECK(std::get<rheology::Arrhenius>(law).viscosity(295.0) == doctest::Approx(0.107154664).epsilon(1e-5));
}

TEST_CASE("viscosity and full stationary: flow between a cold and a hot plate has the exact profile; the plates are kept bit for bit") {
  // doc: lammps-select
  std::variant<Constant, Andrade, Arrhenius, Sutherland, PowerLawGas> law = Arrhenius{.C1 = 1.83e-4, .C2 = 1879.9};
  // end
  const double cold = 0.10715466;
  const Channel flow = channel_flow(law, 4.776, cold, 10.5 * 1e-3 / (9.8696 * 0.5 * (cold + cold / 3.0)));
  CHECK(flow.plates_are_kept);
  const std::array<double, 11> exact{0.0, 0.25580, 0.49227, 0.69842, 0.86157, 0.96729, 0.99938, 0.93972, 0.76829, 0.46306, 0.0};
  double difference = 0.0, whole = 0.0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    difference += dmp::square(flow.speed[k] - exact[k]);
    whole += dmp::square(exact[k]);
  }
  CHECK(std::sqrt(difference / whole) <= 0.03);
  CHECK(std::fabs(flow.highest_at - 0.58827) <= 0.05);

  law = Constant{.mu = 0.05};  // chosen anew while the program runs: the parabola
  const Channel parabola = channel_flow(law, 8.0 * 0.05 * 0.01 / (1000.0 * 1e-6), 0.05, 7.0 * 1e-3 / (9.8696 * 0.05));
  for (std::size_t k = 0; k < exact.size(); ++k) {
    const double y = 0.1 * static_cast<double>(k);
    CHECK(std::fabs(parabola.speed[k] - 4.0 * y * (1.0 - y)) <= 0.03);
  }
}

TEST_CASE("full stationary: the plates keep their density although the density of the liquid is summed in every step") {
  const sph::DensitySum<kernel::Quartic<2>> sum{.kernel = {.support_radius = 2.6 * 1e-3 / rows}};
  CHECK(channel_flow(Constant{.mu = 0.05}, 4.0, 0.05, 5e-4, summed<Water>(sum)).plates_are_kept);
}
