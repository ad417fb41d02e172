// Two dam breaks: a column of water collapses on a dry floor (2D), and a reservoir breaks over a box (3D) (75 s; 4 s with --quick).
// How far do surge front and water levels follow the experiments, and does the scheme only ever lose energy, and no water?
// 2D: J. C. Martin, W. J. Moyce, Phil. Trans. R. Soc. A 244 (1952) 312-324, doi:10.1098/rsta.1952.0006: column a wide and 2a high.
// 3D: K. M. T. Kleefsman et al., J. Comput. Phys. 206 (2005) 363-393, doi:10.1016/j.jcp.2004.12.007: the dam break of MARIN, benchmark 2
// of SPHERIC (https://www.spheric-sph.org/tests/test-02).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <dmp/diffusion/molteni_colagrossi.hpp>
#include <dmp/eos/tait.hpp>
#include <dmp/forcing/constant.hpp>
#include <dmp/geometry/fill.hpp>
#include <dmp/geometry/lattice.hpp>
#include <dmp/geometry/shape.hpp>
#include <dmp/integrator/extrapolated_verlet.hpp>
#include <dmp/io/csv.hpp>
#include <dmp/io/plot.hpp>
#include <dmp/kernel/wendland_c2.hpp>
#include <dmp/simulation/items.hpp>
#include <dmp/simulation/output.hpp>
#include <dmp/simulation/scene.hpp>
#include <dmp/sph/weakly_compressible.hpp>
#include <dmp/viscosity/artificial.hpp>
#include <numbers>
#include <string>
#include <string_view>
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

  double tank_length() const { return tank.upper[0] - tank.lower[0]; }
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
  double variation;                      // root mean square of that
  int escaped;                           // particles of water more than a spacing outside the tank
  std::vector<double> levels;            // at the gauges [m]

  double energy() const { return kinetic + potential + elastic; }
};

