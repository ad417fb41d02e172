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
#include <dmp/simulation/scene.hpp>

namespace dmp::simulation {

struct RelaxOptions {
  Required<double> force_tolerance;            ///< at rest when no particle feels more [N], > 0
  std::uint64_t most_evaluations = 1000000;    ///< of the forces, before it gives up
  double time = -1.0;                          ///< [s] as forcings and driven groups see it; negative: the time of the scene
  bool without_rotation = false;  ///< all mobile particles together do not turn: for a free body that would roll under its load
};
struct RelaxReport {
  std::uint64_t evaluations = 0;  ///< of the forces
  double largest_force = 0.0;     ///< on any particle [N]
};

namespace detail {

/// Takes the rigid rotation about the centre of mass out of velocities and accelerations of all mobile groups together.
template <int Dim, class Engine>
void remove_rotation(Engine& engine) {
  static_assert(Dim > 1, "dmp: relax: nothing rotates on a line");
  constexpr int turns = Dim == 2 ? 1 : 3;  // about the normal of the plane, or about x, y, z
  using Turn = Eigen::Matrix<double, turns, 1>;
  using Arms = Eigen::Matrix<double, Dim, turns>;  // times a turn: velocity at x
  const auto arms = [](const Vector<Dim>& x) -> Arms {
    if constexpr (Dim == 2) return Arms(-x[1], x[0]);
    else return (Arms() << 0.0, x[2], -x[1], -x[2], 0.0, x[0], x[1], -x[0], 0.0).finished();
  };
  const auto for_each_mobile = [&engine](const auto& function) {
    engine.for_each_group([&](auto& g) {
      if constexpr (particles::is_mobile<typename std::remove_cvref_t<decltype(g)>::Mobility>) function(g);
    });
  };
  double mass = 0.0;
  Vector<Dim> centre = Vector<Dim>::Zero();
  for_each_mobile([&](auto& g) {
    mass += g.mass * static_cast<double>(g.size());
    centre += g.mass * sum_over_rows(g.blocks, Vector<Dim>(Vector<Dim>::Zero()), [&](std::size_t i) { return g.positions()[i]; });
  });
  centre /= mass;
  Eigen::Matrix<double, turns, turns + 2> sums = Eigen::Matrix<double, turns, turns + 2>::Zero();  // inertia, angular momentum, torque
  for_each_mobile([&](auto& g) {
    const Eigen::Matrix<double, turns, turns + 2> none = Eigen::Matrix<double, turns, turns + 2>::Zero();
    sums += g.mass * sum_over_rows(g.blocks, none, [&](std::size_t i) {
      const Arms arm = arms(g.positions()[i] - centre);
      Eigen::Matrix<double, turns, turns + 2> one;
      one.template leftCols<turns>() = arm.transpose() * arm;
      one.col(turns) = arm.transpose() * g.template get<field::Velocity>()[i];
      one.col(turns + 1) = arm.transpose() * g.template get<field::Acceleration>()[i];
      return one;
    });
  });
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, turns, turns>> inertia(sums.template leftCols<turns>());
  const auto solve = [&](const Turn& right) {  // without the turns that move nothing: of a row of beads about itself
    Turn result = Turn::Zero();
    for (int k = 0; k < turns; ++k)
      if (inertia.eigenvalues()[k] > 1e-12 * inertia.eigenvalues()[turns - 1])
        result += inertia.eigenvectors().col(k).dot(right) / inertia.eigenvalues()[k] * inertia.eigenvectors().col(k);
    return result;
  };
  const Turn turn = solve(sums.col(turns)), turning = solve(sums.col(turns + 1));
  for_each_mobile([&](auto& g) {
    for_each_range(g.blocks.ranges(), [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const Arms arm = arms(g.positions()[i] - centre);
        g.template get<field::Velocity>()[i] -= arm * turn;
        g.template get<field::Acceleration>()[i] -= arm * turning;
      }
    });
  });
}

}  // namespace detail

/// Brings the mobile groups of a scene to rest in a minimum of their energy, by damped dynamics (FIRE): velocities are turned towards the
/// forces while these do work, and set to zero when they do not. The clock of the scene stands still; velocities are zero afterwards, and
/// accelerations those at `time`. For bonds, potentials and forcings of position; what damps serves no purpose. The same bits for any
/// number of threads. Throws SimulationError if it does not converge.
/// Takes a number of evaluations that grows as the square root of stiffest over softest: twice as many for twice the beads across.
/// E. Bitzek, P. Koskinen, F. Gaehler, M. Moseler, P. Gumbsch, Phys. Rev. Lett. 97 (2006) 170201, doi:10.1103/PhysRevLett.97.170201.
template <int Dim, class Integrator, class Precision, class... Item>
RelaxReport relax(Scene<Dim, Integrator, Precision, Item...>& scene, const RelaxOptions& options) {
  using Engine = Engine<Dim, Integrator, Precision, Item...>;
  static_assert(!Engine::has_substeps, "dmp: relax: sub-stepped bonds have no use where nothing moves in time; make them bonds<...>");
  static_assert(!([] {
    if constexpr (is_bonds<Item>) return bond::HasMemory<decltype(Item::law)>;
    return false;
  }() || ...), "dmp: relax: the tension of a bond with memory depends on time, so there is no energy to minimise");
  require_positive("relax: force_tolerance", options.force_tolerance, "N");
  constexpr double first_mixing = 0.1, mixing_decay = 0.99, growth = 1.1, shrinkage = 0.5, safety = 0.9;
  constexpr int patience = 5;             // steps downhill before the step grows
  constexpr std::uint64_t look_every = 20;  // evaluations after which bounds of the step are looked at again
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
  const auto look = [&] {
    if constexpr (Dim > 1)
      if (options.without_rotation) detail::remove_rotation<Dim>(engine);
    Sums sums;
    for_each_mobile([&](auto& g, auto& velocity, auto& acceleration) {
      const double mass = g.mass;
      sums += sum_over_rows(g.blocks, Sums{}, [&](std::size_t i) {
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
    engine.evaluate(time, scene.step());
    ++report.evaluations;
    return look();
  };
  Sums now = look_from_rest();
  double longest = longest_step(), dt = 0.25 * longest, mixing = first_mixing;
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
    if (report.evaluations % look_every == 0) {
      longest = longest_step();
      dt = std::fmin(dt, longest);
    }
    if (!(longest < std::numeric_limits<double>::infinity()))
      throw ParameterError("relax: no law of this scene bounds the time step, so nothing comes to rest");
    const bool worn = engine.begin_step(dt, time);
    if (worn) engine.build_lists(false);
    engine.prepare_forces(dt, scene.step(), worn);
    engine.forces(dt, time);
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
