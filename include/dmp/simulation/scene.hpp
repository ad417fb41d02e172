#pragma once
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <exception>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>
#include <dmp/core/simulation_error.hpp>
#include <dmp/simulation/checks.hpp>
#include <dmp/simulation/engine.hpp>
#include <dmp/simulation/limits.hpp>
#include <dmp/simulation/progress.hpp>
#include <dmp/simulation/state.hpp>
#include <dmp/sweep/step_limit.hpp>

namespace dmp::simulation {

/// How far to run, and with which step.
struct RunOptions {
  Required<double> until;           ///< end of the run [s]
  double time_step = 0.0;  ///< [s], held against the laws' bounds as often as values are checked; 0: from the bounds, reconsidered every
                           ///< 10 steps, with a viscosity of the shear rate or a pair potential every step
  double safety = 0.9;              ///< fraction of the smallest bound that is taken when time_step is 0; 0 < safety <= 1
  std::uint64_t check_every = 100;  ///< steps of a run between two checks of all values (finite, in the box)
};

/// What a run did.
struct RunReport {
  std::uint64_t steps = 0;         ///< of this run
  double wall_seconds = 0.0;       ///< observers included
  double processor_seconds = 0.0;  ///< of all threads; the same as wall_seconds for one thread that nothing else keeps waiting
  double particle_steps = 0.0;     ///< particles that evolve, times steps
  double time_step = 0.0;          ///< the last one [s]
  sweep::StepLimit limit;          ///< smallest bound met, and the law that set it
  std::string step_bound_by;       ///< what set the step: a law, or the user within the bound of a law, and beyond what resolves another
};

namespace detail {
inline void check_options(const RunOptions& options, const Clock& clock) {
  require(options.until >= clock.time - 0.5 * clock.time_step && options.until < std::numeric_limits<double>::infinity(),
          "scene: run until must be finite and not before the present time [s]", options.until);
  require_not_negative("scene: time_step", options.time_step, "s");
  require(options.safety > 0.0 && options.safety <= 1.0, "scene: safety must be > 0 and <= 1", options.safety);
  require(options.check_every > 0, "scene: check_every must be > 0", static_cast<double>(options.check_every));
}
/// The step [s] to begin with, which must be within the bound of what is stable.
[[nodiscard]] inline double first_step(const RunOptions& options, const sweep::StepLimit& limit) {
  const double step = options.time_step > 0.0 ? options.time_step : options.safety * limit.time_step;
  if (!(step < std::numeric_limits<double>::infinity()))
    throw ParameterError("scene: no law of this scene bounds the time step; give one as time_step");
  if (step > limit.stable_time_step)
    throw ParameterError("scene: time_step must be <= " + to_text(limit.stable_time_step) + " s, the bound of " + limit.stability_bound_by +
                         ", got " + to_text(step));
  return step;
}
/// A step that the user gave must stay within the bounds as they change.
inline void check_given_step(const Clock& clock, const sweep::StepLimit& limit) {
  if (clock.time_step > limit.stable_time_step)
    throw failure("the given time step is longer than " + to_text(limit.stable_time_step) + " s, by now the bound of " +
                      limit.stability_bound_by,
                  clock);
}
/// What set the step of a run.
[[nodiscard]] inline std::string step_bound(const RunOptions& options, const RunReport& report) {
  if (options.time_step == 0.0) return report.limit.bound_by;
  const auto share_of = [&report](double bound) { return to_text(std::round(100.0 * report.time_step / bound)) + " %"; };
  std::string text = "given, " + share_of(report.limit.stable_time_step) + " of the bound of " + report.limit.stability_bound_by;
  if (options.time_step > report.limit.time_step)
    text += ", " + share_of(report.limit.time_step) + " of what resolves " + report.limit.bound_by;
  return text;
}
}  // namespace detail

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

