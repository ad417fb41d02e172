#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <dmp/io/output_folder.hpp>
#include <dmp/simulation/describe.hpp>

#include "support/options.hpp"

namespace example {

/// What a run is worth: its errors against what is known, its cost (0 where not measured), and the law that bound its time step.
///   Result result{.example = "poiseuille", .test_case = "VISC-1"};
///   result.error("L2 of the velocity profile", error, 0.55 / rows, "series solution");
///   result.add(scene.run({.until = 1.0}));
///   result.describe(scene);
///   return result.print(folder);
struct Result {
  struct Error {
    std::string name;
    double value, bound;
    std::string reference;
  };
  std::string example{}, test_case{}, resolution{};
  std::size_t particles = 0;  // of the largest scene, and its bytes per particle
  std::uint64_t steps = 0;
  double wall_seconds = 0.0, processor_seconds = 0.0, particle_steps = 0.0, bytes_per_particle = 0.0;
  std::string step_bound_by{};
  std::vector<Error> errors{};

  /// Notes that |value| should be <= bound, and where the reference comes from.
  void error(std::string_view name, double value, double bound, std::string_view reference);

  /// Adds what a run (RunReport) took.
  template <class Report>
  void add(const Report& report) {
    steps += report.steps;
    wall_seconds += report.wall_seconds;
    processor_seconds += report.processor_seconds;
    particle_steps += report.particle_steps;
    step_bound_by = report.step_bound_by;
  }
  /// Notes what a scene holds after a run, and prints what it consists of; of scenes of one type, the first.
  template <class Scene>
  void describe(Scene& scene) {
    if (scene.particles() >= particles) {
      particles = scene.particles();
      bytes_per_particle = dmp::simulation::bytes_per_particle(scene);
    }
    static bool described = false;
    if (!std::exchange(described, true)) std::fputs(dmp::simulation::describe(scene).c_str(), stdout);
  }
  [[nodiscard]] bool holds() const;

  /// Prints the errors as a table and the line "result: {...}", one JSON object, which also goes into `folder`/result.json. The exit
  /// status: 0 when every bound holds, else 1.
  [[nodiscard]] int print(const dmp::io::OutputFolder& folder) const;
};

/// Runs `function` and turns what it throws into a message and exit status 2: the last line of every example's main.
[[nodiscard]] int guarded(const char* name, int (*function)(const Options&), const Options& options);

}  // namespace example
