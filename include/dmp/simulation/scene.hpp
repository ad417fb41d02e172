#pragma once
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <dmp/core/simulation_error.hpp>
#include <dmp/io/checkpoint.hpp>
#include <dmp/simulation/engine.hpp>
#include <dmp/simulation/progress.hpp>
#include <dmp/sweep/step_limit.hpp>

namespace dmp::simulation {

/// How far to run, and with which step.
struct RunOptions {
  Required<double> until;    ///< end of the run [s]
  double time_step = 0.0;    ///< [s]; 0: from the laws' bounds, reconsidered every 10 steps
  double safety = 0.9;       ///< fraction of the smallest bound that is taken when time_step is 0; 0 < safety <= 1
  std::uint64_t check_every = 100;  ///< steps between two checks of all values (finite, in the box)
};

/// What a run did.
struct RunReport {
  std::uint64_t steps = 0;           ///< of this run
  double wall_seconds = 0.0;         ///< observers included
  double particle_steps = 0.0;       ///< particles that evolve, times steps
  double time_step = 0.0;            ///< the last one [s]
  sweep::StepLimit limit;            ///< smallest bound met, and the law that set it
};

/// A composed simulation: groups, what they do to each other, an integrator, and what looks on. Made by `scene(...)`.
template <int Dim, class Integrator, class... Item>
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
  [[nodiscard]] Engine<Dim, Integrator, Item...>& engine() noexcept { return engine_; }
  [[nodiscard]] const Engine<Dim, Integrator, Item...>& engine() const noexcept { return engine_; }
  [[nodiscard]] double time() const noexcept { return time_; }           ///< [s]
  [[nodiscard]] std::uint64_t step() const noexcept { return step_; }    ///< since the very start, restarts included
  [[nodiscard]] std::size_t particles() const {
    std::size_t count = 0;
    engine_.for_each_group([&count](const auto& g) { count += g.size(); });
    return count;
  }

  /// Margin [m] by which neighbour lists reach beyond the cut-off, so that they last several steps; 0.1 of the largest cut-off unless set.
  Scene& set_skin(double skin) {
    require_not_negative("scene: skin", skin, "m");
    engine_.set_skin(skin);
    prepared_ = false;
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
    return find_step_limit(false);
  }

