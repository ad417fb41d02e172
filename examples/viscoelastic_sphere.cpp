// A ball of viscoelastic bonds between two plates that approach and then hold (50 s; 6 s with --quick). Kelvin-Voigt bonds: on the ramp
// the force is that of the elastic ball plus tau dF/dt, tau = b/k; at the stop it drops to the elastic force and stays (A8a, A8b, A9).
// Standard linear solids: it relaxes to the elastic force with the time of the branches (A8c). Without inertia: every step in time is a
// state of rest. The elastic force is that of the same ball, so that facets and the number of beads cancel.
// M. Sahputra, A. Alexiadis, M. J. Adams, ChemEngineering 4 (2020) 30, doi:10.3390/chemengineering4020030. Their figures of E0 = 54 MPa
// and E_inf = 34 MPa of Kelvin-Voigt bonds are an effect of inertia; here they are given to standard linear solids.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>
#include <Eigen/Geometry>
#include <dmp/dmp.hpp>

#include "support/options.hpp"
#include "support/plates.hpp"
#include "support/result.hpp"

using namespace dmp;
using namespace dmp::simulation;
using example::Beads;
using particles::Mobile;

namespace {

constexpr double radius = example::ball_radius, density = 1000.0;  // R [m]
constexpr double small = 0.02, large = 0.06;                       // delta/2R at the stop
constexpr int ramp_steps = 40;

/// Positions of the beads, pressed step by step to rest. The springs may change from one step to the next.
class Press {
 public:
  Press(const lattice_spring::Body<3>& body, double stiffness)
      : x_(body.points.positions),
        mass_(density * body.points.volume),
        below_(example::plate(x_, -1.0)),
        above_(example::plate(x_, 1.0)),
        tolerance_(1e-7 * stiffness * std::cbrt(body.points.volume)) {}

  /// The force [N] at this approach [m].
  double operator()(const bond::Harmonic& spring, const std::vector<neighbours::Bond>& bonded, double approach, example::Result& result) {
    const auto start = std::chrono::steady_clock::now();
    geometry::Points<3> points;
    points.positions = x_;
    const double step = approach - approach_;
    if (before_.empty()) {  // a first guess: uniform strain, then as in the last step
      const double height = -below_.position - above_.position;
      for (auto& x : points.positions) x[2] *= (height - approach) / (height - approach_);
    } else if (last_step_ > 0.0) {
      for (std::size_t i = 0; i < x_.size(); ++i) points.positions[i] += step / last_step_ * (x_[i] - before_[i]);
    }
    before_ = x_;
    last_step_ = step;
    approach_ = approach;
    auto scene = simulation::scene<integrator::Leapfrog>(geometry::Box<3>::unbounded(), group<Beads>("beads", Mobile{}, points, mass_),
                                                         bonds<Beads, Beads>(spring, bonded), forced_by<Beads>(below_, above_));
    const auto report = relax(scene, {.force_tolerance = tolerance_, .time = approach, .without_rotation = true});
    const auto& now = scene.group<Beads>().positions();
    x_.assign(now.begin(), now.end());
    const auto low = load_on<Beads>(scene, below_, approach), high = load_on<Beads>(scene, above_, approach);
    largest_difference_ = std::max(largest_difference_, std::fabs(low.force[2] + high.force[2]) / std::max(1e-300, low.force[2]));
    result.steps += report.evaluations;
    result.particle_steps += static_cast<double>(report.evaluations) * static_cast<double>(x_.size());
    result.describe(scene);
    result.wall_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return 0.5 * (low.force[2] - high.force[2]);
  }
  [[nodiscard]] const std::vector<Vector<3>>& positions() const { return x_; }
  [[nodiscard]] double largest_difference() const { return largest_difference_; }

