// What a user can get wrong, and what can go wrong in a run: each is told with who, what, the rule and the value.
#include <limits>
#include <string>
#include <utility>
#include <doctest/doctest.h>

#include "io/temporary_folder.hpp"
#include "scenes.hpp"

using namespace test;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A small pond, with everything in it that a case may spoil.
struct Pond {
  double spacing = 0.1, support_radius = 0.26, mass = 0.01, density = 1.0;
  Vector<2> upper{1.0, 1.0};
  std::array<bool, 2> periodic{true, true};
  bool filled_twice = false;
  std::string wall_name = "wall";
};

auto pond(const Pond& p) {
  geometry::Points<2> points = geometry::fill(geometry::Cubic<2>{.spacing = p.spacing}, {.lower = {0.0, 0.0}, .upper = {1.0, 1.0}});
  if (p.filled_twice) points = geometry::merge(points, points);
  const geometry::Points<2> stone{.positions = {{0.5, 0.5}}};
  auto result = scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>{.lower = {0.0, 0.0}, .upper = p.upper, .periodic = p.periodic}, group<Water>("water", Mobile{}, points, p.mass),
      group<Wall>(p.wall_name, Frozen<2>{}, stone, 1.0), interaction<Water, Water>(Flow{.kernel = {.support_radius = p.support_radius}}),
      material<Water>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 10.0}, rheology::Constant{.dynamic_viscosity = 0.01}));
  result.template group<Water>().template set<field::Density>([&p](const auto&) { return p.density; });
  return result;
}

const RunOptions briefly{.until = 0.01};

/// Forcing that does nothing until `from`, then pulls with `strength`.
struct Late {
  double from, strength;
  [[nodiscard]] Components<2, double> acceleration(const auto& subject) const { return {{subject.time > from ? strength : 0.0, 0.0}}; }
};
void validate(const Late&) {}

auto pulled_pond(double from, double strength, bool periodic) {
  const double spacing = 0.1;
  auto result = scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {periodic, true}},
      group<Water>("water", Mobile{}, geometry::fill(geometry::Cubic<2>{.spacing = spacing}, {.lower = {0.0, 0.0}, .upper = {1.0, 1.0}}),
                   0.01),
      interaction<Water, Water>(Flow{.kernel = {.support_radius = 2.6 * spacing}}),
      material<Water>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 10.0}, rheology::Constant{.dynamic_viscosity = 0.01}),
      forced_by<Water>(Late{from, strength}));
  result.template group<Water>().template set<field::Density>([](const auto&) { return 1.0; });
  return result;
}

}  // namespace

TEST_CASE("a pond as it should be runs") {
  auto scene = pond({});
  CHECK_NOTHROW(scene.run(briefly));
}

TEST_CASE("particles: spacing, mass, number and place are checked") {
  CHECK_THROWS_WITH_AS(pond({.spacing = -0.1}), doctest::Contains("spacing must be finite and > 0 m, got -0.1"), ParameterError);
  CHECK_THROWS_WITH_AS(pond({.spacing = 0.0}), doctest::Contains("spacing must be finite and > 0 m, got 0"), ParameterError);
  CHECK_THROWS_WITH_AS(pond({.mass = 0.0}), doctest::Contains("group water: mass of a particle must be finite and > 0 kg, got 0"),
                       ParameterError);
  CHECK_THROWS_WITH_AS(pond({.mass = -1.0}), doctest::Contains("group water: mass of a particle must be finite and > 0 kg, got -1"),
                       ParameterError);
  CHECK_THROWS_WITH_AS(pond({.mass = not_a_number}),
                       doctest::Contains("group water: mass of a particle must be finite and > 0 kg, got nan"), ParameterError);
  CHECK_THROWS_WITH_AS((void)(group<Water>("water", Mobile{}, geometry::Points<2>{}, 1.0)),
                       doctest::Contains("group water: at least one particle is needed"), ParameterError);
  CHECK_THROWS_WITH_AS(pond({.wall_name = "water"}).run(briefly), doctest::Contains("the names of groups must differ, got water twice"),
                       ParameterError);
}

