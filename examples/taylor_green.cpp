// How fast does a Lagrangian method let a vortex decay? (7 s; 1 s with --quick.) Taylor and Green's periodic vortices at
// Reynolds number 100, over three resolutions, against the exact solution: velocity falls as exp(-8 pi^2 nu t/L^2), in place.
// G. I. Taylor, A. E. Green, Proc. R. Soc. Lond. A 158 (1937) 499-521, doi:10.1098/rspa.1937.0036. Hard for particles: they are drawn
// out along the stagnation lines (S. Adami, X. Y. Hu, N. A. Adams, J. Comput. Phys. 241 (2013) 292-307, doi:10.1016/j.jcp.2013.01.043,
// who shift them for that reason; nothing is shifted here).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <type_traits>
#include <vector>
#include <dmp/dmp.hpp>

#include "support/choices.hpp"
#include "support/options.hpp"
#include "support/result.hpp"

using namespace dmp;
using namespace dmp::simulation;
using particles::Mobile;

struct Fluid {};

namespace {

constexpr double length = 1.0, speed = 1.0, density = 1.0, kinematic_viscosity = 0.01;  // [m], [m/s], [kg/m^3], [m^2/s]: Re = 100
constexpr double sound_speed = 10.0 * speed;
constexpr double end = 1.0;                                  // [s], L/U
constexpr double wave_number = 2.0 * std::numbers::pi / length;  // k [1/m]

double decay(double time) { return std::exp(-2.0 * wave_number * wave_number * kinematic_viscosity * time); }
Vector<2> exact_velocity(const Vector<2>& x, double time) {
  const double kx = wave_number * x[0], ky = wave_number * x[1];
  return speed * decay(time) * Vector<2>{std::sin(kx) * std::cos(ky), -std::cos(kx) * std::sin(ky)};
}
double exact_pressure(const Vector<2>& x) {  // at t = 0; its mean is 0
  return 0.25 * density * speed * speed * (std::cos(2.0 * wave_number * x[0]) + std::cos(2.0 * wave_number * x[1]));
}

// Support radius: 5 spacings at N = 25, more at finer resolutions (5.9, 7.1). Smoothing costs an error of order h^2, the disorder of the
// particles one that falls with h/dx only: at fixed h/dx it stays, and nothing converges (N. J. Quinlan, M. Basa, M. Lastiwka, Int. J.
// Numer. Meth. Eng. 66 (2006) 2064-2085, doi:10.1002/nme.1617; Q. Zhu, L. Hernquist, Y. Li, Astrophys. J. 800 (2015) 6,
// doi:10.1088/0004-637X/800/1/6). The kernel must not pair particles at so many neighbours: Wendland's.
double support_radius(int resolution) { return 5.0 * std::pow(resolution / 25.0, 0.25) * length / resolution; }

// Bounds. Morris' viscosity with this kernel damps a wave of vector q as nu q^2 (1 - 5 (q h)^2/288 + ...), here q^2 = 2 k^2: at N = 25
// the speed is 4.3 % too high at the end. Finer resolutions must gain as disorder does, (dx/h)^2 ~ 1/sqrt(N).
double bound_of_l2(int resolution) {
  const double h = support_radius(25), q_squared = 2.0 * wave_number * wave_number;
  const double smoothing = kinematic_viscosity * q_squared * end * 5.0 * q_squared * h * h / 288.0;
  return smoothing * std::sqrt(25.0 / resolution);
}
// If the errors of both components are Gaussian, their mean length is sqrt(pi)/2 of the root of their mean square.
double bound_of_l1(int resolution) { return 0.5 * std::sqrt(std::numbers::pi) * bound_of_l2(resolution); }

/// Nearly equilateral triangles that fit the periodic square: `resolution` points per row. A square lattice gives way to them sooner or
/// later, all at once, and takes a third of the energy away (seen at t = 0.3).
geometry::Points<2> triangles(int resolution) {
  const int rows = 2 * static_cast<int>(std::lround(resolution / std::numbers::sqrt3));
  const double column_spacing = length / resolution, row_spacing = length / rows;
  geometry::Points<2> points{.positions = {}, .spacing = std::min(column_spacing, row_spacing), .volume = column_spacing * row_spacing};
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < resolution; ++column)
      points.positions.emplace_back((column + 0.25 + 0.5 * (row % 2)) * column_spacing, (row + 0.5) * row_spacing);
  return points;
}

