// The scenes of the LAMMPS inputs in this folder, composed with dmp: same particles, laws, support, skin, time step and integrator, so that
// both codes compute the same thing and only their time and memory differ. compare.py runs the two side by side.
// One run prints one line, `result: {...}`, a JSON object; the warm-up steps and the first lists are not in its times.
#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <dmp/dmp.hpp>
#include <fstream>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using namespace dmp;
using namespace dmp::simulation;
using geometry::Cuboid, geometry::Points;
using particles::Mobile, particles::Stationary;

struct Water {};
struct Wall {};
struct Bead {};

namespace {

struct Options {
  std::string scene;
  int n = 0, w = 0;            // particles along a side and, in the dam break, across the width; 0: as in the LAMMPS input
  int steps = 200, warm = 50;  // timed, and before these
  double skin = -1.0;          // in units of the support radius; negative: as in the LAMMPS input
  double rate = 1.0;           // of the starting collapse [1/s]
};

constexpr std::string_view usage =
    "lammps_scenes --scene dam3d|tg2d|springs3d|membrane [options]\n"
    "The scene of the LAMMPS input in.<scene>, composed with dmp. Prints times, memory and result figures as one line of JSON.\n"
    "  --n N        particles along a side; dam3d (even): along the height of the column   (24, tg2d 100, springs3d 22; not for membrane)\n"
    "  --w N        dam3d: particles across the width                                      (32)\n"
    "  --steps N    steps that are timed                                                   (200)\n"
    "  --warm N     steps before these                                                     (50)\n"
    "  --skin X     skin of the lists in units of the support radius; not for springs3d    (0.1; membrane 0.3)\n"
    "  --rate X     dam3d: the column starts with the velocity X (x, 0, -z) [1/s]          (1)\n"
    "  --help       this text\n"
    "Threads: OMP_NUM_THREADS.\n";

/// Reads a number that must fill the whole of `text`.
template <class Number>
Number number(std::string_view option, std::string_view text, Number least) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value >= least))
    throw ParameterError(std::string(option) + " must be a number >= " + to_text(static_cast<double>(least)) + ", got '" +
                         std::string(text) + "'");
  return value;
}

Options read_options(const std::vector<std::string_view>& arguments) {
  Options options;
  for (std::size_t k = 0; k < arguments.size(); k += 2) {
    const std::string_view option = arguments[k];
    if (k + 1 == arguments.size()) throw ParameterError(std::string(option) + " must be followed by a value; see --help");
    const std::string_view value = arguments[k + 1];
    if (option == "--scene") options.scene = value;
    else if (option == "--n") options.n = number(option, value, 4);
    else if (option == "--w") options.w = number(option, value, 4);
    else if (option == "--steps") options.steps = number(option, value, 1);
    else if (option == "--warm") options.warm = number(option, value, 0);
    else if (option == "--skin") options.skin = number(option, value, 0.0);
    else if (option == "--rate") options.rate = number(option, value, 0.0);
    else throw ParameterError("no such option: " + std::string(option) + "; see --help");
  }
  return options;
}

// ---- What is measured ---------------------------------------------------------------------------------------------------------------

/// Processor time [ns] of all threads of this process.
double processor_time() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}
/// The most memory [bytes] that this process has had resident so far.
double resident_peak() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024.0 * std::stod(line.substr(6));
  throw std::runtime_error("/proc/self/status holds no VmHWM");
}

using Figures = std::vector<std::pair<std::string, double>>;

struct Measured {
  std::size_t particles;
  std::uint64_t list_builds;         // during the timed steps
  double processor_time, wall_time;  // of the timed steps [ns]
  double bytes;                      // growth of the peak of resident memory since the start of the program
  Figures figures;
};

/// Memory that the program has before it makes a scene.
const double resident_at_start = resident_peak();

