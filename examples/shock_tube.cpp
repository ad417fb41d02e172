// Shock tube of liquid water, 1000 or 10 000 bar against 1 bar: Noble-Abel stiffened gas, energy equation, local sound speed
// (1 s; 1 s with --quick). Errors of pressure, velocity and density against the exact solution of the Riemann problem. Case NASG-1.
// Equation of state: O. Le Metayer, R. Saurel, Phys. Fluids 28 (2016) 046102, doi:10.1063/1.4945981.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>
#include <dmp/dmp.hpp>

#include "support/choices.hpp"
#include "support/options.hpp"
#include "support/result.hpp"

using namespace dmp;
using namespace dmp::simulation;
using particles::Frozen, particles::Mobile;

struct Water {};
struct LeftEnd {};
struct RightEnd {};

namespace {

constexpr eos::NobleAbelStiffenedGas water = eos::liquid_water;
constexpr double density = 1000.0;    // at the start, on both sides [kg/m^3]
constexpr double low_pressure = 1e5;  // right of the diaphragm at x = 0 [Pa]
constexpr double end_time = 1.5e-4;   // [s]; no wave has reached an end of the tube by then
constexpr double half_length = 0.5;   // [m]
constexpr double support_in_spacings = 2.6;

struct State {
  double pressure, velocity, density;
};

/// Exact solution of the Riemann problem with fluid at rest on both sides: a fan to the left, a contact, a shock to the right.
class Riemann {
 public:
  explicit Riemann(double high_pressure) : high_(high_pressure) {
    double least = low_pressure, most = high_;
    for (int k = 0; k < 200; ++k) {  // the pressure where both waves leave the same velocity, by bisection
      star_.pressure = 0.5 * (least + most);
      (behind_fan(star_.pressure) > behind_shock(star_.pressure) ? least : most) = star_.pressure;
    }
    star_.velocity = behind_shock(star_.pressure);
    fan_density_ = 1.0 / (b + free_volume * std::pow(strength(high_), -1.0 / gamma));
    const double x = strength(low_pressure), above = gamma + 1.0, below = gamma - 1.0;
    shock_density_ = 1.0 / (b + free_volume * (below * x + above) / (above * x + below));
    shock_speed_ = star_.velocity / (1.0 - density / shock_density_);
    head_ = -water.sound_speed(density, water.specific_energy(high_, density));
    tail_ = star_.velocity - water.sound_speed(fan_density_, water.specific_energy(star_.pressure, fan_density_));
  }
  [[nodiscard]] State at(double x, double time) const {
    const double speed = x / time;
    if (speed >= shock_speed_) return {low_pressure, 0.0, density};
    if (speed >= star_.velocity) return {star_.pressure, star_.velocity, shock_density_};
    if (speed >= tail_) return {star_.pressure, star_.velocity, fan_density_};
    if (speed <= head_) return {high_, 0.0, density};
    double least = star_.pressure, most = high_;  // in the fan x/t = u - c
    for (int k = 0; k < 100; ++k) {
      const double p = 0.5 * (least + most);
      (in_fan(p).velocity - sound_in_fan(p) > speed ? least : most) = p;
    }
    return in_fan(least);
  }
  [[nodiscard]] double velocity() const { return star_.velocity; }
  [[nodiscard]] double pressure() const { return star_.pressure; }
  [[nodiscard]] double tail() const { return tail_; }
  [[nodiscard]] double shock_speed() const { return shock_speed_; }

 private:
  static constexpr double gamma = water.heat_capacity_ratio, p_inf = water.stiffening_pressure, b = water.covolume;
  static constexpr double free_volume = 1.0 / density - b;

  [[nodiscard]] double strength(double from) const { return (star_.pressure + p_inf) / (from + p_inf); }
  [[nodiscard]] double behind_shock(double p) const {
    const double a = 2.0 * free_volume / (gamma + 1.0), c = (gamma - 1.0) / (gamma + 1.0) * (low_pressure + p_inf);
    return (p - low_pressure) * std::sqrt(a / (p + p_inf + c));
  }
  [[nodiscard]] double behind_fan(double p) const {
    const double c = water.sound_speed(density, water.specific_energy(high_, density));
    return 2.0 * c * (1.0 - b * density) / (gamma - 1.0) * (1.0 - std::pow((p + p_inf) / (high_ + p_inf), (gamma - 1.0) / (2.0 * gamma)));
  }
  [[nodiscard]] State in_fan(double p) const {
    return {p, behind_fan(p), 1.0 / (b + free_volume * std::pow((p + p_inf) / (high_ + p_inf), -1.0 / gamma))};
  }
  [[nodiscard]] double sound_in_fan(double p) const {
    const double rho = in_fan(p).density;
    return water.sound_speed(rho, water.specific_energy(p, rho));
  }

