#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>
#include <dmp/core/threads.hpp>
#include <dmp/simulation/forces.hpp>

namespace dmp::simulation {

/// One time step of a model: begin, lists when needed, forces, end. Knows neither output nor the length of the run.
template <int Dim, class Integrator, class... Item>
class Engine : public Forces<Dim, Integrator, Item...> {
  static_assert(integrator::explain_integrator<Integrator>());
  using Base = Forces<Dim, Integrator, Item...>;

 public:
  using Base::Base, Base::group, Base::for_each_group, Base::for_each_item, Base::has_pairs;
  static constexpr bool has_substeps = [] {
    return ([] {
      if constexpr (is_bonds<Item>) return Item::substepped;
      return false;
    }() || ...);
  }();

  /// How often sub-stepped bonds are evaluated per step.
  void set_substeps(int substeps) noexcept { substeps_ = substeps; }

  /// Accelerations and rates from the present state, e.g. before the first step; `time` [s] as forcings see it.
  void evaluate(double time) {
    for_each_group([&](auto& g) {
      for (std::size_t i = 0; i < g.size(); ++i) follow_motion(g, i, time);
    });
    this->build_lists();
    if constexpr (has_substeps) {
      this->fast_forces();
    }
    this->forces(time, 0.0);
    if constexpr (Integrator::keeps_rates)
      for_each_group([](auto& g) {
        for_each_field(typename LayoutOf<decltype(g)>::rates{},
                       [&g]<class Rate>(Rate) { g.template get<Previous<Rate>>() = g.template get<Rate>(); });
      });
  }

  /// First part of a step of length `dt` [s] that ends at `time` [s]: everything moves. Returns whether neighbour lists are worn out, so
  /// that build_lists must be called before `finish_step`.
  [[nodiscard]] bool begin_step(double dt, double time) {
    if constexpr (has_substeps) begin_with_substeps(dt, time);
    else for_each_group([&](auto& g) { begin(g, dt, time); });
    bool worn = false;
    if constexpr (has_pairs)
      for_each_item([&](const auto& active) {
        using I = std::remove_cvref_t<decltype(active.item)>;
        if constexpr (is_interaction<I>)
          worn =
              worn || !(this->moved_[Base::template index_of<typename I::A>()] + this->moved_[Base::template index_of<typename I::B>()] <=
                        this->skin_);
      });
    return worn;
  }
  /// Second part: forces at the new positions, and the end of the step.
  void finish_step(double dt, double time) {
    this->forces(time, dt);
    for_each_group([&](auto& g) { end(g, dt); });
  }

 private:
  template <class G>
  using LayoutOf = typename Base::template LayoutOf<G>;
  template <class G>
  static constexpr bool evolves = Base::template evolves<G>;
  template <class G>
  static constexpr bool mobile = Base::template mobile<G>;

  template <class G>
  void begin(G& g, double dt, double time) {
    using C = LayoutOf<G>;
    farthest_.assign(g.ranges.size(), 0.0);
    for_each_range(g.ranges, [&](std::size_t range, std::size_t first, std::size_t last) {
      double farthest = 0.0;
      for (std::size_t i = first; i < last; ++i) {
        if constexpr (mobile<G>) {
          Integrator::begin(g.positions()[i], g.template get<field::Velocity>()[i], g.template get<field::Acceleration>()[i], dt);
        } else {
          follow_motion(g, i, time);
        }
        for_each_field(typename C::rates{}, [&]<class Rate>(Rate) {
          Integrator::begin_state(g.template get<typename Rate::integrates>()[i], g.template get<Rate>()[i], dt);
        });
        if constexpr (G::Mobility::moves && C::has_pairs) farthest = std::max(farthest, displacement(g, i));
      }
      farthest_[range] = farthest;
    });
    this->moved_[Base::template index_of<typename G::Tag>()] = std::sqrt(*std::max_element(farthest_.begin(), farthest_.end()));
  }

  /// Puts a particle of a driven group where its motion has it at `time`; nothing for other groups.
  template <class G>
  void follow_motion(G& g, std::size_t i, double time) {
    if constexpr (particles::is_driven<typename G::Mobility>) {
      const auto& start = g.template get<StartPosition>()[i];
      g.positions()[i] = this->box_.wrap(g.mobility.motion.position(start, time));
      g.template get<field::Velocity>()[i] = g.mobility.motion.velocity(start, time);
    }
  }
  /// Square of the distance from where the particle was when the lists were built.
  template <class G>
  [[nodiscard]] double displacement(const G& g, std::size_t i) const {
    return neighbours::minimum_image<Dim>(g.positions()[i] - g.at_list_build[i], this->box_).squaredNorm();
  }

  template <class G>
  void end(G& g, double dt) {
    if constexpr (evolves<G>)
      for_each_range(g.ranges, [&](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          if constexpr (LayoutOf<G>::has_substeps)
            g.template get<field::Velocity>()[i] += 0.5 * dt * g.template get<field::Acceleration>()[i];  // the second slow kick
          else if constexpr (mobile<G>) Integrator::end(g.template get<field::Velocity>()[i], g.template get<field::Acceleration>()[i], dt);
          for_each_field(typename LayoutOf<G>::rates{}, [&]<class Rate>(Rate) {
            Integrator::end_state(g.template get<typename Rate::integrates>()[i], g.template get<Rate>()[i], dt);
          });
        }
      });
  }

  /// Slow forces are kicks at the two ends of the step; between them the sub-stepped bonds alone move their groups.
  void begin_with_substeps(double dt, double time) {
    const double part = dt / substeps_;
    for_each_group([&](auto& g) {
      using G = std::remove_cvref_t<decltype(g)>;
      if constexpr (!LayoutOf<G>::has_substeps) begin(g, dt, time);
      else
        for_each_particle(g, [&](std::size_t i) {
          g.template get<field::Velocity>()[i] += 0.5 * dt * g.template get<field::Acceleration>()[i];
          for_each_field(typename LayoutOf<G>::rates{}, [&]<class Rate>(Rate) {
            Integrator::begin_state(g.template get<typename Rate::integrates>()[i], g.template get<Rate>()[i], dt);
          });
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
      });
      this->fast_forces();
      for_each_fast(
          [&](auto& g, std::size_t i) { g.template get<field::Velocity>()[i] += 0.5 * part * g.template get<FastAcceleration>()[i]; });
    }
    for_each_group([&](auto& g) {
      using G = std::remove_cvref_t<decltype(g)>;
      if constexpr (LayoutOf<G>::has_substeps && LayoutOf<G>::has_pairs) {
        double farthest = 0.0;
        for (std::size_t i = 0; i < g.size(); ++i) farthest = std::max(farthest, displacement(g, i));
        this->moved_[Base::template index_of<typename G::Tag>()] = std::sqrt(farthest);
      }
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
    for_each_range(g.ranges, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) function(i);
    });
  }

  std::vector<double> farthest_;  // squared, per range, while a group moves
  int substeps_ = 1;
};

}  // namespace dmp::simulation
