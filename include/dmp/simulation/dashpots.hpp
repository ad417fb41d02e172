#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>
#include <dmp/bond/kelvin_voigt.hpp>
#include <dmp/core/aligned.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/simulation/forces.hpp>

namespace dmp::simulation {

/// The dashpots of `implicit_bonds`, however stiff: a part of the acceleration that depends on the velocity at the end of the step.
///   v_half = v + (dt/2) a,  x += dt v_half,  (M + (dt/2) B(x)) v = M v_half + (dt/2) f(x),  a = M^-1 (f - B v)
/// f [N] are all other forces, B [N s/m] has a block c n n^T for each bond. Only before the first step a = M^-1 (f - B v_half) instead. The
/// v_half are those of an implicit half step of the dashpots before the motion and an explicit one after it, without what that does to v
/// where stiff bonds turn. Second order, and c bounds no step. Motion that is damped within a step dies out slowly, changing sign at each:
/// forces and velocities should not jump during a run.
///
/// Solved by conjugate gradients, preconditioned with the masses. Each iteration asks the bonds once, and keeps momentum and angular
/// momentum to rounding; their number grows as the square root of 1 + (dt/2) lambda, the fastest rate of damping. M. R. Hestenes, E.
/// Stiefel, J. Res. Nat. Bur. Stand. 49 (1952) 409-436, doi:10.6028/jres.049.044.
template <int Dim, class Integrator, class Precision, class... Item>
class Dashpots : public Forces<Dim, Integrator, Precision, Item...> {
  using Base = Forces<Dim, Integrator, Precision, Item...>;

 public:
  using Base::Base, Base::for_each_group, Base::for_each_item;
  static constexpr bool has_dashpots = (detail::solves_dashpots<Item> || ...);
  static constexpr int most_iterations = 10000;

  /// False if a step has not been solved to the tolerance that its items ask for.
  [[nodiscard]] bool dashpots_converged() const noexcept { return converged_; }
  /// Beside what groups and items hold.
  [[nodiscard]] std::size_t bytes() const noexcept {
    std::size_t bytes = Base::bytes();
    for (const Work& work : work_) bytes += 4 * work.change.size() * sizeof(Vector<Dim>);
    return bytes;
  }

 protected:
  /// Adds the dashpots to the accelerations, at the velocities after a kick of (dt/2) a.
  void add_dashpots(double dt) {
    show([dt](const auto& g, const Work&, std::size_t i) -> Vector<Dim> {
      return g.template get<field::Velocity>()[i] + 0.5 * dt * g.template get<field::Acceleration>()[i];
    });
    drag();
    each([](auto& g, Work& work, std::size_t i) {  // the first residual of (M + (dt/2) B) change = -B v
      work.change[i] = Vector<Dim>::Zero();
      work.residual[i] = -work.drag[i];
      work.direction[i] = work.residual[i] / g.mass;
    });
    walls_move_ = false;  // what they do is in the residual
    double size = size_of_residual();
    const double enough = std::max(square(tolerance()) * size, std::numeric_limits<double>::min());
    int iterations = 0;
    for (; size > enough && iterations < most_iterations; ++iterations) {
      show([](const auto&, const Work& work, std::size_t i) -> const Vector<Dim>& { return work.direction[i]; });
      drag();
      each([dt](auto& g, Work& work, std::size_t i) { work.drag[i] = g.mass * work.direction[i] + 0.5 * dt * work.drag[i]; });
      const double step = size / total([](const auto&, const Work& work, std::size_t i) { return work.direction[i].dot(work.drag[i]); });
      each([step](auto&, Work& work, std::size_t i) {
        work.change[i] += step * work.direction[i];
        work.residual[i] -= step * work.drag[i];
      });
      const double before = std::exchange(size, size_of_residual());
      each(
          [&](auto& g, Work& work, std::size_t i) { work.direction[i] = work.residual[i] / g.mass + (size / before) * work.direction[i]; });
    }
    walls_move_ = true;
    if (!(size <= enough && size < std::numeric_limits<double>::infinity())) converged_ = false;
    each([](auto& g, Work& work, std::size_t i) { g.template get<field::Acceleration>()[i] += work.change[i]; });
    show(
        [](const auto& g, const Work&, std::size_t i) -> const Vector<Dim>& { return g.template get<field::Velocity>()[i]; });  // as before
  }