TEST_CASE("laws: bad parameters are named before anything is computed") {
  CHECK_THROWS_WITH_AS(pond({.support_radius = -1.0}),
                       doctest::Contains("kernel::WendlandC2: support_radius must be finite and > 0 m, got -1"), ParameterError);
  CHECK_THROWS_WITH_AS(pond({.support_radius = not_a_number}),
                       doctest::Contains("kernel::WendlandC2: support_radius must be finite and > 0 m, got nan"), ParameterError);
  CHECK_THROWS_WITH_AS((void)material<Water>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 0.0}),
                       doctest::Contains("eos::Tait: sound_speed_0 must be finite and > 0 m/s, got 0"), ParameterError);
  CHECK_THROWS_WITH_AS((void)material<Water>(rheology::Constant{.dynamic_viscosity = -1.0}),
                       doctest::Contains("rheology::Constant: dynamic_viscosity must be finite and >= 0 Pa s, got -1"), ParameterError);
  CHECK_THROWS_WITH_AS((void)(bonds<Solid, Solid>(bond::Harmonic{.stiffness = -2.0}, {})),
                       doctest::Contains("bond::Harmonic: stiffness must be finite and >= 0 N/m, got -2"), ParameterError);
  CHECK_THROWS_WITH_AS((void)(interaction<Water, Water>(Flow{.kernel = {.support_radius = 1.0}}).excluding_bonded(0)),
                       doctest::Contains("excluding_bonded must be >= 1 bond, got 0"), ParameterError);
  CHECK_THROWS_WITH_AS((void)(substepped_bonds<Solid, Solid>(bond::Harmonic{.stiffness = 1.0}, {}, -1)),
                       doctest::Contains("substeps must be >= 0"), ParameterError);
}

TEST_CASE("scene: support radius against spacing and box, inverted and endless boxes") {
  CHECK_THROWS_WITH_AS(pond({.support_radius = 0.09}).run(briefly),
                       doctest::Contains("support radius (cut-off) of water and water must be >= their spacing 0.1 m, got 0.09"),
                       ParameterError);
  CHECK_THROWS_WITH_AS(pond({.support_radius = 1.0}).run(briefly),
                       doctest::Contains("a periodic box must be longer than support radius and skin (1.15 m), got 1"), ParameterError);
  CHECK_THROWS_WITH_AS(pond({.upper = {-1.0, 1.0}}), doctest::Contains("geometry::Box: upper must be > lower in direction x"),
                       ParameterError);
  CHECK_THROWS_WITH_AS(pond({.upper = {not_a_number, 1.0}}), doctest::Contains("geometry::Box: upper must be > lower in direction x"),
                       ParameterError);
  CHECK_THROWS_WITH_AS(pond({.upper = {std::numeric_limits<double>::infinity(), 1.0}}),
                       doctest::Contains("geometry::Box: a periodic direction must be finite"), ParameterError);
}

TEST_CASE("overlap: bonded particles leave the interaction and may be near each other, directly or through a periodic face") {
  for (const double second : {0.985, 0.025}) {
    CAPTURE(second);
    geometry::Points<2> beads{.positions = {{0.005, 0.5}, {second, 0.5}}};
    for (const double x : {0.14, 0.28, 0.42, 0.56, 0.7, 0.84}) beads.positions.emplace_back(x, 0.5);
    beads.spacing = 0.1;
    const auto run_ring = [&](bool excluded) {
      auto repulsion = interaction<Solid, Solid>(potential::LennardJones{.energy_scale = 1e-6, .diameter = 0.1, .cutoff = 0.152});
      if (excluded) repulsion = std::move(repulsion).excluding_bonded(1);
      scene<integrator::Leapfrog>(geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {true, true}},
                                  group<Solid>("ring", Mobile{}, beads, 1.0), repulsion,
                                  bonds<Solid, Solid>(bond::Harmonic{.stiffness = 1.0}, {{0, 1}}))
          .run({.until = 1e-5, .time_step = 1e-5});
    };
    CHECK_NOTHROW(run_ring(true));
    CHECK_THROWS_WITH_AS(run_ring(false), doctest::Contains("particles must not overlap at the start: ring"), ParameterError);
  }
}