template <class Scene, int Dim>
Sample observe(const Scene& scene, const Dam<Dim>& dam, const eos::Tait& eos) {
  constexpr int up = Dim - 1;
  const auto& water = scene.template group<Water>();
  const auto& densities = water.template get<field::Density>();
  const double half = 2.0 * dam.spacing;  // a gauge reads the volume of water that stands on a patch of this half width
  const Vector<Dim> skin = Vector<Dim>::Constant(dam.spacing);
  const Cuboid<Dim> around{.lower = dam.tank.lower - skin, .upper = dam.tank.upper + skin};
  Sample sample{.time = scene.time(), .front = 0.0, .kinetic = 0.0, .potential = 0.0, .elastic = 0.0,
                .lightest = 0.0, .heaviest = 0.0, .variation = 0.0, .escaped = 0,
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
    sample.variation += deviation * deviation / static_cast<double>(water.size());
    if (!around.contains(x)) ++sample.escaped;
    for (std::size_t k = 0; k < dam.gauges.size(); ++k) {
      bool is_read = true;
      for (int d = 0; d < up; ++d) is_read = is_read && std::abs(x[d] - dam.gauges[k][d]) < half;
      if (is_read) sample.levels[k] += water.mass / rho / std::pow(2.0 * half, up);
    }
  }
  sample.variation = std::sqrt(sample.variation);
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
      .kernel = {.support_radius = 2.6 * dam.spacing},
      .viscosity = {.alpha = 0.02, .sound_speed = sound_speed},
      .diffusion = {.sound_speed = sound_speed}};
  forcing::Constant<Dim> weight{.uniform_acceleration = Components<Dim, double>{}};
  weight.uniform_acceleration.value[Dim - 1] = -gravity;

  // Scene
  const Vector<Dim> margin = Vector<Dim>::Constant((wall_layers + 1) * dam.spacing);
  const double mass = density * dam.water.volume;
  auto tank = scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<Dim>{.lower = dam.tank.lower - margin, .upper = dam.tank.upper + margin},
      group<Water>(dam.name + "_water", Mobile{}, dam.water, mass), group<Wall>(dam.name + "_wall", Stationary{}, dam.wall, mass),
      interaction<Water, Water>(flow), interaction<Water, Wall>(flow), material<Water, Wall>(eos), forced_by<Water>(weight));
  const auto at_release = [&](const Vector<Dim>& x) {
    const double sign = dam.tank.lower[0] < dam.closed_end - 0.5 * dam.width ? -1.0 : 1.0;
    return eos.density(released_pressure(sign * (x[0] - dam.closed_end), x[Dim - 1], dam.width, dam.depth));
  };
  tank.engine().for_each_group([&](auto& g) { g.template set<field::Density>(at_release); });

  // Observation
  std::vector<io::Column> columns{{"time", "s"}, {"front", "m"}, {"kinetic energy", "J"}, {"potential energy", "J"},
                                  {"elastic energy", "J"}, {"lowest density/rest - 1", "-"}, {"highest density/rest - 1", "-"},
                                  {"particles lost", "-"}};
  for (const auto& gauge : dam.gauges) {
    std::string name = "level at x = ";
    columns.push_back({name += to_text(gauge[0]), "m"});
  }
  io::CsvTable table(folder / (dam.name + ".csv"), columns);
  std::vector<Sample> history;
  tank.every(dam.interval, [&](const auto& scene) {
    const Sample& s = history.emplace_back(observe(scene, dam, eos));
    std::vector<double> row{s.time, s.front, s.kinetic, s.potential, s.elastic, s.lightest, s.heaviest, static_cast<double>(s.escaped)};
    row.insert(row.end(), s.levels.begin(), s.levels.end());
    table.row(row);
  });
  tank.every(dam.end_time / 20.0, VtkOutput(folder, dam.name));
  tank.rescue_to((folder / (dam.name + "_last_good.checkpoint")).string()).progress();

  // Run
  result.add(tank.run({.until = dam.end_time}));
  result.describe(tank);

  // What holds for every dam break
  double lowest = history.front().energy(), growth = 0.0, variation = 0.0, peak = 0.0;
  int lost = 0;
  for (const Sample& s : history) {
    lowest = std::min(lowest, s.energy());
    growth = std::max(growth, s.energy() - lowest);
    variation = std::max(variation, s.variation);
    peak = std::max({peak, s.heaviest, -s.lightest});
    lost = std::max(lost, s.escaped);
  }
  const std::string of = dam.name + ": ";
  const double mach = 2.0 * std::sqrt(gravity * dam.depth) / sound_speed;  // of the fastest front that shallow water allows
  const double available = 0.5 * mass * static_cast<double>(dam.water.positions.size()) * gravity * dam.depth;  // [J]
  result.error(of + "particles lost", lost, 0.0, "impermeable");
  result.error(of + "growth of the total energy/initial", growth / available, 1e-3,
               "pressure conserves, viscosity and diffusion dissipate");
  result.error(of + "dissipated/initial energy", (history.front().energy() - history.back().energy()) / available,
               1.0 - dam.width / dam.tank_length(), "all, when the water has come to rest");
  result.error(of + "variation of density, rms", variation, mach * mach, "Mach number squared");
  result.error(of + "variation of density, largest", peak, mach, "water hammer: Mach number");
  return history;
}

/// The first time [s] when the front is `distance` [m] from the closed end.
double arrival(const std::vector<Sample>& history, double distance) {
  for (std::size_t i = 1; i < history.size(); ++i)
    if (history[i].front >= distance) {
      const double part = (distance - history[i - 1].front) / (history[i].front - history[i - 1].front);
      return std::lerp(history[i - 1].time, history[i].time, part);
    }
  return history.back().time;
}
/// Any quantity of a sample, at a time between two samples.
template <class Quantity>
double at(const std::vector<Sample>& history, double time, Quantity quantity) {
  for (std::size_t i = 1; i < history.size(); ++i)
    if (history[i].time >= time) {
      const double part = (time - history[i - 1].time) / (history[i].time - history[i - 1].time);
      return std::lerp(quantity(history[i - 1]), quantity(history[i]), part);
    }
  return quantity(history.back());
}

/// Martin and Moyce, table 2: column of width a = 2.25 inches and height 2a (n^2 = 2). Z = front/a at T = t sqrt(2 g/a). Taken from the
/// validation scripts of Ocellaris and of Lethe, which agree to 0.01; the paper itself was not at hand.
struct FrontPoint {
  double time, front;
};
constexpr std::array<FrontPoint, 13> martin_moyce{{{0.41, 1.11}, {0.84, 1.22}, {1.19, 1.44}, {1.43, 1.67}, {1.63, 1.89},
                                                   {1.83, 2.11}, {1.98, 2.33}, {2.20, 2.56}, {2.32, 2.78}, {2.51, 3.00},
                                                   {2.65, 3.22}, {2.83, 3.44}, {2.98, 3.67}}};