 private:
  std::vector<Vector<3>> x_, before_{};
  double mass_;
  forcing::Plane<3> below_, above_;
  double tolerance_, approach_ = 0.0, last_step_ = 0.0, largest_difference_ = 0.0;
};

/// delta [m] at each step of a ramp to delta/2R = `squeezed`.
constexpr double approach_at(double squeezed, int step) { return 2.0 * radius * squeezed * std::min(step, ramp_steps) / ramp_steps; }

/// Elastic force at each step of the ramp [N], the first at no approach.
std::vector<double> elastic_forces(const lattice_spring::Body<3>& body, double squeezed, double stiffness, example::Result& result) {
  Press press(body, stiffness);
  std::vector<double> force{0.0};
  for (int n = 1; n <= ramp_steps; ++n) force.push_back(press({.stiffness = stiffness}, body.bonds, approach_at(squeezed, n), result));
  return force;
}

/// Viscoelastic force at each step of dt, `hold_steps` of them after the stop.
template <class Law>
std::vector<double> forces(const std::string& name, const lattice_spring::Body<3>& body, double squeezed, const Law& law, double dt,
                           int hold_steps, example::Result& result) {
  Press press(body, law.stiffness);
  lattice_spring::InertiaFreeStep<3> step(law, dt, body.bonds, press.positions());
  std::vector<double> force{0.0};
  for (int n = 1; n <= ramp_steps + hold_steps; ++n) {
    force.push_back(press(step.law(), step.bonds(), approach_at(squeezed, n), result));
    step.advance(press.positions());
  }
  result.error("plates apart in force, " + name, press.largest_difference(), 0.01, "at rest");
  return force;
}

void write(const io::OutputFolder& folder, const std::string& name, double squeezed, double dt, const std::vector<double>& force,
           const std::vector<double>& expected) {
  io::CsvTable table(folder / (name + ".csv"), {{"time", "s"}, {"delta/2R", "-"}, {"force", "N"}, {"expected", "N"}});
  for (std::size_t n = 0; n < force.size(); ++n)
    table.row({static_cast<double>(n) * dt, approach_at(squeezed, static_cast<int>(n)) / (2.0 * radius), force[n], expected[n]});
}
double relative_l2(const std::vector<double>& force, const std::vector<double>& expected, std::size_t last) {
  double difference = 0.0, all = 0.0;
  for (std::size_t n = 1; n <= last; ++n) difference += square(force[n] - expected[n]), all += square(expected[n]);
  return std::sqrt(difference / all);
}

/// A8a, A8b: Kelvin-Voigt bonds, a ramp of `ramp_in_tau` relaxation times.
void kelvin_voigt(const std::string& name, const lattice_spring::Body<3>& body, double squeezed, const std::vector<double>& elastic,
                  double ramp_in_tau, double bound, const io::OutputFolder& folder, example::Result& result) {
  constexpr bond::KelvinVoigt law{.stiffness = 200.0, .damping = 1e-6};
  constexpr double tau = law.damping / law.stiffness;
  constexpr int last = ramp_steps;
  const double dt = ramp_in_tau * tau / ramp_steps;
  // Plates that beads sink into by sqrt(f/S) let go of a part of the drop within a tenth of tau, so that the hold is measured in tau.
  const int settled = static_cast<int>(std::ceil(0.75 * tau / dt - 1e-9)), hold_steps = 2 * settled;  // 3 and 6 steps of T = 10 tau
  const std::string case_name = name + ", " + to_text(100.0 * squeezed) + " %, T = " + to_text(ramp_in_tau) + " tau", of = case_name + ": ";
  const auto force = forces(case_name, body, squeezed, law, dt, hold_steps, result);
  std::vector<double> expected = elastic;  // + tau dF/dt, as backward Euler has it
  for (std::size_t n = last; n > 0; --n) expected[n] += tau / dt * (elastic[n] - elastic[n - 1]);
  expected.resize(force.size(), elastic[last]);
  write(folder, "kelvin_voigt_" + name + "_" + to_text(100.0 * squeezed) + "_" + to_text(ramp_in_tau), squeezed, dt, force, expected);
  const double ramp_error = relative_l2(force, expected, last);
  result.error("A8b, " + of + "F(t) on the ramp, L2", ramp_error, bound, "F_el + tau dF_el/dt");
  // Dashpots see no geometric stiffness, so that the drop is larger than tau dF_el/dt by about the strain where the ball is in contact.
  const double drop = (force[last] - force.back()) / (expected[last] - elastic[last]) - 1.0;
  if (squeezed <= small) result.error("A8b, " + of + "drop at the stop - 1", drop, 0.03, "tau dF_el/dt");
  double drift = 0.0;
  for (std::size_t n = last + static_cast<std::size_t>(settled); n < force.size(); ++n)
    drift = std::max(drift, std::fabs(force[n] / force.back() - 1.0));
  result.error("A8b, " + of + "drift on hold after 0.75 tau", drift, 0.005, "constant force");
  const double at_the_end = force.back() / elastic[last] - 1.0;
  result.error("A8a, " + of + "F/F_el at the end - 1", at_the_end, 0.005, "elastic ball at the same delta");
  std::printf("%sramp to %.4f, drop at the stop %+.4f from tau dF_el/dt%s, drift %.5f, end %+.5f\n", of.c_str(), ramp_error, drop,
              squeezed <= small ? "" : " (finite strain)", drift, at_the_end);
  std::fflush(stdout);
}

/// A8c: standard linear solids with E_inf : E_0 = 34 : 54, a ramp of two relaxation times.
void linear_solid(const std::string& name, const lattice_spring::Body<3>& body, double squeezed, const io::OutputFolder& folder,
                  example::Result& result) {
  constexpr double tau = 4.6e-5;
  constexpr bond::StandardLinearSolid law{.stiffness = 170.0, .branch_stiffness = 100.0, .branch_damping = 100.0 * tau};
  constexpr double dt = 2.0 * tau / ramp_steps;
  constexpr int hold_steps = 40, last = ramp_steps;
  const auto elastic = elastic_forces(body, squeezed, law.stiffness, result);
  const auto force = forces(name, body, squeezed, law, dt, hold_steps, result);
  // F_el + (k_m/k_e) times a Maxwell branch that is loaded with F_el
  const double h = dt / tau, decay = std::exp(-h), gain = law.branch_stiffness / law.stiffness * -std::expm1(-h) / h;
  std::vector<double> expected = elastic;
  expected.resize(force.size(), elastic[last]);
  double branch = 0.0;
  for (std::size_t n = 1; n < force.size(); ++n) {
    branch = decay * branch + (n <= last ? gain * (elastic[n] - elastic[n - 1]) : 0.0);
    expected[n] += branch;
  }
  write(folder, "linear_solid", squeezed, dt, force, expected);
  // The hold: F = F_inf + F_1 exp(-t/tau'), from three points equally far apart
  const double a = force[last], b = force[last + hold_steps / 2], c = force.back(), ratio = (c - b) / (b - a);
  const double found_tau = -0.5 * hold_steps * dt / std::log(ratio), infinite = a - (a - b) / (1.0 - ratio);
  // E_0/E_inf - 1 from what is left at the stop of the force of the branches: on the ramp they have relaxed by the discrete I(T/tau)
  double left = 0.0;
  for (std::size_t n = 1; n <= last; ++n) left = decay * left + -std::expm1(-h) / h * (elastic[n] - elastic[n - 1]) / elastic[last];
  const double stiff_over_soft = 1.0 + (a - infinite) / infinite / left;
  const std::string source = "F_el convolved with the branch";
  const double curve_error = relative_l2(force, expected, force.size() - 1), moduli = 54.0 / 34.0 / stiff_over_soft - 1.0;
  result.error("A8c, " + name + ": F(t), L2", curve_error, 0.02, source);
  result.error("A8c, " + name + ": E_inf/E_0 of 34/54 - 1", moduli, 0.02, "that of the bonds; fit to the hold");
  result.error("A8c, " + name + ": relaxation time of 46 us - 1", found_tau / tau - 1.0, 0.03, "that of the bonds; fit to the hold");
  std::printf("%s: F(t) to %.4f, E_inf/E_0 %+.4f, relaxation time %+.4f; I(2) of the Hertz ramp 0.5100, of this ball %.4f\n", name.c_str(),
              curve_error, moduli, found_tau / tau - 1.0, left);
  std::fflush(stdout);
}

lattice_spring::Body<3> ordered(int beads_in_radius) {  // orientation q1 of the specification
  const double spacing = radius / beads_in_radius;
  const lattice_spring::CubicLattice lattice{
      .spacing = spacing, .orientation = Eigen::Quaterniond(-0.467424, -0.047608, 0.829916, -0.300813).normalized().toRotationMatrix()};
  return lattice_spring::lattice_body(lattice, example::around_ball(), example::ball(radius - 1e-6 * spacing));
}

int run(const example::Options& options) {
  const io::OutputFolder folder(options.output);
  example::Result result{.example = "viscoelastic_sphere", .test_case = "A8a, A8b, A8c, A9"};
  const bool full = options.size == example::Size::full, alone = options.resolution > 0;
  const bool quick = options.size == example::Size::quick || (alone && !full);
  const int beads_in_radius = options.resolutions({10}, {10}, {32}).front();
  result.resolution = "R = " + std::to_string(beads_in_radius) + " spacings" + (quick || alone ? "" : "; a network of 5,921 beads");
  auto body = ordered(beads_in_radius);
  lattice_spring::measure_rest_lengths<3>(body.bonds, body.points.positions);
  const auto elastic_small = elastic_forces(body, small, 200.0, result);
  kelvin_voigt("lattice", body, small, elastic_small, 10.0, 0.02, folder, result);
  if (!quick) {
    kelvin_voigt("lattice", body, small, elastic_small, 2.0, 0.06, folder, result);
    if (!alone) {
      const auto elastic_large = elastic_forces(body, large, 200.0, result);
      kelvin_voigt("lattice", body, large, elastic_large, 10.0, 0.02, folder, result);
      if (full) kelvin_voigt("lattice", body, large, elastic_large, 2.0, 0.06, folder, result);
    }
    linear_solid("lattice of linear solids", body, large, folder, result);
  }
  if (!quick && !alone) {
    auto network = example::network_ball(5921, 1);
    lattice_spring::measure_rest_lengths<3>(network.bonds, network.points.positions);
    kelvin_voigt("network", network, small, elastic_forces(network, small, 200.0, result), 10.0, 0.02, folder, result);
    io::plot(folder, "viscoelastic_sphere",
             "set datafile separator ','\nset multiplot layout 1, 2\nset xlabel 'time [s]'\nset ylabel 'force [N]'\nset key bottom right\n"
             "plot 'kelvin_voigt_lattice_6_10.csv' using 1:4 skip 1 with lines lw 2 title 'F_{el} + tau dF_{el}/dt', '' using 1:3 skip 1 "
             "with points pt 7 title 'Kelvin-Voigt'\n"
             "plot 'linear_solid.csv' using 1:4 skip 1 with lines lw 2 title 'F_{el} convolved', '' using 1:3 skip 1 with points pt 7 "
             "title 'standard linear solid'\nunset multiplot");
  }
  return result.print(folder);
}

}  // namespace

int main(int argc, char** argv) {
  return example::guarded("viscoelastic_sphere", run,
                          example::options(argc, argv, "viscoelastic_sphere",
                                           "Balls of viscoelastic bonds between plates, loaded and held, without inertia (A8, A9). "
                                           "Resolution: R/l of one ordered ball, slowly; with --full fast, and of linear solids, too.",
                                           {.least_resolution = 6}));
}