  /// Margin [m] by which neighbour lists reach beyond the cut-off, so that they last several steps; 0.15 of the largest cut-off unless set.
  Scene& set_skin(double skin) {
    require_not_negative("scene: skin", skin, "m");
    engine_.set_skin(skin);
    if (prepared_) engine_.build_lists();
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
    detail::check_options(options, clock_);
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t processor_start = std::clock();
    RunReport report;
    try {
      prepare();
      check_places(engine_, clock_.time);
      report.limit = first_bounds();
      const double first_step = detail::first_step(options, report.limit);
      const bool goes_on = options.time_step == 0.0 && clock_.automatic == 1 && clock_.time_step <= report.limit.time_step;
      clock_.automatic = options.time_step == 0.0 ? 1 : 0;
      choose_step(goes_on ? clock_.time_step : first_step);
      engine_.refresh_frozen();
      check_state(engine_, clock_);
      check_materials(engine_, clock_, 0.0);
      take_snapshot();
      Progress bar(shows_progress_, clock_.time, options.until);
      observe();
      const auto goes_further = [&] { return clock_.time < options.until - 0.5 * clock_.time_step; };
      bool begun = false, worn = false, checked = false, bounds_checked = false;  // of the present state
      while (begun || goes_further()) {
        if (!begun) {
          if (options.time_step == 0.0 && clock_.step % steps_between_choices() == 0) {
            const auto limit = bounds_by_now();
            report.limit.include(limit);
            const bool is_bound = limit.time_step < std::numeric_limits<double>::infinity();
            if (!is_bound && !bonds_break)  // broken bonds need no bound, a body that has left a plane may meet it again
              throw failure("no law of this scene bounds the time step any more; give one as time_step", clock_);
            in_run([&] { choose_step(is_bound ? options.safety * limit.time_step : clock_.time_step); });
            if (!(clock_.time_step > 1e-6 * first_step))
              throw SimulationError("the time step collapsed (bound of " + limit.bound_by + ")",
                                    {clock_.time, clock_.step, "", -1, "time_step", clock_.time_step});
          }
          clock_.tick();
          worn = engine_.begin_step(clock_.time_step, clock_.time);
        }
        if (engine_.has_refused()) check_materials(engine_, clock_, clock_.time_step);
        if (worn) {
          check_state(engine_, clock_);
          engine_.build_lists();
        }
        engine_.prepare_forces(clock_.time_step, clock_.step, worn);
        if (engine_.has_refused())
          check_materials(engine_, clock_, clock_.time_step);  // of what has been summed over neighbours, or sub-stepped
        engine_.forces(clock_.time_step, clock_.time);
        if (!engine_.dashpots_converged())
          throw failure("the dashpots of implicit_bonds have not been solved for: conjugate gradients did not converge", clock_);
        ++report.steps;
        // Where nobody looks at the state between two steps, the end of one and the beginning of the next are one pass.
        const bool checks = report.steps % options.check_every == 0,
                   chooses = (options.time_step == 0.0 || bounds_jump || has_substeps) && clock_.step % steps_between_choices() == 0;
        begun = !checks && !chooses && !observes() && goes_further();
        if (begun) {
          clock_.tick();
          worn = engine_.go_on(clock_.time_step, clock_.time_step, clock_.time);
          continue;
        }
        engine_.end_step(clock_.time_step);
        if (checks) {
          check_state(engine_, clock_);
          check_materials(engine_, clock_, 0.0);
          take_snapshot();
        }
        bounds_checked = options.time_step > 0.0 && (checks || chooses);
        if (bounds_checked) check_step(report.limit);
        if (options.time_step > 0.0 && chooses) reconsider_substeps();
        checked = checks && !observes();  // who observes may change it
        observe();
        bar.show(clock_.time);
      }
      if (!checked) {
        check_state(engine_, clock_);
        check_materials(engine_, clock_, 0.0);
      }
      if (has_bonds && options.time_step > 0.0 && !bounds_checked)
        check_step(report.limit);  // their bound follows how they turn, from step to step
      report.time_step = clock_.time_step;
      report.step_bound_by = detail::step_bound(options, report);
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
    report.processor_seconds = static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC;
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
    engine_.build_lists();
    write_checkpoint(path, signature(), views_of(engine_), clock_);
  }
  /// Continues from a checkpoint of the same composition and the same particle numbers. CheckpointError, and nothing is changed, if the
  /// file is no such, or damaged.
  void restart(const std::string& path) {
    clock_ = read_checkpoint(path, signature(), views_of(engine_));
    for (auto& observer : observers_) observer.done = due(observer);
    engine_.forget_exclusions();
    engine_.build_lists();
    if (clock_.step == 0) engine_.start_afresh();
    prepared_ = true;
  }
  /// What a checkpoint must agree with: dimension, integrator, precision, groups, mobilities, columns.
  [[nodiscard]] std::string signature() {
    return simulation::signature(Dim, std::string(Integrator::name) + ", " + std::string(Precision::name), views_of(engine_));
  }

 private:
  /// A viscosity of the shear rate may rise severalfold within a few steps, and the bound of the step falls with it.
  static constexpr bool bounds_jump = [] {
    return ([] {
      if constexpr (is_summed<Item>) return contains<field::ShearRate, typename decltype(Item::law)::sets>;
      return false;
    }() || ...);
  }();
  static constexpr bool has_bonds = Engine<Dim, Integrator, Precision, Item...>::has_bonds;
  static constexpr bool bonds_break = Engine<Dim, Integrator, Precision, Item...>::bonds_break;
  /// Forces of a potential may change the speed at which beads collide as fast; that bounds no step that the user has given.
  static constexpr bool collides = [] {
    return ([] {
      if constexpr (is_interaction<Item>) return Item::collides;
      return false;
    }() || ...);
  }();
  [[nodiscard]] std::uint64_t steps_between_choices() const noexcept { return bounds_jump || (collides && clock_.automatic == 1) ? 1 : 10; }
  static constexpr bool has_substeps = Engine<Dim, Integrator, Precision, Item...>::has_substeps;
  struct Observer {
    double interval;
    std::function<void(Scene&)> call;
    double done = -1.0;  // multiples of the interval observed so far
  };

  void prepare() {
    if (prepared_) return;
    check_input(engine_);
    engine_.evaluate(clock_.time, clock_.step);
    check_materials_at_start(engine_);
    if (clock_.step == 0) reject_overlaps(engine_);
    prepared_ = true;
  }

  void choose_step(double dt) {
    const bool goes_on = dt == clock_.time_step && clock_.substeps > 0 && clock_.step % steps_between_choices() != 0;
    clock_.choose(dt);
    if constexpr (has_substeps) {
      if (!goes_on) clock_.substeps = static_cast<std::uint64_t>(substeps_for(engine_, dt));
      engine_.set_substeps(static_cast<int>(clock_.substeps));
    }
  }
  /// Bonds turn and break, so that other sub-steps may be needed in a step that stays as it was given.
  void reconsider_substeps() {
    in_run([this] { choose_step(clock_.time_step); });
  }
  /// Multiples of the observer's interval that have passed.
  [[nodiscard]] double due(const Observer& observer) const {
    return std::floor((clock_.time + 0.5 * clock_.time_step) / observer.interval);
  }
  /// Whether an observer wants to see the present state.
  [[nodiscard]] bool observes() const {
    for (const auto& observer : observers_)
      if (due(observer) > observer.done) return true;
    return false;
  }
  void observe() {
    for (auto& observer : observers_) {
      const double now = due(observer);
      if (now <= observer.done) continue;
      observer.done = now;
      observer.call(*this);
    }
  }

  /// Nothing wrong: then this state is the last good one.
  void take_snapshot() {
    if (!rescue_path_.empty()) last_good_.take(views_of(engine_), clock_);
  }
  /// The bounds when a run begins. Of a state that is not finite the particle is named, of a law's bound that is none the law.
  [[nodiscard]] sweep::StepLimit first_bounds() {
    try {
      return find_step_limit<Integrator>(engine_, clock_.time, has_substeps);
    } catch (const ParameterError&) {
      check_state(engine_, clock_);
      throw;
    }
  }
  /// The same of function() in mid-run, where the user's parameters are not to blame.
  template <class Function>
  auto in_run(const Function& function) {
    try {
      return function();
    } catch (const ParameterError& error) {
      check_state(engine_, clock_);
      throw failure(error.what(), clock_);
    }
  }
  [[nodiscard]] sweep::StepLimit bounds_by_now() {
    return in_run([this] { return find_step_limit<Integrator>(engine_, clock_.time, has_substeps); });
  }
  /// A step that the user gave must stay within the bounds as they change.
  void check_step(sweep::StepLimit& smallest) {
    const auto limit = bounds_by_now();
    smallest.include(limit);
    detail::check_given_step(clock_, limit);
  }
  void rescue(const SimulationError& error) {
    if (last_good_.empty()) return;
    try {
      write_checkpoint(rescue_path_, signature(), views_of(engine_), last_good_);
    } catch (const std::exception& second) {
      throw SimulationError(error, std::string("; and the last good state could not be written: ") + second.what());
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
