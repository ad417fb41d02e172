// Two dam breaks: a column of water collapses on a dry floor (2D), and a reservoir breaks over a box (3D) (80 s; 8 s with --quick).
// How far do surge front and water levels follow the experiments, and does the scheme only ever lose energy, and no water?
// 2D: J. C. Martin, W. J. Moyce, Phil. Trans. R. Soc. A 244 (1952) 312-324, doi:10.1098/rsta.1952.0006: column a wide and 2a high.
// 3D: K. M. T. Kleefsman et al., J. Comput. Phys. 206 (2005) 363-393, doi:10.1016/j.jcp.2004.12.007: the dam break of MARIN, benchmark 2
// of SPHERIC (https://www.spheric-sph.org/tests/test-02).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <dmp/dmp.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "support/options.hpp"
#include "support/result.hpp"

using namespace dmp;
using namespace dmp::simulation;
using geometry::Cuboid, geometry::Points;
using particles::Mobile, particles::Stationary;

struct Water {};
struct Wall {};

namespace {

constexpr double density = 1000.0, gravity = 9.81;  // [kg/m^3], [m/s^2]
constexpr int wall_layers = 3;

/// A tank with a block of water in one of its corners, held back until the start. The last direction is up, the floor is at 0.
template <int Dim>
struct Dam {
  std::string name;
  double spacing;                   // [m]
  Points<Dim> water, wall;
  Cuboid<Dim> tank;                 // what the walls enclose [m]
  double closed_end, width, depth;  // x of the wall behind the water; extent of the water from there, and its depth [m]
  std::vector<Vector<Dim>> gauges;  // where the water level is read; the height is of no meaning [m]
  double end_time, interval;        // of the run, and between two samples [s]
};

/// Pressure [Pa] of an incompressible fluid at the instant when the face at `width` is released: Laplace's equation with p = 0 there and
/// on top, and dp/dz = -rho g on the floor. Water that starts from it does not ring. Beyond the walls: the mirror image.
double released_pressure(double from_closed_end, double height, double width, double depth) {
  const double s = std::abs(from_closed_end), z = std::abs(height);
  if (s >= width || z >= depth) return 0.0;
  double pressure = height < 0.0 ? 2.0 * density * gravity * z : 0.0, sign = 1.0;
  for (int n = 0; n < 100; ++n, sign = -sign) {
    const double k = (n + 0.5) * std::numbers::pi / width;
    const double decay = (std::exp(-k * z) - std::exp(-k * (2.0 * depth - z))) / (1.0 + std::exp(-2.0 * k * depth));
    pressure += sign * 2.0 * density * gravity / (k * k * width) * std::cos(k * s) * decay;
  }
  return pressure;
}

struct Sample {
  double time, front;                    // [s], distance of the foremost water from the closed end [m]
  double kinetic, potential, elastic;    // [J], in 2D [J/m]
  double lightest, heaviest;             // water: density, relative to that at rest, minus 1
  std::size_t inside;                    // particles of water in the tank
  std::vector<double> levels;            // at the gauges [m]

