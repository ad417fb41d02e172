// Start-up of flow between two plates, driven by a body force (Poiseuille) or by a moving plate (Couette) (1 s; 1 s with --quick).
// Errors of the velocity profile against the series solutions, during the transient and at its end. Cases VISC-1 and FS-2.
// Viscous law: J. P. Morris, P. J. Fox, Y. Zhu, J. Comput. Phys. 136 (1997) 214-226, doi:10.1006/jcph.1997.5776.
#include <cmath>
#include <numbers>
#include <vector>
#include <dmp/dmp.hpp>

#include "support/channel.hpp"
#include "support/choices.hpp"
#include "support/options.hpp"
#include "support/result.hpp"

using namespace dmp;
using namespace dmp::simulation;
using particles::Frozen, particles::Mobile;

struct Water {};
struct LowerPlate {};
struct UpperPlate {};

namespace {

constexpr double gap = 1e-3;         // H [m]
constexpr double density = 1000.0;   // [kg/m^3]
constexpr double viscosity_ = 0.01;  // mu [Pa s]
constexpr double top_speed = 0.01;   // largest speed, or speed of the plate [m/s]
constexpr double diffusion_time = density * gap * gap / (std::numbers::pi * std::numbers::pi * viscosity_);  // rho H^2/(pi^2 mu) [s]

enum class Drive { body_force, plate };

/// Series solutions of the start-up from rest; y from the lower plate.
double exact_velocity(Drive drive, double y, double time) {
  const double eta = y / gap;
  double u = drive == Drive::body_force ? 4.0 * top_speed * eta * (1.0 - eta) : top_speed * eta;
  for (int n = 1; n < 200; ++n) {
    const double decay = std::exp(-n * n * time / diffusion_time), wave = std::sin(n * std::numbers::pi * eta);
    if (drive == Drive::plate) u += (n % 2 == 0 ? 1.0 : -1.0) * 2.0 * top_speed / (n * std::numbers::pi) * wave * decay;
    if (drive == Drive::body_force && n % 2 == 1) u -= 32.0 * top_speed / std::pow(n * std::numbers::pi, 3) * wave * decay;
  }
  return u;
}

example::ProfileError flow(Drive drive, int rows, const example::Options& options, const io::OutputFolder& folder,
                           example::Result& result) {
  example::Channel channel{.gap = gap, .rows = rows};
  if (options.support > 0.0) channel.support_in_spacings = options.support;
  const Vector<2> plate_velocity(drive == Drive::plate ? top_speed : 0.0, 0.0);
  const double force = drive == Drive::body_force ? 8.0 * viscosity_ * top_speed / (density * gap * gap) : 0.0;  // [m/s^2]
  const double mass = density * square(channel.spacing());

  const sph::WeaklyCompressible<example::Kernel<kernel::Lucy<2>>, viscosity::Morris<>> law{
      .kernel = {.support_radius = channel.support_radius()}};
  auto scene = simulation::scene<example::Integrator<integrator::ExtrapolatedVerlet>, example::Precision<precision::Double>>(
      channel.box(), group<Water>("water", Mobile{}, channel.fluid(), mass),
      group<LowerPlate>("lower_plate", Frozen<2>{}, channel.lower_plate(), mass),
      group<UpperPlate>("upper_plate", Frozen<2>{.wall_velocity = plate_velocity}, channel.upper_plate(), mass),
      interaction<Water, Water>(law), interaction<Water, LowerPlate>(law), interaction<Water, UpperPlate>(law),
      material<Water, LowerPlate, UpperPlate>(eos::Tait{.rest_density = density, .sound_speed_0 = 10.0 * top_speed},
                                              rheology::Constant{.dynamic_viscosity = viscosity_}),
      forced_by<Water>(forcing::Constant<2>{.uniform_acceleration = {{{force, 0.0}}}}));

  // The exact profile at a tenth of the diffusion time and at the end; the profile of the particles in a table.
  const std::string name = (drive == Drive::plate ? "couette_" : "poiseuille_") + std::to_string(rows);
  const std::string label = std::string(drive == Drive::plate ? "Couette" : "Poiseuille") + ", N = " + std::to_string(rows);
  const double end = 7.0 * diffusion_time, dt = 0.03 * square(channel.support_radius()) * density / viscosity_;
  const auto transient = scene.run(example::until(diffusion_time, dt, options));
  const auto error = [&] {
    return example::profile_error(scene.group<Water>(), [&](double y) { return exact_velocity(drive, y, scene.time()); });
  };
  const example::ProfileError on_the_way = error();
  const auto rest = scene.run(example::until(end, dt, options));
  const example::ProfileError at_end = error();

  io::CsvTable table(folder / (name + ".csv"), {{"y", "m"}, {"u", "m/s"}, {"exact u", "m/s"}});
  const auto& water = scene.group<Water>();
  for (std::size_t i = 0; i < water.size(); ++i)
    table.row({water.positions()[i][1], water.get<field::Velocity>()[i][0], exact_velocity(drive, water.positions()[i][1], scene.time())});
  VtkOutput(folder, name)(scene);

  const double wall_error = 0.55 / rows,
               bound = drive == Drive::plate ? 0.1 / rows : wall_error;  // first order: the wall is resolved by one row
  const std::string source = drive == Drive::plate ? "FS-2, linear profile" : "VISC-1, series solution";
  result.error(label + ": L2 of u", at_end.l2, bound, source);
  result.error(label + ": L2 of u at one diffusion time", on_the_way.l2, wall_error, "series solution");
  if (drive == Drive::body_force) result.error(label + ": shape of u", at_end.shape, rows >= 20 ? 0.012 : 0.02, source);
  result.add(transient);
  result.add(rest);
  result.describe(scene);
  return at_end;
}

int run(const example::Options& options) {
  const io::OutputFolder folder(options.output);
  const auto resolutions = options.resolutions({10, 20}, {10, 20, 30}, {10, 20, 30, 60});
  example::Result result{.example = "poiseuille",
                         .test_case = "VISC-1, FS-2",
                         .resolution = "10 to " + std::to_string(resolutions.back()) + " spacings across"};
  io::CsvTable convergence(folder / "convergence.csv", {{"rows", "-"}, {"Poiseuille L2", "-"}, {"Couette L2", "-"}});
  for (const int rows : resolutions) {
    const auto poiseuille = flow(Drive::body_force, rows, options, folder, result);
    if (options.resolution > 0) continue;
    const auto couette = flow(Drive::plate, rows, options, folder, result);
    convergence.row({static_cast<double>(rows), poiseuille.l2, couette.l2});
  }
  if (options.resolution == 0)
    io::plot(folder, "poiseuille",
             "set datafile separator ','\nset multiplot layout 1,2\nset xlabel 'u [m/s]'\nset ylabel 'y [m]'\nset key left\n"
             "plot 'poiseuille_20.csv' using 3:1 skip 1 with points pt 6 title 'exact', '' using 2:1 skip 1 with points pt 7 ps 0.4 title "
             "'dmp, N = 20'\n"
             "set logscale\nset xlabel 'N'\nset ylabel 'L2 error of u'\nset key bottom left\n"
             "plot 'convergence.csv' using 1:2 skip 1 with linespoints title 'Poiseuille', '' using 1:3 skip 1 with linespoints title "
             "'Couette', 0.55/x title '0.55/N'\nunset multiplot");
  return result.print(folder);
}

}  // namespace

int main(int argc, char** argv) {
  return example::guarded(
      "poiseuille", run,
      example::options(argc, argv, "poiseuille",
                       "Start-up of plane Poiseuille (VISC-1) and Couette (FS-2) flow against the series solutions.",
                       {.least_resolution = 5, .largest_support = 4.0, .safety = true}));
}
