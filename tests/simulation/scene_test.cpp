#include <array>
#include <cstring>
#include <doctest/doctest.h>

#include "io/temporary_folder.hpp"
#include "scenes.hpp"
#include "support/threads.hpp"

using namespace test;

namespace {

template <class Scene>
Vector<2> momentum(const Scene& scene) {
  Vector<2> sum = Vector<2>::Zero();
  for (const auto& v : scene.template group<Water>().template get<field::Velocity>()) sum += v;
  return scene.template group<Water>().mass * sum;
}

template <class Scene>
double kinetic_energy(const Scene& scene) {
  double sum = 0.0;
  for (const auto& v : scene.template group<Water>().template get<field::Velocity>()) sum += 0.5 * v.squaredNorm();
  return scene.template group<Water>().mass * sum;
}

/// All columns in the order of the ids, as bits.
template <class Scene>
std::vector<double> bits(Scene& scene) {
  std::vector<double> result;
  auto& water = scene.template group<Water>();
  std::vector<std::size_t> row(water.size());
  for (std::size_t k = 0; k < water.size(); ++k) row[water.id[k]] = k;
  const auto view = water.view();
  for (const auto& column : view.columns)
    for (const std::size_t k : row)
      for (int d = 0; d < column.components; ++d)
        result.push_back(column.values[k * static_cast<std::size_t>(column.components) + static_cast<std::size_t>(d)]);
  return result;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace

TEST_CASE("a periodic vortex keeps its momentum and loses kinetic energy at every observation") {
  auto scene = vortex({});
  double energy = kinetic_energy(scene), rises = 0.0;
  int looks = 0;
  scene.every(0.01, [&](const auto& s) {
    rises = std::max(rises, kinetic_energy(s) - energy);
    energy = kinetic_energy(s);
    ++looks;
  });
  const auto report = scene.run({.until = 0.1});
  CHECK(looks == 11);
  CHECK(report.limit.bound_by == "sound");
  CHECK(momentum(scene).norm() < 1e-13);  // of a total of |m v| of order 1
  CHECK(rises <= 1e-15);  // the order of the sum alone, at the first look
  CHECK(energy == doctest::Approx(0.25 * std::exp(-16.0 * std::numbers::pi * std::numbers::pi * 0.01 * scene.time())).epsilon(0.05));
}

TEST_CASE("the same flow seen from a moving frame: positions shift with the frame, velocities differ by it") {
  auto at_rest = vortex({}), moving = vortex({});
  const Vector<2> frame(1.0, 0.5);
  for (auto& v : moving.group<Water>().get<field::Velocity>()) v += frame;
  const RunOptions options{.until = 0.05, .time_step = 5e-4};
  at_rest.run(options);
  moving.run(options);
  const auto a = bits(at_rest), b = bits(moving);
  const std::size_t count = at_rest.particles();
  double position_error = 0.0, velocity_error = 0.0;
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t d = 0; d < 2; ++d) {
      double shift = b[2 * k + d] - a[2 * k + d] - frame[static_cast<int>(d)] * at_rest.time();
      position_error = std::max(position_error, std::fabs(shift - std::round(shift)));
      velocity_error = std::max(velocity_error, std::fabs(b[2 * (count + k) + d] - a[2 * (count + k) + d] - frame[static_cast<int>(d)]));
    }
  CHECK(position_error < 1e-11);
  CHECK(velocity_error < 1e-10);
}

TEST_CASE("1, 2, 3 and 4 threads give the same bits: a fluid of several blocks, over several builds of its lists") {
  std::vector<double> first;
  for (const int count : {1, 2, 3, 4}) {
    const Threads threads(count);
    auto scene = vortex({.columns = 120});  // 14400 particles
    scene.set_skin(0.002);
    scene.run({.until = 0.02});
    CHECK(scene.group<Water>().blocks.size() >= 3);
    CHECK(scene.group<Water>().blocks.ranges().size() == std::min(static_cast<std::size_t>(count), scene.group<Water>().blocks.size()));
    CHECK(scene.engine().list_builds() >= 3);
    const auto result = bits(scene);
    if (first.empty()) first = result;
    CHECK(same_bits(result, first));
  }
}

TEST_CASE("1, 2, 3 and 4 threads give the same bits: a fluid beside a bonded body, either of several blocks") {
  constexpr std::uint32_t columns = 128, rows = 104;  // 13312 particles each, more than three blocks
  const double spacing = 1.0 / rows;
  const geometry::Cubic<2> lattice{.spacing = spacing};
  const Flow flow{.kernel = {.support_radius = 2.6 * spacing}};
  const double width = columns * spacing;
  geometry::Points<2> body;
  std::vector<neighbours::Bond> list;
  for (std::uint32_t y = 0; y < rows; ++y)
    for (std::uint32_t x = 0; x < columns; ++x) {
      body.positions.emplace_back((x + 0.5) * spacing, (y + 0.5) * spacing);
      const std::uint32_t row = x + columns * y;
      if (x + 1 < columns) list.push_back({row, row + 1});
      list.push_back({row, x + columns * ((y + 1) % rows)});
      if (x + 1 < columns) list.push_back({row, x + 1 + columns * ((y + 1) % rows)});
    }
  std::vector<double> first_water;
  std::vector<Vector<2>> first_body;
  for (const int count : {1, 2, 3, 4}) {
    const Threads threads(count);
    auto scene = simulation::scene<integrator::ExtrapolatedVerlet>(
        geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {2.0 * width, 1.0}, .periodic = {true, true}},
        group<Water>("water", Mobile{}, geometry::fill(lattice, {.lower = {width, 0.0}, .upper = {2.0 * width, 1.0}}), spacing * spacing),
        group<Solid>("body", Mobile{}, body, spacing * spacing), interaction<Water, Water>(flow),
        interaction<Water, Solid>(potential::LennardJones{.energy_scale = 1e-6, .diameter = spacing, .cutoff = 1.12 * spacing}),
        bonds<Solid, Solid>(bond::KelvinVoigt{.stiffness = 0.1, .damping = 1e-5}, list),
        material<Water>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 10.0}, rheology::Constant{.dynamic_viscosity = 0.01}));
    const auto swirl = [](const Vector<2>& x) {
      return Vector<2>(std::sin(9.0 * x[0]) * std::cos(7.0 * x[1]), std::cos(5.0 * x[0] + 3.0 * x[1]));
    };
    scene.group<Water>().set<field::Velocity>(swirl);
    scene.group<Solid>().set<field::Velocity>(swirl);
    scene.run({.until = 0.002, .time_step = 1e-4});
    CHECK(scene.group<Solid>().blocks.size() == 3);
    CHECK(scene.group<Water>().blocks.size() >= 3);
    const auto water = bits(scene);
    const std::vector<Vector<2>> positions(scene.group<Solid>().positions().begin(), scene.group<Solid>().positions().end());
    if (first_water.empty()) {
      first_water = water;
      first_body = positions;
    }
    CHECK(same_bits(water, first_water));
    CHECK(positions == first_body);
  }
  CHECK((first_body[0] - body.positions[0]).norm() > 1e-4);
}

