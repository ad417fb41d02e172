#pragma once
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <dmp/core/simulation_error.hpp>
#include <dmp/simulation/engine.hpp>
#include <dmp/simulation/limits.hpp>
#include <dmp/simulation/progress.hpp>
#include <dmp/simulation/state.hpp>
#include <dmp/sweep/step_limit.hpp>

namespace dmp::simulation {

/// How far to run, and with which step.
struct RunOptions {
  Required<double> until;           ///< end of the run [s]
  double time_step = 0.0;           ///< [s]; 0: from the laws' bounds, reconsidered every 10 steps, with a viscosity of the shear rate every step
  double safety = 0.9;              ///< fraction of the smallest bound that is taken when time_step is 0; 0 < safety <= 1
  std::uint64_t check_every = 100;  ///< steps between two checks of all values (finite, in the box)
};

/// What a run did.
struct RunReport {
  std::uint64_t steps = 0;      ///< of this run
  double wall_seconds = 0.0;    ///< observers included
  double particle_steps = 0.0;  ///< particles that evolve, times steps
  double time_step = 0.0;       ///< the last one [s]
  sweep::StepLimit limit;       ///< smallest bound met, and the law that set it
  std::string step_bound_by;    ///< what set the step: a law, or the user within the bound of a law
};

/// A composed simulation: groups, what they do to each other, an integrator, and what looks on. Made by `scene(...)`.
template <int Dim, class Integrator, class Precision, class... Item>
class Scene {
 public:
  static constexpr int dimension = Dim;

  explicit Scene(const geometry::Box<Dim>& box, const Item&... item) : engine_(box, item...) {}

  template <class Tag>
  [[nodiscard]] auto& group() noexcept {
    return engine_.template group<Tag>();
  }
  template <class Tag>
  [[nodiscard]] const auto& group() const noexcept {
    return engine_.template group<Tag>();
  }
  [[nodiscard]] Engine<Dim, Integrator, Precision, Item...>& engine() noexcept { return engine_; }
  [[nodiscard]] const Engine<Dim, Integrator, Precision, Item...>& engine() const noexcept { return engine_; }
  [[nodiscard]] double time() const noexcept { return clock_.time; }         ///< [s]
  [[nodiscard]] std::uint64_t step() const noexcept { return clock_.step; }  ///< since the very start, restarts included
  [[nodiscard]] std::size_t particles() const {
    std::size_t count = 0;
    engine_.for_each_group([&count](const auto& g) { count += g.size(); });
    return count;
  }

  /// Margin [m] by which neighbour lists reach beyond the cut-off, so that they last several steps; 0.2 of the largest cut-off unless set.
  Scene& set_skin(double skin) {
    require_not_negative("scene: skin", skin, "m");
    engine_.set_skin(skin);
    if (prepared_) engine_.build_lists(true);
    return *this;
  }
  /// Calls observer(scene) at the start of the run and then every `interval` [s], at the step nearest to each multiple.
  template <class Observer>
  Scene& every(double interval, Observer observer) {
    require_positive("scene: interval of an observer", interval, "s");
    observers_.push_back({interval, [observer = std::move(observer)](Scene& scene) mutable { observer(scene); }});
    return *this;
  }
  /// Shows a bar with the time left on standard error, when that is a terminal.
  Scene& progress() {
    shows_progress_ = true;
    return *this;
  }
  /// Where the last good state is left when a run goes wrong; without it nothing is written.
  Scene& rescue_to(std::string path) {
    rescue_path_ = std::move(path);
    return *this;
  }

  /// Every law's bound of the time step for the present state; the smallest one, and whose it is.
  [[nodiscard]] sweep::StepLimit step_limit() {
    prepare();
    return find_step_limit<Integrator>(engine_, clock_.time, has_substeps);
  }

