// Properties that are found from the neighbours before the forces: who is summed, when, and that nothing else changes.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <doctest/doctest.h>

#include "io/temporary_folder.hpp"
#include "scenes.hpp"
#include "support/particles.hpp"
#include "support/threads.hpp"

using namespace test;

namespace {

using Kernel = kernel::Quartic<2>;

/// All columns of all groups in the order of the ids, as bits.
template <class Scene>
std::vector<double> bits_of(Scene& scene) {
  std::vector<double> result;
  scene.engine().for_each_group([&](auto& g) {
    std::vector<std::size_t> row(g.size());
    for (std::size_t k = 0; k < g.size(); ++k) row[g.id[k]] = k;
    const auto view = g.view();
    for (const auto& column : view.columns) {
      const auto numbers = static_cast<std::size_t>(column.components);
      for (const std::size_t k : row)
        for (std::size_t d = 0; d < numbers; ++d) result.push_back(column.values[k * numbers + d]);
    }
  });
  return result;
}
bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// Becomes thinner where it is sheared faster.
struct Thinning {
  double mu;  // [Pa s] at rest
  [[nodiscard]] auto apparent_viscosity(const auto& shear_rate) const { return mu / (1.0 + shear_rate); }
};
void validate(const Thinning&) {}

/// Unit square, periodic: water of random places beside a slab of stationary wall with other masses.
struct Mixture {
  std::size_t of_water = 9000, of_wall = 5000;
  std::uint64_t every = 1;
};
template <class Precision = precision::Double>
auto mixture(const Mixture& m) {
  ParticleSource source;
  const double support = 0.03;
  const auto points = [&](std::size_t count, double from, double to) {
    geometry::Points<2> result;
    for (std::size_t k = 0; k < count; ++k) result.positions.emplace_back(source.between(from, to), source.between(0.0, 1.0));
    return result;
  };
  const Flow law{.kernel = {.support_radius = support}};
  auto result = scene<integrator::ExtrapolatedVerlet, Precision>(
      geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {true, true}},
      group<Water>("water", Mobile{}, points(m.of_water, 0.0, 0.7), 0.7 / static_cast<double>(m.of_water)),
      group<Wall>("wall", Stationary{}, points(m.of_wall, 0.65, 1.0), 0.4 / static_cast<double>(m.of_wall)), interaction<Water, Water>(law),
      interaction<Wall, Water>(law), interaction<Wall, Wall>(law),
      summed<Water, Wall>(sph::DensitySum<Kernel>{.kernel = {.support_radius = support}}, m.every),
      summed<Water>(sph::ShearRate<kernel::WendlandC2<2>>{.kernel = {.support_radius = support}}, m.every),
      material<Water>(eos::Linear{.rest_density = 1.0, .sound_speed_0 = 10.0}, Thinning{0.01}),
      material<Wall>(eos::Linear{.rest_density = 1.0, .sound_speed_0 = 10.0}, rheology::Constant{.dynamic_viscosity = 0.01}));
  result.template group<Water>().template set<field::Velocity>(
      [](const Vector<2>& x) { return Vector<2>(std::sin(20.0 * x[1]), std::cos(30.0 * x[0])); });
  return result;
}

/// Largest error of the density of both groups against a plain loop over all pairs and their nearest images, as a fraction of the largest.
template <class Scene>
double density_error(Scene& scene) {
  struct Everybody {
    std::vector<double> x, y, mass, density;
  } all;
  scene.engine().for_each_group([&](const auto& g) {
    for (std::size_t k = 0; k < g.size(); ++k) {
      all.x.push_back(g.positions()[k][0]);
      all.y.push_back(g.positions()[k][1]);
      all.mass.push_back(g.mass);
      all.density.push_back(g.template get<field::Density>()[k]);
    }
  });
  const Kernel kernel{.support_radius = 0.03};
  double error = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < all.x.size(); ++i) {
    double expected = 0.0;
    for (std::size_t j = 0; j < all.x.size(); ++j) {
      const double x = all.x[i] - all.x[j], y = all.y[i] - all.y[j], dx = x - std::round(x), dy = y - std::round(y), r2 = dx * dx + dy * dy;
      if (r2 < 0.03 * 0.03) expected += all.mass[j] * kernel.value(std::sqrt(r2));
    }
    error = std::max(error, std::fabs(all.density[i] - expected));
    largest = std::max(largest, expected);
  }
  return error / largest;
}

}  // namespace