TEST_CASE(
    "a fluid that moves along as a whole wears its lists no faster than one at rest, but that it is put back into the box once per "
    "cut-off; and does the same") {
  auto at_rest = vortex({}), moving = vortex({});
  const Vector<2> frame(100.0, -70.0);
  for (auto& v : moving.group<Water>().get<field::Velocity>()) v += frame;
  const RunOptions options{.until = 0.1, .time_step = 1e-4};
  at_rest.run(options);
  moving.run(options);
  CHECK(at_rest.engine().list_builds() > 3);
  const double put_back = std::ceil(frame.cwiseAbs().maxCoeff() * moving.time() / moving.engine().longest_cutoff());
  CHECK(static_cast<double>(moving.engine().list_builds()) <= static_cast<double>(at_rest.engine().list_builds()) + put_back);
  const auto a = bits(at_rest), b = bits(moving);
  const std::size_t numbers = 2 * at_rest.particles();
  double error = 0.0;
  for (std::size_t k = 0; k < numbers; ++k) {
    const double shift = b[k] - a[k] - frame[static_cast<int>(k % 2)] * at_rest.time();
    error = std::max(error, std::fabs(shift - std::round(shift)));
  }
  CHECK(error < 1e-9);
}

TEST_CASE("a restart from a checkpoint continues bit for bit") {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "vortex.checkpoint").string();
  auto through = vortex({});
  through.run({.until = 0.03});
  through.checkpoint(path);
  auto continued = vortex({});
  continued.restart(path);
  CHECK(continued.time() == through.time());
  CHECK(continued.step() == through.step());
  through.run({.until = 0.08});
  continued.run({.until = 0.08});
  CHECK(continued.step() == through.step());
  CHECK(same_bits(bits(through), bits(continued)));
}

