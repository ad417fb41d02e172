// Sound in a ring of masses and springs: how fast waves of every length run, and whether they last a million steps
// (7 s; 1 s with --quick). Nothing but bonds. Seven waves run round the ring at once; their frequencies are compared with the dispersion
// relation of the chain, omega = 2 sqrt(k/m) |sin(q a/2)|, and with what the leapfrog makes of it, sin(Omega dt/2) = omega dt/2, which it
// must meet to rounding.
// Chain: L. Brillouin, Wave Propagation in Periodic Structures (McGraw-Hill, 1946), chapter 1. Leapfrog: E. Hairer, C. Lubich, G. Wanner,
// Acta Numerica 12 (2003) 399-450, doi:10.1017/S0962492902000144.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>
#include <dmp/dmp.hpp>

#include "support/choices.hpp"
#include "support/options.hpp"
#include "support/result.hpp"

using namespace dmp;
using namespace dmp::simulation;
using particles::Mobile;

struct Beads {};

namespace {

constexpr double spacing = 0.01;                 // a [m]
constexpr double mass = 0.01;                    // m [kg]
constexpr double stiffness = 4.0;                // k [N/m]
constexpr double amplitude = 0.03 * spacing;     // of each wave [m]; together they stretch no bond by more than a fifth
constexpr double own_fraction = 0.1;             // of the largest stable time step
constexpr double rounding = std::numeric_limits<double>::epsilon();
const bond::Harmonic spring{.stiffness = stiffness};

/// One of the waves u = amplitude cos(q x - omega t + phase), and what is seen of it.
struct Wave {
  int number;                              // wavelengths on the ring
  double wave_number, frequency;           // q [1/m], omega of the exact chain [rad/s]
  std::vector<std::complex<double>> base;  // exp(-i (q x + phase)) at the beads
  double angle = 0.0;                      // Omega t so far [rad]

  Wave(int n, int beads)
      : number(n),
        wave_number(2.0 * std::numbers::pi * n / (beads * spacing)),
        frequency(2.0 * std::sqrt(stiffness / mass) * std::sin(std::numbers::pi * n / beads)) {
    for (int i = 0; i < beads; ++i) base.push_back(std::polar(1.0, -wave_number * rest_position(i) - n));
  }
  static double rest_position(int bead) { return (bead + 0.5) * spacing; }
  [[nodiscard]] double displacement(std::size_t i) const { return amplitude * base[i].real(); }
  [[nodiscard]] double velocity(std::size_t i) const { return -amplitude * frequency * base[i].imag(); }
  [[nodiscard]] double half_step_angle(double time_step) const { return 0.5 * frequency * time_step; }

  /// Projects the displacements on the wave and counts on by the angle since the last call, which must be less than pi.
  void follow(const std::vector<double>& displacements) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < base.size(); ++i) sum += displacements[i] * base[i];
    angle += std::remainder(-std::arg(sum) - angle, 2.0 * std::numbers::pi);
  }
};

struct State {
  double energy = 0.0, shadow_energy = 0.0;  // [J]
  double momentum = 0.0;                     // [kg m/s]
};

template <class Scene>
std::vector<double> displacements(const Scene& ring) {
  std::vector<double> result;
  for (const auto& x : ring.template group<Beads>().positions())
    result.push_back(x[0] - Wave::rest_position(static_cast<int>(result.size())));
  return result;
}

/// The leapfrog does not keep the energy H of a chain, but H - (dt^2/8) sum of F^2/m, and that exactly.
template <class Scene>
State observe(const Scene& ring, double time_step) {
  const auto u = displacements(ring);
  const auto& v = ring.template group<Beads>().template get<field::Velocity>();
  State state;
  for (std::size_t i = 0, count = u.size(); i < count; ++i) {
    const double ahead = u[(i + 1) % count] - u[i], behind = u[i] - u[(i + count - 1) % count];
    state.energy += 0.5 * mass * square(v[i][0]) + spring.energy(bond::Stretch<double>{spacing + ahead, spacing});
    state.shadow_energy -= square(stiffness * (ahead - behind) * time_step) / (8.0 * mass);
    state.momentum += mass * v[i][0];
  }
  state.shadow_energy += state.energy;
  return state;
}