  RunReport run(const RunOptions& options) {
    require(options.until >= clock_.time - 0.5 * clock_.time_step && options.until < std::numeric_limits<double>::infinity(),
            "scene: run until must be finite and not before the present time [s]", options.until);
    require_not_negative("scene: time_step", options.time_step, "s");
    require(options.safety > 0.0 && options.safety <= 1.0, "scene: safety must be > 0 and <= 1", options.safety);
    require(options.check_every > 0, "scene: check_every must be > 0", static_cast<double>(options.check_every));
    const auto start = std::chrono::steady_clock::now();
    RunReport report;
    try {
      prepare();
      report.limit = find_step_limit<Integrator>(engine_, clock_.time, has_substeps);
      const double first_step = options.time_step > 0.0 ? options.time_step : options.safety * report.limit.time_step;
      if (!(first_step < std::numeric_limits<double>::infinity()))
        throw ParameterError("scene: no law of this scene bounds the time step; give one as time_step");
      if (first_step > report.limit.stable_time_step)
        throw ParameterError("scene: time_step must be <= " + to_text(report.limit.stable_time_step) + " s, the bound of " +
                             report.limit.stability_bound_by + ", got " + to_text(first_step));
      const bool goes_on = options.time_step == 0.0 && clock_.automatic == 1 && clock_.time_step <= report.limit.stable_time_step;
      if (!goes_on) choose_step(first_step);
      clock_.automatic = options.time_step == 0.0 ? 1 : 0;
      engine_.refresh_frozen();
      check();
      check_materials(0.0);
      take_snapshot();
      Progress bar(shows_progress_, clock_.time, options.until);
      observe();
      const auto goes_further = [&] { return clock_.time < options.until - 0.5 * clock_.time_step; };
      bool begun = false, worn = false;
      while (begun || goes_further()) {
        if (!begun) {
          if (options.time_step == 0.0 && clock_.step % steps_between_choices == 0) {
            const auto limit = find_step_limit<Integrator>(engine_, clock_.time, has_substeps);
            if (limit.time_step < report.limit.time_step) report.limit = limit;
            if (!(limit.time_step < std::numeric_limits<double>::infinity()))
              throw SimulationError("no law of this scene bounds the time step any more; give one as time_step",
                                    {clock_.time, clock_.step, "", -1, "", 0.0});
            choose_step(options.safety * limit.time_step);
            if (!(clock_.time_step > 1e-6 * first_step))
              throw SimulationError("the time step collapsed (bound of " + limit.bound_by + ")",
                                    {clock_.time, clock_.step, "", -1, "time_step", clock_.time_step});
          }
          clock_.tick();
          worn = engine_.begin_step(clock_.time_step, clock_.time);
        }
        if (engine_.has_refused()) check_materials(clock_.time_step);
        if (worn) {
          check();
          engine_.build_lists(false);
        }
        engine_.prepare_forces(clock_.time_step, clock_.step, worn);
        if (engine_.has_refused()) check_materials(clock_.time_step);  // of what has been summed over neighbours, or sub-stepped
        engine_.forces(clock_.time_step, clock_.time);
        if (!engine_.dashpots_converged())
          throw SimulationError("the dashpots of implicit_bonds have not been solved for: conjugate gradients did not converge",
                                {clock_.time, clock_.step, "", -1, "", 0.0});
        ++report.steps;
        // Where nobody looks at the state between two steps, the end of one and the beginning of the next are one pass.
        const bool checks = clock_.step % options.check_every == 0, chooses = (options.time_step == 0.0 || bounds_jump) && clock_.step % steps_between_choices == 0;
        begun = !checks && !chooses && !observes() && goes_further();
        if (begun) {
          clock_.tick();
          worn = engine_.go_on(clock_.time_step, clock_.time_step, clock_.time);
          continue;
        }
        engine_.end_step(clock_.time_step);
        if (checks) {
          check();
          check_materials(0.0);
          take_snapshot();
        }
        if (options.time_step > 0.0 && (checks || chooses)) check_step(report.limit);
        observe();
        bar.show(clock_.time);
      }
      check();
      check_materials(0.0);
      report.time_step = clock_.time_step;
      report.step_bound_by = options.time_step == 0.0
                                 ? report.limit.bound_by
                                 : "given, " + to_text(std::round(100.0 * clock_.time_step / report.limit.stable_time_step)) +
                                       " % of the bound of " + report.limit.stability_bound_by;
    } catch (const SimulationError& error) {
      rescue(error);
      throw;
    }
    std::size_t evolving = 0;
    engine_.for_each_group([&evolving](const auto& g) {
      if (std::remove_cvref_t<decltype(g)>::Mobility::evolves) evolving += g.size();
    });
    report.particle_steps = static_cast<double>(evolving) * static_cast<double>(report.steps);
    report.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return report;
  }