TEST_CASE(
    "a checkpoint that an observer writes in mid-run, with steps chosen by the scene, continues bit for bit; so does a run in two parts") {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "midway.checkpoint").string();
  auto through = vortex({});
  through.every(0.0313, [&](auto& scene) {
    if (scene.time() > 0.03 && scene.time() < 0.05) scene.checkpoint(path);
  });
  through.run({.until = 0.08});
  auto continued = vortex({});
  continued.restart(path);
  continued.run({.until = 0.08});
  CHECK(continued.time() == through.time());
  CHECK(same_bits(bits(through), bits(continued)));
  auto whole = vortex({}), parts = vortex({});
  whole.run({.until = 0.05});
  parts.run({.until = 0.0217});
  parts.run({.until = 0.05});
  CHECK(parts.time() == whole.time());
  CHECK(same_bits(bits(whole), bits(parts)));
}

namespace {

/// Fall of two beads on a sub-stepped spring in 1 s at 1 m/s^2.
template <class Integrator>
double fall() {
  auto pair = simulation::scene<Integrator>(geometry::Box<2>::unbounded(),
                                            group<Solid>("pair", Mobile{}, geometry::Points<2>{.positions = {{0.0, 0.0}, {1.0, 0.0}}}, 1.0),
                                            substepped_bonds<Solid, Solid>(bond::Harmonic{.stiffness = 1e6}, {{0, 1}}),
                                            forced_by<Solid>(forcing::Constant<2>{.uniform_acceleration = {{{0.0, -1.0}}}}));
  pair.run({.until = 1.0, .time_step = 1.0 / 64.0});
  return pair.template group<Solid>().positions()[0][1];
}

}  // namespace

TEST_CASE("a pair of beads on a sub-stepped spring falls as freely as one bead, under every integrator") {
  CHECK(fall<integrator::ExtrapolatedVerlet>() == doctest::Approx(-0.5).epsilon(1e-12));
  CHECK(fall<integrator::Leapfrog>() == doctest::Approx(-0.5).epsilon(1e-12));
  CHECK(fall<integrator::SymplecticEuler>() == doctest::Approx(-0.5).epsilon(1e-12));
}

TEST_CASE("the velocity of a frozen wall drags the fluid though the wall stays in place (FS-2); at rest it holds the fluid back") {
  const double spacing = 0.05;
  const auto final_speed = [&](double wall_speed) {
    const Flow law{.kernel = {.support_radius = 2.6 * spacing}};
    const geometry::Cubic<2> lattice{.spacing = spacing};
    auto scene = simulation::scene<integrator::ExtrapolatedVerlet>(
        geometry::Box<2>{.lower = {0.0, -0.2}, .upper = {0.5, 0.6}, .periodic = {true, false}},
        group<Water>("water", Mobile{}, geometry::fill(lattice, {.lower = {0.0, 0.0}, .upper = {0.5, 0.4}}), spacing * spacing),
        group<Wall>("wall", Frozen<2>{.wall_velocity = {wall_speed, 0.0}},
                    geometry::fill(lattice, {.lower = {0.0, -0.15}, .upper = {0.5, 0.55}},
                                   !geometry::Cuboid<2>{.lower = {-1.0, 0.0}, .upper = {1.0, 0.4}}), spacing * spacing),
        interaction<Water, Water>(law), interaction<Water, Wall>(law),
        material<Water, Wall>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 5.0}, rheology::Constant{.dynamic_viscosity = 0.5}));
    scene.engine().for_each_group([](auto& g) { g.template set<field::Density>([](const auto&) { return 1.0; }); });
    const auto wall_before = scene.template group<Wall>().positions();
    const auto density_before = scene.template group<Wall>().template get<field::Density>();
    scene.run({.until = 0.5});  // many times H^2/nu
    CHECK(scene.template group<Wall>().positions() == wall_before);
    CHECK(scene.template group<Wall>().template get<field::Density>() == density_before);
    double slowest = 1e30;
    for (const auto& v : scene.template group<Water>().template get<field::Velocity>()) slowest = std::min(slowest, v[0]);
    return slowest;
  };
  CHECK(final_speed(0.2) == doctest::Approx(0.2).epsilon(1e-3));
  CHECK(final_speed(0.0) == 0.0);
}

