#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/simulation/relax.hpp>

namespace dmp::simulation {

struct StepsOptions {
  Required<double> until;         ///< [s] as forcings and driven groups see it, > from
  Required<double> largest_step;  ///< [s] of their time between two states of rest, > 0
  double from = 0.0;              ///< [s], >= 0, where the scene is at rest
  int most_halvings = 6;          ///< of a step, >= 0; 0: folds are counted only
  RelaxOptions relax;             ///< to each state of rest; its time is not looked at
};
struct StepsReport {
  std::uint64_t evaluations = 0;  ///< of the forces, those of steps taken back among them
  std::size_t steps = 0;          ///< states of rest kept
  std::size_t halvings = 0;       ///< steps taken back
  std::size_t folded = 0;         ///< what folded() counts at the end
};

/// Brings a scene from rest at `from` to rest at `until`, by states of rest in between while plates and driven groups move on. folded()
/// counts what a step must not add to: beads whose layers have been pushed through each other,
///   relax_in_steps(scene, options, [&] { return folded_beads<3>(body.bonds, start, scene.group<Beads>().positions()).size(); });
/// If it finds more than before, the step is taken back and done in two halves, and each of these likewise. A smallest step that folds
/// beads all the same is kept: there the body gives way. guess(from, to) may move particles before each step, e.g. by a uniform strain.
/// Throws as relax does, the particles being where the last state of rest has them, and ParameterError.
template <class Scene, class Folded, class Guess>
StepsReport relax_in_steps(Scene& scene, const StepsOptions& options, const Folded& folded, const Guess& guess) {
  require_not_negative("relax_in_steps: from", options.from, "s");
  require(options.until > options.from && options.until < std::numeric_limits<double>::infinity(),
          "relax_in_steps: until must be finite and > from [s]", options.until);
  require_positive("relax_in_steps: largest_step", options.largest_step, "s");
  require(options.most_halvings >= 0, "relax_in_steps: most_halvings must be >= 0", options.most_halvings);
  using Positions = std::vector<Vector<Scene::dimension>>;
  std::vector<Positions> kept;  // of each group, by id: rows may change
  const auto for_each_position = [&](const auto& function) {
    std::size_t index = 0;
    scene.engine().for_each_group([&](auto& g) {
      if (kept.size() == index) kept.emplace_back(g.size());
      for (std::size_t i = 0; i < g.size(); ++i) function(g.positions()[i], kept[index][g.id[i]]);
      ++index;
    });
  };
  StepsReport report{.folded = folded()};
  const auto advance = [&](const auto& self, double from, double to, int halvings) -> void {
    for_each_position([](const auto& present, auto& before) { before = present; });
    guess(from, to);
    RelaxOptions relaxing = options.relax;
    relaxing.time = to;
    try {
      report.evaluations += relax(scene, relaxing).evaluations;
    } catch (...) {
      for_each_position([](auto& present, const auto& before) { present = before; });
      throw;
    }
    const std::size_t found = folded();
    const double middle = 0.5 * (from + to);
    if (found > report.folded && halvings < options.most_halvings && from < middle && middle < to) {
      for_each_position([](auto& present, const auto& before) { present = before; });
      ++report.halvings;
      self(self, from, middle, halvings + 1);
      self(self, middle, to, halvings + 1);
      return;
    }
    report.folded = found;
    ++report.steps;
  };
  const double way = options.until - options.from;
  const double steps = std::fmax(1.0, std::ceil(way / options.largest_step - 1e-9)), step = way / steps;
  for (double n = 0.0; n < steps; ++n)
    advance(advance, options.from + n * step, n + 1.0 < steps ? options.from + (n + 1.0) * step : static_cast<double>(options.until), 0);
  return report;
}
template <class Scene, class Folded>
StepsReport relax_in_steps(Scene& scene, const StepsOptions& options, const Folded& folded) {
  return relax_in_steps(scene, options, folded, [](double, double) {});
}

}  // namespace dmp::simulation