  double high_;
  State star_{};
  double fan_density_ = 0.0, shock_density_ = 0.0, shock_speed_ = 0.0, head_ = 0.0, tail_ = 0.0;
};

/// Where the pressure of the particles, in order of x, falls through `level`, coming from the right.
double last_crossing(const std::vector<std::pair<double, double>>& profile, double level) {
  for (std::size_t k = profile.size() - 1; k > 0; --k) {
    const auto [x, p] = profile[k - 1];
    if (p >= level) return x + (profile[k].first - x) * (p - level) / (p - profile[k].second);
  }
  return -half_length;
}

void tube(double high_pressure, int columns, const example::Options& options, const io::OutputFolder& folder, example::Result& result) {
  const double spacing = 2.0 * half_length / columns, height = 6.0 * spacing, mass = density * spacing * spacing;
  const double support_radius = (options.support > 0.0 ? options.support : support_in_spacings) * spacing;
  const Riemann exact(high_pressure);
  const auto block = [&](double first, double last) {
    return geometry::fill(geometry::Cubic<2>{.spacing = spacing, .origin = {-half_length, 0.0}},
                          geometry::Cuboid<2>{.lower = {first, 0.0}, .upper = {last, height}});
  };
  const sph::Compressible<example::Kernel<kernel::Lucy<2>>, viscosity::ShockCapturing> law{
      .kernel = {.support_radius = support_radius}, .viscosity = {.alpha = 1.0}};
  const double end = half_length + 4.0 * spacing;
  const geometry::Box<2> box{.lower = {-end, 0.0}, .upper = {end, height}, .periodic = {false, true}};
  auto scene = simulation::scene<example::Integrator<integrator::ExtrapolatedVerlet>>(
      box, group<Water>("water", Mobile{}, block(-half_length, half_length), mass),
      group<LeftEnd>("left_end", Frozen<2>{}, block(-end, -half_length), mass),
      group<RightEnd>("right_end", Frozen<2>{}, block(half_length, end), mass), interaction<Water, Water>(law),
      interaction<Water, LeftEnd>(law), interaction<Water, RightEnd>(law), material<Water, LeftEnd, RightEnd>(water));
  const auto start = [&](auto& group) {
    group.template set<field::Density>([](const auto&) { return density; });
    group.template set<field::SpecificEnergy>(
        [&](const auto& x) { return water.specific_energy(x[0] < 0.0 ? high_pressure : low_pressure, density); });
  };
  start(scene.template group<Water>());
  start(scene.template group<LeftEnd>());
  start(scene.template group<RightEnd>());

  const auto& liquid = scene.template group<Water>();
  const auto energy = [&] {
    double sum = 0.0;
    for (std::size_t i = 0; i < liquid.size(); ++i)
      sum += mass * (liquid.template get<field::SpecificEnergy>()[i] + 0.5 * liquid.template get<field::Velocity>()[i].squaredNorm());
    return sum;
  };
  const double energy_before = energy();
  const double sound = water.sound_speed(density, water.specific_energy(high_pressure, density));
  const auto report =
      scene.run(example::until(end_time, 0.2 * support_radius / (sound + exact.velocity()), options));

  const double t = scene.time();
  std::vector<std::pair<double, double>> profile;
  double difference = 0.0, plateau_p = 0.0, plateau_u = 0.0, worst_density = 0.0;
  int on_plateau = 0;
  const std::string name = high_pressure > 5e8 ? "shock_tube_10000_bar" : "shock_tube_1000_bar";
  io::CsvTable table(
      folder / (name + ".csv"),
      {{"x", "m"}, {"p", "Pa"}, {"u", "m/s"}, {"density", "kg/m^3"}, {"exact p", "Pa"}, {"exact u", "m/s"}, {"exact density", "kg/m^3"}});
  double density_difference[2] = {0.0, 0.0};
  int density_count[2] = {0, 0};
  for (std::size_t i = 0; i < liquid.size(); ++i) {
    const double x = liquid.positions()[i][0], rho = liquid.template get<field::Density>()[i];
    const State measured{water.pressure(rho, liquid.template get<field::SpecificEnergy>()[i]), liquid.template get<field::Velocity>()[i][0],
                         rho};
    const State right = exact.at(x, t);
    table.row({x, measured.pressure, measured.velocity, measured.density, right.pressure, right.velocity, right.density});
    profile.emplace_back(x, measured.pressure);
    difference += std::fabs(measured.pressure - right.pressure);
    if (x < exact.tail() * t + 0.05 || x > exact.shock_speed() * t - 0.05 || std::fabs(x - exact.velocity() * t) < 0.04) continue;
    plateau_p += measured.pressure;
    plateau_u += measured.velocity;
    const int side = x < exact.velocity() * t ? 0 : 1;
    density_difference[side] += measured.density / right.density - 1.0;
    ++density_count[side];
    ++on_plateau;
  }
  for (int side = 0; side < 2; ++side) worst_density = std::max(worst_density, std::fabs(density_difference[side] / density_count[side]));
  std::sort(profile.begin(), profile.end());
  const double shock = last_crossing(profile, 0.5 * (exact.pressure() + low_pressure));

  const bool strong = high_pressure > 5e8;
  const std::string label = std::string(strong ? "10 000 bar, N = " : "1000 bar, N = ") + std::to_string(columns);
  const std::string source = "NASG-1, exact Riemann solution";
  const double coarser = std::max(1.0, std::sqrt(400.0 / columns));  // L1 falls with an order of 0.5 to 0.7
  result.error(label + ": L1 of p over p_L", difference / static_cast<double>(liquid.size()) / high_pressure,
               (strong ? 0.02 : 0.025) * coarser, source);
  if (columns >= 400) {  // coarser ones have hardly any plateau
    result.error(label + ": p of the plateau", plateau_p / on_plateau / exact.pressure() - 1.0, strong ? 0.025 : 0.003, source);
    result.error(label + ": u of the plateau", plateau_u / on_plateau / exact.velocity() - 1.0, strong ? 0.02 : 0.01, source);
    if (strong) result.error(label + ": density of the plateau", worst_density, 0.01, source);
    else result.error(label + ": position of the shock [m]", shock - exact.shock_speed() * t, 0.004, source);
  }
  result.error(label + ": energy, relative change", energy() / energy_before - 1.0, 1e-5, "conservation");
  VtkOutput(folder, name)(scene);
  result.add(report);
  result.describe(scene);
}

int run(const example::Options& options) {
  const io::OutputFolder folder(options.output);
  const auto resolutions = options.resolutions({400}, {100, 200, 400}, {100, 200, 400, 800, 1600});
  example::Result result{
      .example = "shock_tube", .test_case = "NASG-1", .resolution = "up to " + std::to_string(resolutions.back()) + " columns"};
  for (const int columns : resolutions) {
    tube(1e8, columns, options, folder, result);
    if (options.resolution == 0) tube(1e9, columns, options, folder, result);
  }
  if (options.resolution == 0)
    io::plot(folder, "shock_tube",
             "set datafile separator ','\nset multiplot layout 2,2\nset xlabel 'x [m]'\n"
             "do for [name in '1000 10000'] {\n  file = 'shock_tube_'.name.'_bar.csv'\n"
             "  set ylabel 'p [Pa]'\n  plot file using 1:5 skip 1 with points pt 7 ps 0.3 title 'exact', '' using 1:2 skip 1 with points "
             "pt 6 ps 0.3 title 'dmp, '.name.' bar'\n"
             "  set ylabel 'u [m/s]'\n  plot file using 1:6 skip 1 with points pt 7 ps 0.3 title 'exact', '' using 1:3 skip 1 with points "
             "pt 6 ps 0.3 title 'dmp'\n}\nunset multiplot");
  return result.print(folder);
}

}  // namespace

int main(int argc, char** argv) {
  return example::guarded(
      "shock_tube", run,
      example::options(argc, argv, "shock_tube",
                       "Shock tube of liquid water with the energy equation against the exact Riemann solution (NASG-1).",
                       {.least_resolution = 50, .largest_support = 4.0, .safety = true}));
}