/// Warm-up and timed steps, each of exactly `time_step` [s]; then `figures(scene)`.
template <class Scene, class GetFigures>
Measured measure(Scene& scene, double time_step, const Options& options, GetFigures figures) {
  scene.run({.until = options.warm * time_step, .time_step = time_step});
  const std::uint64_t builds = scene.engine().list_builds();
  const double processor_start = processor_time();
  const auto start = std::chrono::steady_clock::now();
  const RunReport report = scene.run({.until = (options.warm + options.steps) * time_step, .time_step = time_step});
  const auto end = std::chrono::steady_clock::now();
  const double processor_end = processor_time();
  if (report.steps != static_cast<std::uint64_t>(options.steps))
    throw std::logic_error("took " + std::to_string(report.steps) + " steps instead of " + std::to_string(options.steps));
  return {scene.particles(), scene.engine().list_builds() - builds, processor_end - processor_start,
          std::chrono::duration<double, std::nano>(end - start).count(), resident_peak() - resident_at_start, figures(scene)};
}

// ---- Result figures, by the same formulas as in the LAMMPS inputs -------------------------------------------------------------------

template <class Group>
double maximum_speed(const Group& group) {
  double square = 0.0;
  for (const auto& v : group.template get<field::Velocity>()) square = std::max(square, v.squaredNorm());
  return std::sqrt(square);
}
template <class Group>
double kinetic_energy(const Group& group) {
  double sum = 0.0;
  for (const auto& v : group.template get<field::Velocity>()) sum += v.squaredNorm();
  return 0.5 * group.mass * sum;
}
template <class Group>
double largest_density(const Group& group) {
  const auto& densities = group.template get<field::Density>();
  return *std::max_element(densities.begin(), densities.end());
}
/// Integral of p/rho^2 over rho, times the mass, for Tait's exponent 7.
template <class Group>
double elastic_energy(const Group& group, const eos::Tait& tait) {
  double sum = 0.0;
  for (const double density : group.template get<field::Density>()) {
    const double x = density / tait.rest_density;
    sum += power(x, 6.0) / 6.0 + 1.0 / x - 7.0 / 6.0;
  }
  return group.mass * tait.stiffness() / tait.rest_density * sum;
}

// ---- Scenes -------------------------------------------------------------------------------------------------------------------------

/// A column of water collapses in a tank that is periodic across its width.
Measured dam_break(const Options& options) {
  const int n = options.n > 0 ? options.n : 24, w = options.w > 0 ? options.w : 32;
  require(n % 2 == 0, "dam3d: --n must be even, so that the walls end between two layers of particles", n);
  const double density = 1000.0, gravity = 9.81, sound_speed = 10.0 * std::sqrt(2.0 * gravity * 1.0);
  const double spacing = 1.0 / n, support_radius = 2.4 * spacing, time_step = 0.1 * support_radius / sound_speed;
  const double mass = density * spacing * spacing * spacing, width = w * spacing, walls = 3.0 * spacing;

  const geometry::Box<3> box{.lower = {-walls, 0.0, -walls}, .upper = {2.0 + walls, width, 2.0}, .periodic = {false, true, false}};
  const geometry::Cubic<3> lattice{.spacing = spacing};
  const Cuboid<3> column{.lower = {0.0, 0.0, 0.0}, .upper = {1.0, width, 1.0}};
  const Cuboid<3> inside{.lower = {0.0, 0.0, 0.0}, .upper = {2.0, width, 2.0}};
  const Cuboid<3> below{.lower = box.lower, .upper = {2.0 + walls, width, 1.5}};

  const eos::Tait tait{.rest_density = density, .sound_speed_0 = sound_speed};
  const sph::WeaklyCompressible<kernel::Lucy<3>, viscosity::Artificial> flow{.kernel = {.support_radius = support_radius},
                                                                             .viscosity = {.alpha = 0.1, .sound_speed = sound_speed}};
  const forcing::Constant<3> weight{.uniform_acceleration = {{{0.0, 0.0, -gravity}}}};
  auto dam = scene<integrator::LammpsVerlet>(box, group<Water>("water", Mobile{}, geometry::fill(lattice, column), mass),
                                             group<Wall>("wall", Stationary{}, geometry::fill(lattice, below, below - inside), mass),
                                             interaction<Water, Water>(flow), interaction<Water, Wall>(flow), material<Water, Wall>(tait),
                                             forced_by<Water>(weight));
  dam.set_skin((options.skin < 0.0 ? 0.1 : options.skin) * support_radius);
  auto& water = dam.group<Water>();
  water.set<field::Density>([&](const Vector<3>& x) { return tait.density(density * gravity * (1.0 - x[2])); });
  water.set<field::Velocity>([&](const Vector<3>& x) { return Vector<3>(options.rate * x[0], 0.0, -options.rate * x[2]); });

  return measure(dam, time_step, options, [&](const auto& scene) -> Figures {
    const auto& liquid = scene.template group<Water>();
    const auto& wall = scene.template group<Wall>();
    double height = 0.0, front = 0.0;
    for (const Vector<3>& x : liquid.positions()) {
      height += x[2];
      front = std::max(front, x[0]);
    }
    const double kinetic = kinetic_energy(liquid), elastic = elastic_energy(liquid, tait) + elastic_energy(wall, tait);
    return {{"maximum_speed", maximum_speed(liquid)},
            {"kinetic_energy", kinetic},
            {"total_energy", kinetic + mass * gravity * height + elastic},
            {"largest_density", std::max(largest_density(liquid), largest_density(wall))},
            {"front", front}};
  });
}

