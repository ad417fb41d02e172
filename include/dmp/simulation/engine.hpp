#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <dmp/core/threads.hpp>
#include <dmp/integrator/leapfrog.hpp>
#include <dmp/simulation/dashpots.hpp>

namespace dmp::simulation {

/// One time step of a model: begin, lists when needed, forces, end. Knows neither output nor the length of the run.
template <int Dim, class Integrator, class Precision, class... Item>
class Engine : public Dashpots<Dim, Integrator, Precision, Item...> {
  static_assert(integrator::explain_integrator<Integrator>());
  using Base = Dashpots<Dim, Integrator, Precision, Item...>;

 public:
  using Base::Base, Base::group, Base::for_each_group, Base::for_each_item, Base::has_pairs;
  static constexpr bool has_substeps = [] {
    return ([] {
      if constexpr (is_bonds<Item>) return Item::substepped;
      return false;
    }() || ...);
  }();

  static constexpr bool has_dashpots = Base::has_dashpots;
  static_assert(!has_dashpots || std::is_base_of_v<integrator::Leapfrog, Integrator>, "dmp: implicit_bonds need integrator::Leapfrog");
  static_assert(!has_dashpots || !has_substeps, "dmp: implicit_bonds and substepped_bonds do not go together in one scene");

  /// How often sub-stepped bonds are evaluated per step.
  void set_substeps(int substeps) noexcept { substeps_ = substeps; }
  [[nodiscard]] int substeps() const noexcept { return substeps_; }

  /// The next step is the first one, whose accelerations are still without the dashpots that are solved for.
  void start_afresh() noexcept { fresh_ = true; }

  /// Accelerations and rates from the present state, e.g. before the first step; `time` [s] as forcings see it, `step` as summed laws do.
  void evaluate(double time, std::uint64_t step) {
    for_each_group([&](auto& g) { for_each_particle(g, [&](std::size_t i) { follow_motion(g, i, time); }); });
    this->build_lists();
    this->pack_all(0.0);
    this->gather_summed(step, 0.0);
    if constexpr (has_substeps) this->fast_forces(0.0);
    this->gather_all(time, 0.0);
    start_afresh();
    if constexpr (Integrator::keeps_rates)
      for_each_group([](auto& g) {
        for_each_field(typename LayoutOf<decltype(g)>::rates{},
                       [&g]<class Rate>(Rate) { g.template get<Previous<Rate>>() = g.template get<Rate>(); });
      });
  }

  /// First part of a step of length `dt` [s] that ends at `time` [s]: everything moves. Returns whether neighbour lists are worn out, so
  /// that build_lists must be called before `prepare_forces`.
  [[nodiscard]] bool begin_step(double dt, double time) {
    if constexpr (has_dashpots)
      if (fresh_) this->add_dashpots(dt);
    fresh_ = false;
    if constexpr (has_substeps) begin_with_substeps(dt, time);
    else for_each_group([&](auto& g) { pass(g, 0.0, dt, time); });
    return this->lists_are_worn();
  }
  /// Second part: properties that are summed at the new positions, in step number `step`. `fresh_lists`: built since the step began.
  void prepare_forces(double dt, std::uint64_t step, bool fresh_lists) {
    if (has_substeps || fresh_lists) this->pack_all(dt);  // otherwise the records are those that begin_step has left
    this->gather_summed(step, dt);
  }
  /// Third part: forces.
  void forces(double dt, double time) {
    this->gather_all(time, dt);
    if constexpr (has_dashpots) this->add_dashpots(dt);
  }
  /// Last part: the end of the step.
  void end_step(double dt) {
    for_each_group([&](auto& g) { pass(g, dt, 0.0, 0.0); });
  }
  /// end_step of a step of length `last_dt` and begin_step of the next, in one pass over the particles.
  [[nodiscard]] bool go_on(double last_dt, double dt, double time) {
    if constexpr (has_substeps) {
      end_step(last_dt);
      return begin_step(dt, time);
    } else {
      for_each_group([&](auto& g) { pass(g, last_dt, dt, time); });
      return this->lists_are_worn();
    }
  }

 private:
  template <class G>
  using LayoutOf = typename Base::template LayoutOf<G>;
  template <class G>
  static constexpr bool evolves = Base::template evolves<G>;
  template <class G>
  static constexpr bool mobile = Base::template mobile<G>;

