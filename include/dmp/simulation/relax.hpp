#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <Eigen/Eigenvalues>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>
#include <dmp/core/simulation_error.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/particles/mobility.hpp>
#include <dmp/simulation/contacts.hpp>
#include <dmp/simulation/scene.hpp>

namespace dmp::simulation {

struct RelaxOptions {
  Required<double> force_tolerance;          ///< at rest when no particle feels more [N], > 0
  std::uint64_t most_evaluations = 1000000;  ///< of the forces, before it gives up
  double time = -1.0;                        ///< [s] as forcings and driven groups see it; negative: the time of the scene
  bool without_rotation = false;             ///< all mobile particles together do not turn: for a free body that would roll under its load
};
struct RelaxReport {
  std::uint64_t evaluations = 0;  ///< of the forces
  double largest_force = 0.0;     ///< on any particle [N]
};

namespace detail {

/// A particle that a contact plane bears keeps its place on it.
template <class G>
[[nodiscard]] bool turns_with_body([[maybe_unused]] const G& g, [[maybe_unused]] std::size_t i) noexcept {
  if constexpr (meets_planes<G>) return g.template get<ContactForce>()[i].isZero(0.0);
  else return true;
}

/// The rigid rotation about the centre of mass, of all mobile groups together.
template <int Dim>
struct Rotation {
  static constexpr int turns = Dim == 1 ? 0 : Dim == 2 ? 1 : 3;  // about the normal of the plane, or about x, y, z
  using Turn = Eigen::Matrix<double, turns, 1>;
  using Arms = Eigen::Matrix<double, Dim, turns>;
  Vector<Dim> centre = Vector<Dim>::Zero();  // [m]
  Turn speed = Turn::Zero();                 // angular velocity [1/s]
  Turn rate = Turn::Zero();                  // angular acceleration [1/s^2]