  double energy() const { return kinetic + potential + elastic; }
};

template <class Scene, int Dim>
Sample observe(const Scene& scene, const Dam<Dim>& dam, const eos::Tait& eos) {
  constexpr int up = Dim - 1;
  const auto& water = scene.template group<Water>();
  const auto& densities = water.template get<field::Density>();
  const double half = 2.0 * dam.spacing;  // a gauge reads the volume of water that stands on a patch of this half width
  Sample sample{.time = scene.time(), .front = 0.0, .kinetic = 0.0, .potential = 0.0, .elastic = 0.0, .lightest = 0.0, .heaviest = 0.0, .inside = 0,
                .levels = std::vector<double>(dam.gauges.size(), 0.0)};
  const auto elastic = [&eos](double rho) {  // integral of p/rho^2 [J/kg]
    const double x = rho / eos.rest_density, n = eos.exponent - 1.0;
    return eos.stiffness() / eos.rest_density * ((std::pow(x, n) - 1.0) / n + 1.0 / x - 1.0);
  };
  for (std::size_t i = 0; i < water.size(); ++i) {
    const auto& x = water.positions()[i];
    const double rho = densities[i], deviation = rho / density - 1.0;
    sample.front = std::max(sample.front, std::abs(x[0] - dam.closed_end) + 0.5 * dam.spacing);
    sample.kinetic += 0.5 * water.mass * water.template get<field::Velocity>()[i].squaredNorm();
    sample.potential += water.mass * gravity * x[up];
    sample.elastic += water.mass * elastic(rho);
    sample.lightest = std::min(sample.lightest, deviation);
    sample.heaviest = std::max(sample.heaviest, deviation);
    if (dam.tank.contains(x)) ++sample.inside;
    for (std::size_t k = 0; k < dam.gauges.size(); ++k)
      if ((x - dam.gauges[k]).template head<up>().cwiseAbs().maxCoeff() < half) sample.levels[k] += water.mass / rho / std::pow(2.0 * half, up);
  }
  const auto& wall = scene.template group<Wall>();
  for (const double rho : wall.template get<field::Density>()) sample.elastic += wall.mass * elastic(rho);
  return sample;
}

/// Composes and runs one dam break; what was seen goes into <name>.csv, what the run took into `result`.
template <int Dim>
std::vector<Sample> collapse(const Dam<Dim>& dam, const io::OutputFolder& folder, example::Result& result) {
  // Laws
  const double sound_speed = 10.0 * std::sqrt(2.0 * gravity * dam.depth);  // [m/s]
  const eos::Tait eos{.rest_density = density, .sound_speed_0 = sound_speed};
  const sph::WeaklyCompressible<kernel::WendlandC2<Dim>, viscosity::Artificial, diffusion::MolteniColagrossi> flow{
      .kernel = {.support_radius = 2.6 * dam.spacing}, .viscosity = {.alpha = 0.02, .sound_speed = sound_speed}, .diffusion = {.sound_speed = sound_speed}};
  forcing::Constant<Dim> weight{.uniform_acceleration = Components<Dim, double>{}};
  weight.uniform_acceleration.value[Dim - 1] = -gravity;

  // Scene
  const Vector<Dim> margin = Vector<Dim>::Constant((wall_layers + 1) * dam.spacing);
  const double mass = density * dam.water.volume;
  auto tank = scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<Dim>{.lower = dam.tank.lower - margin, .upper = dam.tank.upper + margin}, group<Water>(dam.name + "_water", Mobile{}, dam.water, mass),
      group<Wall>(dam.name + "_wall", Stationary{}, dam.wall, mass), interaction<Water, Water>(flow), interaction<Water, Wall>(flow),
      material<Water, Wall>(eos), forced_by<Water>(weight));
  const auto at_release = [&](const Vector<Dim>& x) {
    const double sign = dam.tank.lower[0] < dam.closed_end - 0.5 * dam.width ? -1.0 : 1.0;
    return eos.density(released_pressure(sign * (x[0] - dam.closed_end), x[Dim - 1], dam.width, dam.depth));
  };
  tank.engine().for_each_group([&](auto& g) { g.template set<field::Density>(at_release); });
  std::fputs(describe(tank).c_str(), stdout);

  // Observation
  std::vector<io::Column> columns{{"time", "s"}, {"front", "m"}, {"kinetic energy", "J"}, {"potential energy", "J"}, {"elastic energy", "J"},
                                  {"lowest density/rest - 1", "-"}, {"highest density/rest - 1", "-"}, {"particles in the tank", "-"}};
  for (const auto& gauge : dam.gauges) columns.push_back({"level at x = " + to_text(gauge[0]), "m"});
  io::CsvTable table(folder / (dam.name + ".csv"), columns);
  std::vector<Sample> history;
  tank.every(dam.interval, [&](const auto& scene) {
    const Sample& s = history.emplace_back(observe(scene, dam, eos));
    std::vector<double> row{s.time, s.front, s.kinetic, s.potential, s.elastic, s.lightest, s.heaviest, static_cast<double>(s.inside)};
    row.insert(row.end(), s.levels.begin(), s.levels.end());
    table.row(row);
  });
  tank.every(dam.end_time / 50.0, VtkOutput(folder, dam.name));
  tank.rescue_to((folder / (dam.name + "_last_good.checkpoint")).string()).progress();