  /// What a summed law finds now at each particle of a group, row by row, e.g. the density of the particles around, to be compared with
  /// the density of the continuity equation: find_sums<Water>(sph::DensitySum<K>{...})[i].density.
  template <class Tag, class Law>
  [[nodiscard]] auto find_sums(const Law& law) {
    prepare();
    return engine_.template find_sums<Tag>(law);
  }

  /// Writes everything that a bit-exact continuation needs. Also rebuilds the lists, so that this run and the restarted one go on alike.
  void checkpoint(const std::string& path) {
    prepare();
    engine_.build_lists(true);
    write_checkpoint(path, signature(), views(), clock_);
  }
  /// Continues from a checkpoint of the same composition and the same particle numbers.
  void restart(const std::string& path) {
    clock_ = read_checkpoint(path, signature(), views());
    for (auto& observer : observers_) observer.done = due(observer);
    engine_.build_lists(true);
    if (clock_.step == 0) engine_.start_afresh();
    if constexpr (has_substeps)
      if (clock_.time_step > 0.0) engine_.set_substeps(substeps_for<Integrator>(engine_, clock_.time_step));
    prepared_ = true;
  }
  /// What a checkpoint must agree with: dimension, integrator, precision, groups, mobilities, columns.
  [[nodiscard]] std::string signature() {
    return simulation::signature(Dim, std::string(Integrator::name) + ", " + std::string(Precision::name), views());
  }

 private:
  /// A viscosity of the shear rate may rise severalfold within a few steps, and the bound of the step falls with it.
  static constexpr bool bounds_jump = [] {
    return ([] {
      if constexpr (is_summed<Item>) return contains<field::ShearRate, typename decltype(Item::law)::sets>;
      return false;
    }() || ...);
  }();
  static constexpr std::uint64_t steps_between_choices = bounds_jump ? 1 : 10;
  static constexpr bool has_substeps = Engine<Dim, Integrator, Precision, Item...>::has_substeps;
  struct Observer {
    double interval;
    std::function<void(Scene&)> call;
    std::int64_t done = -1;  // multiples of the interval observed so far
  };

  void prepare() {
    if (prepared_) return;
    check_input();
    engine_.evaluate(clock_.time, clock_.step);
    check_materials_at_start();
    if (clock_.step == 0) reject_overlaps();
    prepared_ = true;
  }

  void choose_step(double dt) {
    clock_.choose(dt);
    if constexpr (has_substeps) engine_.set_substeps(substeps_for<Integrator>(engine_, dt));
  }
  /// Multiples of the observer's interval that have passed.
  [[nodiscard]] std::int64_t due(const Observer& observer) const {
    return static_cast<std::int64_t>(std::floor((clock_.time + 0.5 * clock_.time_step) / observer.interval));
  }
  /// Whether an observer wants to see the present state.
  [[nodiscard]] bool observes() const {
    for (const auto& observer : observers_)
      if (due(observer) > observer.done) return true;
    return false;
  }
  void observe() {
    for (auto& observer : observers_) {
      const std::int64_t now = due(observer);
      if (now <= observer.done) continue;
      observer.done = now;
      observer.call(*this);
    }
  }