  RunReport run(const RunOptions& options) {
    require(options.until >= time_ && options.until < std::numeric_limits<double>::infinity(), "scene: run until must be finite and not before the present time [s]", options.until);
    require_not_negative("scene: time_step", options.time_step, "s");
    require(options.safety > 0.0 && options.safety <= 1.0, "scene: safety must be > 0 and <= 1", options.safety);
    require(options.check_every > 0, "scene: check_every must be > 0", static_cast<double>(options.check_every));
    const auto start = std::chrono::steady_clock::now();
    RunReport report;
    try {
      prepare();
      report.limit = find_step_limit(has_substeps);
      double dt = options.time_step;
      if (dt == 0.0) dt = options.safety * report.limit.time_step;
      if (!(dt < std::numeric_limits<double>::infinity())) throw ParameterError("scene: no law of this scene bounds the time step; give one as time_step");
      if (dt > report.limit.stable_time_step)
        throw ParameterError("scene: time_step must be <= " + to_text(report.limit.stable_time_step) + " s, the bound of " +
                             report.limit.stability_bound_by + ", got " + to_text(dt));
      const double first_dt = dt;
      choose_substeps(dt);
      check();
      Progress bar(shows_progress_, time_, options.until);
      observe(dt);
      double base_time = time_;
      std::uint64_t base_step = step_;
      while (time_ < options.until - 0.5 * dt) {
        if (options.time_step == 0.0 && step_ % 10 == 0) {
          const auto limit = find_step_limit(has_substeps);
          if (limit.time_step < report.limit.time_step) report.limit = limit;
          dt = options.safety * limit.time_step;
          if (!(dt > 1e-6 * first_dt)) throw SimulationError("the time step collapsed (bound of " + limit.bound_by + ")", {time_, step_, "", -1, "time_step", dt});
          base_time = time_;
          base_step = step_;
          choose_substeps(dt);
        }
        ++step_;
        time_ = base_time + static_cast<double>(step_ - base_step) * dt;
        engine_.step(dt, time_);
        if (step_ % options.check_every == 0) check();
        observe(dt);
        bar.show(time_);
        ++report.steps;
      }
      check();
      report.time_step = dt;
    } catch (const SimulationError&) {
      rescue();
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

  /// Writes everything that a bit-exact continuation needs. Also rebuilds the lists, so that this run and the restarted one go on alike.
  void checkpoint(const std::string& path) {
    prepare();
    engine_.build_lists();
    io::CheckpointWriter writer(path, signature());
    writer.add("clock", std::span<const double>(std::vector<double>{time_, static_cast<double>(step_)}));
    engine_.for_each_group([&writer](const auto& g) { write_group(writer, g, g.columns, g.id); });
    writer.commit();
  }
  /// Continues from a checkpoint of the same program and the same particle numbers.
  void restart(const std::string& path) {
    const io::CheckpointReader reader(path, signature());
    const auto clock = reader.template read<double>("clock");
    if (clock.size() != 2) throw io::CheckpointError(path + ": section clock must hold 2 numbers");
    engine_.for_each_group([&](auto& g) {
      using List = typename std::remove_cvref_t<decltype(g)>::Layout::columns;
      for_each_field(List{}, [&]<class Field>(Field) { read_column(reader, path, g.name + "." + std::string(Field::name), g.template get<Field>()); });
      read_column(reader, path, g.name + ".id", g.id);
    });
    time_ = clock[0];
    step_ = static_cast<std::uint64_t>(clock[1]);
    engine_.build_lists();
    prepared_ = true;
  }
  /// Names groups, mobilities, columns and dimension: a checkpoint of another composition does not fit.
  [[nodiscard]] std::string signature() const {
    std::string text = std::to_string(Dim) + "D, " + std::string(Integrator::name);
    engine_.for_each_group([&text](const auto& g) {
      using G = std::remove_cvref_t<decltype(g)>;
      text += "; " + g.name + " (" + std::string(G::Mobility::name) + "):";
      for_each_field(typename G::Layout::columns{}, [&text]<class Field>(Field) { text += " " + std::string(Field::name); });
    });
    return text;
  }

 private:
  static constexpr bool has_substeps = Engine<Dim, Integrator, Item...>::has_substeps;
  struct Observer {
    double interval;
    std::function<void(Scene&)> call;
    std::int64_t done = -1;  // multiples of the interval observed so far
  };

  void prepare() {
    if (prepared_) return;
    engine_.evaluate(time_);
    reject_overlaps();
    prepared_ = true;
  }

  void observe(double dt) {
    for (auto& observer : observers_) {
      const auto due = static_cast<std::int64_t>(std::floor((time_ + 0.5 * dt) / observer.interval));
      if (due <= observer.done) continue;
      observer.done = due;
      observer.call(*this);
    }
  }

  /// Particles closer than half their spacing at the start are a fill done twice, or two fills that overlap.
  void reject_overlaps() const {
    engine_.for_each_item([this](const auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_interaction<I>) {
        reject_overlap(engine_.template group<typename I::A>(), engine_.template group<typename I::B>(), active.of_a);
        if constexpr (!std::is_same_v<typename I::A, typename I::B>)
          reject_overlap(engine_.template group<typename I::B>(), engine_.template group<typename I::A>(), active.of_b);
      }
    });
  }
  template <class A, class B>
  static void reject_overlap(const A& a, const B& b, const neighbours::PairList& pairs) {
    const double least = 0.5 * std::min(a.spacing, b.spacing);
    if constexpr (A::Mobility::evolves)
      for (std::size_t range = 0; range < a.ranges.size(); ++range)
        for (std::size_t i = a.ranges.begin(range); i < a.ranges.end(range); ++i)
          for (const std::uint32_t j : pairs.of(range, i)) {
            if (j >= b.size()) continue;
            const double distance = (a.positions()[i] - b.positions()[j]).norm();
            if (distance < least)
              throw ParameterError("scene: particles must not overlap at the start: " + a.name + " " + std::to_string(a.id[i]) + " and " + b.name + " " +
                                   std::to_string(b.id[j]) + " must be >= " + to_text(least) + " m apart, got " + to_text(distance));
          }
  }

  // ---- time step ------------------------------------------------------------------------------------------------------------

  template <class G>
  [[nodiscard]] sweep::StepState state_of(const G& g) const {
    using C = typename G::Layout;
    sweep::StepState state{.oscillation_limit = Integrator::oscillation_limit, .damping_limit = Integrator::damping_limit};
    if constexpr (particles::is_mobile<typename G::Mobility>) state.mass = g.mass;
    for (std::size_t i = 0; i < g.size(); ++i) {
      const auto particle = engine_.prepared(g, i, 0.0);
      state.speed = std::max(state.speed, dot(particle.velocity, particle.velocity));
      if constexpr (particles::is_mobile<typename G::Mobility>)
        state.acceleration = std::max(state.acceleration, g.template get<field::Acceleration>()[i].squaredNorm());
      if constexpr (requires { particle.dynamic_viscosity; particle.density; })
        state.kinematic_viscosity = std::max(state.kinematic_viscosity, particle.dynamic_viscosity / particle.density);
      engine_.for_each_item([&](const auto& active) {
        using I = std::remove_cvref_t<decltype(active.item)>;
        if constexpr (is_material<I>)
          if constexpr (I::template concerns<typename std::remove_cvref_t<G>::Tag>)
            std::apply([&](const auto&... law) {
              const auto one = [&](const auto& l) {
                if constexpr (requires { l.sound_speed(particle); }) state.sound_speed = std::max(state.sound_speed, l.sound_speed(particle));
              };
              (one(law), ...);
            }, active.item.laws);
      });
    }
    state.speed = std::sqrt(state.speed);
    state.acceleration = std::sqrt(state.acceleration);
    return state;
  }

  [[nodiscard]] sweep::StepLimit find_step_limit(bool without_substepped) const {
    sweep::StepLimit limit;
    std::vector<sweep::StepState> states;
    engine_.for_each_group([&](const auto& g) { states.push_back(state_of(g)); });
    const auto state = [&]<class Tag>(std::type_identity<Tag>) {
      std::size_t index = 0, found = 0;
      engine_.for_each_group([&](const auto& g) {
        if (std::is_same_v<typename std::remove_cvref_t<decltype(g)>::Tag, Tag>) found = index;
        ++index;
      });
      return states[found];
    };
    engine_.for_each_item([&](const auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_interaction<I>) {
        sweep::StepState both = state(std::type_identity<typename I::A>{});
        const sweep::StepState other = state(std::type_identity<typename I::B>{});
        both.speed = std::max(both.speed, other.speed);
        both.acceleration = std::max(both.acceleration, other.acceleration);
        both.sound_speed = std::max(both.sound_speed, other.sound_speed);
        both.kinematic_viscosity = std::max(both.kinematic_viscosity, other.kinematic_viscosity);
        both.mass = std::min(both.mass, other.mass);
        std::apply([&](const auto&... law) { (law.step_limits(both, limit), ...); }, active.item.laws);
      }
      if constexpr (is_bonds<I>) {
        if (!(I::substepped && without_substepped)) limit_bonds(active, limit);
      }
      if constexpr (is_forced<I>)
        engine_.for_each_group([&](const auto& g) {
          if constexpr (I::template concerns<typename std::remove_cvref_t<decltype(g)>::Tag>)
            std::apply([&](const auto&... law) {
              const auto one = [&](const auto& l) {
                if constexpr (requires { l.damping_rate(g.mass); })
                  if (l.damping_rate(g.mass) > 0.0) limit.require_below(Integrator::damping_limit / l.damping_rate(g.mass), "drag");
              };
              (one(law), ...);
            }, active.item.laws);
        });
    });
    return limit;
  }

