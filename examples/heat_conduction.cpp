// Heat conduction between two slabs of unequal conductivity: the steady state, the transient of two half-spaces, and one phase
// (14 s; 2 s with --quick). Errors of the temperature against the exact solutions, with the harmonic mean of the conductivities and with
// the arithmetic one. Integrated as LAMMPS' fix sph does it: heat has no sound, which needs the extrapolated state and a step a quarter
// as long; at 10 rows its error of first order cancels a fifth of the error in space. Cases HX-1, HX-2, HX-3. P. W. Cleary, J. J. Monaghan,
// J. Comput. Phys. 148 (1999) 227-264, doi:10.1006/jcph.1998.6118.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <type_traits>
#include <dmp/dmp.hpp>

#include "support/choices.hpp"
#include "support/options.hpp"
#include "support/result.hpp"

using namespace dmp;
using namespace dmp::simulation;
using particles::Frozen, particles::Stationary;

struct Left {};
struct Right {};
struct HotFace {};
struct ColdFace {};

namespace {

struct Solid {
  double conductivity, density, specific_heat;
  [[nodiscard]] double diffusivity() const { return conductivity / (density * specific_heat); }  // [m^2/s]
};

/// Temperature, constant density and conductivity of a group; zero energy is 0 K above the reference of 1000 K, so that all are positive.
template <class... Group>
auto properties(const Solid& solid) {
  return material<Group...>(
      thermal::Linear{.specific_heat_capacity = solid.specific_heat, .reference_temperature = 1000.0, .reference_energy = 0.0},
      eos::ConstantDensity{.density = solid.density}, thermal::Conductivity{.thermal_conductivity = solid.conductivity});
}
constexpr int rows_across = 6;  // of the periodic strip

geometry::Points<2> strip(double spacing, int first, int last) {  // columns first .. last - 1, of which column k lies at (k + 1/2) spacing
  return geometry::fill(geometry::Cubic<2>{.spacing = spacing},
                        geometry::Cuboid<2>{.lower = {first * spacing, 0.0}, .upper = {last * spacing, rows_across * spacing}});
}

struct Errors {
  double square_sum = 0.0, largest = 0.0;
  std::size_t count = 0;
  void add(double difference) {
    square_sum += square(difference);
    largest = std::max(largest, std::fabs(difference));
    ++count;
  }
  [[nodiscard]] double l2() const { return std::sqrt(square_sum / static_cast<double>(count)); }
};

/// Temperatures above the reference of a group, per joule: e/c.
void compare(const auto& group, double specific_heat, Errors& errors, io::CsvTable& table, const auto& exact) {
  for (std::size_t i = 0; i < group.size(); ++i) {
    const double x = group.positions()[i][0], temperature = group.template get<field::SpecificEnergy>()[i] / specific_heat;
    errors.add(temperature - exact(x));
    table.row({x, temperature, exact(x)});
  }
}

template <class Mean>
constexpr const char* mean_name = std::is_same_v<Mean, HarmonicMean> ? "harmonic" : "arithmetic";

/// HX-1: outer faces kept at 1 and 0 K; water beside air. Runs until the profile is steady.
template <class Mean>
void two_slabs(int rows, const io::OutputFolder& folder, example::Result& result, const std::array<double, 3>& bounds) {
  const double spacing = 1.0 / (rows + 0.5);  // the first row of a face lies on it, the interface midway between two rows
  const Solid left{0.6, 1000.0, 4180.0}, right{0.0255, 1000.0, 4180.0 * 0.0255 / 0.6};  // the same diffusivity: the same time to rest
  const sph::HeatConduction<kernel::Lucy<2>, Mean> conduction{.kernel = {.support_radius = 2.6 * spacing}};
  const double height = rows_across * spacing, end = (rows + 3) * spacing;
  const geometry::Box<2> box{.lower = {-end, 0.0}, .upper = {end, height}, .periodic = {false, true}};
  const double mass = 1000.0 * spacing * spacing;
  auto scene = simulation::scene<integrator::LammpsVerlet>(
      box, group<Left>("left", Stationary{}, strip(spacing, -rows, 0), mass),
      group<Right>("right", Stationary{}, strip(spacing, 0, rows), mass),
      group<HotFace>("hot_face", Frozen<2>{}, strip(spacing, -rows - 3, -rows), mass),
      group<ColdFace>("cold_face", Frozen<2>{}, strip(spacing, rows, rows + 3), mass), interaction<Left, Left>(conduction),
      interaction<Right, Right>(conduction), interaction<Left, Right>(conduction), interaction<Left, HotFace>(conduction),
      interaction<Right, ColdFace>(conduction), properties<Left, HotFace>(left), properties<Right, ColdFace>(right));
  scene.template group<HotFace>().template set<field::SpecificEnergy>([&](const auto&) { return left.specific_heat; });
  scene.template group<Left>().template set<field::SpecificEnergy>([&](const auto&) { return left.specific_heat; });

  const double relaxation = 4.0 / (9.8696 * left.diffusivity());  // slowest mode of a bar of length 2 [s]
  const auto report = scene.run({.until = 20.0 * relaxation});

  const double interface_temperature = left.conductivity / (left.conductivity + right.conductivity);
  const auto exact = [&](double x) {
    return x < 0.0 ? interface_temperature - x * (1.0 - interface_temperature) : interface_temperature * (1.0 - x);
  };
  Errors errors;
  const std::string name = "slabs_" + std::string(mean_name<Mean>) + "_" + std::to_string(rows);
  io::CsvTable table(folder / (name + ".csv"), {{"x", "m"}, {"T", "K"}, {"exact T", "K"}});
  compare(scene.template group<Left>(), left.specific_heat, errors, table, exact);
  compare(scene.template group<Right>(), right.specific_heat, errors, table, exact);
  // The flux, the same through any section: from the slope of a straight line through the temperatures well inside the right slab.
  const auto& slab = scene.template group<Right>();
  double n = 0.0, sum_x = 0.0, sum_t = 0.0, sum_xx = 0.0, sum_xt = 0.0;
  for (std::size_t i = 0; i < slab.size(); ++i) {
    const double x = slab.positions()[i][0], t = slab.template get<field::SpecificEnergy>()[i] / right.specific_heat;
    if (x > 0.3 && x < 0.7) n += 1.0, sum_x += x, sum_t += t, sum_xx += x * x, sum_xt += x * t;
  }
  const double flux = -right.conductivity * (n * sum_xt - sum_x * sum_t) / (n * sum_xx - sum_x * sum_x);
  const std::string label = "HX-1, " + std::string(mean_name<Mean>) + " mean, N = " + std::to_string(rows);
  const std::string source = "two slabs in series";
  result.error(label + ": L2 of T", errors.l2(), 1.2 * bounds[0], source);
  result.error(label + ": largest error of T", errors.largest, 1.2 * bounds[1], source);
  result.error(label + ": flux", flux / (interface_temperature * right.conductivity) - 1.0, 1.2 * std::fabs(bounds[2] - 1.0), source);
  result.add(report);
  result.describe(scene);
}

/// HX-2: two half-spaces at 1 and 0 K are joined at t = 0; outer ends insulated, and too far away to matter.
template <class Mean>
void two_half_spaces(int rows, const io::OutputFolder& folder, example::Result& result, const std::array<double, 2>& bounds) {
  constexpr double length = 0.1, end_time = 15.625;
  constexpr Solid left{10.0, 1000.0, 1000.0}, right{1.0, 100.0, 1000.0};
  const double spacing = length / rows, support_radius = 2.6 * spacing;
  const sph::HeatConduction<example::Kernel<kernel::Lucy<2>>, Mean> conduction{.kernel = {.support_radius = support_radius}};
  const geometry::Box<2> box{.lower = {-length, 0.0}, .upper = {length, rows_across * spacing}, .periodic = {false, true}};
  auto scene = simulation::scene<integrator::LammpsVerlet>(
      box, group<Left>("left", Stationary{}, strip(spacing, -rows, 0), left.density * spacing * spacing),
      group<Right>("right", Stationary{}, strip(spacing, 0, rows), right.density * spacing * spacing), interaction<Left, Left>(conduction),
      interaction<Right, Right>(conduction), interaction<Left, Right>(conduction), properties<Left>(left), properties<Right>(right));
  scene.template group<Left>().template set<field::SpecificEnergy>([&](const auto&) { return left.specific_heat; });
  const auto report = scene.run({.until = end_time, .time_step = 0.01 * square(support_radius) / left.diffusivity()});

  const auto effusivity = [](const Solid& solid) { return std::sqrt(solid.conductivity * solid.density * solid.specific_heat); };
  const double joint = effusivity(left) / (effusivity(left) + effusivity(right));
  const auto exact = [&](double x) {
    const Solid& solid = x < 0.0 ? left : right;
    return joint + ((x < 0.0 ? 1.0 : 0.0) - joint) * std::erf(std::fabs(x) / std::sqrt(4.0 * solid.diffusivity() * scene.time()));
  };
  Errors errors;
  const std::string name = "half_spaces_" + std::string(mean_name<Mean>) + "_" + std::to_string(rows);
  io::CsvTable table(folder / (name + ".csv"), {{"x", "m"}, {"T", "K"}, {"exact T", "K"}});
  compare(scene.template group<Left>(), left.specific_heat, errors, table, exact);
  compare(scene.template group<Right>(), right.specific_heat, errors, table, exact);
  const std::string label = "HX-2, " + std::string(mean_name<Mean>) + " mean, N = " + std::to_string(rows);
  result.error(label + ": L2 of T", errors.l2(), 1.2 * bounds[0], "error functions");
  result.error(label + ": largest error of T", errors.largest, 1.2 * bounds[1], "error functions");
  result.add(report);
  result.describe(scene);
}

/// HX-3: one phase, 100 by 10 particles, support of two spacings: the example of LAMMPS' sph/heatconduction.
void one_phase(const io::OutputFolder& folder, example::Result& result) {
  constexpr double spacing = 0.01;
  constexpr Solid solid{1e-5, 0.1, 1.0};  // diffusivity 1e-4 m^2/s
  const sph::HeatConduction<kernel::Lucy<2>> conduction{.kernel = {.support_radius = 0.02}};
  const auto points = geometry::fill(geometry::Cubic<2>{.spacing = spacing}, geometry::Cuboid<2>{.lower = {0.0, 0.0}, .upper = {1.0, 0.1}});
  const geometry::Box<2> box{.lower = {0.0, 0.0}, .upper = {1.0, 0.1}, .periodic = {false, true}};
  auto scene = simulation::scene<integrator::LammpsVerlet>(box, group<Left>("bar", Stationary{}, points, solid.density * spacing * spacing),
                                                           interaction<Left, Left>(conduction), properties<Left>(solid));
  auto& bar = scene.group<Left>();
  bar.set<field::SpecificEnergy>([](const auto& x) { return x[0] < 0.5 ? 1.0 : 2.0; });
  const auto report = scene.run({.until = 160 * 0.025, .time_step = 0.025});
  Errors errors;
  io::CsvTable table(folder / "one_phase.csv", {{"x", "m"}, {"e", "J/kg"}, {"exact e", "J/kg"}});
  for (std::size_t i = 0; i < bar.size(); ++i) {
    const double x = bar.positions()[i][0], e = bar.get<field::SpecificEnergy>()[i];
    const double exact = 1.5 + 0.5 * std::erf((x - 0.5) / std::sqrt(4.0 * solid.diffusivity() * scene.time()));
    table.row({x, e, exact});
    if (x > 0.1 && x < 0.9) errors.add(e - exact);
  }
  result.error("HX-3, one phase: L2 of e [J/kg]", errors.l2(), 1.0e-3, "error function; stock LAMMPS 7.4e-4");
  result.add(report);
  result.describe(scene);
}

int run(const example::Options& options) {
  const io::OutputFolder folder(options.output);
  example::Result result{.example = "heat_conduction", .test_case = "HX-1, HX-2, HX-3"};
  const auto resolutions = options.resolutions({10, 20}, {10, 20, 40}, {10, 20, 40, 80});
  result.resolution = "up to " + std::to_string(resolutions.back()) + " rows per slab";
  // L2, largest error and flux ratio of an independent solver at 10, 20 and 40 rows; beyond that the errors halve at least
  struct Table {
    int rows;
    std::array<double, 3> slabs_arithmetic, slabs_harmonic;
    std::array<double, 2> spaces_arithmetic, spaces_harmonic;
  };
  constexpr std::array<Table, 3> tables{{{10, {0.0350, 0.0799, 1.082}, {0.0045, 0.0081, 0.998}, {0.056, 0.179}, {0.0077, 0.029}},
                                         {20, {0.0178, 0.0421, 1.041}, {0.0024, 0.0042, 0.999}, {0.032, 0.118}, {0.0014, 0.0057}},
                                         {40, {0.0090, 0.0216, 1.020}, {0.0012, 0.0022, 0.9994}, {0.017, 0.063}, {0.0012, 0.0049}}}};
  for (const int rows : resolutions) {
    const Table* bounds = tables.data();
    for (const Table& table : tables)
      if (table.rows <= rows) bounds = &table;
    if (options.resolution == 0) {
      two_slabs<ArithmeticMean>(rows, folder, result, bounds->slabs_arithmetic);
      two_slabs<HarmonicMean>(rows, folder, result, bounds->slabs_harmonic);
      two_half_spaces<ArithmeticMean>(rows, folder, result, bounds->spaces_arithmetic);
    }
    two_half_spaces<HarmonicMean>(rows, folder, result, bounds->spaces_harmonic);
  }
  if (options.resolution == 0) {
    one_phase(folder, result);
    const auto curves = [](const std::string& name) {
      return "plot '" + name + "_harmonic_20.csv' using 1:3 skip 1 with points pt 6 lc 'black' title 'exact', '' using 1:2 skip 1 with "
             "points pt 7 ps 0.4 title 'harmonic mean', '" + name + "_arithmetic_20.csv' using 1:2 skip 1 with points pt 7 ps 0.4 "
             "title 'arithmetic mean'\n";
    };
    io::plot(folder, "heat_conduction",
             "set datafile separator ','\nset multiplot layout 1,2\nset xlabel 'x [m]'\nset ylabel 'T [K]'\n"
             "set title 'two slabs, N = 20'\n" + curves("slabs") + "set title 'two half-spaces, N = 20'\n" + curves("half_spaces") +
                 "unset multiplot");
  }
  return result.print(folder);
}

}  // namespace

int main(int argc, char** argv) {
  return example::guarded(
      "heat_conduction", run,
      example::options(argc, argv, "heat_conduction",
                       "Heat conduction inside and between phases against exact solutions (HX-1, HX-2, HX-3).", {.least_resolution = 10}));
}