/// Errors of the velocity field, relative to U exp(-8 pi^2 nu t/L^2).
struct Errors {
  double l1 = 0.0, l2 = 0.0, highest_speed = 0.0, mean_velocity = 0.0;
};

template <class Scene>
Errors compare(const Scene& scene) {
  const auto& fluid = scene.template group<Fluid>();
  const auto& velocities = fluid.template get<field::Velocity>();
  const double now = speed * decay(scene.time()), share = 1.0 / static_cast<double>(fluid.size());
  Errors errors;
  double fastest = 0.0;
  Vector<2> mean = Vector<2>::Zero();
  for (std::size_t i = 0; i < fluid.size(); ++i) {
    const double error = (velocities[i] - exact_velocity(fluid.positions()[i], scene.time())).norm() / now;
    errors.l1 += share * error;
    errors.l2 += share * error * error;
    mean += share * velocities[i];
    fastest = std::max(fastest, velocities[i].norm());
  }
  errors.l2 = std::sqrt(errors.l2);
  errors.highest_speed = fastest / now - 1.0;
  errors.mean_velocity = mean.norm() / speed;
  return errors;
}

/// One resolution: the errors at the end, and that of the highest speed at its worst.
struct Outcome {
  Errors last;
  double worst_speed = 0.0;
};

template <class Precision>
Outcome solve(int resolution, const example::Options& options, const io::OutputFolder& folder, example::Result& result) {
  const std::string precision = std::is_same_v<Precision, precision::Single> ? "_single" : "";
  const std::string name = "taylor_green_" + std::to_string(resolution) + precision;
  const geometry::Points<2> points = triangles(resolution);

  // Laws
  const double h = options.support > 0.0 ? options.support * length / resolution : support_radius(resolution);
  const sph::WeaklyCompressible<example::Kernel<kernel::WendlandC2<2>>, viscosity::Morris<>, diffusion::MolteniColagrossi> flow{
      .kernel = {.support_radius = h}, .diffusion = {.sound_speed = sound_speed}};
  const eos::Linear eos{.rest_density = density, .sound_speed_0 = sound_speed};
  const rheology::Constant rheology{.dynamic_viscosity = density * kinematic_viscosity};

  // Scene. The density starts with the pressure of the flow, or a sound wave would take its place.
  const geometry::Box<2> box{.lower = {0.0, 0.0}, .upper = {length, length}, .periodic = {true, true}};
  auto vortices = scene<example::Integrator<integrator::ExtrapolatedVerlet>, Precision>(
      box, group<Fluid>("fluid_" + std::to_string(resolution) + precision, Mobile{}, points, density * points.volume),
      interaction<Fluid, Fluid>(flow), material<Fluid>(eos, rheology));
  auto& fluid = vortices.template group<Fluid>();
  fluid.template set<field::Density>([&](const Vector<2>& x) { return eos.density(exact_pressure(x)); });
  fluid.template set<field::Velocity>([](const Vector<2>& x) { return exact_velocity(x, 0.0); });

  // Observation
  Outcome outcome;
  io::CsvTable table(folder / (name + ".csv"), {{"time", "s"}, {"highest speed", "m/s"}, {"exact", "m/s"}, {"L1", "-"}, {"L2", "-"}});
  vortices.every(end / 50.0, [&](const auto& scene) {
    outcome.last = compare(scene);
    const double exact = speed * decay(scene.time());
    table.row({scene.time(), exact * (1.0 + outcome.last.highest_speed), exact, outcome.last.l1, outcome.last.l2});
    if (std::abs(outcome.last.highest_speed) > std::abs(outcome.worst_speed)) outcome.worst_speed = outcome.last.highest_speed;
  });
  vortices.every(end / 20.0, VtkOutput(folder, name));
  vortices.rescue_to((folder / (name + "_last_good.checkpoint")).string()).progress();

  // Run
  result.add(vortices.run(example::until(end, 0.0, options)));
  result.describe(vortices);
  return outcome;
}

