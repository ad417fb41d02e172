// Checkpoints of a scene that cannot be trusted are refused, and the scene that was to be restarted stays as it was; so does a scene whose
// checkpoint cannot be written.
#include <bit>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>
#include <doctest/doctest.h>

#include "io/temporary_folder.hpp"
#include "scenes.hpp"

using namespace test;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Four beads on springs that also repel each other.
template <class Integrator = integrator::Leapfrog>
auto beads(double stretch = 1.0, std::size_t count = 4, const std::string& name = "beads") {
  geometry::Points<2> points{.positions = {{0.1, 0.1}, {0.2 * stretch, 0.1}, {0.2, 0.2}, {0.1, 0.2}}};
  points.positions.resize(count);
  const geometry::Box<2> box{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {true, false}};
  return scene<Integrator>(box, group<Solid>(name, Mobile{}, points, 1e-3),
                           bonds<Solid, Solid>(bond::Harmonic{.stiffness = 1.0}, {{0, 1}, {1, 2}}),
                           interaction<Solid, Solid>(potential::LennardJones{.energy_scale = 1e-6, .diameter = 0.1, .cutoff = 0.12}));
}

/// Everything of a scene, bit for bit.
template <class Scene>
std::string all_of(Scene& scene) {
  std::string bytes;
  const auto add = [&bytes](const auto& values) { bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes()); };
  for (const auto& group : views_of(scene.engine())) {
    for (const auto& column : group.columns) add(column.values);
    add(group.id);
  }
  return bytes + to_text(scene.time()) + " " + std::to_string(scene.step());
}

/// A scene that has run, in a folder with a checkpoint of another one that has run longer.
struct Restart {
  TemporaryFolder folder;
  std::string path = (folder / "beads.checkpoint").string(), start = "io::checkpoint: '" + path + "': ";
  decltype(beads()) scene = beads(1.1), later = beads(1.2);
  std::string before, checkpoint;

  Restart() {
    scene.run({.until = 0.02});
    later.run({.until = 0.05});
    later.checkpoint(path);
    before = all_of(scene);
    checkpoint = read_bytes(path);
  }
  /// What restarting from these bytes says; the scene must stay as it was.
  std::string refusal(const std::string& bytes) {
    write_bytes(path, bytes);
    const std::string text = error_of<io::CheckpointError>([this] { scene.restart(path); });
    CHECK(all_of(scene) == before);
    return text;
  }
};

/// The same checkpoint with something done to the values of one section, and with all CRCs right.
template <class T>
std::string rewritten(Restart& restart, const std::string& section, const std::function<void(std::vector<T>&)>& change) {
  write_bytes(restart.path, restart.checkpoint);
  const std::string signature = restart.scene.signature();
  const io::CheckpointReader reader(restart.path, signature);
  io::CheckpointWriter writer(restart.path, signature);
  const auto copy = [&]<class Element>(const std::string& name, std::type_identity<Element>) {
    auto values = reader.read<Element>(name);
    if constexpr (std::is_same_v<Element, T>)
      if (name == section) change(values);
    writer.add(name, values);
  };
  copy("clock.times", std::type_identity<double>{});
  copy("clock.steps", std::type_identity<std::uint64_t>{});
  for (const char* name : {"beads.position", "beads.velocity", "beads.acceleration"}) copy(name, std::type_identity<double>{});
  copy("beads.id", std::type_identity<std::uint32_t>{});
  writer.commit();
  return read_bytes(restart.path);
}

}  // namespace

TEST_CASE("restart: a whole checkpoint changes everything to what it was") {
  Restart restart;
  write_bytes(restart.path, restart.checkpoint);
  restart.scene.restart(restart.path);
  CHECK(all_of(restart.scene) == all_of(restart.later));
  CHECK(all_of(restart.scene) != restart.before);
  write_bytes(restart.path, rewritten<double>(restart, "", [](auto&) {}));
  CHECK(read_bytes(restart.path) == restart.checkpoint);
}

TEST_CASE("restart: cut off after any byte, or with any bit flipped, a checkpoint is refused, and the scene stays as it was") {
  Restart restart;
  for (std::size_t length = 0; length < restart.checkpoint.size(); ++length) {
    CAPTURE(length);
    CHECK(restart.refusal(restart.checkpoint.substr(0, length)) ==
          restart.start + "truncated or damaged: ends after " + std::to_string(length) + " bytes");
  }
  for (std::size_t bit = 0; bit < 8 * restart.checkpoint.size(); ++bit) {
    std::string damaged = restart.checkpoint;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    CAPTURE(bit);
    CHECK(restart.refusal(damaged).starts_with(restart.start));
  }
  restart.scene.run({.until = 0.03});  // and it goes on as if nothing had been
  auto undisturbed = beads(1.1);
  undisturbed.run({.until = 0.02});
  undisturbed.run({.until = 0.03});
  CHECK(all_of(restart.scene) == all_of(undisturbed));
}