  /// The end of the last step, of length `last_dt`, and the beginning of the next, of length `dt`, up to the records; 0 for none.
  template <class G>
  void pass(G& g, double last_dt, double dt, double time) {
    using C = LayoutOf<G>;
    if constexpr (evolves<G>) {
      this->with_materials(g, [&](const auto&... law) {
        for_each_block(g.blocks, [&](std::size_t, std::size_t block) {
          this->follow(g, block, [&, last_dt, dt, time](std::size_t i) {
            g.prefetch_for_step(i + 96);
            if constexpr (mobile<G>) move(g, i, last_dt, dt);
            if (last_dt > 0.0) end_state(g, i, last_dt);
            if (!(dt > 0.0)) return;
            if constexpr (meets_planes<G>) stop_at_planes(*this, g, i, dt, time);
            follow_motion(g, i, time);
            begin_state(g, i, dt);
            if constexpr (C::has_records) this->pack_one(g, i, dt, law...);
          });
        });
      });
      if (dt > 0.0) this->pack_ghosts(g);
    }
  }
  /// Velocity and position of a particle over the end of the last step and the beginning of the next, in registers.
  template <class G>
  static void move(G& g, std::size_t i, double last_dt, double dt) {
    auto& x = g.positions()[i];
    auto& v = g.template get<field::Velocity>()[i];
    auto position = to_components<Dim>(x), velocity = to_components<Dim>(v);
    const auto acceleration = to_components<Dim>(g.template get<field::Acceleration>()[i]);
    if (last_dt > 0.0)
      unrolled<Dim>([&](auto d) {
        if constexpr (LayoutOf<G>::has_substeps) velocity[d] += 0.5 * last_dt * acceleration[d];  // the second slow kick
        else Integrator::end(velocity[d], acceleration[d], last_dt);
      });
    if (dt > 0.0) unrolled<Dim>([&](auto d) { Integrator::begin(position[d], velocity[d], acceleration[d], dt); });
    for (int d = 0; d < Dim; ++d) x[d] = position[d];
    for (int d = 0; d < Dim; ++d) v[d] = velocity[d];
  }
  template <class G>
  void begin_state(G& g, std::size_t i, double dt) {
    for_each_field(typename LayoutOf<G>::rates{}, [&]<class Rate>(Rate) {
      Integrator::begin_state(g.template get<typename Rate::integrates>()[i], g.template get<Rate>()[i], dt);
    });
  }
  template <class G>
  void end_state(G& g, std::size_t i, double dt) {
    for_each_field(typename LayoutOf<G>::rates{}, [&]<class Rate>(Rate) {
      Integrator::end_state(g.template get<typename Rate::integrates>()[i], g.template get<Rate>()[i], dt);
    });
  }
  /// Puts a particle of a driven group, or of one on rollers, where its motion has it at `time`; nothing for other groups.
  template <class G>
  void follow_motion(G& g, std::size_t i, double time) {
    using M = typename G::Mobility;
    if constexpr (particles::is_driven<M> || particles::is_roller<M>) {
      const auto& start = g.template get<StartPosition>()[i];
      Vector<Dim> there = g.mobility.motion.position(start, time);
      for (int d = 0; d < Dim; ++d)  // no jump through a periodic face before positions are put back into the box
        if (const double period = this->periods_[static_cast<std::size_t>(d)]; period > 0.0)
          there[d] += period * std::round((g.positions()[i][d] - there[d]) / period);
      auto& velocity = g.template get<field::Velocity>()[i];
      const Vector<Dim> speed = g.mobility.motion.velocity(start, time);
      if constexpr (particles::is_driven<M>) {
        g.positions()[i] = there;
        velocity = speed;
      } else {
        g.positions()[i] += g.mobility.held(Vector<Dim>(there - g.positions()[i]));
        velocity += g.mobility.held(Vector<Dim>(speed - velocity));
      }
    }
  }
  /// Slow forces are kicks at the two ends of the step; between them the sub-stepped bonds alone move their groups.
  void begin_with_substeps(double dt, double time) {
    const double part = dt / substeps_;
    for_each_group([&](auto& g) {
      using G = std::remove_cvref_t<decltype(g)>;
      if constexpr (!LayoutOf<G>::has_substeps) pass(g, 0.0, dt, time);
      else
        for_each_particle(g, [&](std::size_t i) {
          g.template get<field::Velocity>()[i] += 0.5 * dt * g.template get<field::Acceleration>()[i];
          begin_state(g, i, dt);
        });
    });
    for (int k = 0; k < substeps_; ++k) {
      for_each_group([&](auto& g) {
        using G = std::remove_cvref_t<decltype(g)>;
        if constexpr (particles::is_driven<typename G::Mobility> && LayoutOf<G>::has_bonds)
          for_each_particle(g, [&](std::size_t i) { follow_motion(g, i, time - dt + (k + 1) * part); });
      });
      for_each_fast([&](auto& g, std::size_t i) {
        g.template get<field::Velocity>()[i] += 0.5 * part * g.template get<FastAcceleration>()[i];
        g.positions()[i] += part * g.template get<field::Velocity>()[i];
        follow_motion(g, i, time - dt + (k + 1) * part);
      });
      this->fast_forces(part);
      for_each_fast(
          [&](auto& g, std::size_t i) { g.template get<field::Velocity>()[i] += 0.5 * part * g.template get<FastAcceleration>()[i]; });
    }
    for_each_group([&](auto& g) {
      using G = std::remove_cvref_t<decltype(g)>;
      if constexpr (LayoutOf<G>::has_substeps && LayoutOf<G>::has_pairs)
        for_each_block(g.blocks, [&](std::size_t, std::size_t block) { this->follow(g, block, [](std::size_t) {}); });
    });
  }
  template <class Function>
  void for_each_fast(Function&& function) {
    for_each_group([&](auto& g) {
      if constexpr (LayoutOf<decltype(g)>::has_substeps) for_each_particle(g, [&](std::size_t i) { function(g, i); });
    });
  }
  template <class G, class Function>
  static void for_each_particle(const G& g, Function&& function) {
    for_each_range(g.blocks.ranges(), [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) function(i);
    });
  }

  int substeps_ = 1;
  bool fresh_ = false;
};

}  // namespace dmp::simulation