TEST_CASE("input: overlapping fills, values that are not numbers, density not set, particles outside the box") {
  CHECK_THROWS_WITH_AS(pond({.filled_twice = true}).run(briefly), doctest::Contains("particles must not overlap at the start: water"),
                       ParameterError);
  CHECK_THROWS_WITH_AS(pond({.density = 0.0}).run(briefly), doctest::Contains("group water, particle 0: density must be > 0, got 0"),
                       ParameterError);
  CHECK_THROWS_WITH_AS(pond({.density = not_a_number}).run(briefly),
                       doctest::Contains("group water, particle 0: density must be finite, got nan"), ParameterError);
  CHECK_THROWS_WITH_AS(pond({.upper = {0.9, 1.0}, .periodic = {false, true}}).run(briefly),
                       doctest::Contains("position must lie in the box, got 0.95"), ParameterError);
  auto scene = pond({});
  scene.group<Water>().get<field::Velocity>()[7][1] = not_a_number;
  CHECK_THROWS_WITH_AS(scene.run(briefly), doctest::Contains("group water, particle 7: velocity must be finite, got nan"), ParameterError);
  auto moved = pond({});
  moved.group<Water>().positions()[3][0] = -std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH_AS(moved.run(briefly), doctest::Contains("group water, particle 3: position must be finite, got -inf"), ParameterError);
}

TEST_CASE("run: options out of range") {
  auto scene = pond({});
  CHECK_THROWS_WITH_AS(scene.run({.until = -1.0}),
                       doctest::Contains("run until must be finite and not before the present time [s], got -1"), ParameterError);
  CHECK_THROWS_WITH_AS(scene.run({.until = not_a_number}), doctest::Contains("run until must be finite"), ParameterError);
  CHECK_THROWS_WITH_AS(scene.run({.until = 1.0, .time_step = -1e-3}), doctest::Contains("time_step must be finite and >= 0 s, got -0.001"),
                       ParameterError);
  CHECK_THROWS_WITH_AS(scene.run({.until = 1.0, .time_step = 1.0}), doctest::Contains("scene: time_step must be <= "), ParameterError);
  CHECK_THROWS_WITH_AS(scene.run({.until = 1.0, .safety = 0.0}), doctest::Contains("safety must be > 0 and <= 1, got 0"), ParameterError);
  CHECK_THROWS_WITH_AS(scene.run({.until = 1.0, .safety = 1.1}), doctest::Contains("safety must be > 0 and <= 1, got 1.1"), ParameterError);
  CHECK_THROWS_WITH_AS(scene.run({.until = 1.0, .check_every = 0}), doctest::Contains("check_every must be > 0"), ParameterError);
  CHECK_THROWS_WITH_AS(scene.set_skin(-0.1), doctest::Contains("skin must be finite and >= 0 m, got -0.1"), ParameterError);
  CHECK_THROWS_WITH_AS(scene.every(0.0, [](const auto&) {}), doctest::Contains("interval of an observer must be finite and > 0 s, got 0"),
                       ParameterError);
}

TEST_CASE("a run that goes wrong stops with time, step, group, particle, field and value, and leaves the last good state") {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "last_good.checkpoint").string();
  auto scene = pulled_pond(0.005, 1e3, false);
  scene.rescue_to(path);
  bool caught = false;
  try {
    scene.run({.until = 1.0, .time_step = 1e-4, .check_every = 10});
  } catch (const SimulationError& error) {
    caught = true;
    CHECK(std::string(error.what()).find("dmp: a value must lie in the box at t = ") == 0);
    CHECK(error.where.group == "water");
    CHECK(error.where.field == "position");
    CHECK(error.where.value > 1.0);
    CHECK(error.where.particle >= 0);
    CHECK(error.where.time > 0.005);
    CHECK(error.where.step == scene.step());
  }
  CHECK(caught);
  auto again = pulled_pond(0.005, 0.0, false);
  again.restart(path);  // the last good state is whole, and older than the failure by at most the interval of the checks
  CHECK(again.time() < scene.time());
  CHECK(again.time() >= scene.time() - 10.5e-4);
  for (const auto& x : again.group<Water>().positions()) CHECK(again.engine().box().contains(x));
}

TEST_CASE("a time step that collapses is an error, not an endless run") {
  auto scene = pulled_pond(0.005, 1e20, true);
  CHECK_THROWS_WITH_AS(scene.run({.until = 1.0}), doctest::Contains("the time step collapsed (bound of "), SimulationError);
}