/// Periodic vortices at Re = 100.
Measured taylor_green(const Options& options) {
  const int n = options.n > 0 ? options.n : 100;
  const double density = 1.0, sound_speed = 10.0, dynamic_viscosity = 0.01, pi = std::numbers::pi;
  const double spacing = 1.0 / n, support_radius = 2.6 * spacing, time_step = 0.1 * support_radius / sound_speed;
  const double mass = density * spacing * spacing;

  const geometry::Box<2> box{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {true, true}};
  const geometry::Cubic<2> lattice{.spacing = spacing};
  const eos::Tait tait{.rest_density = density, .sound_speed_0 = sound_speed};
  const sph::WeaklyCompressible<kernel::Lucy<2>, viscosity::Morris<>> flow{.kernel = {.support_radius = support_radius}};
  auto vortices = scene<integrator::LammpsVerlet>(
      box, group<Water>("fluid", Mobile{}, geometry::fill(lattice, {.lower = box.lower, .upper = box.upper}), mass),
      interaction<Water, Water>(flow), material<Water>(tait, rheology::Constant{.dynamic_viscosity = dynamic_viscosity}));
  vortices.set_skin((options.skin < 0.0 ? 0.1 : options.skin) * support_radius);
  vortices.group<Water>().set<field::Velocity>([pi](const Vector<2>& x) {
    return Vector<2>(std::sin(2.0 * pi * x[0]) * std::cos(2.0 * pi * x[1]), -std::cos(2.0 * pi * x[0]) * std::sin(2.0 * pi * x[1]));
  });

  return measure(vortices, time_step, options, [&](const auto& scene) -> Figures {
    const auto& fluid = scene.template group<Water>();
    return {{"maximum_speed", maximum_speed(fluid)},
            {"kinetic_energy", kinetic_energy(fluid)},
            {"total_energy", kinetic_energy(fluid) + elastic_energy(fluid, tait)},
            {"largest_density", largest_density(fluid)}};
  });
}

/// Bonds of the cubic lattice of n^3 points as `fill` numbers them, x running fastest; each once, across periodic faces too.
std::vector<neighbours::Bond> lattice_bonds(int n) {
  constexpr std::array<std::array<int, 3>, 9> directions{
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}}};
  const auto row = [n](int x, int y, int z) {
    const auto wrapped = [n](int k) { return static_cast<std::uint32_t>((k + n) % n); };
    return wrapped(x) + static_cast<std::uint32_t>(n) * (wrapped(y) + static_cast<std::uint32_t>(n) * wrapped(z));
  };
  std::vector<neighbours::Bond> bonds;
  bonds.reserve(directions.size() * static_cast<std::size_t>(n) * static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x)
        for (const auto& d : directions) {
          const bool edge = d[0] * d[0] + d[1] * d[1] + d[2] * d[2] == 1;  // the diagonals are half as stiff
          bonds.push_back({row(x, y, z), row(x + d[0], y + d[1], z + d[2]), edge ? 1.0 : std::numbers::sqrt2, edge ? 1.0 : 0.5});
        }
  return bonds;
}