 private:
  struct Work {
    AlignedVector<Vector<Dim>> change, residual, direction, drag;  // [m/s^2], [N], [m/s^2], [N]
  };
  template <class G>
  static constexpr bool has_ends = ((detail::solves_dashpots<Item> && detail::joins<typename std::remove_cvref_t<G>::Tag, Item>) ||
                                    ...);
  template <class G>
  static constexpr bool is_solved_for = has_ends<G>&& Base::template mobile<G>;

  [[nodiscard]] double tolerance() const {
    double least = 1.0;
    for_each_item([&least](const auto& active) {
      if constexpr (detail::solves_dashpots<std::remove_cvref_t<decltype(active.item)>>)
        least = std::min(least, active.item.law.tolerance);
    });
    return least;
  }
  template <class Function>
  void for_each_solved(Function&& function) {
    std::size_t index = 0;
    for_each_group([&](auto& g) {
      Work& work = work_[index++];
      if constexpr (is_solved_for<decltype(g)>) {
        for (auto* const values : {&work.change, &work.residual, &work.direction, &work.drag}) values->resize(g.size());
        function(g, work);
      }
    });
  }
  template <class Function>
  void each(Function&& function) {
    for_each_solved([&](auto& g, Work& work) {
      for_each_range(g.blocks.ranges(), [&](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) function(g, work, i);
      });
    });
  }
  /// Sum of term(g, work, i), the same for any number of threads.
  template <class Term>
  [[nodiscard]] double total(Term&& term) {
    double sum = 0.0;
    for_each_solved(
        [&](auto& g, Work& work) { sum += sum_over_rows(g.blocks, 0.0, [&](std::size_t i) { return term(g, work, i); }); });
    return sum;
  }
  [[nodiscard]] double size_of_residual() {
    return total([](const auto& g, const Work& work, std::size_t i) { return work.residual[i].squaredNorm() / g.mass; });
  }
  /// Writes positions, and as velocities what `velocity` says of the groups that are solved for, into the records in which bonds look.
  template <class Function>
  void show(Function&& velocity) {
    std::size_t index = 0;
    for_each_group([&](auto& g) {
      using G = std::remove_cvref_t<decltype(g)>;
      const Work& work = work_[index++];
      if constexpr (has_ends<G>)
        for_each_range(g.blocks.ranges(), [&](std::size_t, std::size_t first, std::size_t last) {
          for (std::size_t i = first; i < last; ++i) {
            Vector<Dim> seen = Vector<Dim>::Zero();
            if constexpr (is_solved_for<G>) seen = velocity(std::as_const(g), work, i);
            else if (walls_move_) seen = this->seen_velocity(g, i, 0.0);
            double* const record = g.records.data() + i * static_cast<std::size_t>(G::Records::stride);
            for (int d = 0; d < Dim; ++d) {
              record[d] = g.positions()[i][d];
              record[Dim + d] = seen[d];
            }
          }
        });
    });
  }
  /// work.drag = B times the velocities that the records show.
  void drag() {
    for_each_solved([&](auto& g, Work& work) {
      using G = std::remove_cvref_t<decltype(g)>;
      for_each_block(g.blocks, [&](std::size_t, std::size_t block) {
        const auto add = g.sums.adder();
        for_each_item([&](auto& active) {
          using I = std::remove_cvref_t<decltype(active.item)>;
          if constexpr (detail::solves_dashpots<I>) {
            const auto& law = active.item.law.dashpot;
            const auto none = [](std::size_t) { return sweep::NoMemory{}; };
            if constexpr (std::is_same_v<typename G::Tag, typename I::A>)
              this->template bonds<typename I::B>(g, block, active.of_a, add, law, none);
            else if constexpr (std::is_same_v<typename G::Tag, typename I::B>)
              this->template bonds<typename I::A>(g, block, active.of_b, add, law, none);
          }
        });
        for (std::size_t i = g.blocks.begin(block); i < g.blocks.end(block); ++i) {
          View<Dim, typename Base::Lanes, typename G::Layout::writes> nothing;
          sweep::set_zero(nothing);
          work.drag[i] = -to_vector<Dim>(g.sums.take(i, nothing).force);
          if constexpr (particles::is_roller<typename G::Mobility>) work.drag[i] -= g.mobility.held(work.drag[i]);
        }
      });
    });
  }

  std::array<Work, Base::Groups::count> work_;
  bool converged_ = true, walls_move_ = true;
};

}  // namespace dmp::simulation