TEST_CASE("the sound bound: stable at 0.95 of it; a step beyond every bound is refused, naming the law, before anything is computed") {
  auto scene = vortex({});
  const double bound = scene.step_limit().stable_time_step;
  CHECK(scene.step_limit().stability_bound_by == "sound");
  CHECK_NOTHROW(scene.run({.until = 0.2, .time_step = 0.95 * bound}));
  CHECK(kinetic_energy(scene) < 0.25);
  auto other = vortex({});
  CHECK_THROWS_WITH_AS(other.run({.until = 0.2, .time_step = 1.5 * bound}), doctest::Contains("the bound of sound, got"), ParameterError);
  CHECK(other.step() == 0);
}

TEST_CASE("the viscosity bound: stable at 0.95 of it, with a viscosity that makes it the binding one") {
  auto scene = vortex({.viscosity = 1.0});
  const auto limit = scene.step_limit();
  CHECK(limit.stability_bound_by == "viscosity");
  double energy = kinetic_energy(scene);
  CHECK_NOTHROW(scene.run({.until = 400.0 * limit.stable_time_step, .time_step = 0.95 * limit.stable_time_step}));
  CHECK(kinetic_energy(scene) < 1e-3 * energy);
}

TEST_CASE("a driven group follows its motion, and pushes what it meets") {
  struct Piston {
    Vector<2> position(const Vector<2>& start, double time) const { return start + Vector<2>(0.1 * time, 0.0); }
    Vector<2> velocity(const Vector<2>&, double) const { return {0.1, 0.0}; }
  };
  const double spacing = 0.05;
  const geometry::Cubic<2> lattice{.spacing = spacing};
  const Flow law{.kernel = {.support_radius = 2.6 * spacing}};
  auto scene = simulation::scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>{.lower = {-1.0, 0.0}, .upper = {3.0, 0.5}, .periodic = {false, true}},
      group<Water>("water", Mobile{}, geometry::fill(lattice, {.lower = {0.0, 0.0}, .upper = {0.5, 0.5}}), spacing * spacing),
      group<Wall>("piston", particles::Driven<Piston>{}, geometry::fill(lattice, {.lower = {-0.15, 0.0}, .upper = {0.0, 0.5}}),
                  spacing * spacing),
      interaction<Water, Water>(law), interaction<Water, Wall>(law),
      material<Water, Wall>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 2.0}, rheology::Constant{.dynamic_viscosity = 0.01}));
  scene.engine().for_each_group([](auto& g) { g.template set<field::Density>([](const auto&) { return 1.0; }); });
  const auto start = scene.group<Wall>().positions();
  scene.run({.until = 1.0});
  double error = 0.0, leftmost = 1e30, speed = 0.0;
  auto& piston = scene.group<Wall>();
  for (std::size_t k = 0; k < piston.size(); ++k)
    error = std::max(error, (piston.positions()[k] - start[piston.id[k]] - Vector<2>(0.1 * scene.time(), 0.0)).norm());
  for (const auto& x : scene.group<Water>().positions()) leftmost = std::min(leftmost, x[0]);
  for (const auto& v : scene.group<Water>().get<field::Velocity>()) speed += v[0] / static_cast<double>(scene.group<Water>().size());
  CHECK(error < 1e-12);
  CHECK(leftmost > 0.1 * scene.time());
  CHECK(speed == doctest::Approx(0.1).epsilon(0.2));
}