TEST_CASE(
    "the density sum of two groups of several blocks in a periodic box is that of a plain loop over all pairs; single precision has six "
    "digits") {
  auto scene = mixture({});
  (void)scene.step_limit();  // evaluates
  CHECK(scene.group<Water>().blocks.size() >= 2);
  CHECK(density_error(scene) < 1e-13);
  auto single = mixture<precision::Single>({});
  (void)single.step_limit();
  CHECK(density_error(single) < 1e-5);
  const auto& rates = scene.group<Water>().get<field::ShearRate>();
  const auto& in_single = single.group<Water>().get<field::ShearRate>();
  double difference = 0.0, largest = 0.0;
  for (std::size_t k = 0; k < rates.size(); ++k) {
    CHECK_MESSAGE(scene.group<Water>().id[k] == single.group<Water>().id[k], "the same order");
    difference = std::max(difference, std::fabs(rates[k] - in_single[k]));
    largest = std::max(largest, rates[k]);
  }
  CHECK(largest > 20.0);
  CHECK(difference < 1e-4 * largest);
}

TEST_CASE("summed properties have the same bits with 1 and with 4 threads, at the start and after a run over several builds of the lists") {
  std::vector<double> first, last;
  for (const int count : {1, 4}) {
    const Threads threads(count);
    auto scene = mixture({.of_water = 14000, .of_wall = 6000, .every = 2});
    scene.set_skin(0.0015);
    (void)scene.step_limit();
    CHECK(scene.group<Water>().blocks.size() >= 3);
    const auto at_start = bits_of(scene);
    scene.run({.until = 1e-3, .time_step = 1e-4});
    CHECK(scene.engine().list_builds() >= 2);
    const auto at_end = bits_of(scene);
    if (first.empty()) first = at_start, last = at_end;
    CHECK(same_bits(at_start, first));
    CHECK(same_bits(at_end, last));
    CHECK(!same_bits(at_start, at_end));
  }
}

namespace {

/// How often a particle has been visited.
struct Visits {
  static constexpr std::string_view name = "visits", unit = "-";
  static constexpr bool is_vector = false;
  template <int Dim, class T>
  struct Slot {
    T visits;
  };
  static constexpr auto& of(auto& slots) { return slots.visits; }
};
/// Counts its visits, and nothing else.
struct Visit {
  using reads = Fields<Visits>;
  using sums = Fields<field::Density>;
  using sets = Fields<Visits>;
  static constexpr bool uses_velocity = false;
  double reach;
  [[nodiscard]] double cutoff() const { return reach; }
  void add(const auto&, const auto&, const auto&, auto&) const {}
  void set(auto& particle, const auto&) const { particle.visits += 1.0; }
};
void validate(const Visit&) {}

}  // namespace

TEST_CASE("a summed law with `every` 5 acts at the start and then in steps divisible by 5, however the run is cut, and in a restart too") {
  const double spacing = 0.1;
  const auto make = [&] {
    auto result = scene<integrator::ExtrapolatedVerlet>(
        geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {true, true}},
        group<Water>("water", Mobile{}, geometry::fill(geometry::Cubic<2>{.spacing = spacing}, {.lower = {0.0, 0.0}, .upper = {1.0, 1.0}}),
                     spacing * spacing),
        interaction<Water, Water>(Flow{.kernel = {.support_radius = 0.26}}), summed<Water>(Visit{0.26}, 5),
        material<Water>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 10.0}, rheology::Constant{.dynamic_viscosity = 0.01}));
    return result;
  };
  const auto visits = [](const auto& scene) {
    const auto& of = scene.template group<Water>().template get<Visits>();
    CHECK(*std::min_element(of.begin(), of.end()) == *std::max_element(of.begin(), of.end()));
    return of[0];
  };
  auto scene = make();
  CHECK(visits(scene) == 0.0);
  const double dt = 1.0 / 1024.0;
  scene.run({.until = 4.0 * dt, .time_step = dt});
  CHECK(scene.step() == 4);
  CHECK(visits(scene) == 1.0);
  scene.run({.until = 5.0 * dt, .time_step = dt});
  CHECK(visits(scene) == 2.0);
  scene.run({.until = 23.0 * dt, .time_step = dt});
  CHECK(visits(scene) == 5.0);
  const TemporaryFolder folder;
  const std::string path = (folder / "visits.checkpoint").string();
  scene.checkpoint(path);
  auto continued = make();
  continued.restart(path);
  continued.run({.until = 41.0 * dt, .time_step = dt});
  CHECK(continued.step() == 41);
  CHECK(visits(continued) == 9.0);
  CHECK_THROWS_WITH_AS((void)summed<Water>(Visit{0.26}, 0), doctest::Contains("summed: every must be >= 1 step, got 0"), ParameterError);
}