TEST_CASE("a scene that no law bounds needs a time step") {
  auto scene = simulation::scene<integrator::Leapfrog>(geometry::Box<2>::unbounded(),
                                                       group<Solid>("dust", Mobile{}, geometry::Points<2>{.positions = {{0.0, 0.0}}}, 1.0));
  CHECK_THROWS_WITH_AS(scene.run({.until = 1.0}), doctest::Contains("no law of this scene bounds the time step; give one as time_step"),
                       ParameterError);
  scene.group<Solid>().get<field::Velocity>()[0] = {1.0, -2.0};
  scene.run({.until = 1.0, .time_step = 0.125});
  CHECK(scene.group<Solid>().positions()[0] == Vector<2>(1.0, -2.0));  // free flight, exact in binary
}

namespace {

/// Bounds the step by `bound` [s] until particles are faster than `calm` [m/s], then by what is no number.
struct Moody {
  using reads = Fields<>;
  using writes = Fields<field::Acceleration>;
  static constexpr bool uses_velocity = false;
  double bound, calm;
  [[nodiscard]] double cutoff() const { return 1.0; }
  void add(const auto&, const auto&, const auto&, auto&) const {}
  void step_limits(const sweep::StepState& state, sweep::StepLimit& limit) const {
    limit.require_below(state.speed > calm ? not_a_number : bound, "mood");
  }
};
void validate(const Moody&) {}

auto moody(const Moody& law) {
  return simulation::scene<integrator::Leapfrog>(
      geometry::Box<2>::unbounded(), group<Solid>("dust", Mobile{}, geometry::Points<2>{.positions = {{0.0, 0.0}, {0.5, 0.0}}}, 1.0),
      interaction<Solid, Solid>(law), forced_by<Solid>(forcing::Constant<2>{.uniform_acceleration = {{1.0, 0.0}}}));
}
/// Bonds and drag that say of themselves what they are told.
struct Stated {
  double stiffness, damping;
  auto tension(const auto& bond) const { return 0.0 * bond.length_rate; }
  double largest_stiffness() const { return stiffness; }
  double largest_damping() const { return damping; }
};
void validate(const Stated&) {}
struct StatedDrag {
  double rate;
  [[nodiscard]] Components<2, double> acceleration(const auto&) const { return {{0.0, 0.0}}; }
  [[nodiscard]] double damping_rate(double) const { return rate; }
};
void validate(const StatedDrag&) {}
/// A trap that is soft on the left, and on the right whatever it is told.
struct StatedTrap {
  double right;
  [[nodiscard]] Components<2, double> acceleration(const auto&) const { return {{0.0, 0.0}}; }
  [[nodiscard]] double stiffness(const auto& subject) const { return subject.position[0] > 0.5 ? right : 1.0; }
};
void validate(const StatedTrap&) {}

template <class Forcing>
auto stated(const Stated& bond, const Forcing& forcing) {
  return simulation::scene<integrator::Leapfrog>(
      geometry::Box<2>::unbounded(), group<Solid>("body", Mobile{}, geometry::Points<2>{.positions = {{0.0, 0.0}, {1.0, 0.0}}}, 1.0),
      bonds<Solid, Solid>(bond, {{0, 1}}), forced_by<Solid>(forcing));
}

}  // namespace

TEST_CASE(
    "a bound of the time step that is no number >= 0 is refused, and its law named: before a run, and in it whether the step is given or "
    "chosen") {
  CHECK_THROWS_WITH_AS(moody({not_a_number, 10.0}).run({.until = 1.0}), "bound of the time step by mood must be >= 0 s, got nan",
                       ParameterError);
  CHECK_THROWS_WITH_AS(moody({-1.0, 10.0}).run({.until = 1.0, .time_step = 0.1}), "bound of the time step by mood must be >= 0 s, got -1",
                       ParameterError);
  for (const double step : {0.0, 0.01}) {
    auto scene = moody({0.01, 1.0});  // faster from t = 1 s on
    try {
      scene.run({.until = 5.0, .time_step = step, .check_every = 10});
      FAIL("it ran");
    } catch (const SimulationError& error) {
      CHECK(std::string(error.what()).starts_with("dmp: bound of the time step by mood must be >= 0 s, got nan at t = "));
      CHECK(error.where.time > 0.99);
      CHECK(error.where.time < 1.2);
      CHECK(error.where.step == scene.step());
    }
  }
}

