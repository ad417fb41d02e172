// Plane channel flow of fluids whose viscosity varies: with the temperature between a cold and a hot wall, prescribed or conducted, and
// with the shear rate; and of one viscosity by the laws along the line of centres (10 s; 2 s with --quick). Errors of velocity and
// viscosity against exact profiles. Cases VISC-2, VISC-3, VISC-4, VISC-5. A. Albano et al., ChemEngineering 5 (2021) 30,
// doi:10.3390/chemengineering5020030, section 7.2.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>
#include <dmp/dmp.hpp>

#include "support/channel.hpp"
#include "support/choices.hpp"
#include "support/options.hpp"
#include "support/result.hpp"

using namespace dmp;
using namespace dmp::simulation;
using particles::Frozen, particles::Mobile, particles::Stationary;

struct Water {};
struct ColdPlate {};
struct HotPlate {};

namespace {

constexpr double density = 1000.0;        // [kg/m^3]
constexpr double gap = 1e-3;              // H [m], from the cold plate at y = 0 to the hot one
constexpr double top_speed = 0.01;        // u_max [m/s]
constexpr double specific_heat = 4184.0;  // [J/(kg K)]

/// The fluid of the paper, 100 times as viscous as water (its C1 is a misprint that the case keeps).
constexpr rheology::Arrhenius oil{
    .pre_exponential_factor = 1.83e-4, .activation_temperature = 1879.9, .temperature_range = {.lowest = 273.0, .highest = 473.0}};
constexpr double cold = 295.0;  // [K]

/// The hot wall that makes the viscosity there 1/ratio of that at the cold wall.
double hot_for(double ratio) { return cold + cold * cold * std::log(ratio) / (oil.activation_temperature - cold * std::log(ratio)); }

/// Exact steady flow with a viscosity mu(y): u = (G/rho-free) [t0 I1(y) - I2(y)], I1 = int dy/mu, I2 = int y dy/mu, t0 = I2(H)/I1(H),
/// scaled by the body force g so that the largest speed is top_speed.
class VariableProfile {
 public:
  explicit VariableProfile(double hot) : integral_(intervals + 1), moment_(intervals + 1) {
    const auto fluidity = [hot](double y) { return 1.0 / oil.viscosity(cold + (hot - cold) * y / gap); };
    const double step = gap / intervals;
    for (std::size_t k = 0; k < intervals; ++k) {  // Simpson's rule
      const double y = static_cast<double>(k) * step, middle = y + 0.5 * step, end = y + step;
      integral_[k + 1] = integral_[k] + step / 6.0 * (fluidity(y) + 4.0 * fluidity(middle) + fluidity(end));
      moment_[k + 1] = moment_[k] + step / 6.0 * (y * fluidity(y) + 4.0 * middle * fluidity(middle) + end * fluidity(end));
    }
    top_at_ = moment_.back() / integral_.back();
    force_ = top_speed / (density * unscaled(top_at_));
  }
  [[nodiscard]] double velocity(double y) const { return density * force_ * unscaled(y); }
  [[nodiscard]] double top_at() const { return top_at_; }  ///< where the speed is largest [m]
  [[nodiscard]] double force() const { return force_; }    ///< that drives it [m/s^2]

