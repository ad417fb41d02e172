// Laws that work in a limited range only, and laws that are chosen at run time.
#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <doctest/doctest.h>

#include "io/temporary_folder.hpp"
#include "scenes.hpp"

using namespace test;

namespace {

/// T = e/c.
struct Caloric {
  double c;  // [J/(kg K)]
  [[nodiscard]] auto temperature(const auto& e) const { return e * (1.0 / c); }
  [[nodiscard]] auto specific_energy(const auto& temperature) const { return temperature * c; }
  [[nodiscard]] double specific_heat() const { return c; }
};
void validate(const Caloric&) {}

/// A viscosity that is known from 200 K to `hottest` only.
struct Tabulated {
  double hottest;
  [[nodiscard]] auto viscosity(const auto& temperature) const { return 1e-3 + 0.0 * temperature; }
  [[nodiscard]] bool admits(double temperature) const { return temperature >= 200.0 && temperature <= hottest; }
  [[nodiscard]] std::string demand() const { return "Tabulated: temperature must be >= 200 and <= " + to_text(hottest) + " K"; }
};
void validate(const Tabulated&) {}

/// Reads the viscosity and exerts nothing; heats each of a pair by w (r0 - r)  [W/kg].
struct Heater {
  using reads = Fields<field::DynamicViscosity>;
  using writes = Fields<field::SpecificEnergyRate>;
  static constexpr bool uses_velocity = false;
  double power, reversal, reach;
  [[nodiscard]] double cutoff() const { return reach; }
  void add(const auto& pair, const auto&, const auto&, auto& sums) const {
    sums.specific_energy_rate += select(pair.distance < reach, power * (reversal - pair.distance), 0.0 * pair.distance);
  }
  void step_limits(const sweep::StepState&, sweep::StepLimit&) const {}
};
void validate(const Heater&) {}

constexpr double c = 4.0, dt = 1.0 / 128.0, w = 800.0;

/// Two pairs of particles; particles 2 and 3 fly apart at 1 m/s from a distance of 1 m and heat each other, till they are 1.5 m apart.
/// Then they cool: T = 300 + w (t - t^2)/(2 c), at most 325 K, at t = 1/2. Particles 0 and 1 stay as they are.
auto flight(double hottest, double start = 300.0) {
  auto result = scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>::unbounded(),
      group<Water>("drops", Mobile{}, geometry::Points<2>{.positions = {{0.0, 90.0}, {1.5, 90.0}, {-0.5, 0.0}, {0.5, 0.0}}}, 1.0),
      interaction<Water, Water>(Heater{w, 1.5, 4.0}), material<Water>(Caloric{c}, Tabulated{hottest}));
  auto& drops = result.template group<Water>();
  drops.template set<field::SpecificEnergy>([](const auto&) { return c * 300.0; });
  drops.template get<field::SpecificEnergy>()[3] = c * start;
  drops.template get<field::Velocity>()[2] = {-0.5, 0.0};
  drops.template get<field::Velocity>()[3] = {0.5, 0.0};
  return result;
}
double temperature_at(double t) { return 300.0 + w * (t - t * t) / (2.0 * c); }
/// The first step at whose end the drops are hotter than that.
std::uint64_t first_step_above(double hottest) {
  std::uint64_t step = 1;
  while (temperature_at(static_cast<double>(step) * dt) <= hottest) ++step;
  return step;
}

}  // namespace

TEST_CASE(
    "a law that cannot work with a particle stops the run in that very step, with its demand, particle, field and value; the last good "
    "state is on disk") {
  // 324.9 K is passed after the check of step 50, and would be left again before that of step 100.
  for (const double hottest : {302.0, 314.7, 324.9}) {
    CAPTURE(hottest);
    const TemporaryFolder folder;
    const std::string path = (folder / "last_good").string();
    auto scene = flight(hottest);
    scene.rescue_to(path);
    const std::uint64_t expected = first_step_above(hottest);
    bool caught = false;
    try {
      scene.run({.until = 1.0, .time_step = dt, .check_every = 50});
    } catch (const SimulationError& error) {
      caught = true;
      const std::string text = error.what();
      CHECK(text.find("dmp: Tabulated: temperature must be >= 200 and <= " + to_text(hottest) + " K, got temperature ") == 0);
      CHECK(error.where.step == expected);
      CHECK(error.where.time == static_cast<double>(expected) * dt);
      CHECK(error.where.group == "drops");
      CHECK((error.where.particle == 2 || error.where.particle == 3));
      CHECK(error.where.field == "temperature");
      CHECK(error.where.value > hottest);
      CHECK(error.where.value == doctest::Approx(temperature_at(error.where.time)).epsilon(1e-12));
    }
    CHECK(caught);
    auto again = flight(1e3);
    again.restart(path);
    CHECK(again.step() == expected / 50 * 50);  // the last check
    CHECK(again.time() == static_cast<double>(again.step()) * dt);
    const auto& drops = again.group<Water>();
    for (std::size_t i = 0; i < 4; ++i)
      CHECK(drops.get<field::SpecificEnergy>()[i] / c ==
            doctest::Approx(drops.id[i] < 2 ? 300.0 : temperature_at(again.time())).epsilon(1e-12));
  }
}