  /// arms(x) times a turn: the velocity at x.
  [[nodiscard]] static Arms arms(const Vector<Dim>& x) noexcept {
    Arms result;
    if constexpr (Dim == 2) {
      result[0] = -x[1], result[1] = x[0];
    } else if constexpr (Dim == 3) {
      result.setZero();
      result(0, 1) = x[2], result(0, 2) = -x[1];
      result(1, 0) = -x[2], result(1, 2) = x[0];
      result(2, 0) = x[1], result(2, 1) = -x[0];
    }
    return result;
  }
  void find(auto& engine) {
    struct Moments {  // about the last centre
      Vector<Dim> position = Vector<Dim>::Zero(), velocity = Vector<Dim>::Zero(), acceleration = Vector<Dim>::Zero();
      Eigen::Matrix<double, turns, turns> inertia = Eigen::Matrix<double, turns, turns>::Zero();
      Turn spin = Turn::Zero(), torque = Turn::Zero();
      double mass = 0.0;
      void operator+=(const Moments& other) { add(1.0, other); }
      void add(double factor, const Moments& other) {
        position += factor * other.position;
        velocity += factor * other.velocity;
        acceleration += factor * other.acceleration;
        inertia += factor * other.inertia;
        spin += factor * other.spin;
        torque += factor * other.torque;
        mass += factor * other.mass;
      }
    };
    Moments all;
    engine.for_each_group([&](auto& g) {
      if constexpr (particles::is_mobile<typename std::remove_cvref_t<decltype(g)>::Mobility>)
        all.add(g.mass, sum_over_rows(g.blocks, Moments{}, [&](std::size_t i) {
                  Moments one;
                  if (!turns_with_body(g, i)) return one;
                  one.position = g.positions()[i] - centre;
                  one.velocity = g.template get<field::Velocity>()[i];
                  one.acceleration = g.template get<field::Acceleration>()[i];
                  const Arms arm = arms(one.position);
                  one.inertia = arm.transpose() * arm;
                  one.spin = arm.transpose() * one.velocity;
                  one.torque = arm.transpose() * one.acceleration;
                  one.mass = 1.0;
                  return one;
                }));
    });
    if (!(all.mass > 0.0)) return;
    const Vector<Dim> shift = all.position / all.mass;
    const Arms arm = arms(shift);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, turns, turns>> inertia(all.inertia - all.mass * (arm.transpose() * arm));
    const auto solve = [&inertia](const Turn& right) {  // without the turns that move nothing: of a row of beads about itself
      Turn result = Turn::Zero();
      for (int k = 0; k < turns; ++k)
        if (inertia.eigenvalues()[k] > 1e-12 * inertia.eigenvalues()[turns - 1])
          result += inertia.eigenvectors().col(k).dot(right) / inertia.eigenvalues()[k] * inertia.eigenvectors().col(k);
      return result;
    };
    centre += shift;
    speed = solve(all.spin - arm.transpose() * all.velocity);
    rate = solve(all.torque - arm.transpose() * all.acceleration);
  }
  void remove(const Vector<Dim>& x, Vector<Dim>& velocity, Vector<Dim>& acceleration) const noexcept {
    const Arms arm = arms(x - centre);
    velocity -= arm * speed;
    acceleration -= arm * rate;
  }
};

}  // namespace detail

/// Brings the mobile groups of a scene to rest in a minimum of their energy, by damped dynamics (FIRE): velocities are turned towards the
/// forces while these do work, and set to zero when they do not. The clock of the scene stands still; velocities are zero afterwards, and
/// accelerations those at `time`. For bonds, potentials, forcings of position, and contact planes: these bear what presses at them, and
/// what is behind one is put on it first. What damps serves no purpose. The same bits for any number of threads. Throws SimulationError if
/// it does not converge.
/// Takes a number of evaluations that grows as the square root of stiffest over softest: twice as many for twice the beads across.
/// E. Bitzek, P. Koskinen, F. Gaehler, M. Moseler, P. Gumbsch, Phys. Rev. Lett. 97 (2006) 170201, doi:10.1103/PhysRevLett.97.170201.
template <int Dim, class Integrator, class Precision, class... Item>
RelaxReport relax(Scene<Dim, Integrator, Precision, Item...>& scene, const RelaxOptions& options) {
  static_assert(!Engine<Dim, Integrator, Precision, Item...>::has_substeps,
                "dmp: relax: sub-stepped bonds have no use where nothing moves in time; make them bonds<...>");
  static_assert(!([] {
    if constexpr (is_bonds<Item>) return bond::HasMemory<decltype(Item::law)>;
    return false;
  }() || ...),
                "dmp: relax: the tension of a bond with memory depends on time, so there is no energy to minimise");
  static_assert(!([] {
    if constexpr (is_bonds<Item>) return bond::CanBreak<decltype(Item::law)>;
    return false;
  }() || ...),
                "dmp: relax: bonds that break would do so on the way to the minimum; relax with the law inside of bond::Breaking");
  require_positive("relax: force_tolerance", options.force_tolerance, "N");
  constexpr bool has_contacts = (is_confined<Item> || ...);
  constexpr double first_mixing = 0.1, mixing_decay = 0.99, growth = 1.1, shrinkage = 0.5, safety = 0.9;
  constexpr int patience = 5;               // steps downhill before the step grows
  constexpr std::uint64_t look_every = 20;  // evaluations after which bounds of the step are looked at again ...
  constexpr double look_at = 1.5;           // ... or factor by which the largest force has grown: planes and potentials stiffen with it
  auto& engine = scene.engine();
  (void)scene.step_limit();  // checks the scene, and evaluates it
  const double time = options.time >= 0.0 ? options.time : scene.time();
  const auto longest_step = [&] { return safety * find_step_limit<Integrator>(engine, time, false).stable_time_step; };

  const auto for_each_mobile = [&engine](const auto& function) {  // function(group, velocities, accelerations)
    engine.for_each_group([&](auto& g) {
      using G = std::remove_cvref_t<decltype(g)>;
      static_assert(std::is_same_v<typename G::Layout::rates, Fields<>>,
                    "dmp: relax: a group has a state with a rate (density, energy), so its energy is not one of positions alone");
      if constexpr (particles::is_mobile<typename G::Mobility>)
        function(g, g.template get<field::Velocity>(), g.template get<field::Acceleration>());
    });
  };
  const auto stop = [&] {
    for_each_mobile([](auto& g, auto& velocity, auto&) {
      for_each_range(g.blocks.ranges(), [&](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) velocity[i].setZero();
      });
    });
  };
  struct Sums {
    double power = 0.0, speeds = 0.0, forces = 0.0;  // sums of m a . v, m v^2, m a^2
    double largest = 0.0;                            // squared force on any particle
    bool finite = true;
    void operator+=(const Sums& other) {
      power += other.power;
      speeds += other.speeds;
      forces += other.forces;
      largest = std::fmax(largest, other.largest);
      finite = finite && other.finite;
    }
  };
  [[maybe_unused]] detail::Rotation<Dim> rotation;
  const auto look = [&] {
    if constexpr (has_contacts) rest_on_planes(engine, time);
    if constexpr (Dim > 1)
      if (options.without_rotation) rotation.find(engine);
    Sums sums;
    for_each_mobile([&](auto& g, auto& velocity, auto& acceleration) {
      const double mass = g.mass;
      sums += sum_over_rows(g.blocks, Sums{}, [&](std::size_t i) {
        if constexpr (Dim > 1)
          if (options.without_rotation && detail::turns_with_body(g, i)) rotation.remove(g.positions()[i], velocity[i], acceleration[i]);
        if constexpr (particles::is_roller<typename std::remove_cvref_t<decltype(g)>::Mobility>) {  // what is held does not come to rest
          velocity[i] -= g.mobility.held(velocity[i]);
          acceleration[i] -= g.mobility.held(acceleration[i]);
        }
        const double squared = acceleration[i].squaredNorm();
        return Sums{mass * acceleration[i].dot(velocity[i]), mass * velocity[i].squaredNorm(), mass * squared, mass * mass * squared,
                    squared < std::numeric_limits<double>::infinity()};
      });
    });
    return sums;
  };