  // Run
  result.add(tank.run({.until = dam.end_time, .safety = std::getenv("SAFETY") ? std::atof(std::getenv("SAFETY")) : 0.3}));
  result.particles += tank.particles();
  result.bytes_per_particle = bytes_per_particle(tank);
  return history;
}

}  // namespace

namespace {
Dam<2> column(int across) {
  constexpr double a = 0.05715;
  const double spacing = a / across;
  const geometry::Cubic<2> lattice{.spacing = spacing};
  const Cuboid<2> tank{.lower = {0.0, 0.0}, .upper = {4.0 * a, 6.0 * a}};
  const Vector<2> layers = Vector<2>::Constant(wall_layers * spacing);
  const double unit = std::sqrt(a / (2.0 * gravity));
  return {.name = "column", .spacing = spacing,
          .water = fill(lattice, {.lower = {0.0, 0.0}, .upper = {a, 2.0 * a}}),
          .wall = fill(lattice, {.lower = tank.lower - layers, .upper = {tank.upper[0] + layers[0], tank.upper[1]}}, !tank),
          .tank = tank, .closed_end = 0.0, .width = a, .depth = 2.0 * a,
          .gauges = {{2.0 * spacing, 0.0}, {2.0 * a, 0.0}, {3.0 * a, 0.0}, {4.0 * a - 2.0 * spacing, 0.0}}, .end_time = (std::getenv("TEND") ? std::atof(std::getenv("TEND")) : 12.0) * unit, .interval = 0.02 * unit};
}
Dam<3> reservoir(int deep, double end_time) {
  constexpr double depth = 0.55;
  const double spacing = depth / deep;
  const geometry::Cubic<3> lattice{.spacing = spacing};
  const auto whole = [spacing](double length) { return std::round(length / spacing) * spacing; };
  const double length = whole(3.22), breadth = whole(1.0), gate = whole(1.992);
  const Cuboid<3> tank{.lower = {0.0, 0.0, 0.0}, .upper = {length, breadth, whole(1.0)}};
  const Cuboid<3> box{.lower = {whole(0.6635), whole(0.2985), 0.0}, .upper = {whole(0.8245), whole(0.7015), whole(0.161)}};
  const Vector<3> layers = Vector<3>::Constant(wall_layers * spacing);
  return {.name = "reservoir", .spacing = spacing,
          .water = fill(lattice, {.lower = {gate, 0.0, 0.0}, .upper = {length, breadth, depth}}),
          .wall = fill(lattice, {.lower = tank.lower - layers, .upper = {length + layers[0], breadth + layers[1], tank.upper[2]}}, (!tank) | box),
          .tank = tank, .closed_end = length, .width = length - gate, .depth = depth,
          .gauges = {{0.496, 0.5, 0.0}, {0.992, 0.5, 0.0}, {1.488, 0.5, 0.0}, {2.638, 0.5, 0.0}}, .end_time = std::getenv("T3") ? std::atof(std::getenv("T3")) : end_time, .interval = 0.01};
}
int run(const example::Options& options) {
  const io::OutputFolder folder(options.output);
  example::Result result{.example = "dam_break"};
  const int na = std::getenv("NA") ? std::atoi(std::getenv("NA")) : 24, nr = std::getenv("NR") ? std::atoi(std::getenv("NR")) : 10;
  if (na) collapse(column(na), folder, result);
  if (nr) collapse(reservoir(nr, 2.0), folder, result);
  result.error("x", 0, 0, "x");
  return result.print();
}
}
int main(int argc, char** argv) {
  return example::guarded("dam_break", run, example::options(argc, argv, "dam_break", "x"));
}