namespace {

/// The vortex with the density of the particles around; the largest |rho_sum - rho| at the end of a run to 0.05 s in `steps` steps.
template <class Integrator>
double density_lag(int steps) {
  constexpr double spacing = 1.0 / 24.0, k = 2.0 * std::numbers::pi;
  const double support = 2.6 * spacing;
  auto flow = scene<Integrator>(
      geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {true, true}},
      group<Water>("water", Mobile{}, geometry::fill(geometry::Cubic<2>{.spacing = spacing}, {.lower = {0.0, 0.0}, .upper = {1.0, 1.0}}),
                   spacing * spacing),
      interaction<Water, Water>(Flow{.kernel = {.support_radius = support}}),
      summed<Water>(sph::DensitySum<Kernel>{.kernel = {.support_radius = support}}),
      material<Water>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 5.0}, rheology::Constant{.dynamic_viscosity = 0.02}));
  auto& water = flow.template group<Water>();
  water.template set<field::Velocity>(
      [](const Vector<2>& x) { return Vector<2>(std::sin(k * x[0]) * std::cos(k * x[1]), -std::cos(k * x[0]) * std::sin(k * x[1])); });
  flow.run({.until = 0.05, .time_step = 0.05 / steps});
  CHECK(flow.step() == static_cast<std::uint64_t>(steps));
  const auto sums = flow.template find_sums<Water>(sph::DensitySum<Kernel>{.kernel = {.support_radius = support}});
  double lag = 0.0;
  for (std::size_t i = 0; i < water.size(); ++i) lag = std::max(lag, std::fabs(sums[i].density - water.template get<field::Density>()[i]));
  return lag;
}

}  // namespace

TEST_CASE(
    "summed in every step, the density at the end of a step is the sum there, to second order or better in the time step; with LAMMPS' "
    "half-step state to first order") {
  const double of_100 = density_lag<integrator::ExtrapolatedVerlet>(100), of_200 = density_lag<integrator::ExtrapolatedVerlet>(200);
  CHECK(of_100 < 1e-4);
  CHECK(of_100 > 3.8 * of_200);
  const double leapfrog_100 = density_lag<integrator::Leapfrog>(100), leapfrog_200 = density_lag<integrator::Leapfrog>(200);
  CHECK(leapfrog_100 < 1e-4);
  CHECK(leapfrog_100 > 3.8 * leapfrog_200);
  const double euler_100 = density_lag<integrator::SymplecticEuler>(100), euler_200 = density_lag<integrator::SymplecticEuler>(200);
  CHECK(euler_100 > 3.8 * euler_200);
  const double lammps_100 = density_lag<integrator::LammpsVerlet>(100), lammps_200 = density_lag<integrator::LammpsVerlet>(200);
  CHECK(lammps_100 == doctest::Approx(2.0 * lammps_200).epsilon(0.05).scale(0.0));  // what laws see there is the state of half a step ago
}