int run(const example::Options& options) {
  const auto resolutions = options.resolutions({25, 50}, {25, 50, 100}, {25, 50, 100, 200});
  const io::OutputFolder folder(options.output);
  example::Result result{.example = "taylor_green", .test_case = "2D, Re 100", .resolution = {}};
  io::CsvTable table(folder / "taylor_green.csv", {{"N", "-"}, {"L1", "-"}, {"L2", "-"}, {"bound of L1", "-"}, {"bound of L2", "-"}});
  Errors coarser;
  std::string curves, separator;
  for (const int n : resolutions) {
    const Outcome outcome = solve<example::Precision<precision::Double>>(n, options, folder, result);
    const Errors& errors = outcome.last;
    const std::string at = " at t = L/U, N = " + std::to_string(n);
    result.error("L1 of the velocity" + at, errors.l1, bound_of_l1(n), "exact; smoothing and disorder, see the source");
    result.error("L2 of the velocity" + at, errors.l2, bound_of_l2(n), "exact; smoothing and disorder, see the source");
    result.error("highest speed, relative, worst, N = " + std::to_string(n), outcome.worst_speed, n < 100 ? 0.05 : 0.03,
                 "exp(-8 pi^2 nu t/L^2)");
    result.error("mean velocity" + at, errors.mean_velocity, 1e-12, "momentum is kept to rounding");
    if (n == resolutions.front() && options.resolution == 0) {
      // Pair laws in single precision: the error of rounding must stay small beside the error of the method.
      const Errors single = solve<precision::Single>(n, options, folder, result).last;
      result.error("L2 in single precision against double, relative" + at, single.l2 / errors.l2 - 1.0, 1e-3,
                   "double precision; seven digits");
      result.error("mean velocity in single precision" + at, single.mean_velocity, 1e-5, "momentum is kept to rounding");
    }
    if (n > resolutions.front()) {
      // Half the spacing must gain half of what disorder alone would give: an observed order of at least 1/4.
      result.error("L2 over that of the next coarser N" + at, errors.l2 / coarser.l2, std::pow(2.0, -0.25), "order >= 1/4; 1/2 expected");
      std::printf("N = %d: observed order of L1 %.2f, of L2 %.2f\n", n, std::log2(coarser.l1 / errors.l1),
                  std::log2(coarser.l2 / errors.l2));
    }
    table.row({static_cast<double>(n), errors.l1, errors.l2, bound_of_l1(n), bound_of_l2(n)});
    result.resolution += (result.resolution.empty() ? "N = " : ", ") + std::to_string(n);
    curves +=
        separator + "'taylor_green_" + std::to_string(n) + ".csv' using 1:2 skip 1 with lines lw 2 title 'N = " + std::to_string(n) + "'";
    separator = ", ";
    coarser = errors;
  }
  if (options.resolution > 0) return result.print(folder);
  io::plot(folder, "taylor_green",
           "set datafile separator ','\nset multiplot layout 1,2\nset xlabel 't U/L'\nset ylabel 'highest speed / U'\nset logscale y\n"
           "set xrange [0:1]\nset yrange [0.4:1.05]\nplot " + curves +
               ", 'taylor_green_25.csv' using 1:3 skip 1 with lines dt 2 lc 'black' title 'exact'\n"
               "set autoscale y\nset logscale x\nset xlabel 'N'\nset ylabel 'error of the velocity at t = L/U'\nset xrange [20:250]\n"
               "plot 'taylor_green.csv' using 1:2 skip 1 with linespoints title 'L1', '' using 1:3 skip 1 with linespoints title 'L2', "
               "'' using 1:5 skip 1 with lines dt 2 title 'bound of L2'\nunset multiplot");
  return result.print(folder);
}

}  // namespace

int main(int argc, char** argv) {
  return example::guarded("taylor_green", run,
                          example::options(argc, argv, "taylor_green", "Decay of periodic vortices at Re = 100 against the exact solution.",
                                           {.least_resolution = 20, .largest_support = 8.0, .safety = true}));
}