TEST_CASE("a run whose states stay within the range goes through") {
  auto scene = flight(325.1);
  CHECK_NOTHROW(scene.run({.until = 1.0, .time_step = dt}));
  CHECK(scene.group<Water>().get<field::SpecificEnergy>()[2] == doctest::Approx(c * 300.0).epsilon(1e-6));
}

TEST_CASE("a particle out of range at the start is an error of the input, which names group, particle, demand and value") {
  auto hot = flight(350.0, 351.0);
  CHECK_THROWS_WITH_AS(
      hot.run({.until = 1.0, .time_step = dt}),
      doctest::Contains("scene: group drops, particle 3: Tabulated: temperature must be >= 200 and <= 350 K, got temperature 351 K"),
      ParameterError);
  CHECK(hot.step() == 0);
  auto no_number = flight(350.0, std::nan(""));
  CHECK_THROWS_WITH_AS(no_number.run({.until = 1.0, .time_step = dt}),
                       doctest::Contains("particle 3: specific_energy must be finite, got nan"), ParameterError);
  auto changed = flight(350.0);  // by the user, between two runs
  changed.run({.until = 0.1, .time_step = dt});
  changed.group<Water>().get<field::SpecificEnergy>()[1] = c * 100.0;
  CHECK_THROWS_WITH_AS(changed.run({.until = 1.0, .time_step = dt}), doctest::Contains("got temperature 100 K"), SimulationError);
}

namespace {

/// Reads viscosity and density, and exerts nothing.
struct Listener {
  using reads = Fields<field::Density, field::DynamicViscosity>;
  using writes = Fields<field::Acceleration>;
  static constexpr bool uses_velocity = false;
  double reach;
  [[nodiscard]] double cutoff() const { return reach; }
  void add(const auto& pair, const auto& i, const auto&, auto& sums) const {
    sums.acceleration += (0.0 * i.dynamic_viscosity) * pair.separation;
  }
  void step_limits(const sweep::StepState&, sweep::StepLimit&) const {}
};
void validate(const Listener&) {}
/// A viscosity that was measured up to a shear rate of `fastest`.
struct Measured {
  double fastest;
  [[nodiscard]] auto apparent_viscosity(const auto& shear_rate) const { return 1e-3 + 0.0 * shear_rate; }
  [[nodiscard]] bool admits(double shear_rate) const { return shear_rate <= fastest; }
  [[nodiscard]] std::string demand() const { return "Measured: shear rate must be <= " + to_text(fastest) + " 1/s"; }
};
void validate(const Measured&) {}
/// a = (rate y, 0): shears ever faster.
struct Shearing {
  double rate;
  [[nodiscard]] Components<2, double> acceleration(const auto& subject) const { return {{rate * subject.position[1], 0.0}}; }
};
void validate(const Shearing&) {}

auto sheared(double fastest, double shear_rate = 0.0) {
  auto result = scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>::unbounded(),
      group<Water>("drop", Mobile{}, geometry::fill(geometry::Cubic<2>{.spacing = 0.1}, {.lower = {0.0, 0.0}, .upper = {0.6, 0.6}}), 0.01),
      interaction<Water, Water>(Listener{0.26}), summed<Water>(sph::ShearRate<kernel::Lucy<2>>{.kernel = {.support_radius = 0.26}}),
      material<Water>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 1.0}, Measured{fastest}), forced_by<Water>(Shearing{8.0}));
  auto& drop = result.template group<Water>();
  drop.template set<field::Velocity>([&](const Vector<2>& x) { return Vector<2>(shear_rate * x[1], 0.0); });
  return result;
}

}  // namespace