namespace {

/// Energy after six periods of a standing sound wave without viscosity, over the energy at the start; kinetic and elastic.
template <class Integrator>
double energy_kept_by_sound(double safety) {
  const double spacing = 1.0 / 32.0, sound_speed = 10.0, amplitude = 1e-3;
  using Ideal = sph::WeaklyCompressible<kernel::WendlandC2<2>>;
  auto scene = simulation::scene<Integrator>(
      geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {1.0, 0.25}, .periodic = {true, true}},
      group<Water>("water", Mobile{}, geometry::fill(geometry::Cubic<2>{.spacing = spacing}, {.lower = {0.0, 0.0}, .upper = {1.0, 0.25}}),
                   spacing * spacing),
      interaction<Water, Water>(Ideal{.kernel = {.support_radius = 2.6 * spacing}}),
      material<Water>(eos::Linear{.rest_density = 1.0, .sound_speed_0 = sound_speed}));
  auto& water = scene.template group<Water>();
  water.template set<field::Density>([](const auto&) { return 1.0; });
  water.template set<field::Velocity>(
      [&](const Vector<2>& x) { return Vector<2>(amplitude * std::sin(2.0 * std::numbers::pi * x[0]), 0.0); });
  const auto energy = [&] {
    double sum = 0.0;
    for (std::size_t i = 0; i < water.size(); ++i)
      sum += water.template get<field::Velocity>()[i].squaredNorm() + square(sound_speed * (water.template get<field::Density>()[i] - 1.0));
    return sum;
  };
  const double before = energy();
  scene.run({.until = 0.6, .safety = safety});  // the period is 0.1
  return energy() / before;
}

}  // namespace

TEST_CASE("a sound wave without viscosity keeps its energy under every integrator; with LAMMPS' half-step density it grows") {
  CHECK(energy_kept_by_sound<integrator::ExtrapolatedVerlet>(0.9) == doctest::Approx(1.0).epsilon(0.05));
  CHECK(energy_kept_by_sound<integrator::Leapfrog>(0.9) == doctest::Approx(1.0).epsilon(0.05));
  CHECK(energy_kept_by_sound<integrator::SymplecticEuler>(0.9) == doctest::Approx(1.0).epsilon(0.05));
  CHECK(energy_kept_by_sound<integrator::LammpsVerlet>(0.9) > 2.0);
}

namespace {

/// Moves along x at 0.5 m/s.
struct Conveyor {
  Vector<2> position(const Vector<2>& start, double time) const { return start + Vector<2>(0.5 * time, 0.0); }
  Vector<2> velocity(const Vector<2>&, double) const { return {0.5, 0.0}; }
};

/// Water between two rows of a conveyor, in a box that is periodic along it.
auto conveyor() {
  const double spacing = 0.05;
  const geometry::Cubic<2> lattice{.spacing = spacing};
  const Flow law{.kernel = {.support_radius = 2.6 * spacing}};
  return simulation::scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>{.lower = {0.0, -0.5}, .upper = {0.5, 0.5}, .periodic = {true, false}},
      group<Water>("water", Mobile{}, geometry::fill(lattice, {.lower = {0.0, 0.0}, .upper = {0.5, 0.2}}), spacing * spacing),
      group<Wall>("conveyor", particles::Driven<Conveyor>{}, geometry::fill(lattice, {.lower = {0.0, -0.15}, .upper = {0.5, 0.0}}),
                  spacing * spacing),
      interaction<Water, Water>(law), interaction<Water, Wall>(law),
      material<Water, Wall>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 10.0}, rheology::Constant{.dynamic_viscosity = 0.1}));
}

}  // namespace

TEST_CASE("a driven wall drags from the first evaluation on; crossing the periodic face wears no lists out; its run restarts bit for bit") {
  auto scene = conveyor();
  (void)scene.step_limit();  // evaluates
  double drag = 0.0;
  for (const auto& a : scene.group<Water>().get<field::Acceleration>()) drag = std::max(drag, a[0]);
  CHECK(drag > 0.0);
  scene.run({.until = 1.5});  // one and a half times round
  CHECK(scene.engine().list_builds() < scene.step() / 5);
  const double support =
      scene.engine().longest_cutoff();  // particles go back into the box when lists are built, at the latest after this way
  for (const auto& x : scene.group<Wall>().positions()) CHECK((x[0] > -support && x[0] < 0.5 + support));
  const TemporaryFolder folder;
  const std::string path = (folder / "conveyor.checkpoint").string();
  scene.checkpoint(path);
  auto continued = conveyor();
  continued.restart(path);
  scene.run({.until = 1.6});
  continued.run({.until = 1.6});
  CHECK(same_bits(bits(scene), bits(continued)));
}