  RelaxReport report;
  const auto look_from_rest = [&] {
    stop();
    if constexpr (has_contacts) put_before_planes(engine, time);
    engine.evaluate(time, scene.step());
    ++report.evaluations;
    return look();
  };
  Sums now = look_from_rest();
  double longest = longest_step(), dt = 0.25 * longest, mixing = first_mixing, force_then = std::sqrt(now.largest);
  int downhill = 0;
  for (bool moving = false;;) {
    report.largest_force = std::sqrt(now.largest);
    if (now.finite && report.largest_force <= options.force_tolerance) {
      if (!moving) return report;
      now = look_from_rest();  // without what depends on velocities
      moving = false;
      continue;
    }
    if (!now.finite || report.evaluations >= options.most_evaluations)
      throw SimulationError("relax: not at rest after " + std::to_string(report.evaluations) + " evaluations",
                            {time, scene.step(), "", -1, "largest force [N]", report.largest_force});
    if (report.evaluations % look_every == 0 || report.largest_force > look_at * force_then) {
      force_then = report.largest_force;
      const double bound = longest_step();
      if (dt > bound / safety) stop();              // the last step was too long for what it met
      longest = std::fmin(bound, look_at * longest);  // what is stiff and has just been left is met again
      dt = std::fmin(dt, longest);
    }
    if (!(longest < std::numeric_limits<double>::infinity()))
      throw ParameterError("relax: no law of this scene bounds the time step, so nothing comes to rest");
    const bool worn = engine.begin_step(dt, time);
    if (worn) engine.build_lists();
    engine.prepare_forces(dt, scene.step(), worn);
    engine.forces(has_contacts ? 0.0 : dt, time);  // planes stand still, as if there were no next step: rest_on_planes
    engine.end_step(dt);
    ++report.evaluations;
    moving = true;
    now = look();
    if (now.power > 0.0) {
      const double turn = mixing * std::sqrt(now.speeds / now.forces), keep = 1.0 - mixing;
      for_each_mobile([&](auto& g, auto& velocity, auto& acceleration) {
        for_each_range(g.blocks.ranges(), [&](std::size_t, std::size_t first, std::size_t last) {
          for (std::size_t i = first; i < last; ++i) velocity[i] = keep * velocity[i] + turn * acceleration[i];
        });
      });
      if (++downhill > patience) {
        dt = std::fmin(growth * dt, longest);
        mixing *= mixing_decay;
      }
    } else {
      stop();
      dt *= shrinkage;
      mixing = first_mixing;
      downhill = 0;
    }
  }
}

}  // namespace dmp::simulation