  /// omega^2 <= 2 n k/m and lambda <= 2 n c/m for a particle with n bonds (Gershgorin's circles of the stiffness matrix).
  template <class Active>
  void limit_bonds(const Active& active, sweep::StepLimit& limit) const {
    using I = std::remove_cvref_t<decltype(active.item)>;
    const auto end = [&](const auto& g, const neighbours::BondList& list) {
      if constexpr (particles::is_mobile<typename std::remove_cvref_t<decltype(g)>::Mobility>) {
        const double per_mass = 2.0 * list.most_bonds() / g.mass;
        const double stiffness = active.item.law.largest_stiffness();
        if (stiffness * per_mass > 0.0) limit.require_below(Integrator::oscillation_limit / std::sqrt(stiffness * per_mass), "bond stiffness");
        if constexpr (bond::UsesVelocity<decltype(active.item.law)>) {
          const double damping = active.item.law.largest_damping();
          if (damping * per_mass > 0.0) limit.require_below(Integrator::damping_limit / (damping * per_mass), "bond dashpot");
        }
      }
    };
    end(engine_.template group<typename I::A>(), active.of_a);
    if constexpr (!std::is_same_v<typename I::A, typename I::B>) end(engine_.template group<typename I::B>(), active.of_b);
  }

  void choose_substeps(double dt) {
    if constexpr (has_substeps) {
      sweep::StepLimit fast;
      int asked = 0;
      engine_.for_each_item([&](const auto& active) {
        using I = std::remove_cvref_t<decltype(active.item)>;
        if constexpr (is_bonds<I>)
          if constexpr (I::substepped) {
            limit_bonds(active, fast);
            asked = std::max(asked, active.item.substeps);
          }
      });
      const double needed = std::ceil(dt / (0.9 * fast.time_step));
      if (asked > 0 && dt / asked > fast.time_step)
        throw ParameterError("substepped_bonds: substeps must be >= " + to_text(std::ceil(dt / fast.time_step)) + " for a step of " + to_text(dt) + " s, got " + std::to_string(asked));
      engine_.set_substeps(asked > 0 ? asked : std::max(1, static_cast<int>(needed)));
    }
  }