  /// Particles closer than half their spacing at the start are a fill done twice, or two fills that overlap.
  void reject_overlaps() const {
    engine_.for_each_item([&](const auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_interaction<I>) {
        reject_overlap(engine_.template group<typename I::A>(), engine_.template group<typename I::B>(), active.of_a);
        if constexpr (!std::is_same_v<typename I::A, typename I::B>)
          reject_overlap(engine_.template group<typename I::B>(), engine_.template group<typename I::A>(), active.of_b);
      }
    });
  }
  template <class A, class B>
  void reject_overlap(const A& a, const B& b, const neighbours::PairList& pairs) const {
    const double least = 0.5 * std::min(a.spacing, b.spacing);
    if constexpr (A::Mobility::evolves)
      for (std::size_t block = 0; block < a.blocks.size(); ++block)
        for (std::size_t i = a.blocks.begin(block); i < a.blocks.end(block); ++i) {
          for (const std::uint32_t row : pairs.of(block, i)) {
            if (row >= b.size() && row < b.first_ghost()) continue;  // fills up the pack
            const std::size_t j = b.sources(false).original(row);
            const double distance = neighbours::minimum_image<Dim>(a.positions()[i] - b.positions()[j], engine_.box()).norm();
            if (distance < least)
              throw ParameterError("scene: particles must not overlap at the start: " + a.name + " " + std::to_string(a.id[i]) + " and " +
                                   b.name + " " + std::to_string(b.id[j]) + " must be >= " + to_text(least) + " m apart, got " +
                                   to_text(distance));
          }
        }
  }

  // ---- checks and rescue ----------------------------------------------------------------------------------------------------

