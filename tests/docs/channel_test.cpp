// docs/compose-a-scene.md, first part: flow between two plates.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <doctest/doctest.h>
#include <dmp/dmp.hpp>

#include "io/temporary_folder.hpp"

namespace channel_program {

// doc: channel
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <dmp/dmp.hpp>

using namespace dmp;
using namespace dmp::simulation;

struct Water {};
struct Plates {};

int main() {
  // Physics
  const double gap = 1e-3, length = 1e-3;                   // between the plates, and along them [m]
  const double density = 1000.0, dynamic_viscosity = 0.01;  // [kg/m^3], [Pa s]
  const double top_speed = 0.01;                            // wanted in the middle [m/s]
  const double drive = 8.0 * dynamic_viscosity * top_speed / (density * gap * gap);  // [m/s^2]

  // Places. Rows of particles lie at y = 0, spacing, 2 spacing, ...; the first row of a plate lies on its surface, where the liquid stands still.
  const double spacing = gap / 16.0, support_radius = 2.6 * spacing;
  const geometry::Box<2> box{.lower = {0.0, -2.5 * spacing}, .upper = {length, gap + 2.5 * spacing}, .periodic = {true, false}};
  const geometry::Cubic<2> lattice{.spacing = spacing, .origin = {0.0, 0.5 * spacing}};
  const geometry::Cuboid<2> everywhere{.lower = box.lower, .upper = box.upper};
  const geometry::Cuboid<2> between{.lower = {0.0, 0.5 * spacing}, .upper = {length, gap - 0.5 * spacing}};
  const auto water_points = geometry::fill(lattice, between);
  const auto plate_points = geometry::fill(lattice, everywhere, everywhere - between);
  const double mass = density * water_points.volume;  // of one particle [kg per metre of depth]

  // Laws
  const sph::WeaklyCompressible<kernel::Lucy<2>, viscosity::Morris<>> flow{.kernel = {.support_radius = support_radius}};
  const eos::Tait tait{.rest_density = density, .sound_speed_0 = 10.0 * top_speed};
  const rheology::Constant newtonian{.dynamic_viscosity = dynamic_viscosity};
  const forcing::Constant<2> push{.uniform_acceleration = {{{drive, 0.0}}}};

  // Scene
  auto channel = scene<integrator::ExtrapolatedVerlet>(
      box,
      group<Water>("water", particles::Mobile{}, water_points, mass),
      group<Plates>("plates", particles::Frozen<2>{}, plate_points, mass),
      interaction<Water, Water>(flow),
      interaction<Water, Plates>(flow),
      material<Water, Plates>(tait, newtonian),
      forced_by<Water>(push));
  channel.group<Water>().set<field::Density>([&](const Vector<2>&) { return density; });
  channel.group<Plates>().set<field::Density>([&](const Vector<2>&) { return density; });
  std::fputs(describe(channel).c_str(), stdout);

  // Observation
  const auto fastest = [&channel] {
    double speed = 0.0;
    for (const Vector<2>& v : channel.group<Water>().get<field::Velocity>()) speed = std::max(speed, v[0]);
    return speed;
  };
  const io::OutputFolder folder("output/channel");
  io::CsvTable table(folder / "channel.csv", {{"time", "s"}, {"fastest", "m/s"}});
  channel.every(1e-3, [&](auto&) { table.row({channel.time(), fastest()}); });
  channel.every(1e-2, VtkOutput(folder, "channel"));
  channel.rescue_to((folder / "last_good.checkpoint").string()).progress();

  // Run
  const RunReport report = channel.run({.until = 0.07});
  std::printf("%llu steps, the last of %g s, bound by %s\n", static_cast<unsigned long long>(report.steps), report.time_step, report.limit.bound_by.c_str());
  std::printf("fastest %g m/s, exact %g m/s\n", fastest(), top_speed);
  return std::fabs(fastest() / top_speed - 1.0) < 0.05 ? 0 : 1;
}
// end

}  // namespace channel_program

TEST_CASE("the channel of docs/compose-a-scene.md reaches its speed and leaves what the page says that it leaves") {
  const test::TemporaryFolder folder;
  const auto here = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  CHECK(channel_program::main() == 0);
  std::filesystem::current_path(here);
  for (const char* file : {"channel.csv", "channel.pvd", "water_0000.vtp", "water_0007.vtp", "plates_0007.vtp"}) {
    CAPTURE(file);
    CHECK(std::filesystem::exists(folder / "output" / "channel" / file));
  }
}