/// Beads and springs, 18 springs to a bead; no pair forces, so neither lists nor a skin.
Measured springs(const Options& options) {
  const int n = options.n > 0 ? options.n : 22;
  const double size = n, time_step = 0.005;
  const bond::Harmonic spring{.stiffness = 200.0};  // K = 100 and 50 of LAMMPS' K (r - r0)^2
  const geometry::Box<3> box{.lower = {0.0, 0.0, 0.0}, .upper = {size, size, size}, .periodic = {true, true, true}};
  auto beads = geometry::fill(geometry::Cubic<3>{.spacing = 1.0}, {.lower = box.lower, .upper = box.upper});
  auto lattice =
      scene<integrator::Leapfrog>(box, group<Bead>("beads", Mobile{}, std::move(beads), 1.0), bonds<Bead, Bead>(spring, lattice_bonds(n)));
  lattice.group<Bead>().set<field::Velocity>([k = 8.0 * std::numbers::pi / size](const Vector<3>& x) {
    return Vector<3>(0.1 * std::sin(k * (x[0] + x[1])), 0.1 * std::cos(k * (x[1] + x[2])), 0.1 * std::sin(k * (x[2] + x[0])));
  });

  return measure(lattice, time_step, options, [&](const auto& scene) -> Figures {
    const auto& group = scene.template group<Bead>();
    double elastic = 0.0;
    for (const auto& link : lattice_bonds(n)) {
      const double length = neighbours::minimum_image<3>(group.positions()[link.i] - group.positions()[link.j], box).norm();
      elastic += link.weight * spring.energy(bond::Stretch<double>{.length = length, .rest_length = link.rest_length});
    }
    return {{"maximum_speed", maximum_speed(group)},
            {"kinetic_energy", kinetic_energy(group)},
            {"bond_energy", elastic},
            {"total_energy", kinetic_energy(group) + elastic}};
  });
}

/// The tube and the membrane of examples/membrane.cpp, case DMP-A.
/// The one difference: `fix viscous` of LAMMPS damps v(t + dt/2), forcing::Drag the extrapolated velocity that all laws see here. With
/// `-var drag extrapolated` in.membrane shows LAMMPS that velocity too, and then all figures agree to rounding.
Measured membrane(const Options& options) {
  const double time_step = 1e-5, spacing = 1.11111e-4, bead_spacing = spacing / 10.0, mass = 1.23457e-5, support_radius = 1.66667e-4;
  const auto block = [spacing](int first_column, int last_column, int first_row, int last_row) {
    return geometry::fill(geometry::Cubic<2>{.spacing = spacing}, {.lower = {first_column * spacing, first_row * spacing},
                                                                   .upper = {(last_column + 1) * spacing, (last_row + 1) * spacing}});
  };
  Points<2> wall = geometry::merge(geometry::merge(block(-2, 44, -2, -1), block(-2, 44, 9, 10)), block(-2, -1, 0, 8));
  wall.spacing = bead_spacing;  // the two anchors, the end beads of the chain, stand that close to the membrane
  const auto first_anchor = static_cast<std::uint32_t>(wall.positions.size());
  const auto chain = geometry::line<2>({45.5 * spacing, -0.5 * spacing}, {45.5 * spacing, 9.5 * spacing}, bead_spacing).positions;
  wall.positions.push_back(chain.front());
  wall.positions.push_back(chain.back());
  Points<2> beads{.positions = {chain.begin() + 1, chain.end() - 1}, .spacing = bead_spacing, .volume = 0.0};
  const auto count = static_cast<std::uint32_t>(beads.positions.size());
  std::vector<neighbours::Bond> links;
  for (std::uint32_t bead = 0; bead + 1 < count; ++bead) links.push_back({bead, bead + 1, bead_spacing});
  const std::vector<neighbours::Bond> anchors{{0, first_anchor, bead_spacing}, {count - 1, first_anchor + 1, bead_spacing}};

  const sph::WeaklyCompressible<kernel::Lucy<2>, viscosity::Morris<>> flow{.kernel = {.support_radius = support_radius}};
  const double cutoff = (1.0 - 1e-6) * spacing;  // were it the spacing, rounding would decide which pairs of the lattice repel at the start
  const potential::LennardJones padding{.energy_scale = 1e-12, .diameter = spacing, .cutoff = cutoff};
  const potential::LennardJones barrier{.energy_scale = 1e-10, .diameter = spacing, .cutoff = cutoff};
  const potential::LennardJones between_beads{.energy_scale = 1e-10, .diameter = 0.5 * bead_spacing, .cutoff = cutoff};
  const bond::Harmonic spring{.stiffness = 200.0};  // K = 100 of LAMMPS' K (r - r0)^2
  const forcing::Constant<2> push{.uniform_acceleration = {{{5e-5 / mass, 0.0}}}};
  const forcing::Drag drag{.coefficient = 0.01};

  const geometry::Box<2> box{
      .lower = {-5.0 * spacing, -40.0 * spacing}, .upper = {105.0 * spacing, 49.0 * spacing}, .periodic = {true, true}};
  auto balloon = scene<integrator::LammpsVerlet>(
      box, group<Water>("liquid", Mobile{}, block(0, 44, 0, 8), mass), group<Wall>("wall", Stationary{}, std::move(wall), mass),
      group<Bead>("membrane", Mobile{}, std::move(beads), 0.1 * mass), interaction<Water, Water>(flow, padding),
      interaction<Water, Wall>(flow, padding), interaction<Water, Bead>(flow, barrier),
      interaction<Wall, Bead>(padding).excluding_bonded(3), interaction<Bead, Bead>(between_beads).excluding_bonded(3),
      bonds<Bead, Bead>(spring, links), bonds<Bead, Wall>(spring, anchors),
      material<Water, Wall, Bead>(eos::Tait{.rest_density = 1000.0, .sound_speed_0 = 0.1}, rheology::Constant{.dynamic_viscosity = 1e-3}),
      forced_by<Water>(push), forced_by<Water, Bead>(drag));
  balloon.set_skin((options.skin < 0.0 ? 0.3 : options.skin) * support_radius);

  return measure(balloon, time_step, options, [](const auto& scene) -> Figures {
    const auto& positions = scene.template group<Bead>().positions();
    Vector<2> mean = Vector<2>::Zero();
    for (const Vector<2>& x : positions) mean += x / static_cast<double>(positions.size());
    double square = 0.0, tip = -std::numeric_limits<double>::infinity();
    for (const Vector<2>& x : positions) {
      square += (x - mean).squaredNorm() / static_cast<double>(positions.size());
      tip = std::max(tip, x[0]);
    }
    double densities = 0.0;
    const auto add = [&densities](const auto& group) {
      for (const double density : group.template get<field::Density>()) densities += density;
    };
    add(scene.template group<Water>());
    add(scene.template group<Wall>());
    add(scene.template group<Bead>());
    return {{"mean_x_of_beads", mean[0]},
            {"mean_y_of_beads", mean[1]},
            {"radius_of_beads", std::sqrt(square)},
            {"tip", tip},
            {"mean_density", densities / static_cast<double>(scene.particles())},
            {"maximum_speed", maximum_speed(scene.template group<Water>())}};
  });
}