  [[nodiscard]] std::vector<particles::GroupView> views() {
    std::vector<particles::GroupView> result;
    engine_.for_each_group([&result](auto& g) { result.push_back(g.view()); });
    engine_.for_each_item([&, item = 0](auto& active) mutable {  // and what bonds remember
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_bonds<I>)
        if constexpr (bond::HasMemory<decltype(I::law)>)
          for (auto* const list : {&active.of_a, &active.of_b})
            if (!list->empty())
              result.push_back(list->view("bonds " + std::to_string(item) + (list == &active.of_a ? ", first ends" : ", second ends")));
      ++item;
    });
    return result;
  }
  [[nodiscard]] Fault fault() {
    std::array<double, Dim> lower, upper;
    for (int d = 0; d < Dim; ++d) {
      const auto k = static_cast<std::size_t>(d);
      const bool open = engine_.box().periodic[k];  // particles wander out of a periodic face until the lists are rebuilt
      lower[k] = open ? -std::numeric_limits<double>::infinity() : engine_.box().lower[d];
      upper[k] = open ? std::numeric_limits<double>::infinity() : engine_.box().upper[d];
    }
    return find_fault(views(), lower, upper);
  }
  /// Nothing wrong: then this state is the last good one.
  void check() {
    const Fault found = fault();
    if (!found.what.empty())
      throw SimulationError("a value " + found.what, {clock_.time, clock_.step, found.group, found.particle, found.field, found.value});
    engine_.for_each_item([&](const auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_bonds<I>) {
        const auto& a = engine_.template group<typename I::A>();
        const auto& b = engine_.template group<typename I::B>();
        if (const auto* const bond = engine_.find_long_bond(active.item))
          throw SimulationError("a bond has become longer than 0.45 of the periodic box",
                                {clock_.time, clock_.step, a.name, bond->i, "distance to " + b.name + " " + std::to_string(bond->j),
                                 neighbours::minimum_image<Dim>(a.positions()[bond->i] - b.positions()[bond->j], engine_.box()).norm()});
      }
    });
  }
  /// Text of what a material law was given and cannot work with.
  template <class Particle, class... Field>
  [[nodiscard]] static std::string given(const Particle& particle, Fields<Field...>) {
    std::string text;
    ((text += (text.empty() ? "" : ", ") + std::string(Field::name) + " " + to_text(Field::of(particle)) + " " + std::string(Field::unit)), ...);
    return text;
  }
  /// Every particle must be one that the material laws of its group can work with; `dt` [s] is the step under way.
  void check_materials(double dt) const {
    engine_.find_refused(dt, [this]<class... Field>(const auto& g, std::size_t i, const std::string& demand, const auto& particle, Fields<Field...> read) {
      double value = 0.0;
      std::string_view name;
      ((value = Field::of(particle), name = Field::name), ...);
      throw SimulationError(demand + ", got " + given(particle, read), {clock_.time, clock_.step, g.name, g.id[i], std::string(name), value});
    });
  }
  /// The state is whole and right: the last good one.
  void take_snapshot() {
    if (!rescue_path_.empty()) last_good_.take(views(), clock_);
  }
  /// A step that the user gave must stay within the bounds as they change.
  void check_step(sweep::StepLimit& smallest) {
    const auto limit = find_step_limit<Integrator>(engine_, clock_.time, has_substeps);
    if (limit.stable_time_step < smallest.stable_time_step) smallest = limit;
    if (clock_.time_step > limit.stable_time_step)
      throw SimulationError(
          "the given time step is longer than " + to_text(limit.stable_time_step) + " s, by now the bound of " + limit.stability_bound_by,
          {clock_.time, clock_.step, "", -1, "", 0.0});
  }
  /// The same before anything is computed.
  void check_input() {
    const auto groups = views();
    for (std::size_t a = 0; a < groups.size(); ++a)
      for (std::size_t b = a + 1; b < groups.size(); ++b)
        if (groups[a].name == groups[b].name)
          throw ParameterError("scene: the names of groups must differ, got " + groups[a].name + " twice");
    const Fault found = fault();
    if (!found.what.empty())
      throw ParameterError("scene: group " + found.group + ", particle " + std::to_string(found.particle) + ": " + found.field + " " +
                           found.what + ", got " + to_text(found.value));
    engine_.for_each_item([&](const auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_interaction<I>) {
        const auto& a = engine_.template group<typename I::A>();
        const auto& b = engine_.template group<typename I::B>();
        const double spacing = std::max(a.spacing, b.spacing);
        if (active.item.cutoff() < (1.0 - 1e-9) * spacing)
          throw ParameterError("scene: support radius (cut-off) of " + a.name + " and " + b.name + " must be >= their spacing " +
                               to_text(spacing) + " m, got " + to_text(active.item.cutoff()));
      }
    });
  }
  /// check_materials at the start, when summed properties are known.
  void check_materials_at_start() const {
    engine_.find_refused(0.0, [](const auto& g, std::size_t i, const std::string& demand, const auto& particle, auto read) {
      throw ParameterError("scene: group " + g.name + ", particle " + std::to_string(g.id[i]) + ": " + demand + ", got " + given(particle, read));
    });
  }
  void rescue(const SimulationError& error) {
    if (last_good_.empty()) return;
    try {
      write_checkpoint(rescue_path_, signature(), views(), last_good_);
    } catch (const std::exception& second) {
      throw SimulationError(std::string(error.what()) + "; and the last good state could not be written: " + second.what(), error.where);
    }
  }

  Engine<Dim, Integrator, Precision, Item...> engine_;
  std::vector<Observer> observers_;
  std::string rescue_path_;
  Snapshot last_good_;
  Clock clock_;
  bool prepared_ = false, shows_progress_ = false;
};

/// Composes a scene: a box, then groups, interactions, bonds, materials and forcings in any order.
///   auto flow = scene<integrator::ExtrapolatedVerlet>(box, group<Water>(...), interaction<Water, Water>(...), ...);
/// Pair laws are evaluated in a precision::Double unless another Precision is named: scene<integrator::ExtrapolatedVerlet,
/// precision::Single>(...).
template <class Integrator, class Precision = precision::Double, int Dim, class... Item>
[[nodiscard]] auto scene(const geometry::Box<Dim>& box, const Item&... item) {
  return Scene<Dim, Integrator, Precision, Item...>(box, item...);
}

}  // namespace dmp::simulation
