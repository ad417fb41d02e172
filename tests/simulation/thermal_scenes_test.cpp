// Scenes of the library's own fluids at and beyond the ends of their ranges: what stops, where, and which step the laws ask for.
#include <cmath>
#include <string>
#include <type_traits>
#include <doctest/doctest.h>
#include <dmp/dmp.hpp>

namespace {

using namespace dmp;
using namespace dmp::simulation;
using particles::Frozen, particles::Mobile, particles::Stationary;

struct Fluid {};
constexpr double spacing = 0.1;

geometry::Points<2> lattice() {
  return geometry::fill(geometry::Cubic<2>{.spacing = spacing}, geometry::Cuboid<2>{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}});
}
geometry::Box<2> periodic() { return {.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {true, true}}; }

/// A periodic square of one fluid at rest.
template <class Eos>
auto square_of(const Eos& eos, double density, double specific_energy) {
  const sph::Compressible<kernel::Lucy<2>, viscosity::ShockCapturing> law{.kernel = {.support_radius = 2.6 * spacing},
                                                                          .viscosity = {.alpha = 1.0}};
  auto result = scene<integrator::ExtrapolatedVerlet>(periodic(), group<Fluid>("fluid", Mobile{}, lattice(), density * spacing * spacing),
                                                      interaction<Fluid, Fluid>(law), material<Fluid>(eos));
  result.template group<Fluid>().template set<field::Density>([=](const auto&) { return density; });
  result.template group<Fluid>().template set<field::SpecificEnergy>([=](const auto&) { return specific_energy; });
  return result;
}

