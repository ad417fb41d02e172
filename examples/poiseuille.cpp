// Start-up of flow between two plates, driven by a body force (Poiseuille) or by a moving plate (Couette) (6 s; 1 s with --quick).
// Errors of the velocity profile against the series solutions, during the transient and at its end. Cases VISC-1 and FS-2.
// Viscous law: J. P. Morris, P. J. Fox, Y. Zhu, J. Comput. Phys. 136 (1997) 214-226, doi:10.1006/jcph.1997.5776.
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>
#include <dmp/dmp.hpp>

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

struct ProfileError {
  double l2;     // root mean square difference over that of the exact profile
  double shape;  // the same after scaling the measured profile to fit best
};

template <class Scene>
ProfileError profile_error(const Scene& scene, Drive drive) {
  const auto& water = scene.template group<Water>();
  double difference = 0.0, exact_squared = 0.0, measured_squared = 0.0, product = 0.0;
  for (std::size_t i = 0; i < water.size(); ++i) {
    const double u = water.template get<field::Velocity>()[i][0], exact = exact_velocity(drive, water.positions()[i][1], scene.time());
    difference += square(u - exact);
    exact_squared += square(exact);
    measured_squared += square(u);
    product += u * exact;
  }
  return {std::sqrt(difference / exact_squared), std::sqrt(std::max(0.0, 1.0 - square(product) / (measured_squared * exact_squared)))};
}

/// Plates whose first row lies on the plane of the wall, three rows each; `rows` spacings between the two planes.
ProfileError flow(Drive drive, int rows, const io::OutputFolder& folder, example::Result& result) {
  const double spacing = gap / rows, support_radius = 2.6 * spacing, length = 10.0 * spacing;
  const auto layer = [&](double first, double last) {  // rows of particles from y = first to y = last
    return geometry::fill(geometry::Cubic<2>{.spacing = spacing, .origin = {0.0, 0.5 * spacing}},
                          geometry::Cuboid<2>{.lower = {0.0, first - 0.25 * spacing}, .upper = {length, last + 0.25 * spacing}});
  };
  const Vector<2> plate_velocity(drive == Drive::plate ? top_speed : 0.0, 0.0);
  const double force = drive == Drive::body_force ? 8.0 * viscosity_ * top_speed / (density * gap * gap) : 0.0;  // [m/s^2]
  const double mass = density * spacing * spacing;

  const sph::WeaklyCompressible<kernel::Lucy<2>, viscosity::Morris<>> law{.kernel = {.support_radius = support_radius}};
  const geometry::Box<2> box{.lower = {0.0, -3.0 * spacing}, .upper = {length, gap + 3.0 * spacing}, .periodic = {true, false}};
  auto channel = scene<integrator::ExtrapolatedVerlet>(
      box, group<Water>("water", Mobile{}, layer(spacing, gap - spacing), mass),
      group<LowerPlate>("lower_plate", Frozen<2>{}, layer(-2.0 * spacing, 0.0), mass),
      group<UpperPlate>("upper_plate", Frozen<2>{.wall_velocity = plate_velocity}, layer(gap, gap + 2.0 * spacing), mass),
      interaction<Water, Water>(law), interaction<Water, LowerPlate>(law), interaction<Water, UpperPlate>(law),
      material<Water, LowerPlate, UpperPlate>(eos::Tait{.rest_density = density, .sound_speed_0 = 10.0 * top_speed},
                                              rheology::Constant{.dynamic_viscosity = viscosity_}),
      forced_by<Water>(forcing::Constant<2>{.uniform_acceleration = {{{force, 0.0}}}}));

  // The exact profile at a tenth of the diffusion time and at the end; the profile of the particles in a table.
  const std::string name = (drive == Drive::plate ? "couette_" : "poiseuille_") + std::to_string(rows);
  const std::string label = std::string(drive == Drive::plate ? "Couette" : "Poiseuille") + ", N = " + std::to_string(rows);
  const double end = 7.0 * diffusion_time, dt = 0.03 * square(support_radius) * density / viscosity_;
  const auto transient = channel.run({.until = diffusion_time, .time_step = dt});
  const ProfileError on_the_way = profile_error(channel, drive);
  const auto rest = channel.run({.until = end, .time_step = dt});
  const ProfileError at_end = profile_error(channel, drive);

  io::CsvTable table(folder / (name + ".csv"), {{"y", "m"}, {"u", "m/s"}, {"exact u", "m/s"}});
  const auto& water = channel.group<Water>();
  for (std::size_t i = 0; i < water.size(); ++i)
    table.row({water.positions()[i][1], water.get<field::Velocity>()[i][0], exact_velocity(drive, water.positions()[i][1], channel.time())});
  VtkOutput(folder, name)(channel);

  const double wall_error = 0.55 / rows, bound = drive == Drive::plate ? 0.1 / rows : wall_error;  // first order: the wall is resolved by one row
  const std::string source = drive == Drive::plate ? "FS-2, linear profile" : "VISC-1, series solution";
  result.error(label + ": L2 of u", at_end.l2, bound, source);
  result.error(label + ": L2 of u at one diffusion time", on_the_way.l2, wall_error, "series solution");
  if (drive == Drive::body_force) result.error(label + ": shape of u", at_end.shape, rows >= 20 ? 0.012 : 0.02, source);
  result.add(transient);
  result.add(rest);
  result.particles = std::max(result.particles, channel.particles());
  result.bytes_per_particle = bytes_per_particle(channel);
  return at_end;
}

int run(const example::Options& options) {
  const io::OutputFolder folder(options.output);
  std::vector<int> resolutions{10, 20};
  if (options.size != example::Size::quick) resolutions.push_back(30);
  if (options.size == example::Size::full) resolutions.push_back(60);
  example::Result result{.example = "poiseuille", .test_case = "VISC-1, FS-2", .resolution = "10 to " + std::to_string(resolutions.back()) + " spacings across"};
  io::CsvTable convergence(folder / "convergence.csv", {{"rows", "-"}, {"Poiseuille L2", "-"}, {"Couette L2", "-"}});
  for (const int rows : resolutions) {
    const ProfileError poiseuille = flow(Drive::body_force, rows, folder, result), couette = flow(Drive::plate, rows, folder, result);
    convergence.row({static_cast<double>(rows), poiseuille.l2, couette.l2});
  }
  io::plot(folder, "poiseuille",
           "set datafile separator ','\nset multiplot layout 1,2\nset xlabel 'u [m/s]'\nset ylabel 'y [m]'\nset key left\n"
           "plot 'poiseuille_20.csv' using 3:1 skip 1 with points pt 6 title 'exact', '' using 2:1 skip 1 with points pt 7 ps 0.4 title 'dmp, N = 20'\n"
           "set logscale\nset xlabel 'N'\nset ylabel 'L2 error of u'\nset key bottom left\n"
           "plot 'convergence.csv' using 1:2 skip 1 with linespoints title 'Poiseuille', '' using 1:3 skip 1 with linespoints title 'Couette', 0.55/x title '0.55/N'\nunset multiplot");
  return result.print();
}

}  // namespace

int main(int argc, char** argv) {
  return example::guarded("poiseuille", run, example::options(argc, argv, "poiseuille", "Start-up of plane Poiseuille (VISC-1) and Couette (FS-2) flow against the series solutions."));
}