constexpr double inch_column = 0.05715;  // a [m]

void column(int across, double end, const io::OutputFolder& folder, example::Result& result) {
  constexpr double a = inch_column;
  const double spacing = a / across, unit = std::sqrt(a / (2.0 * gravity));
  const geometry::Cubic<2> lattice{.spacing = spacing};
  const Vector<2> layers = Vector<2>::Constant(wall_layers * spacing);
  const Cuboid<2> tank{.lower = {0.0, 0.0}, .upper = {4.0 * a, 10.0 * a}};  // so high that no splash leaves it
  const auto history =
      collapse<2>({.name = "column",
                   .spacing = spacing,
                   .water = fill(lattice, {.lower = {0.0, 0.0}, .upper = {a, 2.0 * a}}),
                   .wall = fill(lattice, {.lower = tank.lower - layers, .upper = {tank.upper[0] + layers[0], tank.upper[1]}}, !tank),
                   .tank = tank,
                   .closed_end = 0.0,
                   .width = a,
                   .depth = 2.0 * a,
                   .gauges = {{2.0 * spacing, 0.0}, {a, 0.0}, {2.0 * a, 0.0}, {3.0 * a, 0.0}, {4.0 * a - 2.0 * spacing, 0.0}},
                   .end_time = end * unit,
                   .interval = 0.02 * unit},
                  folder, result);
  // The gate of the experiment takes its time to open: times count from where Z = 1.44.
  const FrontPoint& start = martin_moyce[2];
  const double shift = start.time - arrival(history, start.front * a) / unit;
  double deviation = 0.0, overtaking = 0.0;
  for (const FrontPoint& point : martin_moyce)
    if (point.time > start.time)
      deviation = std::max(
          deviation, std::abs(at(history, (point.time - shift) * unit, [](const Sample& s) { return s.front; }) / (point.front * a) - 1.0));
  for (const Sample& s : history) overtaking = std::max(overtaking, s.front / a - 1.0 - 2.0 * s.time / unit - 0.5 / across);
  std::printf("column: the front of the experiment is %.2f sqrt(a/2g) late at Z = 1.44\n", shift);
  result.error("column: front, relative, Z = 1.67 to 3.67", deviation, 0.05, "Martin and Moyce table 2; their two columns differ by 4 %");
  result.error("column: front ahead of shallow water/a", overtaking, 0.0, "Ritter: 2 sqrt(g H)");

  std::string points;
  for (const FrontPoint& point : martin_moyce) points += to_text(point.time - shift) + " " + to_text(point.front) + "\n";
  io::plot(folder, "column",
           "set datafile separator ','\n$experiment << EOD\n" + points + "EOD\n"
           "set xlabel 't sqrt(2g/a)'\nset ylabel 'surge front/a'\nset key bottom right\nset xrange [0:4]\n"
           "plot 'column.csv' using ($1/" + to_text(unit) + "):($2/" + to_text(a) + ") skip 1 with lines lw 2 title 'dmp', "
           "$experiment using (real(word(strcol(1), 1))):(real(word(strcol(1), 2))) with points pt 6 ps 2 "
           "title 'Martin and Moyce 1952, from Z = 1.44'");
}

/// Water levels of the experiment of MARIN, as the example 3d-dam-break of Lethe holds them, sampled where no splash is on the gauge.
struct Level {
  std::size_t gauge;
  double time, level;  // [s], [m]
};
constexpr std::array<Level, 20> marin{{{3, 0.2, 0.511}, {3, 0.3, 0.486}, {3, 0.4, 0.460}, {3, 0.5, 0.428},  {3, 0.6, 0.395},
                                       {3, 0.7, 0.363}, {3, 1.0, 0.279}, {3, 1.1, 0.254}, {3, 1.45, 0.188}, {2, 0.3, 0.070},
                                       {2, 0.4, 0.099}, {2, 0.6, 0.115}, {2, 0.7, 0.124}, {2, 1.0, 0.155},  {2, 1.1, 0.158},
                                       {1, 0.4, 0.046}, {1, 0.6, 0.119}, {1, 0.7, 0.131}, {1, 1.0, 0.179},  {1, 1.1, 0.186}}};