TEST_CASE(
    "FS-1: in a channel with density summation frozen walls keep every bit, hold no force that could work on them, and fill up the sums of "
    "the fluid beside them") {
  const double spacing = 0.05, support = 2.6 * spacing;
  const geometry::Cubic<2> lattice{.spacing = spacing};
  const Flow law{.kernel = {.support_radius = support}};
  auto scene = simulation::scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>{.lower = {0.0, -0.2}, .upper = {0.5, 0.6}, .periodic = {true, false}},
      group<Water>("water", Mobile{}, geometry::fill(lattice, {.lower = {0.0, 0.0}, .upper = {0.5, 0.4}}), spacing * spacing),
      group<Wall>("wall", Frozen<2>{},
                  geometry::fill(lattice, {.lower = {0.0, -0.15}, .upper = {0.5, 0.55}},
                                 !geometry::Cuboid<2>{.lower = {-1.0, 0.0}, .upper = {1.0, 0.4}}),
                  spacing * spacing),
      interaction<Water, Water>(law), interaction<Water, Wall>(law),
      summed<Water>(sph::DensitySum<Kernel>{.kernel = {.support_radius = support}}, 3),
      forced_by<Water>(forcing::Constant<2>{.uniform_acceleration = {{{1.0, 0.0}}}}),
      material<Water, Wall>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 10.0}, rheology::Constant{.dynamic_viscosity = 0.1}));
  auto& wall = scene.group<Wall>();
  ParticleSource source;
  wall.set<field::Density>([&](const auto&) { return source.between(0.999, 1.001); });
  static_assert(std::is_same_v<std::remove_cvref_t<decltype(wall)>::Layout::columns, Fields<field::Position, field::Density>>);
  const auto view = wall.view();
  std::vector<std::vector<double>> before;
  for (const auto& column : view.columns) before.emplace_back(column.values.begin(), column.values.end());
  scene.run({.until = 0.3});
  CHECK(scene.step() > 50);
  const auto after = wall.view();
  for (std::size_t c = 0; c < before.size(); ++c)
    CHECK(same_bits(before[c], {after.columns[c].values.begin(), after.columns[c].values.end()}));
  double least = 2.0, most = 0.0;
  for (const auto& at : scene.find_sums<Water>(sph::DensitySum<Kernel>{.kernel = {.support_radius = support}})) {
    least = std::min(least, at.density);
    most = std::max(most, at.density);
  }
  CHECK(least > 0.97);  // the wall's mass is in the sums
  CHECK(most < 1.03);
  double fastest = 0.0;
  for (const auto& v : scene.group<Water>().get<field::Velocity>()) fastest = std::max(fastest, v[0]);
  CHECK(fastest > 0.01);
}

TEST_CASE("a fluid that thins with shear and has its density summed restarts bit for bit, whatever step the checkpoint was written in") {
  const TemporaryFolder folder;
  for (const int steps : {7, 8}) {
    CAPTURE(steps);
    const std::string path = (folder / ("thinning" + std::to_string(steps))).string();
    const auto make = [] { return mixture({.of_water = 1500, .of_wall = 500, .every = 4}); };
    auto through = make();
    through.run({.until = steps * 1e-4, .time_step = 1e-4});
    through.checkpoint(path);
    auto continued = make();
    continued.restart(path);
    through.run({.until = 30e-4, .time_step = 1e-4});
    continued.run({.until = 30e-4, .time_step = 1e-4});
    CHECK(same_bits(bits_of(through), bits_of(continued)));
  }
}

TEST_CASE("a summed law that reaches beyond the cut-off of an interaction of its group is refused; so is one that only looks on") {
  const auto make = [](double support) {
    const geometry::Points<2> points{.positions = {{0.0, 0.0}, {0.1, 0.0}}};
    return scene<integrator::ExtrapolatedVerlet>(
        geometry::Box<2>::unbounded(), group<Water>("water", Mobile{}, points, 1.0),
        group<Wall>("wall", Frozen<2>{}, geometry::Points<2>{.positions = {{0.0, 0.3}}}, 1.0),
        interaction<Water, Water>(Flow{.kernel = {.support_radius = 0.5}}),
        interaction<Wall, Water>(Flow{.kernel = {.support_radius = 0.4}}),
        summed<Water>(sph::DensitySum<Kernel>{.kernel = {.support_radius = support}}),
        material<Water, Wall>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 1.0}, rheology::Constant{.dynamic_viscosity = 0.1}));
  };
  CHECK_NOTHROW((void)make(0.4));
  CHECK_THROWS_WITH_AS(
      (void)make(0.41),
      doctest::Contains("summed: support radius must be <= the cut-off of the interaction of wall and water (0.4 m), got 0.41"),
      ParameterError);
  CHECK_THROWS_WITH_AS(
      (void)make(0.6),
      doctest::Contains("summed: support radius must be <= the cut-off of the interaction of water and water (0.5 m), got 0.6"),
      ParameterError);
  CHECK_THROWS_WITH_AS((void)(summed<Water>(sph::DensitySum<Kernel>{.kernel = {.support_radius = -1.0}})),
                       doctest::Contains("kernel::Quartic: support_radius must be finite and > 0 m, got -1"), ParameterError);
  auto scene = make(0.4);
  CHECK_THROWS_WITH_AS((void)scene.find_sums<Water>(sph::DensitySum<Kernel>{.kernel = {.support_radius = 0.45}}),
                       doctest::Contains("support radius must be <= the cut-off of the interaction of wall and water (0.4 m), got 0.45"),
                       ParameterError);
}