TEST_CASE("a stiffness or a rate of damping that a law states as negative, or as no number, is refused with whose it is") {
  CHECK_THROWS_WITH_AS((void)stated({not_a_number, 1.0}, StatedDrag{1.0}).step_limit(),
                       "bonds of body - body: largest_stiffness must be >= 0 N/m, got nan", ParameterError);
  CHECK_THROWS_WITH_AS((void)stated({-2.0, 1.0}, StatedDrag{1.0}).step_limit(),
                       "bonds of body - body: largest_stiffness must be >= 0 N/m, got -2", ParameterError);
  CHECK_THROWS_WITH_AS((void)stated({1.0, not_a_number}, StatedDrag{1.0}).step_limit(),
                       "bonds of body - body: largest_damping must be >= 0 N s/m, got nan", ParameterError);
  CHECK_THROWS_WITH_AS((void)stated({1.0, 1.0}, StatedDrag{-1.0}).step_limit(), "drag on body: damping_rate must be >= 0 1/s, got -1",
                       ParameterError);
  CHECK(stated({1.0, 1.0}, StatedDrag{1.0}).step_limit().stable_time_step > 0.0);
  CHECK_THROWS_WITH_AS((void)stated({1.0, 1.0}, StatedTrap{not_a_number}).step_limit(),
                       "stiffness of a forcing on body must be >= 0 N/m, got nan", ParameterError);
  CHECK_THROWS_WITH_AS((void)stated({100.0, 1.0}, StatedTrap{-1.0}).step_limit(),  // outweighed by the bond
                       "stiffness of a forcing on body must be >= 0 N/m, got -1", ParameterError);
  CHECK(stated({1.0, 1.0}, StatedTrap{4.0}).step_limit().stable_time_step > 0.0);
}

TEST_CASE("sub-stepped bonds that need more sub-steps than anybody waits for are refused") {
  const geometry::Points<2> two{.positions = {{0.0, 0.0}, {1.0, 0.0}}};
  auto scene = simulation::scene<integrator::Leapfrog>(geometry::Box<2>::unbounded(), group<Solid>("body", Mobile{}, two, 1.0),
                                                       substepped_bonds<Solid, Solid>(bond::Harmonic{.stiffness = 1e30}, {{0, 1}}));
  CHECK_THROWS_WITH_AS(scene.run({.until = 1.0, .time_step = 1.0}),
                       doctest::Contains("substepped_bonds: a step of 1 s must need <= 1e+06 sub-steps, got "), ParameterError);
}

TEST_CASE("an observer of an interval however short is called once at each step") {
  auto scene = pond({});
  int calls = 0;
  scene.every(1e-300, [&calls](const auto&) { ++calls; });
  scene.run({.until = 0.005, .time_step = 0.001});
  CHECK(calls == 6);  // the start among them
}

TEST_CASE("checkpoints: missing, truncated, foreign, and of other particle numbers") {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "pond.checkpoint").string();
  auto scene = pond({});
  CHECK_THROWS_AS(scene.restart(path), io::CheckpointError);
  scene.checkpoint(path);
  auto finer = pond({.spacing = 0.05});
  CHECK_THROWS_WITH_AS(finer.restart(path), doctest::Contains("section water.position must hold 800 numbers, got 200"),
                       io::CheckpointError);
  auto other = pulled_pond(1.0, 0.0, true);
  CHECK_THROWS_WITH_AS(other.restart(path), doctest::Contains("2D, extrapolated-velocity Verlet, double; water (mobile)"),
                       io::CheckpointError);
  const std::string bytes = read_bytes(path);
  write_bytes(path, bytes.substr(0, bytes.size() / 2));
  CHECK_THROWS_AS(scene.restart(path), io::CheckpointError);
}

TEST_CASE("an output folder that cannot be written to is refused") {
  const TemporaryFolder folder;
  write_bytes(folder / "file", "x");
  CHECK_THROWS_WITH_AS(io::OutputFolder((folder / "file") / "below"), doctest::Contains("below"), ParameterError);
}