  // ---- checks and rescue ----------------------------------------------------------------------------------------------------

  /// All values finite, all particles in the box; then this state is the last good one.
  void check() {
    engine_.for_each_group([this](const auto& g) { check_group(g); });
    if (rescue_path_.empty()) return;
    good_time_ = time_;
    good_step_ = step_;
    snapshot_ = std::make_optional<Snapshot>();
    engine_.for_each_group([this](const auto& g) { std::get<Copy<std::remove_cvref_t<decltype(g)>>>(*snapshot_) = {g.columns, g.id}; });
  }
  template <class G>
  void check_group(const G& g) const {
    if constexpr (G::Mobility::evolves) {
      for_each_field(typename G::Layout::columns{}, [&]<class Field>(Field) {
        const auto& values = g.template get<Field>();
        double probe = 0.0;  // stays 0 as long as all values are finite
        for (const auto& value : values) {
          if constexpr (Field::is_vector)
            probe += 0.0 * value.sum();
          else
            probe += 0.0 * value;
        }
        if (probe == 0.0) return;
        for (std::size_t i = 0; i < values.size(); ++i) {
          if constexpr (Field::is_vector) {
            for (int d = 0; d < Dim; ++d)
              if (!(values[i][d] - values[i][d] == 0.0)) fail("a value is not finite", g, i, Field::name, values[i][d]);
          } else {
            if (!(values[i] - values[i] == 0.0)) fail("a value is not finite", g, i, Field::name, values[i]);
          }
        }
      });
      const auto& box = engine_.box();
      for (std::size_t i = 0; i < g.size(); ++i)
        for (int d = 0; d < Dim; ++d) {
          const double x = g.positions()[i][d];
          if (!box.periodic[static_cast<std::size_t>(d)] && !(x >= box.lower[d] && x <= box.upper[d])) fail("a particle left the box", g, i, field::Position::name, x);
        }
    }
  }
  template <class G>
  [[noreturn]] void fail(const char* what, const G& g, std::size_t i, std::string_view field, double value) const {
    throw SimulationError(what, {time_, step_, g.name, static_cast<std::int64_t>(g.id[i]), std::string(field), value});
  }