int run(const example::Options& options) {
  const int beads = options.size == example::Size::quick ? 64 : options.size == example::Size::normal ? 256 : 1024;
  // The time is that of so many steps at a tenth of the largest stable one. Waves are looked at often enough to see them turn, the last
  // time at the end.
  const double fraction = options.safety > 0.0 ? options.safety : own_fraction;
  const double steps_between_looks = std::max(1.0, std::floor(0.8 / fraction + 1e-9));
  const double looks = (options.size == example::Size::quick ? 1e5 : 1e6) * own_fraction / (fraction * steps_between_looks);
  const double steps = steps_between_looks * std::ceil(looks - 1e-9);
  const io::OutputFolder folder(options.output);

  // Ring at rest, closed through the periodic face
  geometry::Points<1> points{.positions = {}, .spacing = spacing};
  std::vector<neighbours::Bond> chain;
  for (int i = 0; i < beads; ++i) {
    points.positions.emplace_back(Wave::rest_position(i));
    chain.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>((i + 1) % beads), spacing});
  }
  auto ring =
      scene<example::Integrator<integrator::Leapfrog>>(geometry::Box<1>{.lower = {0.0}, .upper = {beads * spacing}, .periodic = {true}},
                                                       group<Beads>("beads", Mobile{}, points, mass), bonds<Beads, Beads>(spring, chain));

  // Waves, from as long as the ring to almost as short as two beads
  std::vector<Wave> waves;
  for (const int number : {1, beads / 32, beads / 16, beads / 8, beads / 4, 3 * beads / 8, 7 * beads / 16})
    waves.emplace_back(number, beads);
  for (std::size_t i = 0; i < points.positions.size(); ++i)
    for (const Wave& wave : waves) {
      ring.group<Beads>().positions()[i][0] += wave.displacement(i);
      ring.group<Beads>().get<field::Velocity>()[i][0] += wave.velocity(i);
    }

  // Observation
  const double time_step = fraction * ring.step_limit().time_step, end = steps * time_step;
  const State start = observe(ring, time_step);
  State largest;  // deviations
  io::CsvTable energies(folder / "energy.csv",
                        {{"time", "s"}, {"energy, relative change", "-"}, {"shadow energy, relative change", "-"}, {"momentum", "kg m/s"}});
  ring.every(steps_between_looks * time_step, [&](const auto& scene) {
    const auto u = displacements(scene);
    for (Wave& wave : waves) wave.follow(u);
  });
  ring.every(end / 2000.0, [&](const auto& scene) {
    const State state = observe(scene, time_step);
    const State change{state.energy / start.energy - 1.0, state.shadow_energy / start.shadow_energy - 1.0, state.momentum};
    energies.row({scene.time(), change.energy, change.shadow_energy, change.momentum});
    largest.energy = std::max(largest.energy, std::fabs(change.energy));
    largest.shadow_energy = std::max(largest.shadow_energy, std::fabs(change.shadow_energy));
    largest.momentum = std::max(largest.momentum, std::fabs(change.momentum));
  });
  ring.every(end / 20.0, VtkOutput(folder, "oscillator_chain"));
  ring.rescue_to((folder / "last_good.checkpoint").string()).progress();

  // Run
  example::Result result{
      .example = "oscillator_chain", .test_case = "waves on a ring of springs", .resolution = std::to_string(beads) + " beads, 7 waves"};
  result.add(ring.run({.until = end, .time_step = time_step}));
  result.describe(ring);

  // Frequencies: the error of the leapfrog is (omega dt)^2/24 to leading order. A wave that starts with the velocity of the exact chain
  // carries (omega dt/4)^2 of a wave that runs backwards, by which its angle is uncertain.
  io::CsvTable table(
      folder / "dispersion.csv",
      {{"wavelengths on the ring", "-"}, {"q a", "rad"}, {"frequency", "rad/s"}, {"exact chain", "rad/s"}, {"leapfrog", "rad/s"}});
  for (const Wave& wave : waves) {
    const double half = wave.half_step_angle(time_step), measured = wave.angle / end, leapfrog = 2.0 * std::asin(half) / time_step;
    table.row({static_cast<double>(wave.number), wave.wave_number * spacing, measured, wave.frequency, leapfrog});
    const std::string of = "frequency of wave " + std::to_string(wave.number) + ", relative to ";
    result.error(of + "the chain's", measured / wave.frequency - 1.0, 1.01 * square(half) / 6.0,
                 "omega = 2 sqrt(k/m) sin(q a/2); error (omega dt)^2/24");
    result.error(of + "the leapfrog's", measured / leapfrog - 1.0, (1.05 * square(half) / 4.0 + 1e-9) / wave.angle,
                 "sin(Omega dt/2) = omega dt/2");
  }
  const double half = fraction;  // omega dt/2 of the shortest wave a chain can carry
  result.error("energy, largest relative change", largest.energy, square(square(half)) / (2.0 * (1.0 - square(half))),
               "the waver of the leapfrog, (omega dt/2)^4/2");
  result.error("shadow energy, largest relative change", largest.shadow_energy, std::sqrt(steps) * rounding * beads * spacing / amplitude,
               "invariant; rounding of positions");
  result.error("momentum, of that of one wave", largest.momentum / (beads * mass * amplitude * 2.0 * std::sqrt(stiffness / mass)),
               steps * rounding, "action = reaction; rounding of velocities");

  io::plot(folder, "oscillator_chain",
           "set datafile separator ','\nset multiplot layout 1, 2\nset xlabel 'q a [rad]'\nset xrange [0:pi]\nset key top left\n"
           "set ylabel 'omega / sqrt(k/m)'\nplot 2*sin(x/2) with lines lw 2 title '2 sin(q a/2)', "
           "'dispersion.csv' using 2:($3/" + to_text(std::sqrt(stiffness / mass)) + ") skip 1 with points pt 7 ps 2 title 'dmp'\n"
           "set ylabel 'frequency error, relative'\nset logscale y\nset format y '10^{%T}'\n"
           "plot (" + to_text(2.0 * fraction) + "*sin(x/2))**2/24 with lines lw 2 title '(omega dt)^2/24', "
           "'dispersion.csv' using 2:($3/$4 - 1) skip 1 with points pt 7 ps 2 title 'dmp'\nunset multiplot");
  return result.print(folder);
}

}  // namespace

int main(int argc, char** argv) {
  return example::guarded("oscillator_chain", run,
                          example::options(argc, argv, "oscillator_chain",
                                           "Waves on a ring of masses and springs: frequencies against the exact dispersion relation, "
                                           "energy over a million steps.",
                                           {.safety = true}));
}