TEST_CASE(
    "find_sums tells the density around from that of the continuity equation, leaves everything as it is, and does so after a checkpoint "
    "and a restart too") {
  const sph::DensitySum<Kernel> law{.kernel = {.support_radius = 2.6 / 24.0}};
  auto flow = vortex({});
  flow.run({.until = 0.05, .time_step = 5e-4});
  const auto before = bits_of(flow);
  const auto sorted = [&](auto& scene) {
    const auto& water = scene.template group<Water>();
    const auto found = scene.template find_sums<Water>(law);
    std::vector<double> result(water.size());
    for (std::size_t i = 0; i < water.size(); ++i) result[water.id[i]] = found[i].density - water.template get<field::Density>()[i];
    return result;
  };
  const auto difference = sorted(flow);
  const auto [least, most] = std::minmax_element(difference.begin(), difference.end());
  CHECK(*least > -0.05);
  CHECK(*most < 0.05);
  CHECK(*most - *least > 1e-6);
  CHECK(same_bits(bits_of(flow), before));
  const auto same = [&](const std::vector<double>& other) {
    double error = 0.0;
    for (std::size_t i = 0; i < other.size(); ++i) error = std::max(error, std::fabs(other[i] - difference[i]));
    return error < 1e-13;
  };
  const TemporaryFolder folder;
  const std::string path = (folder / "vortex").string();
  flow.checkpoint(path);
  CHECK(same(sorted(flow)));
  auto continued = vortex({});
  continued.restart(path);
  CHECK(same(sorted(continued)));
  flow.run({.until = 0.06, .time_step = 5e-4});
  continued.run({.until = 0.06, .time_step = 5e-4});
  CHECK(same_bits(bits_of(flow), bits_of(continued)));
}

TEST_CASE("find_sums of what depends on the state sees the state between two steps, not that of half a step ago") {
  // Drops in free shear that grows in time: u = (w y t, 0), no forces between particles at rest density but friction,
  // which a linear u does not feel inside.
  const sph::ShearRate<kernel::WendlandC2<2>> law{.kernel = {.support_radius = 0.26}};
  auto scene = simulation::scene<integrator::Leapfrog>(
      geometry::Box<2>::unbounded(),
      group<Water>("water", Mobile{}, geometry::fill(geometry::Cubic<2>{.spacing = 0.1}, {.lower = {0.0, 0.0}, .upper = {1.0, 1.0}}), 0.01),
      interaction<Water, Water>(sph::WeaklyCompressible<kernel::WendlandC2<2>>{.kernel = {.support_radius = 0.26}}),
      material<Water>(eos::Linear{.rest_density = 1.0, .sound_speed_0 = 1e-6}), forced_by<Water>(forcing::Drag{.coefficient = 0.1}));
  auto& water = scene.group<Water>();
  water.set<field::Velocity>([](const Vector<2>& x) { return Vector<2>(2.0 * x[1], 0.0); });
  scene.run({.until = 0.01, .time_step = 0.01});
  Vector<2> slowest = water.get<field::Velocity>()[0], fastest = water.get<field::Velocity>()[99];
  const double now = (fastest[0] - slowest[0]) / (water.positions()[99][1] - water.positions()[0][1]);
  for (const auto& at : scene.find_sums<Water>(law)) CHECK(at.shear_rate == doctest::Approx(now).epsilon(1e-9));
}