void print(const Options& options, const Measured& measured) {
  const double particle_steps = static_cast<double>(measured.particles) * options.steps;
  std::printf("result: {\"scene\": \"%s\", \"particles\": %zu, \"steps\": %d, \"threads\": %d, \"list_builds\": %llu, ",
              options.scene.c_str(), measured.particles, options.steps, available_threads(),
              static_cast<unsigned long long>(measured.list_builds));
  std::printf("\"processor_ns\": %.6g, \"wall_ns\": %.6g, \"bytes_per_particle\": %.6g, \"figures\": {",
              measured.processor_time / particle_steps, measured.wall_time / particle_steps,
              measured.bytes / static_cast<double>(measured.particles));
  const char* separator = "";
  for (const auto& [name, value] : measured.figures) {
    std::printf("%s\"%s\": %.17g", separator, name.c_str(), value);
    separator = ", ";
  }
  std::printf("}}\n");
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string_view> arguments(argv + 1, argv + argc);
  if (std::find(arguments.begin(), arguments.end(), "--help") != arguments.end()) {
    std::printf("%s", usage.data());
    return 0;
  }
  try {
    const Options options = read_options(arguments);
    if (options.scene == "dam3d") print(options, dam_break(options));
    else if (options.scene == "tg2d") print(options, taylor_green(options));
    else if (options.scene == "springs3d") print(options, springs(options));
    else if (options.scene == "membrane") print(options, membrane(options));
    else throw ParameterError("--scene must be dam3d, tg2d, springs3d or membrane, got '" + options.scene + "'; see --help");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lammps_scenes: %s\n", error.what());
    return 2;
  }
  return 0;
}