template <class Scene>
std::string complaint(Scene& scene) {
  try {
    scene.run({.until = 1e-3});
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE(
    "NASG: water whose theta is not positive is refused at the start, with particle, density and energy; at 1000 kg/m^3 below -939538.8 "
    "J/kg") {
  auto good = square_of(eos::liquid_water, 1000.0, -939538.0);
  CHECK(complaint(good).empty());
  auto bad = square_of(eos::liquid_water, 1000.0, 314585.143);
  bad.group<Fluid>().get<field::SpecificEnergy>()[18] = -939539.6;
  const std::string text = complaint(bad);
  CHECK(text.find("scene: group fluid, particle 18: eos::NobleAbelStiffenedGas: theta") == 0);
  CHECK(text.find("density 1000 kg/m^3, specific_energy -939539.6 J/kg") != std::string::npos);
}

TEST_CASE("NASG: a density within 1e-6 of 1/b is refused") {
  auto dense = square_of(eos::liquid_water, 1512.858, 1e6);
  CHECK(complaint(dense).find("particle 0: eos::NobleAbelStiffenedGas") != std::string::npos);
}

TEST_CASE("the ideal gas refuses an energy of zero, and one below") {
  for (const double e : {0.0, -1.0}) {
    auto cold = square_of(eos::IdealGas{}, 1.2, e);
    CHECK(complaint(cold).find("scene: group fluid, particle 0: eos::IdealGas") == 0);
  }
}

TEST_CASE("NASG: the step follows the local sound speed, 1571 m/s at 1000 kg/m^3 and 1 bar, 8100 at 1500") {
  const auto step = [](double density) {
    return square_of(eos::liquid_water, density, eos::liquid_water.specific_energy(1e5, density)).step_limit().stable_time_step;
  };
  CHECK(step(1000.0) / step(1500.0) == doctest::Approx(8100.0 / 1571.0).epsilon(1e-3));  // sheet 06, section 6
}

TEST_CASE("a liquid that is torn apart stops with the particle and the rule, not with a number that is none") {
  auto torn = square_of(eos::liquid_water, 1000.0, 314585.143);
  torn.group<Fluid>().set<field::Velocity>([](const auto& x) { return Vector<2>(4e4 * (x[0] < 0.5 ? -1.0 : 1.0), 0.0); });
  bool caught = false;
  try {
    torn.run({.until = 1e-3});
  } catch (const SimulationError& error) {
    caught = true;
    CHECK(error.where.particle >= 0);
    CHECK(error.where.group == "fluid");
    CHECK(std::isfinite(error.where.value));
  }
  CHECK(caught);
}

// ---- Light gas next to liquid: what conduction and a heat sink make of temperatures near 0 K --------------------------------------

namespace {
struct Gas {};
struct Liquid {};
struct Plate {};

constexpr thermal::Gas air{.molar_mass = 0.029};
constexpr thermal::Linear water{.specific_heat_capacity = 4184.0, .reference_temperature = 293.15, .reference_energy = -1e5};
constexpr double rho_gas = 1.2, rho_liquid = 1000.0, kappa_gas = 0.025, kappa_liquid = 0.6;  // [kg/m^3], [W/(m K)]
const sph::HeatConduction<kernel::Lucy<2>> conduction{.kernel = {.support_radius = 2.6 * spacing}};

/// What a cold plate takes from a particle that it reaches [W/kg].
struct Sink {
  using reads = Fields<>;
  using writes = Fields<field::SpecificEnergyRate>;
  static constexpr bool uses_velocity = false;
  double power, reach;
  [[nodiscard]] double cutoff() const { return reach; }
  void add(const auto& pair, const auto&, const auto&, auto& sums) const {
    sums.specific_energy_rate -= select(pair.distance < reach, power + 0.0 * pair.distance, 0.0 * pair.distance);
  }
  void step_limits(const sweep::StepState&, sweep::StepLimit&) const {}
};
void validate(const Sink&) {}

/// Gas and liquid at 300 K; `Cooled` is the one of them that a plate, out of reach of the conduction, takes heat from.
template <class Cooled>
auto gas_next_to_liquid(const geometry::Points<2>& gas, const geometry::Points<2>& liquid, double power) {
  auto result = scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>::unbounded(), group<Gas>("gas", Stationary{}, gas, rho_gas * spacing * spacing),
      group<Liquid>("liquid", Stationary{}, liquid, rho_liquid * spacing * spacing),
      group<Plate>("plate", Frozen<2>{}, geometry::Points<2>{.positions = {{0.0, -1.0}}}, 1.0), interaction<Gas, Gas>(conduction),
      interaction<Liquid, Liquid>(conduction), interaction<Gas, Liquid>(conduction), interaction<Cooled, Plate>(Sink{power, 2.0}),
      material<Gas>(air, eos::ConstantDensity{.density = rho_gas}, thermal::Conductivity{.thermal_conductivity = kappa_gas}),
      material<Liquid>(water, eos::ConstantDensity{.density = rho_liquid}, thermal::Conductivity{.thermal_conductivity = kappa_liquid}));
  result.template group<Gas>().template set<field::SpecificEnergy>([](const auto&) { return air.specific_energy(300.0); });
  result.template group<Liquid>().template set<field::SpecificEnergy>([](const auto&) { return water.specific_energy(300.0); });
  return result;
}
}  // namespace

TEST_CASE("gas next to liquid: an energy of 0 K or less is refused at the start, with group, particle, rule and value") {
  const auto refused = [](double gas_energy, double liquid_energy) {
    const geometry::Cubic<2> grid{.spacing = spacing};
    auto layers = gas_next_to_liquid<Gas>(geometry::fill(grid, {.lower = {0.0, 0.5}, .upper = {1.0, 1.0}}),
                                          geometry::fill(grid, {.lower = {0.0, 0.0}, .upper = {1.0, 0.5}}), 0.0);
    layers.template group<Gas>().template get<field::SpecificEnergy>()[31] = gas_energy;
    layers.template group<Liquid>().template get<field::SpecificEnergy>()[17] = liquid_energy;
    return complaint(layers);
  };
  const double lowest = -1e5 - 4184.0 * 293.15;  // [J/kg] of the liquid, at 0 K
  CHECK(refused(1e-3, lowest + 1.0).empty());
  CHECK(refused(0.0, 0.0) ==
        "scene: group gas, particle 31: thermal::Gas: temperature must be > 0 K, that is specific_energy > 0 J/kg, got specific_energy 0 "
        "J/kg");
  CHECK(refused(-2.5, 0.0).find("group gas, particle 31: thermal::Gas: temperature must be > 0 K, that is specific_energy > 0 J/kg, got "
                                "specific_energy -2.5 J/kg") != std::string::npos);
  CHECK(refused(1.0, lowest - 1.0)
            .find("group liquid, particle 17: thermal::Linear: temperature must be > 0 K, that is specific_energy > " + to_text(lowest) +
                  " J/kg, got specific_energy " + to_text(lowest - 1.0) + " J/kg") != std::string::npos);
}

TEST_CASE(
    "gas next to liquid: a particle that a heat sink brings down to 0 K, against the heat that the other one conducts to it, stops the run "
    "in that very step") {
  constexpr double h = 2.6 * spacing, q = spacing / h, F = -12.0 * 5.0 / (3.14159265358979323846 * h * h) * (1.0 - q) * (1.0 - q) / (h * h);
  constexpr double kappa = 4.0 * kappa_gas * kappa_liquid / (kappa_gas + kappa_liquid);
  const auto check = [&]<class Cooled>(std::type_identity<Cooled>) {
    constexpr bool gas = std::is_same_v<Cooled, Gas>;
    const double c_gas = air.specific_heat(), c_liquid = water.specific_heat(), V = spacing * spacing;
    const double of_gas = V * kappa * -F / (rho_gas * c_gas),
                 of_liquid = V * kappa * -F / (rho_liquid * c_liquid);  // dT/dt = -rate (T - T'): sheet 06, 2.7
    const double a = gas ? of_gas : of_liquid, b = gas ? of_liquid : of_gas;
    const double cooling = 400.0 * a + (gas ? 0.0 : 1.0);  // [K/s]: the gas would be held at -100 K
    // T' - T = D grows as D' = cooling - (a + b) D, and T' = -cooling + a D.
    const auto temperature = [&](double t) {
      return 300.0 - cooling * t + a * cooling / (a + b) * (t + std::expm1(-(a + b) * t) / (a + b));
    };
    const double dt = (gas ? 1.0 / a : 300.0 / cooling) / 1000.0;
    std::uint64_t expected = 1;
    while (temperature(static_cast<double>(expected) * dt) > 0.0) ++expected;

    auto pair =
        gas_next_to_liquid<Cooled>({.positions = {{0.0, 0.0}}}, {.positions = {{spacing, 0.0}}}, cooling * (gas ? c_gas : c_liquid));
    CHECK(dt < pair.step_limit().stable_time_step);
    bool caught = false;
    try {
      pair.run({.until = 1e5 * dt, .time_step = dt, .check_every = 1000000});
    } catch (const SimulationError& error) {
      caught = true;
      const std::string rule = gas ? "thermal::Gas: temperature must be > 0 K, that is specific_energy > 0 J/kg" : water.demand();
      CHECK(std::string(error.what()).find("dmp: " + rule + ", got specific_energy " + to_text(error.where.value) + " J/kg") == 0);
      CHECK(error.where.step == expected);
      CHECK(error.where.group == (gas ? "gas" : "liquid"));
      CHECK(error.where.particle == 0);
      CHECK(error.where.field == "specific_energy");
      const double there = gas ? air.temperature(error.where.value) : water.temperature(error.where.value);
      CHECK(there <= 0.0);
      CHECK(std::fabs(there - temperature(static_cast<double>(expected) * dt)) <= 1e-3);
    }
    CHECK(caught);
  };
  check(std::type_identity<Gas>{});
  check(std::type_identity<Liquid>{});
}

TEST_CASE("Arrhenius: the step follows the largest viscosity, and a temperature outside the range stops with law and range") {
  constexpr rheology::Arrhenius oil{
      .pre_exponential_factor = 1.83e-4, .activation_temperature = 1879.9, .temperature_range = {.lowest = 250.0, .highest = 400.0}};
  const sph::WeaklyCompressible<kernel::Lucy<2>, viscosity::Morris<>> law{.kernel = {.support_radius = 2.6 * spacing}};
  const auto at = [&](double temperature) {
    auto result =
        scene<integrator::ExtrapolatedVerlet>(periodic(), group<Fluid>("fluid", Mobile{}, lattice(), 10.0), interaction<Fluid, Fluid>(law),
                                              material<Fluid>(eos::Tait{.rest_density = 1000.0, .sound_speed_0 = 1e-4}, oil));
    result.template group<Fluid>().template set<field::Temperature>([](const auto&) { return 350.0; });
    result.template group<Fluid>().template get<field::Temperature>()[7] = temperature;
    return result;
  };
  auto warm = at(300.0), cold = at(295.0), frozen = at(249.0);
  CHECK(warm.step_limit().stability_bound_by == "viscosity");
  CHECK(warm.step_limit().stable_time_step / cold.step_limit().stable_time_step == doctest::Approx(0.107154664 / 0.0963574).epsilon(1e-5));
  CHECK(complaint(frozen).find(
            "scene: group fluid, particle 7: rheology::Arrhenius: temperature must be in [250, 400] K, got temperature 249 K") == 0);
}

namespace {
struct Other {};
/// Neither pressure nor sound.
struct Dust {
  double rest_density;  // [kg/m^3]
  [[nodiscard]] auto pressure(const auto& density) const noexcept { return 0.0 * density; }
  [[nodiscard]] auto sound_speed(const auto& density) const noexcept { return 0.0 * density; }
  [[nodiscard]] auto density(const auto& pressure) const noexcept { return rest_density + 0.0 * pressure; }
};
void validate(const Dust&) {}
}  // namespace

TEST_CASE(
    "Monaghan's viscosity is written in mu: where the sound speed is 0, two particles of two fluids slow each other down by the formula, "
    "and bound the step") {
  constexpr double h = 0.3, mu_a = 2.0, mu_b = 5.0, rho_a = 900.0, rho_b = 1100.0, m_a = 3.0, m_b = 7.0, speed = 1e-6;
  const Vector<2> apart(0.12, -0.05), moving = speed * Vector<2>(0.8, 0.3);
  const sph::WeaklyCompressible<kernel::Lucy<2>, viscosity::Monaghan<2>> law{.kernel = {.support_radius = h}};
  auto pair = scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>::unbounded(), group<Fluid>("a", Mobile{}, geometry::Points<2>{.positions = {apart}}, m_a),
      group<Other>("b", Mobile{}, geometry::Points<2>{.positions = {{0.0, 0.0}}}, m_b), interaction<Fluid, Fluid>(law),
      interaction<Other, Other>(law), interaction<Fluid, Other>(law),
      material<Fluid>(Dust{rho_a}, rheology::Constant{.dynamic_viscosity = mu_a}),
      material<Other>(Dust{rho_b}, rheology::Constant{.dynamic_viscosity = mu_b}));
  const auto limit = pair.step_limit();  // at rest
  CHECK(limit.stability_bound_by == "viscosity");
  const double along = 2.0 - 1.0 / 2.0;  // of a lattice in 2D: neighbours along the line of motion slow down most
  CHECK(limit.stable_time_step == doctest::Approx(h * h / (40.0 * mu_b / rho_b) / along).epsilon(1e-5));

  auto& va = pair.group<Fluid>().get<field::Velocity>()[0];
  auto& vb = pair.group<Other>().get<field::Velocity>()[0];
  va = moving;
  pair.engine().evaluate(0.0, 0);
  const double r2 = apart.squaredNorm(), q = std::sqrt(r2) / h, sigma = 5.0 / (3.14159265358979323846 * h * h);
  const double F = -12.0 * sigma * (1.0 - q) * (1.0 - q) / (h * h),
               per_approach = -4.0 * (mu_a + mu_b) / (rho_a * rho_b * (r2 + 0.01 * h * h));  // sheet 06, 2.1 and 2.3
  const double Pi = per_approach * moving.dot(apart);
  CHECK((pair.group<Fluid>().get<field::Acceleration>()[0] + m_b * Pi * F * apart).norm() <=
        1e-13 * std::fabs(m_b * Pi * F) * apart.norm());
  CHECK((pair.group<Other>().get<field::Acceleration>()[0] - m_a * Pi * F * apart).norm() <=
        1e-13 * std::fabs(m_a * Pi * F) * apart.norm());

  const double rate = (m_a + m_b) * per_approach * F * r2;  // of d(v.r)/dt = -rate v.r, while the particles hardly move
  pair.run({.until = 2.0 / rate, .time_step = 0.01 / rate});
  CHECK((va - vb).dot(apart) / moving.dot(apart) == doctest::Approx(std::exp(-2.0)).epsilon(2e-4));
  CHECK((m_a * va + m_b * vb - m_a * moving).norm() <= 1e-14 * m_a * speed);
}