 private:
  [[nodiscard]] double unscaled(double y) const {
    const double place = std::clamp(y / gap, 0.0, 1.0) * intervals;
    const auto k = static_cast<std::size_t>(std::min(place, intervals - 1.0));
    const double part = place - static_cast<double>(k);
    const auto at = [&](const std::vector<double>& table) { return table[k] + part * (table[k + 1] - table[k]); };
    return top_at_ * at(integral_) - at(moment_);
  }
  static constexpr int intervals = 2000;
  std::vector<double> integral_, moment_;
  double top_at_ = 0.0, force_ = 0.0;
};

/// Mean velocity of each row of particles, by its height at the start.
template <class Group>
double row_of_largest_velocity(const Group& water, double spacing) {
  std::map<long, std::pair<double, int>> rows;
  for (std::size_t i = 0; i < water.size(); ++i) {
    auto& [sum, count] = rows[std::lround(water.positions()[i][1] / spacing)];
    sum += water.template get<field::Velocity>()[i][0];
    ++count;
  }
  double largest = 0.0;
  long found = 0;
  for (const auto& [row, mean] : rows)
    if (mean.first / mean.second > largest) largest = mean.first / mean.second, found = row;
  return static_cast<double>(found) * spacing;
}

template <class Group, class Exact>
void write_profile(const io::OutputFolder& folder, const std::string& name, const Group& water, const Exact& exact) {
  io::CsvTable table(folder / (name + ".csv"), {{"y", "m"}, {"u", "m/s"}, {"exact u", "m/s"}});
  for (std::size_t i = 0; i < water.size(); ++i)
    table.row({water.positions()[i][1], water.template get<field::Velocity>()[i][0], exact(water.positions()[i][1])});
}

enum class Temperature { prescribed, conducted };

/// VISC-2 and VISC-3: the viscosity falls by `ratio` from the cold wall to the hot one.
template <Temperature Kind>
void heated_channel(double ratio, int rows, const example::Options& options, const io::OutputFolder& folder, example::Result& result) {
  constexpr bool conducts = Kind == Temperature::conducted;
  const example::Channel channel{.gap = gap, .rows = rows};
  const double hot = hot_for(ratio), mass = density * square(channel.spacing());
  const VariableProfile exact(hot);
  const double hottest = oil.viscosity(hot), coldest = oil.viscosity(cold);
  const sph::WeaklyCompressible<example::Kernel<kernel::Lucy<2>>, viscosity::Morris<>> flow{
      .kernel = {.support_radius = channel.support_radius()}};
  const sph::HeatConduction<example::Kernel<kernel::Lucy<2>>> conduction{.kernel = {.support_radius = channel.support_radius()}};
  const eos::Tait liquid{.rest_density = density, .sound_speed_0 = 10.0 * top_speed};
  const auto pairs = [&]<class A, class B>(std::type_identity<A>, std::type_identity<B>) {
    if constexpr (conducts) return interaction<A, B>(flow, conduction);
    else return interaction<A, B>(flow);
  };
  const auto properties = [&] {  // with a prescribed temperature that is a column of the particles, and nothing else of heat is there
    if constexpr (conducts)
      return material<Water, ColdPlate, HotPlate>(liquid, thermal::Linear{.specific_heat_capacity = specific_heat}, oil,
                                                  thermal::Conductivity{.thermal_conductivity = hottest * specific_heat});
    else return material<Water, ColdPlate, HotPlate>(liquid, oil);
  };
  auto scene = simulation::scene<integrator::ExtrapolatedVerlet>(
      channel.box(), group<Water>("water", Mobile{}, channel.fluid(), mass),
      group<ColdPlate>("cold_plate", Frozen<2>{}, channel.lower_plate(), mass),
      group<HotPlate>("hot_plate", Frozen<2>{}, channel.upper_plate(), mass),
      pairs(std::type_identity<Water>{}, std::type_identity<Water>{}), pairs(std::type_identity<Water>{}, std::type_identity<ColdPlate>{}),
      pairs(std::type_identity<Water>{}, std::type_identity<HotPlate>{}), properties(),
      forced_by<Water>(forcing::Constant<2>{.uniform_acceleration = {{{exact.force(), 0.0}}}}));
  const auto set_temperature = [](auto& group, auto&& temperature) {
    if constexpr (conducts) group.template set<field::SpecificEnergy>([&](const auto& x) { return specific_heat * temperature(x[1]); });
    else group.template set<field::Temperature>([&](const auto& x) { return temperature(x[1]); });
  };
  auto& water = scene.template group<Water>();
  const double middle = 0.5 * (cold + hot);
  set_temperature(scene.template group<ColdPlate>(), [](double) { return cold; });
  set_temperature(scene.template group<HotPlate>(), [&](double) { return hot; });
  set_temperature(water, [&](double y) { return conducts ? middle : cold + (hot - cold) * y / gap; });

  const double mean = 0.5 * (coldest + hottest);
  const double end = 10.5 * density * gap * gap / (std::numbers::pi * std::numbers::pi * mean);
  const auto report =
      scene.run(example::until(end, 0.03 * square(channel.support_radius()) * density / coldest, options));

  double viscosity_error = 0.0;
  for (std::size_t i = 0; i < water.size(); ++i) {
    const double right = oil.viscosity(cold + (hot - cold) * water.positions()[i][1] / gap);
    viscosity_error = std::max(viscosity_error, std::fabs(scene.engine().prepared(water, i, 0.0).dynamic_viscosity / right - 1.0));
  }
  const auto velocity = [&](double y) { return exact.velocity(y); };
  const auto error = example::profile_error(water, velocity);
  const std::string id = conducts ? "VISC-3" : "VISC-2";
  const std::string label = id + ", m = " + to_text(ratio) + ", N = " + std::to_string(rows), source = "exact profile by quadrature";
  const double coarser = std::max(1.0, 20.0 / rows);  // the bounds are those of 20 rows, the order is one
  result.error(label + ": L2 of u", error.l2, 0.03 * coarser, source);
  result.error(label + ": shape of u", error.shape, 0.012 * coarser, source);
  result.error(label + ": place of the largest u, over H", (row_of_largest_velocity(water, channel.spacing()) - exact.top_at()) / gap,
               0.05 * coarser, source);
  result.error(label + ": viscosity, largest relative error", viscosity_error, 0.01, source);
  const std::string name = id + "_" + to_text(ratio) + "_" + std::to_string(rows);
  write_profile(folder, name, water, velocity);
  VtkOutput(folder, name)(scene);
  result.add(report);
  result.describe(scene);
}

/// VISC-4: one viscosity, by a law along the line of centres.
template <class Viscosity>
void along_centres(const Viscosity& viscosity, double sound_speed, const std::string& name, double scale, double margin, double shape,
                   const io::OutputFolder& folder, example::Result& result) {
  constexpr double mu = 0.01;
  const example::Channel channel{.gap = gap, .rows = 20};
  const double mass = density * square(channel.spacing()), h = channel.support_radius();
  const sph::WeaklyCompressible<kernel::Lucy<2>, Viscosity> law{.kernel = {.support_radius = h}, .viscosity = viscosity};
  auto scene = simulation::scene<integrator::ExtrapolatedVerlet>(
      channel.box(), group<Water>("water", Mobile{}, channel.fluid(), mass),
      group<ColdPlate>("lower_plate", Frozen<2>{}, channel.lower_plate(), mass),
      group<HotPlate>("upper_plate", Frozen<2>{}, channel.upper_plate(), mass), interaction<Water, Water>(law),
      interaction<Water, ColdPlate>(law), interaction<Water, HotPlate>(law),
      material<Water, ColdPlate, HotPlate>(eos::Tait{.rest_density = density, .sound_speed_0 = sound_speed},
                                           rheology::Constant{.dynamic_viscosity = mu}),
      forced_by<Water>(forcing::Constant<2>{.uniform_acceleration = {{{8.0 * mu * top_speed / (density * gap * gap), 0.0}}}}));
  const double viscous = 0.012 * h * h * density / mu, acoustic = 0.2 * h / (sound_speed + 3.0 * top_speed);
  const double end = 7.0 * density * gap * gap / (std::numbers::pi * std::numbers::pi * mu);
  const auto report = scene.run({.until = end, .time_step = std::min(viscous, acoustic)});
  const auto parabola = [](double y) { return 4.0 * top_speed * y / gap * (1.0 - y / gap); };
  const auto error = example::profile_error(scene.template group<Water>(), parabola);
  result.error("VISC-4, " + name + ": scale of u less " + to_text(scale), error.scale - scale, margin,
               "independent runs: the law's own error on this lattice");
  result.error("VISC-4, " + name + ": shape of u", error.shape, shape, "parabola");
  write_profile(folder, "VISC-4_" + name, scene.template group<Water>(), parabola);
  result.add(report);
  result.describe(scene);
}

/// VISC-5: power-law fluid, H = K = u_max = density = 1; the plates are stationary, so that they know the shear rate beside them.
void power_law(double n, int rows, double l2, double shape, const io::OutputFolder& folder, example::Result& result) {
  const example::Channel channel{.gap = 1.0, .rows = rows};
  const double mass = square(channel.spacing()), h = channel.support_radius(), exponent = (n + 1.0) / n;
  const double force = std::pow(exponent * std::pow(2.0, exponent), n);
  const sph::WeaklyCompressible<kernel::Lucy<2>, viscosity::Morris<>> law{.kernel = {.support_radius = h}};
  const sph::ShearRate<kernel::Lucy<2>> shear_rate{.kernel = {.support_radius = h}};
  const rheology::PowerLaw fluid{
      .consistency_index = 1.0, .power_law_index = n, .lowest_shear_rate = 0.1, .lowest_viscosity = 1e-3, .highest_viscosity = 1e3};
  auto scene = simulation::scene<integrator::ExtrapolatedVerlet>(
      channel.box(), group<Water>("fluid", Mobile{}, channel.fluid(), mass),
      group<ColdPlate>("lower_plate", Stationary{}, channel.lower_plate(), mass),
      group<HotPlate>("upper_plate", Stationary{}, channel.upper_plate(), mass), interaction<Water, Water>(law),
      interaction<Water, ColdPlate>(law), interaction<Water, HotPlate>(law), summed<Water, ColdPlate, HotPlate>(shear_rate),
      material<Water, ColdPlate, HotPlate>(eos::Tait{.rest_density = 1.0, .sound_speed_0 = 10.0}, fluid),
      forced_by<Water>(forcing::Constant<2>{.uniform_acceleration = {{{force, 0.0}}}}));
  const auto report = scene.run({.until = 3.0});
  const auto exact = [&](double y) {
    return n / (n + 1.0) * std::pow(force, 1.0 / n) * (std::pow(0.5, exponent) - std::pow(std::fabs(y - 0.5), exponent));
  };
  const auto error = example::profile_error(scene.template group<Water>(), exact);
  const std::string label = "VISC-5, n = " + to_text(n) + ", N = " + std::to_string(rows);
  result.error(label + ": L2 of u", error.l2, l2, "exact profile");
  result.error(label + ": shape of u", error.shape, shape, "exact profile");
  write_profile(folder, "VISC-5_" + to_text(n) + "_" + std::to_string(rows), scene.template group<Water>(), exact);
  result.add(report);
  result.describe(scene);
}

int run(const example::Options& options) {
  const io::OutputFolder folder(options.output);
  example::Result result{.example = "variable_viscosity", .test_case = "VISC-2, VISC-3, VISC-4, VISC-5"};
  const auto resolutions = options.resolutions({20}, {20}, {10, 20, 40});
  result.resolution = "up to " + std::to_string(resolutions.back()) + " spacings across";
  for (const int rows : resolutions) {
    if (options.resolution > 0) {
      heated_channel<Temperature::prescribed>(3.0, rows, options, folder, result);
      return result.print(folder);
    }
    for (const double ratio : {1.5, 2.0, 3.0, 5.0}) heated_channel<Temperature::prescribed>(ratio, rows, options, folder, result);
    heated_channel<Temperature::conducted>(3.0, rows, options, folder, result);
  }
  along_centres(viscosity::Monaghan<2>{}, 10.0 * top_speed, "two-sided", 1.14, 0.03, 0.005, folder, result);
  if (options.size != example::Size::quick) {
    const double sound_speed = 100.0 * top_speed, h = example::Channel{.gap = gap, .rows = 20}.support_radius();
    along_centres(viscosity::Artificial{.alpha = 8.0 * 0.01 / (sound_speed * h * density), .sound_speed = sound_speed}, sound_speed,
                  "one-sided", 2.2, 0.2, 0.03, folder, result);
    power_law(0.5, 40, 0.10, 0.03, folder, result);
  }
  power_law(0.5, 20, 0.18, 0.04, folder, result);
  power_law(1.5, 20, 0.07, 0.04, folder, result);
  return result.print(folder);
}

}  // namespace

int main(int argc, char** argv) {
  return example::guarded(
      "variable_viscosity", run,
      example::options(argc, argv, "variable_viscosity",
                       "Channel flow of fluids whose viscosity varies with temperature or shear rate (VISC-2 to VISC-5).",
                       {.least_resolution = 5, .safety = true}));
}