constexpr std::array<double, 4> gauges{0.496, 0.992, 1.488, 2.638};  // x [m]; the box is between the first two, the last in the reservoir

/// The tank of the experiment is 1 m high and open. Here its walls may be higher, so that no splash leaves it.
void reservoir(int deep, double end, double height, const io::OutputFolder& folder, example::Result& result) {
  constexpr double depth = 0.55;
  const double spacing = depth / deep;
  const auto whole = [spacing](double length) { return std::round(length / spacing) * spacing; };
  const double length = whole(3.22), breadth = whole(1.0), gate = whole(1.992);
  const geometry::Cubic<3> lattice{.spacing = spacing};
  const Vector<3> layers = Vector<3>::Constant(wall_layers * spacing);
  const Cuboid<3> tank{.lower = {0.0, 0.0, 0.0}, .upper = {length, breadth, whole(height)}};
  const Cuboid<3> box{.lower = {whole(0.6635), whole(0.2985), 0.0}, .upper = {whole(0.8245), whole(0.7015), whole(0.161)}};
  std::vector<Vector<3>> places;
  for (const double x : gauges) places.emplace_back(x, 0.5, 0.0);
  const auto history =
      collapse<3>({.name = "reservoir",
                   .spacing = spacing,
                   .water = fill(lattice, {.lower = {gate, 0.0, 0.0}, .upper = {length, breadth, depth}}),
                   .wall = fill(lattice, {.lower = tank.lower - layers, .upper = {length + layers[0], breadth + layers[1], tank.upper[2]}},
                                (!tank) | box),
                   .tank = tank,
                   .closed_end = length,
                   .width = length - gate,
                   .depth = depth,
                   .gauges = places,
                   .end_time = end,
                   .interval = 0.01},
                  folder, result);
  std::array<double, 4> deviation{};
  std::string points;
  for (const Level& point : marin) {
    points += to_text(point.time) + " " + to_text(point.level) + "\n";
    if (point.time > end) continue;
    const double level = at(history, point.time, [&point](const Sample& s) { return s.levels[point.gauge]; });
    deviation[point.gauge] = std::max(deviation[point.gauge], std::abs(level - point.level) / depth);
  }
  for (const std::size_t gauge : {3u, 2u, 1u})
    result.error(std::string("reservoir: level at x = ").append(to_text(gauges[gauge])).append(" m/depth"), deviation[gauge],
                 0.03 + 1.0 / deep, "MARIN: a spacing, and the delay of the gate");

  io::plot(folder, "reservoir",
           "set datafile separator ','\n$experiment << EOD\n" + points + "EOD\nset xlabel 't [s]'\nset ylabel 'water level [m]'\n"
           "plot for [k=10:12] 'reservoir.csv' using 1:k skip 1 with lines lw 2 title 'dmp, x = '.word('0.992 1.488 2.638', k - 9).' m', "
           "$experiment using (real(word(strcol(1), 1))):(real(word(strcol(1), 2))) with points pt 6 ps 2 title 'MARIN'");
}

int run(const example::Options& options) {
  const bool quick = options.size == example::Size::quick, full = options.size == example::Size::full;
  const int across = options.resolutions({12}, {24}, {50}).front(), deep = quick ? 10 : full ? 40 : 20;
  const io::OutputFolder folder(options.output);
  example::Result result{
      .example = "dam_break",
      .test_case = "Martin and Moyce; SPHERIC 2",
      .resolution = to_text(2 * across) + " particles in the height of the column, " + to_text(deep) + " in that of the reservoir"};
  if (options.resolution > 0) {  // the column alone, until the front has come farther than in the experiment
    column(across, 5.0, folder, result);
    return result.print(folder);
  }
  column(across, quick ? 5.0 : 12.0, folder, result);
  reservoir(deep, quick ? 1.02 : full ? 3.0 : 1.2, full ? 3.0 : 1.0, folder, result);
  return result.print(folder);
}

}  // namespace

int main(int argc, char** argv) {
  return example::guarded("dam_break", run,
                          example::options(argc, argv, "dam_break",
                                           "Dam breaks: a collapsing column (2D), a reservoir over a box (3D); compared with experiments.",
                                           {.least_resolution = 8}));
}