TEST_CASE("restart: a checkpoint of another integrator, group or number of particles is refused, and the scene stays as it was") {
  Restart restart;
  const auto of = [&](auto other) {
    other.checkpoint(restart.path);
    return restart.refusal(read_bytes(restart.path));
  };
  const std::string another = restart.start + "is the checkpoint of another scene: its signature is '";
  CHECK(of(beads<integrator::SymplecticEuler>()).starts_with(another + "2D, symplectic Euler, double; beads (mobile): position velocity"));
  CHECK(of(beads(1.0, 4, "pearls")).starts_with(another + "2D, leapfrog, double; pearls (mobile): "));
  CHECK(of(beads(1.0, 3)) == restart.start + "section beads.position must hold 8 numbers, got 6");
  CHECK(of(vortex({.columns = 8})).starts_with(another + "2D, extrapolated-velocity Verlet, double; water (mobile): "));
  CHECK(restart.refusal("") == restart.start + "truncated or damaged: ends after 0 bytes");
  CHECK(restart.refusal("GROMACS checkpoint") == restart.start + "is not a checkpoint");
}

TEST_CASE("restart: values that cannot be are refused where all CRCs are right too, and the scene stays as it was") {
  Restart restart;
  const auto with = [&](const std::string& section, std::size_t at, double value) {
    return restart.refusal(rewritten<double>(restart, section, [=](auto& values) { values.at(at) = value; }));
  };
  CHECK(with("beads.position", 3, not_a_number) == restart.start + "group beads, particle 1: position must be finite, got nan");
  CHECK(with("beads.velocity", 0, -std::numeric_limits<double>::infinity()) ==
        restart.start + "group beads, particle 0: velocity must be finite, got -inf");
  CHECK(with("clock.times", 0, not_a_number) == restart.start + "clock.times must be finite, got nan");
  CHECK(with("clock.times", 1, -1e-3) == restart.start + "the time step must be >= 0, got -0.001");
  CHECK(restart.refusal(rewritten<std::uint64_t>(restart, "clock.steps", [](auto& values) {
          values = {10, 11, 1, 0};
        })) == restart.start + "the step at which the time step was chosen must be <= 10, got 11");
  CHECK(restart.refusal(rewritten<std::uint64_t>(restart, "clock.steps", [](auto& values) { values.pop_back(); })) ==
        restart.start + "section clock.steps must hold 4 numbers, got 3");
  CHECK(restart.refusal(rewritten<std::uint32_t>(restart, "beads.id", [](auto& values) { values.push_back(4); })) ==
        restart.start + "section beads.id must hold 4 numbers, got 5");
}

TEST_CASE("restart: a particle far away, or outside the box, is found when the run begins") {
  Restart restart;
  for (const double far : {1e300, -1e300, 1e18, 2.0}) {
    write_bytes(restart.path, rewritten<double>(restart, "beads.position", [far](auto& values) { values.at(3) = far; }));
    restart.scene.restart(restart.path);
    CHECK(error_of<SimulationError>([&] { restart.scene.run({.until = 0.1}); })
              .starts_with("dmp: a value must lie in the box at t = " + to_text(restart.later.time())));
  }
}

TEST_CASE("checkpoint: on a full disk it is an error, the former one stays, and the run goes on with the same bits") {
  const TemporaryFolder folder;
  const std::string path = (folder / "beads.checkpoint").string();
  auto scene = beads(1.1), lucky = beads(1.1);
  lucky.checkpoint(path);
  const std::string former = read_bytes(path);
  scene.run({.until = 0.02});
  lucky.run({.until = 0.02});
  const auto complaint = [&] {
    const SmallDisk disk(former.size() - 1);
    return error_of<io::CheckpointError>([&] { scene.checkpoint(path); });
  }();
  CHECK(complaint == "io::checkpoint: '" + path + "': io: cannot write '" + path + ".part': File too large");
  CHECK(read_bytes(path) == former);
  lucky.checkpoint(path);
  scene.run({.until = 0.04});
  lucky.run({.until = 0.04});
  CHECK(all_of(scene) == all_of(lucky));
}

TEST_CASE("rescue: where the last good state cannot be written, the error tells that beside what went wrong") {
  const TemporaryFolder folder;
  auto scene = beads(1.1);
  scene.rescue_to((folder / "missing/last_good.checkpoint").string());
  scene.every(0.01, [](auto& s) {
    if (s.time() > 0.005) s.template group<Solid>().template get<field::Velocity>()[2][1] = not_a_number;
  });
  const std::string complaint = error_of<SimulationError>([&] { scene.run({.until = 0.1, .time_step = 1e-3, .check_every = 1}); });
  CHECK(complaint.starts_with("dmp: a value must be finite at t = 0.011 s, step 11, group beads, particle 2, position = nan; and the last "
                              "good state could not be written: io::checkpoint: '"));
}