  void rescue() const {
    if (rescue_path_.empty() || !snapshot_) return;
    io::CheckpointWriter writer(rescue_path_, signature());
    writer.add("clock", std::span<const double>(std::vector<double>{good_time_, static_cast<double>(good_step_)}));
    engine_.for_each_group([&](const auto& g) {
      const auto& copy = std::get<Copy<std::remove_cvref_t<decltype(g)>>>(*snapshot_);
      write_group(writer, g, copy.columns, copy.id);
    });
    writer.commit();
  }
  static void write_group(io::CheckpointWriter& writer, const auto& g, const auto& columns, const std::vector<std::uint32_t>& id) {
    for_each_field(typename std::remove_cvref_t<decltype(g)>::Layout::columns{}, [&]<class Field>(Field) {
      const auto& values = columns.template get<Field>();
      constexpr std::size_t numbers = Field::is_vector ? Dim : 1;
      writer.add(g.name + "." + std::string(Field::name), std::span<const double>(reinterpret_cast<const double*>(values.data()), numbers * values.size()));
    });
    writer.add(g.name + ".id", std::span<const std::uint32_t>(id));
  }
  template <class V>
  static void read_column(const io::CheckpointReader& reader, const std::string& path, const std::string& section, std::vector<V>& to) {
    using Number = std::conditional_t<std::is_same_v<V, std::uint32_t>, std::uint32_t, double>;
    const auto numbers = reader.template read<Number>(section);
    if (numbers.size() * sizeof(Number) != to.size() * sizeof(V))
      throw io::CheckpointError(path + ": section " + section + " must hold " + std::to_string(to.size()) + " particles, got " +
                                std::to_string(numbers.size() * sizeof(Number) / sizeof(V)));
    std::copy(numbers.begin(), numbers.end(), reinterpret_cast<Number*>(to.data()));
  }

  template <class G>
  struct Copy {
    typename G::Columns columns;
    std::vector<std::uint32_t> id;
  };
  template <class List>
  struct SnapshotOf;
  template <class... G>
  struct SnapshotOf<std::tuple<G...>> {
    using type = std::tuple<Copy<G>...>;
  };
  using Snapshot = typename SnapshotOf<typename Engine<Dim, Integrator, Item...>::Groups>::type;

  Engine<Dim, Integrator, Item...> engine_;
  std::vector<Observer> observers_;
  std::string rescue_path_;
  std::optional<Snapshot> snapshot_;
  double time_ = 0.0, good_time_ = 0.0;
  std::uint64_t step_ = 0, good_step_ = 0;
  bool prepared_ = false, shows_progress_ = false;
};

/// Composes a scene: a box, then groups, interactions, bonds, materials and forcings in any order.
///   auto flow = scene<integrator::ExtrapolatedVerlet>(box, group<Water>(...), interaction<Water, Water>(...), ...);
template <class Integrator, int Dim, class... Item>
[[nodiscard]] auto scene(const geometry::Box<Dim>& box, const Item&... item) {
  return Scene<Dim, Integrator, Item...>(box, item...);
}

}  // namespace dmp::simulation