TEST_CASE(
    "a law of a summed property stops the run in the step whose sums it cannot work with, not one later; at the start that is an error of "
    "the input") {
  for (const std::uint64_t check_every : {std::uint64_t{1}, std::uint64_t{100}}) {
    auto scene = sheared(1.03);  // the shear rate is 8 t: 1.0625 after step 17
    bool caught = false;
    try {
      scene.run({.until = 0.5, .time_step = dt, .check_every = check_every});
    } catch (const SimulationError& error) {
      caught = true;
      CHECK(std::string(error.what()).find("dmp: Measured: shear rate must be <= 1.03 1/s, got shear_rate 1.06") == 0);
      CHECK(error.where.step == 17);
      CHECK(error.where.field == "shear_rate");
      CHECK(error.where.value == doctest::Approx(1.0625).epsilon(1e-9));
    }
    CHECK(caught);
  }
  auto last = sheared(1.03);  // in the last step of a run too
  CHECK_THROWS_AS(last.run({.until = 17.0 * dt, .time_step = dt}), SimulationError);
  auto before = sheared(1.03);
  CHECK_NOTHROW(before.run({.until = 16.0 * dt, .time_step = dt}));
  auto fast = sheared(1.03, 2.0);
  CHECK_THROWS_WITH_AS(fast.run({.until = 0.5, .time_step = dt}),
                       doctest::Contains("scene: group drop, particle 0: Measured: shear rate must be <= 1.03 1/s, got shear_rate "),
                       ParameterError);
}

namespace {

/// A liquid that boils when it is stretched.
struct Boiling : eos::Linear {
  [[nodiscard]] bool admits(double density) const { return density > 0.99 * rest_density; }
  [[nodiscard]] std::string demand() const { return "Boiling: density must be > 0.99 of that at rest"; }
};

}  // namespace

TEST_CASE("an equation of state of the density alone may have a range too") {
  auto scene = simulation::scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>::unbounded(),
      group<Water>("water", Mobile{}, geometry::fill(geometry::Cubic<2>{.spacing = 0.1}, {.lower = {0.0, 0.0}, .upper = {1.0, 1.0}}), 0.01),
      interaction<Water, Water>(sph::WeaklyCompressible<kernel::Lucy<2>>{.kernel = {.support_radius = 0.26}}),
      material<Water>(Boiling{{.rest_density = 1.0, .sound_speed_0 = 0.1}}));
  scene.group<Water>().set<field::Velocity>(
      [](const Vector<2>& x) { return Vector<2>(0.1 * x); });  // expands: the density sinks by about 0.2 per second
  bool caught = false;
  try {
    scene.run({.until = 1.0, .time_step = 1e-3});
  } catch (const SimulationError& error) {
    caught = true;
    CHECK(std::string(error.what()).find("dmp: Boiling: density must be > 0.99 of that at rest, got density 0.98") == 0);
    CHECK(error.where.time == doctest::Approx(0.05).epsilon(0.1).scale(0.0));
    CHECK(error.where.field == "density");
  }
  CHECK(caught);
}

namespace {

/// A law of its own shape for each alternative.
struct Exponential {
  double mu, slope;
  [[nodiscard]] auto viscosity(const auto& temperature) const { return mu * exp(-slope * temperature); }
};
void validate(const Exponential& law) { require_positive("Exponential: mu", law.mu, "Pa s"); }
struct Thinning {
  double mu;
  [[nodiscard]] auto apparent_viscosity(const auto& shear_rate) const { return mu / (1.0 + shear_rate); }
};
void validate(const Thinning&) {}

/// The vortex with these laws; all columns at the end, in the order of the ids.
template <class... Law>
std::vector<double> columns_of_vortex(const Law&... law) {
  constexpr double spacing = 1.0 / 16.0, k = 2.0 * std::numbers::pi, support = 2.6 * spacing;
  auto flow = scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {true, true}},
      group<Water>("water", Mobile{}, geometry::fill(geometry::Cubic<2>{.spacing = spacing}, {.lower = {0.0, 0.0}, .upper = {1.0, 1.0}}),
                   spacing * spacing),
      interaction<Water, Water>(Flow{.kernel = {.support_radius = support}}),
      summed<Water>(sph::ShearRate<kernel::WendlandC2<2>>{.kernel = {.support_radius = support}}), material<Water>(law...));
  auto& water = flow.template group<Water>();
  if constexpr (dmp::contains<field::Temperature, typename std::remove_cvref_t<decltype(water)>::Layout::columns>)
    water.template set<field::Temperature>([](const Vector<2>& x) { return 300.0 + x[0]; });
  water.template set<field::Velocity>(
      [](const Vector<2>& x) { return Vector<2>(std::sin(k * x[0]) * std::cos(k * x[1]), -std::cos(k * x[0]) * std::sin(k * x[1])); });
  flow.run({.until = 0.02});
  std::vector<double> result;
  std::vector<std::size_t> row(water.size());
  for (std::size_t i = 0; i < row.size(); ++i) row[water.id[i]] = i;
  for (const std::size_t i : row)
    for (const double x : {water.positions()[i][0], water.positions()[i][1], water.template get<field::Velocity>()[i][0],
                           water.template get<field::Density>()[i], water.template get<field::ShearRate>()[i]})
      result.push_back(x);
  return result;
}
/// Two programs of the same arithmetic: to the rounding that the compiler's contractions differ by.
bool same(const std::vector<double>& a, const std::vector<double>& b) {
  bool result = a.size() == b.size();
  for (std::size_t k = 0; result && k < a.size(); ++k) result = std::fabs(a[k] - b[k]) <= 1e-11 * std::fmax(1.0, std::fabs(b[k]));
  return result;
}