TEST_CASE("a driven wall pushes all along as it did before when some of it has crossed the periodic face") {
  auto scene = conveyor();
  auto& water = scene.group<Water>();
  water.set<field::Velocity>(
      [](const auto&) { return Vector<2>(0.5, 0.0); });  // along with the conveyor: all columns of the water are alike
  scene.engine().for_each_group([](auto& g) { g.template set<field::Density>([](const auto&) { return 1.05; }); });
  double spread = 0.0, largest = 0.0;
  scene.every(1e-3, [&](const auto& s) {
    const auto& acceleration = s.template group<Water>().template get<field::Acceleration>();
    double least = 1e30, most = -1e30;
    for (std::size_t k = 0; k < acceleration.size(); ++k)
      if (s.template group<Water>().id[k] < 10) {  // the row next to the wall
        least = std::min(least, acceleration[k][1]);
        most = std::max(most, acceleration[k][1]);
      }
    spread = std::max(spread, most - least);
    largest = std::max(largest, std::fabs(most));
  });
  scene.run({.until = 0.06, .time_step = 5e-4});  // the first column of the wall crosses at 0.05 s
  CHECK(largest > 10.0);
  CHECK(spread < 1e-9 * largest);
}

namespace {

/// Sees how far outside the unit square particles are.
struct Watch {
  double* farthest;
  [[nodiscard]] Components<2, double> acceleration(const auto& subject) const {
    for (int d = 0; d < 2; ++d) *farthest = std::max(*farthest, std::fabs(subject.position[d] - 0.5) - 0.5);
    return {{0.0, 0.0}};
  }
};
void validate(const Watch&) {}

}  // namespace

TEST_CASE("a forcing sees particles in the periodic box, to within the cut-off and a step, however far the fluid has drifted") {
  const Threads threads(1);
  const double spacing = 0.05;
  double farthest = 0.0;
  auto scene = simulation::scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {true, true}},
      group<Water>("water", Mobile{}, geometry::fill(geometry::Cubic<2>{.spacing = spacing}, {.lower = {0.0, 0.0}, .upper = {1.0, 1.0}}),
                   spacing * spacing),
      interaction<Water, Water>(Flow{.kernel = {.support_radius = 2.6 * spacing}}), forced_by<Water>(Watch{&farthest}),
      material<Water>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 10.0}, rheology::Constant{.dynamic_viscosity = 0.01}));
  scene.group<Water>().set<field::Velocity>([](const auto&) { return Vector<2>(100.0, -70.0); });
  scene.run({.until = 0.03, .time_step = 1e-4});
  CHECK(farthest <= scene.engine().longest_cutoff() + 100.0 * 1e-4);
}

TEST_CASE("sub-stepped bonds to a stationary partner restart bit for bit") {
  const auto make = [] {
    return simulation::scene<integrator::Leapfrog>(geometry::Box<2>::unbounded(),
                                                   group<Water>("bead", Mobile{}, geometry::Points<2>{.positions = {{1.2, 0.0}}}, 1.0),
                                                   group<Wall>("post", Stationary{}, geometry::Points<2>{.positions = {{0.0, 0.0}}}, 1.0),
                                                   substepped_bonds<Water, Wall>(bond::Harmonic{.stiffness = 100.0}, {{0, 0, 1.0}}),
                                                   forced_by<Water>(forcing::Constant<2>{.uniform_acceleration = {{{0.0, -1.0}}}}));
  };
  const TemporaryFolder folder;
  const std::string path = (folder / "bead.checkpoint").string();
  auto through = make();
  through.run({.until = 0.5, .time_step = 0.05});
  through.checkpoint(path);
  auto continued = make();
  continued.restart(path);
  through.run({.until = 1.0, .time_step = 0.05});
  continued.run({.until = 1.0, .time_step = 0.05});
  CHECK(same_bits(bits(through), bits(continued)));
  CHECK(through.group<Water>().positions()[0][0] != 1.2);
}

TEST_CASE("a skin set by an observer in mid-run leaves the forces as they are") {
  auto plain = vortex({}), changed = vortex({});
  changed.every(0.011, [](auto& scene) { scene.set_skin(scene.time() < 0.02 ? 0.03 : 0.005); });
  plain.run({.until = 0.05, .time_step = 5e-4});
  changed.run({.until = 0.05, .time_step = 5e-4});
  const auto a = bits(plain), b = bits(changed);
  double difference = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) difference = std::max(difference, std::fabs(a[k] - b[k]) / (1.0 + std::fabs(a[k])));
  CHECK(difference < 1e-9);  // the order of the sums alone
}
