// Does a liquid in an open tank come to rest, and under the right pressure? (4 s; 1 s with --quick.) Two starts: with the hydrostatic
// density, and with a uniform one, from which the liquid must sink until the pressure carries it.
// Gravity, walls of particles that stay in place while their density answers to the liquid, a free surface: no law treats any of them
// specially. J. J. Monaghan, J. Comput. Phys. 110 (1994) 399-406, doi:10.1006/jcph.1994.1034; walls: A. J. C. Crespo,
// M. Gomez-Gesteira, R. A. Dalrymple, Comput. Mater. Continua 5 (2007) 173-184, doi:10.3970/cmc.2007.005.173.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <dmp/dmp.hpp>

#include "support/choices.hpp"
#include "support/options.hpp"
#include "support/result.hpp"

using namespace dmp;
using namespace dmp::simulation;
using particles::Mobile, particles::Stationary;

struct Liquid {};
struct Wall {};

namespace {

constexpr double depth = 1.0, width = 1.0;               // of the liquid [m]
constexpr double gravity = 9.81, rest_density = 1000.0;  // [m/s^2], [kg/m^3]
constexpr double bottom_pressure = rest_density * gravity * depth;  // [Pa]
constexpr double mach_squared = 0.01;  // g H/c0^2: the liquid is 1 % denser at the bottom than at the surface
const double sound_speed = std::sqrt(gravity * depth / mach_squared);  // [m/s]
// Rest does not depend on the viscosity. This one, of a syrup, damps the slowest motion, the column that bounces on its own
// compressibility (wave number k = pi/2H), at 3 nu k^2/2 = 0.37/s and by friction at the side walls at nu (pi/W)^2 = 0.99/s: in 4 s its
// energy falls by a factor of 5e4.
constexpr double kinematic_viscosity = 0.1;  // [m^2/s]

double rest_pressure(const Vector<2>& x) { return rest_density * gravity * (depth - x[1]); }  // [Pa]

struct State {
  double kinetic_energy = 0.0;           // of the liquid, relative to what it would gain by falling all its depth, m g H
  Vector<2> centre = Vector<2>::Zero();  // of mass [m]
  double pressure_error = 0.0;           // L2 over the liquid deeper than the support radius, relative to rho g H
  double wall_error = 0.0;               // pressure of the first wall row below the bottom, relative to rho g H
  int leaked = 0;                        // particles outside the tank
};

struct Outcome {
  State start, middle, end;
  double highest_energy = 0.0;
  int most_leaked = 0;
};

enum class Start { hydrostatic, uniform };

Outcome settle(Start start, int rows, double end, const example::Options& options, const io::OutputFolder& folder,
               example::Result& result) {
  const double spacing = depth / rows, thickness = 3.0 * spacing;  // of the walls [m]
  const double h = thickness;                                      // support radius [m]: no particle sees through a wall
  const std::string name = start == Start::hydrostatic ? "hydrostatic" : "uniform";

  // Geometry: walls go on where the lattice of the liquid ends, the first row half a spacing outside the tank. A particle at the wall
  // then has the same neighbours as one in the middle, so the pressure gradient it feels is that of the liquid and no gap opens; rows
  // a whole spacing away leave a sheet of missing mass along the wall, which the liquid would fill by sinking half a spacing.
  const geometry::Cubic<2> lattice{.spacing = spacing};
  const geometry::Cuboid<2> inside{.lower = {0.0, 0.0}, .upper = {width, 1.25 * depth}};
  const geometry::Cuboid<2> outside{.lower = {-thickness, -thickness}, .upper = {width + thickness, 1.25 * depth}};
  const auto liquid = geometry::fill(lattice, {.lower = {0.0, 0.0}, .upper = {width, depth}});
  const auto wall = geometry::fill(lattice, outside, outside - inside);
  const geometry::Box<2> box{.lower = {-1.5 * thickness, -1.5 * thickness}, .upper = {width + 1.5 * thickness, 1.5 * depth}};

  // Laws
  const sph::WeaklyCompressible<example::Kernel<kernel::WendlandC2<2>>, viscosity::Monaghan<2>> flow{.kernel = {.support_radius = h}};
  const eos::Linear eos{.rest_density = rest_density, .sound_speed_0 = sound_speed};
  const rheology::Constant rheology{.dynamic_viscosity = rest_density * kinematic_viscosity};
  const forcing::Constant<2> weight{.uniform_acceleration = {{{0.0, -gravity}}}};

  // Scene
  const double mass = rest_density * liquid.volume;
  auto tank = scene<example::Integrator<integrator::ExtrapolatedVerlet>>(
      box, group<Liquid>("liquid_" + name, Mobile{}, liquid, mass), group<Wall>("wall_" + name, Stationary{}, wall, mass),
      interaction<Liquid, Liquid>(flow), interaction<Liquid, Wall>(flow), material<Liquid, Wall>(eos, rheology), forced_by<Liquid>(weight));
  tank.engine().for_each_group([&](auto& g) {
    g.template set<field::Density>([&](const Vector<2>& x) {
      return start == Start::hydrostatic ? eos.density(std::max(rest_pressure(x), 0.0)) : rest_density;
    });
  });

  // Observation
  const auto observe = [&](const auto& scene) {
    const auto& g = scene.template group<Liquid>();
    const auto& w = scene.template group<Wall>();
    State state;
    double squares = 0.0;
    int deep = 0, in_wall = 0;
    for (std::size_t i = 0; i < g.size(); ++i) {
      const Vector<2>& x = g.positions()[i];
      state.kinetic_energy += 0.5 * g.template get<field::Velocity>()[i].squaredNorm() / (gravity * depth * static_cast<double>(g.size()));
      state.centre += x / static_cast<double>(g.size());
      if (!inside.contains(x)) ++state.leaked;
      if (x[1] > depth - h) continue;
      const double error = (eos.pressure(g.template get<field::Density>()[i]) - rest_pressure(x)) / bottom_pressure;
      squares += error * error;
      ++deep;
    }
    for (std::size_t i = 0; i < w.size(); ++i) {
      const Vector<2>& x = w.positions()[i];
      if (x[0] < 0.0 || x[0] > width || x[1] > 0.0 || x[1] < -spacing) continue;
      state.wall_error += (eos.pressure(w.template get<field::Density>()[i]) - rest_pressure(x)) / bottom_pressure;
      ++in_wall;
    }
    state.pressure_error = std::sqrt(squares / deep);
    state.wall_error /= in_wall;
    return state;
  };
  Outcome outcome;
  io::CsvTable table(folder / (name + ".csv"), {{"time", "s"}, {"kinetic energy / m g H", "-"},
                                                {"height of the centre of mass", "m"}, {"L2 of the pressure / rho g H", "-"},
                                                {"pressure error of the wall / rho g H", "-"}, {"leaked", "-"}});
  tank.every(0.02, [&](const auto& scene) {
    const State state = observe(scene);
    table.row(
        {scene.time(), state.kinetic_energy, state.centre[1], state.pressure_error, state.wall_error, static_cast<double>(state.leaked)});
    if (scene.step() == 0) outcome.start = state;
    if (scene.time() < 0.501 * end) outcome.middle = state;
    outcome.end = state;
    outcome.highest_energy = std::max(outcome.highest_energy, state.kinetic_energy);
    outcome.most_leaked = std::max(outcome.most_leaked, state.leaked);
  });
  tank.every(end / 20.0, VtkOutput(folder, name));
  tank.rescue_to((folder / (name + "_last_good.checkpoint")).string()).progress();

  // Run
  result.add(tank.run(example::until(end, 0.0, options)));
  result.describe(tank);
  return outcome;
}

int run(const example::Options& options) {
  const int rows = options.resolutions({20}, {32}, {64}).front();
  const double end = options.size == example::Size::quick ? 4.0 : 10.0;  // [s]
  const double spacing = depth / rows;
  const io::OutputFolder folder(options.output);
  example::Result result{
      .example = "hydrostatic", .test_case = "2D tank", .resolution = std::to_string(rows) + " x " + std::to_string(rows) + " particles"};

  for (const Start start : {Start::hydrostatic, Start::uniform}) {
    const Outcome outcome = settle(start, rows, end, options, folder, result);
    const std::string of = start == Start::hydrostatic ? ", hydrostatic start" : ", uniform start";
    const bool is_uniform = start == Start::uniform;
    // The sums take m = rho0 dx^2 where p/rho^2 takes a density up to 1 % higher, twice: p is high by up to 2 g H/c^2, at the bottom (the
    // lattice sums themselves add half a percent at 3 spacings). The uniform start adds up to half a spacing by which the liquid may
    // stand nearer to the wall: the wall has no pressure before it is approached.
    const double compressible = 2.0 * mach_squared;
    result.error("L2 of the pressure / rho g H" + of, outcome.end.pressure_error, compressible + (is_uniform ? 0.5 * spacing / depth : 0.0),
                 "rho g (H - y); compressibility, half a spacing");
    // A wall row gains density as liquid approaches within its support: with f_n the pull of a row of the kernel at n spacings, the first
    // row gains f_1 + f_2, the second f_2, the third nothing; with f_2/f_1 = 0.226 they carry the liquid when the first holds
    // (f_1 + f_2)(f_1 + 2 f_2)/((f_1 + f_2)^2 + f_2^2) = 1.145 of its pressure. A wall that starts with the right density keeps it.
    result.error("wall pressure at the bottom, relative" + of, outcome.end.wall_error, compressible + (is_uniform ? 0.145 : 0.01),
                 "rho g H; shares of the wall rows");

    // A column of uniform density sinks until it is compressed; that sets energy free, at first as motion.
    const double sinks = depth * mach_squared / 3.0;  // [m], of the centre of mass
    const double expected = 0.5 * depth - (is_uniform ? sinks : 0.0);
    result.error("height of the centre / spacing" + of, (outcome.end.centre[1] - expected) / spacing, is_uniform ? 0.05 : 0.01,
                 "compressed column: -g H^2/(3 c^2)");
    result.error("drift, second half / spacing" + of, (outcome.end.centre - outcome.middle.centre).norm() / spacing, 0.005, "rest");
    result.error("kinetic energy / energy set free" + of, outcome.end.kinetic_energy / (sinks / depth), 1e-4,
                 "at rest; damping leaves 2e-5 after 4 s");
    result.error("particles outside the tank" + of, outcome.most_leaked, 0.0, "impermeable");
    std::printf("kinetic energy / m g H%s: highest %.2e, at the end %.2e\n", of.c_str(), outcome.highest_energy,
                outcome.end.kinetic_energy);
  }
  io::plot(folder, "hydrostatic",
           "set datafile separator ','\nset multiplot layout 1,2\nset xlabel 't [s]'\nset logscale y\nset ylabel 'kinetic energy / m g H'\n"
           "plot 'hydrostatic.csv' using 1:2 skip 1 with lines title 'hydrostatic start', "
           "'uniform.csv' using 1:2 skip 1 with lines title 'uniform start'\n"
           "set ylabel 'L2 of the pressure / rho g H'\n"
           "plot 'hydrostatic.csv' using 1:4 skip 1 with lines title 'hydrostatic start', "
           "'uniform.csv' using 1:4 skip 1 with lines title 'uniform start'\nunset multiplot");
  return result.print(folder);
}

}  // namespace

int main(int argc, char** argv) {
  return example::guarded("hydrostatic", run,
                          example::options(argc, argv, "hydrostatic", "Liquid at rest in an open tank: pressure against rho g (H - y).",
                                           {.least_resolution = 10, .safety = true}));
}