constexpr eos::Tait tait{.rest_density = 1.0, .sound_speed_0 = 10.0};
constexpr eos::Linear linear{.rest_density = 1.0, .sound_speed_0 = 9.0};
constexpr rheology::Constant newtonian{.dynamic_viscosity = 0.02};
constexpr Exponential exponential{0.1, 0.005};
constexpr Thinning thinning{0.03};

}  // namespace

TEST_CASE("an equation of state chosen at run time is that law, and its rest density at the start") {
  using Choice = std::variant<eos::Tait, eos::Linear>;
  const auto of_tait = columns_of_vortex(tait, newtonian), of_linear = columns_of_vortex(linear, newtonian);
  CHECK(!same(of_tait, of_linear));
  CHECK(same(columns_of_vortex(Choice(tait), newtonian), of_tait));
  CHECK(same(columns_of_vortex(Choice(linear), newtonian), of_linear));
}

TEST_CASE("a viscosity chosen at run time is that law: constant, of temperature, of shear rate") {
  using Choice = std::variant<rheology::Constant, Exponential, Thinning>;
  const auto of_constant = columns_of_vortex(tait, newtonian), of_temperature = columns_of_vortex(tait, exponential),
             of_shear = columns_of_vortex(tait, thinning);
  CHECK(!same(of_constant, of_temperature));
  CHECK(!same(of_constant, of_shear));
  CHECK(same(columns_of_vortex(tait, Choice(exponential)), of_temperature));
  CHECK(same(columns_of_vortex(tait, Choice(thinning)), of_shear));
  CHECK(same(columns_of_vortex(tait, Choice(newtonian)), of_constant));
}

TEST_CASE(
    "one of two constants chosen at run time stays a constant of the group; two choices at once; a bad parameter of what is chosen is "
    "named") {
  using Constants = std::variant<rheology::Constant>;
  CHECK(same(columns_of_vortex(tait, Constants(newtonian)), columns_of_vortex(tait, newtonian)));
  using Eos = std::variant<eos::Tait, eos::Linear>;
  using Viscosity = std::variant<Exponential, Thinning>;
  CHECK(same(columns_of_vortex(Eos(linear), Viscosity(thinning)), columns_of_vortex(linear, thinning)));
  CHECK_THROWS_WITH_AS((void)material<Water>(Viscosity(Exponential{0.0, 1.0})),
                       doctest::Contains("Exponential: mu must be finite and > 0 Pa s, got 0"), ParameterError);
}

TEST_CASE("a chosen law's range counts, that of those not chosen does not") {
  using Choice = std::variant<Tabulated, Exponential>;
  const auto run = [](const Choice& choice) {
    auto scene = simulation::scene<integrator::ExtrapolatedVerlet>(
        geometry::Box<2>::unbounded(), group<Water>("drops", Mobile{}, geometry::Points<2>{.positions = {{0.0, 0.0}, {1.0, 0.0}}}, 1.0),
        interaction<Water, Water>(Heater{w, 1.5, 4.0}), material<Water>(Caloric{c}, choice));
    scene.group<Water>().set<field::SpecificEnergy>([](const auto&) { return c * 300.0; });
    scene.run({.until = 1.0, .time_step = dt});  // heats by 50 K/s
  };
  CHECK_THROWS_WITH_AS(run(Tabulated{310.0}), doctest::Contains("Tabulated: temperature must be >= 200 and <= 310 K, got temperature 310."),
                       SimulationError);
  CHECK_NOTHROW(run(Tabulated{410.0}));
  CHECK_NOTHROW(run(exponential));
}
