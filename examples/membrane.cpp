// A liquid pushed down a tube that an elastic membrane closes: the membrane inflates like a balloon (14 s; 1 s with --quick).
// SPH liquid (Tait, Morris viscosity), a chain of springs, and Lennard-Jones repulsion between the two: a coupled scene whose groups
// share nothing but what is declared. Case DMP-A; A. Albano et al., ChemEngineering 5 (2021) 30, doi:10.3390/chemengineering5020030,
// appendix A, on a closed geometry; the reference values were run with LAMMPS on this geometry.
#include <array>
#include <cstdlib>
#include <dmp/dmp.hpp>

#include "support/choices.hpp"
#include "support/options.hpp"
#include "support/result.hpp"

using namespace dmp;
using namespace dmp::simulation;
using geometry::Points;
using particles::Mobile, particles::Stationary;

struct Liquid {};
struct Wall {};
struct Membrane {};

namespace {

constexpr double spacing = 1.11111e-4;                 // of the liquid [m]
constexpr double bead_spacing = spacing / 10.0;        // of the membrane [m]
constexpr double mass = 1.23457e-5;                    // liquid and wall [kg per metre of depth]; a membrane bead has a tenth
constexpr double density = 1000.0, sound_speed = 0.1;  // [kg/m^3], [m/s]
constexpr double support_radius = 1.66667e-4;          // [m]

struct Geometry {
  Points<2> liquid, wall, membrane;
  std::vector<neighbours::Bond> chain, anchors;
};

Points<2> block(int first_column, int last_column, int first_row, int last_row) {
  Points<2> points{.positions = {}, .spacing = spacing, .volume = spacing * spacing};
  for (int row = first_row; row <= last_row; ++row)
    for (int column = first_column; column <= last_column; ++column)
      points.positions.emplace_back((column + 0.5) * spacing, (row + 0.5) * spacing);
  return points;
}

Geometry tube_with_membrane() {
  Geometry result;
  result.liquid = block(0, 44, 0, 8);
  result.wall = geometry::merge(geometry::merge(block(-2, 44, -2, -1), block(-2, 44, 9, 10)), block(-2, -1, 0, 8));
  result.wall.spacing = bead_spacing;  // the two anchors, the end beads of the chain, stand that close to the membrane
  const auto first_anchor = static_cast<std::uint32_t>(result.wall.positions.size());
  Points<2> chain = geometry::line<2>({45.5 * spacing, -0.5 * spacing}, {45.5 * spacing, 9.5 * spacing}, bead_spacing);
  result.wall.positions.push_back(chain.positions.front());
  result.wall.positions.push_back(chain.positions.back());
  result.membrane = {
      .positions = {chain.positions.begin() + 1, chain.positions.end() - 1}, .spacing = bead_spacing, .volume = chain.volume};
  const auto beads = static_cast<std::uint32_t>(result.membrane.positions.size());
  for (std::uint32_t bead = 0; bead + 1 < beads; ++bead) result.chain.push_back({bead, bead + 1, bead_spacing});
  result.anchors = {{0, first_anchor, bead_spacing}, {beads - 1, first_anchor + 1, bead_spacing}};
  return result;
}

/// What LAMMPS gives on this geometry at dt = 1e-6 s.
struct Reference {
  double time, mean_density, tip;  // [s], [kg/m^3] over all particles, [m]
};
constexpr std::array<Reference, 6> references{{{0.1, 1034.23, 5.3119e-3}, {0.2, 1061.64, 5.6576e-3}, {0.5, 1113.80, 6.3136e-3},
                                               {1.0, 1138.52, 6.9972e-3}, {2.0, 1153.18, 7.6287e-3}, {2.5, 1153.44, 7.7115e-3}}};

struct State {
  double tip = 0.0, mean_density = 0.0, fastest = 0.0;
  int leaked = 0;
};

template <class Scene>
State observe(const Scene& scene) {
  const auto& liquid = scene.template group<Liquid>();
  const auto& wall = scene.template group<Wall>();
  const auto& membrane = scene.template group<Membrane>();
  State state;
  for (const auto& x : membrane.positions()) state.tip = std::max(state.tip, x[0]);
  double sum = 0.0;
  for (const auto* densities :
       {&liquid.template get<field::Density>(), &wall.template get<field::Density>(), &membrane.template get<field::Density>()})
    for (const double rho : *densities) sum += rho;
  state.mean_density = sum / static_cast<double>(scene.particles());
  for (const auto& v : liquid.template get<field::Velocity>()) state.fastest = std::max(state.fastest, v[0]);
  for (const auto& x : liquid.positions()) {  // beyond the membrane: further right than every bead within a spacing in height
    double right = 0.0;
    for (const auto& bead : membrane.positions())
      if (std::abs(bead[1] - x[1]) < spacing) right = std::max(right, bead[0]);
    if (x[0] > std::max(right, 45.5 * spacing)) ++state.leaked;
  }
  return state;
}

int run(const example::Options& options) {
  const double end = options.size == example::Size::quick ? 0.2 : 2.5;  // [s]
  const io::OutputFolder folder(options.output);
  const Geometry tube = tube_with_membrane();

  // Laws
  const sph::WeaklyCompressible<kernel::Lucy<2>, viscosity::Morris<>> flow{.kernel = {.support_radius = support_radius}};
  const potential::LennardJones padding{.energy_scale = 1e-12, .diameter = spacing, .cutoff = spacing};
  const potential::LennardJones barrier{.energy_scale = 1e-10, .diameter = spacing, .cutoff = spacing};
  const potential::LennardJones between_beads{.energy_scale = 1e-10, .diameter = 0.5 * bead_spacing, .cutoff = spacing};
  const bond::Harmonic spring{.stiffness = 200.0};  // K = 100 of the script's K (r - r0)^2
  const forcing::Constant<2> push{.uniform_acceleration = {{{5e-5 / mass, 0.0}}}};
  const forcing::Drag drag{.coefficient = 0.01};

  // Scene
  const geometry::Box<2> box{
      .lower = {-5.0 * spacing, -40.0 * spacing}, .upper = {105.0 * spacing, 49.0 * spacing}, .periodic = {true, true}};
  auto balloon = scene<integrator::ExtrapolatedVerlet>(
      box, group<Liquid>("liquid", Mobile{}, tube.liquid, mass), group<Wall>("wall", Stationary{}, tube.wall, mass),
      group<Membrane>("membrane", Mobile{}, tube.membrane, 0.1 * mass), interaction<Liquid, Liquid>(flow, padding),
      interaction<Liquid, Wall>(flow, padding), interaction<Liquid, Membrane>(flow, barrier),
      interaction<Wall, Membrane>(padding).excluding_bonded(3), interaction<Membrane, Membrane>(between_beads).excluding_bonded(3),
      bonds<Membrane, Membrane>(spring, tube.chain), bonds<Membrane, Wall>(spring, tube.anchors),
      material<Liquid, Wall, Membrane>(eos::Tait{.rest_density = density, .sound_speed_0 = sound_speed},
                                       rheology::Constant{.dynamic_viscosity = 1e-3}),
      forced_by<Liquid>(push), forced_by<Liquid, Membrane>(drag));

  // Observation
  example::Result result{.example = "membrane", .test_case = "DMP-A", .resolution = "9 particles across the tube, 100 bonds"};
  io::CsvTable table(folder / "membrane.csv",
                     {{"time", "s"}, {"tip", "mm"}, {"mean density", "kg/m^3"}, {"fastest", "m/s"}, {"leaked", "-"}});
  std::size_t next = 0;
  int leaked = 0;
  balloon.every(0.01, [&](const auto& scene) {
    const State state = observe(scene);
    table.row({scene.time(), 1e3 * state.tip, state.mean_density, state.fastest, static_cast<double>(state.leaked)});
    leaked = std::max(leaked, state.leaked);
    if (next == references.size() || scene.time() < references[next].time - 0.005) return;
    const Reference& reference = references[next++];
    const std::string at = " at " + to_text(reference.time) + " s";
    result.error("tip" + at + ", relative", state.tip / reference.tip - 1.0, 0.005, "LAMMPS 29 Sep 2021, dt = 1e-6 s");
    result.error("mean density" + at + ", relative", state.mean_density / reference.mean_density - 1.0, 0.003,
                 "LAMMPS 29 Sep 2021, dt = 1e-6 s");
    if (reference.time == 0.1)
      result.error("fastest liquid at 0.1 s, relative", state.fastest / 5.1e-3 - 1.0, 0.02, "LAMMPS 29 Sep 2021, dt = 1e-6 s");
  });
  balloon.every(end / 50.0, VtkOutput(folder, "membrane"));
  balloon.rescue_to((folder / "last_good.checkpoint").string()).progress();

  // Run
  result.add(balloon.run(example::until(end, 1e-5, options)));
  result.describe(balloon);
  result.error("particles that passed the membrane", leaked, 0.0, "impermeable");

  io::CsvTable shape(folder / "particles.csv", {{"group", "-"}, {"x", "mm"}, {"y", "mm"}, {"density", "kg/m^3"}});
  double number = 0.0;
  balloon.engine().for_each_group([&](const auto& g) {
    for (std::size_t i = 0; i < g.size(); ++i)
      shape.row({number, 1e3 * g.positions()[i][0], 1e3 * g.positions()[i][1], g.template get<field::Density>()[i]});
    number += 1.0;
  });
  std::string lammps;
  for (const Reference& reference : references) lammps += to_text(reference.time) + " " + to_text(1e3 * reference.tip) + "\n";
  io::plot(folder, "membrane",
           "$lammps << EOD\n" + lammps + "EOD\n"
           "set datafile separator ','\nset multiplot layout 2,1\nset size ratio -1\nset xlabel 'x [mm]'\nset ylabel 'y [mm]'\n"
           "set cblabel 'density [kg/m^3]'\nset key off\nset title 'liquid, wall and membrane at the end of the run'\n"
           "plot 'particles.csv' using ($1==1?$2:1/0):3 skip 1 with points pt 5 ps 0.7 lc rgb 'gray60', "
           "'' using ($1==0?$2:1/0):3:4 skip 1 with points pt 7 ps 0.8 lc palette, "
           "'' using ($1==2?$2:1/0):3 skip 1 with lines lw 3 lc rgb 'black'\n"
           "set size noratio\nset title 'tip of the membrane'\nset xlabel 't [s]'\nset ylabel 'x [mm]'\nset key bottom right\n"
           "set datafile separator whitespace\nplot $lammps using 1:2 with points pt 6 ps 2 title 'LAMMPS', "
           "\"<sed 's/,/ /g' membrane.csv\" using 1:2 skip 1 with lines lw 2 title 'dmp'\nunset multiplot");
  return result.print(folder);
}

}  // namespace

int main(int argc, char** argv) {
  return example::guarded(
      "membrane", run,
      example::options(argc, argv, "membrane", "Liquid pushed against an elastic membrane (case DMP-A), compared with LAMMPS.",
                       {.safety = true}));
}
