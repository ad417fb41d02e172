// docs/compose-a-scene.md, second part: an elastic disc in the channel, carried by sub-stepped bonds; checkpoint, restart, options of a run.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/dmp.hpp>

#include "io/temporary_folder.hpp"

namespace elastic_body_program {

using namespace dmp;
using namespace dmp::simulation;

struct Water {};
struct Plates {};
// doc: body-tag
struct Body {};
// end

// doc: body-bonds
/// Bonds between all points closer than `reach` [m].
std::vector<neighbours::Bond> bonds_within(const geometry::Points<2>& points, double reach) {
  neighbours::CellGrid<2> grid;
  grid.build(points.positions, reach);
  std::vector<neighbours::Bond> bonds;
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < points.positions.size(); ++i) {
    found.clear();
    grid.find(points.positions[i], reach, i, found);
    for (const std::uint32_t j : found)
      if (i < j) bonds.push_back({.i = i, .j = j});
  }
  return bonds;
}
// end

struct Outcome {
  double time, speed, drift, strain;  // [s]; of the disc: mean speed [m/s], way along the channel [m], largest strain of a bond [-]
};

Outcome run(double until) {
  const double gap = 1e-3, length = 1e-3, density = 1000.0, dynamic_viscosity = 0.01, top_speed = 0.01;
  const double drive = 8.0 * dynamic_viscosity * top_speed / (density * gap * gap);
  const double spacing = gap / 16.0, support_radius = 2.6 * spacing;
  const geometry::Box<2> box{.lower = {0.0, -2.5 * spacing}, .upper = {length, gap + 2.5 * spacing}, .periodic = {true, false}};
  const geometry::Cubic<2> lattice{.spacing = spacing, .origin = {0.0, 0.5 * spacing}};
  const geometry::Cuboid<2> everywhere{.lower = box.lower, .upper = box.upper};
  const geometry::Cuboid<2> between{.lower = {0.0, 0.5 * spacing}, .upper = {length, gap - 0.5 * spacing}};
  const auto plate_points = geometry::fill(lattice, everywhere, everywhere - between);
  // doc: body-points
  const geometry::Ball<2> disc{.centre = {0.5 * length, 0.5 * gap}, .radius = 0.2 * gap};
  const auto water_points = geometry::fill(lattice, between, between - disc);
  const auto body_points = geometry::fill(lattice, between, disc);
  const auto body_bonds = bonds_within(body_points, 1.5 * spacing);  // edges and diagonals of the square lattice
  // end
  const double mass = density * water_points.volume;
  const sph::WeaklyCompressible<kernel::Lucy<2>, viscosity::Morris<>> flow{.kernel = {.support_radius = support_radius}};
  const eos::Tait tait{.rest_density = density, .sound_speed_0 = 10.0 * top_speed};
  const rheology::Constant newtonian{.dynamic_viscosity = dynamic_viscosity};
  const forcing::Constant<2> push{.uniform_acceleration = {{{drive, 0.0}}}};

  // doc: body-scene
  const bond::Harmonic spring{.stiffness = 2500.0};  // [N/m per metre of depth]
  const potential::LennardJones contact{.energy_scale = 1e-10, .diameter = 0.89 * spacing, .cutoff = spacing};  // repulsion alone

  auto channel = scene<integrator::ExtrapolatedVerlet>(
      box,
      group<Water>("water", particles::Mobile{}, water_points, mass),
      group<Plates>("plates", particles::Frozen<2>{}, plate_points, mass),
      group<Body>("body", particles::Mobile{}, body_points, mass),
      interaction<Water, Water>(flow),
      interaction<Water, Plates>(flow),
      interaction<Water, Body>(flow, contact),
      interaction<Body, Plates>(contact),
      interaction<Body, Body>(contact).excluding_bonded(2),
      substepped_bonds<Body, Body>(spring, body_bonds),
      material<Water, Plates, Body>(tait, newtonian),
      forced_by<Water, Body>(push));
  channel.group<Body>().set<field::Density>([&](const Vector<2>&) { return density; });
  // end
  channel.group<Water>().set<field::Density>([&](const Vector<2>&) { return density; });
  channel.group<Plates>().set<field::Density>([&](const Vector<2>&) { return density; });

  // doc: body-observer
  io::OutputFolder folder("output/body");
  io::CsvTable table(folder / "body.csv", {{"time", "s"}, {"speed", "m/s"}});
  channel.every(1e-3, [&](auto&) {
    Vector<2> sum = Vector<2>::Zero();
    for (const Vector<2>& v : channel.group<Body>().get<field::Velocity>()) sum += v;
    table.row({channel.time(), sum[0] / static_cast<double>(channel.group<Body>().size())});
  });
  // end

  // doc: restart
  const std::string saved = (folder / "saved.checkpoint").string();
  if (std::filesystem::exists(saved)) channel.restart(saved);
  // end
  const double from = channel.time();

  // doc: options
  const sweep::StepLimit limit = channel.step_limit();  // of the present state; sub-stepped bonds do not count
  std::printf("%g s bound by %s; unstable beyond %g s (%s)\n", limit.time_step, limit.bound_by.c_str(), limit.stable_time_step,
              limit.stability_bound_by.c_str());
  const RunReport report = channel.run({.until = until, .time_step = 1e-4, .check_every = 50});
  // end
  CHECK(limit.bound_by.find("bond") == std::string::npos);
  CHECK(report.steps == static_cast<std::uint64_t>(std::lround((until - from) / 1e-4)));

  // doc: checkpoint
  channel.checkpoint(saved);
  // end

  Outcome outcome{channel.time(), 0.0, 0.0, 0.0};
  const auto& body = channel.group<Body>();
  for (std::size_t k = 0; k < body.size(); ++k) {
    outcome.speed += body.get<field::Velocity>()[k][0] / static_cast<double>(body.size());
    outcome.drift += (body.positions()[k] - body_points.positions[k])[0] / static_cast<double>(body.size());
  }
  for (const auto& bond : body_bonds) {
    const double rest = (body_points.positions[bond.i] - body_points.positions[bond.j]).norm();
    outcome.strain = std::max(outcome.strain, std::fabs((body.positions()[bond.i] - body.positions()[bond.j]).norm() / rest - 1.0));
  }
  return outcome;
}

}  // namespace elastic_body_program

TEST_CASE("the elastic disc of docs/compose-a-scene.md goes with the flow, holds together, and goes on after a restart") {
  const int threads = dmp::available_threads();
  // doc: threads
  dmp::use_threads(2);
  // end
  const test::TemporaryFolder folder;
  const auto here = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  const auto first = elastic_body_program::run(0.01), second = elastic_body_program::run(0.03);
  std::filesystem::current_path(here);
  dmp::use_threads(threads);
  CHECK(second.time == doctest::Approx(0.03).epsilon(1e-6));
  CHECK(second.speed > first.speed);
  CHECK(second.speed > 0.006);
  CHECK(second.speed < 0.0105);
  CHECK(second.drift > first.drift);
  CHECK(second.drift < 0.03 * 0.01);
  CHECK(second.strain < 0.01);
}