namespace {
struct Push {  // makes waves of shear
  double strength;
  [[nodiscard]] auto acceleration(const auto& subject) const noexcept {
    return Components<2, double>{0.0, strength * std::sin(6.283185307179586 * subject.position[0])};
  }
};
}  // namespace

TEST_CASE("a fluid that thickens from rest: the step follows; one that was given is refused at the step where it is too long") {
  constexpr double h = 2.6 * spacing;
  const sph::WeaklyCompressible<kernel::Lucy<2>, viscosity::Morris<>> law{.kernel = {.support_radius = h}};
  const rheology::PowerLaw thickening{
      .consistency_index = 1.0, .power_law_index = 1.5, .lowest_shear_rate = 0.01, .lowest_viscosity = 1e-3, .highest_viscosity = 1e3};
  const auto at_rest = [&] {
    return scene<integrator::ExtrapolatedVerlet>(
        periodic(), group<Fluid>("fluid", Mobile{}, lattice(), spacing * spacing), interaction<Fluid, Fluid>(law),
        summed<Fluid>(sph::ShearRate<kernel::Lucy<2>>{.kernel = {.support_radius = h}}),
        material<Fluid>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 10.0}, thickening), forced_by<Fluid>(Push{100.0}));
  };
  auto free = at_rest();
  const double first = free.step_limit().stable_time_step;
  const auto report = free.run({.until = 0.5});
  CHECK(report.limit.stable_time_step < 0.5 * first);
  for (const auto& v : free.group<Fluid>().get<field::Velocity>())
    CHECK(v.norm() < 0.5 * 100.0);  // what the push alone would have made of it

  auto given = at_rest();
  bool caught = false;
  try {
    given.run({.until = 0.5, .time_step = 0.9 * first});
  } catch (const SimulationError& error) {
    caught = true;
    CHECK(std::string(error.what()).find("the given time step is longer than") != std::string::npos);
    CHECK(error.where.step < 100);
  }
  CHECK(caught);
}
