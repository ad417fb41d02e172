#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>
#include <Eigen/Core>
#include <Eigen/IterativeLinearSolvers>
#include <dmp/core/require.hpp>
#include <dmp/core/simulation_error.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/lattice_spring/detail/checks.hpp>
#include <dmp/lattice_spring/detail/matrix_free.hpp>
#include <dmp/lattice_spring/small_strain.hpp>

namespace dmp::lattice_spring {

/// Which beads are held, in which directions. All others are free.
template <int Dim>
class Supports {
 public:
  explicit Supports(std::size_t beads) : held_(beads) {
    for (auto& one : held_) one.fill(0);
  }
  void hold(std::size_t bead) { held_.at(bead).fill(1); }
  void hold(std::size_t bead, int direction) { held_.at(bead).at(static_cast<std::size_t>(direction)) = 1; }
  [[nodiscard]] bool holds(std::size_t bead, int direction) const noexcept { return held_[bead][static_cast<std::size_t>(direction)] != 0; }
  [[nodiscard]] std::size_t beads() const noexcept { return held_.size(); }

 private:
  std::vector<std::array<std::uint8_t, Dim>> held_;
};

/// Beads that no spring holds in some free direction: a load there would move them without end. `refuse` tells of them before anything is
/// solved; `leave` keeps what moves without force where the start has it, as all motions of a body as a whole.
enum class Mechanisms { refuse, leave };

struct EquilibriumSettings {
  double tolerance = 1e-10;         ///< norm of the forces left over, relative to that at the start
  std::size_t most_iterations = 0;  ///< 0: twice the components of u
  Mechanisms mechanisms = Mechanisms::refuse;
};
inline void validate(const EquilibriumSettings& settings) {
  require(settings.tolerance > 0.0 && settings.tolerance < 1.0, "lattice_spring::EquilibriumSettings: tolerance must be > 0 and < 1",
          settings.tolerance);
}

template <int Dim>
struct Equilibrium {
  std::vector<Vector<Dim>> displacements;  ///< u [m]
  std::size_t iterations = 0;
  double residual = 0.0;  ///< norm of the forces left over, relative to that at the start; 0 if there was none
};

/// Displacements at which the springs balance the `loads` [N] on all free components; none: no loads. Held components stay as `start` has
/// them. Conjugate gradients with Jacobi's preconditioner, BiCGSTAB where there is no energy, both Eigen's. SimulationError if they do not
/// converge: a load on something that moves without force, or D so near its limits that a body hardly resists.
template <int Dim>
[[nodiscard]] Equilibrium<Dim> equilibrium(const SmallStrain<Dim>& body, const Supports<Dim>& supports, std::vector<Vector<Dim>> start,
                                           std::span<const Vector<Dim>> loads = {}, const EquilibriumSettings& settings = {}) {
  validate(settings);
  detail::require_same_size("lattice_spring::equilibrium", "supports", supports.beads(), body.beads());
  detail::require_same_size("lattice_spring::equilibrium", "displacements of the start", start.size(), body.beads());
  if (!loads.empty()) detail::require_same_size("lattice_spring::equilibrium", "loads", loads.size(), body.beads());
  for (const Vector<Dim>& u : start) detail::require_finite<Dim>("lattice_spring::equilibrium: start", u, "m");
  for (const Vector<Dim>& f : loads) detail::require_finite<Dim>("lattice_spring::equilibrium: load", f, "N");
  if (settings.mechanisms == Mechanisms::refuse) {
    const auto loose = body.mechanisms([&](std::uint32_t bead, int d) { return supports.holds(bead, d); });
    if (!loose.empty())
      throw ParameterError(
          "lattice_spring::equilibrium: springs must hold every free bead in all directions (3 not in one plane in 3D), got " +
          std::to_string(loose.size()) + " that can move without force, the first of them bead " + std::to_string(loose.front()));
  }

  const Eigen::Index size = body.size();
  Eigen::VectorXd is_free(size);
  for (Eigen::Index c = 0; c < size; ++c) is_free[c] = supports.holds(static_cast<std::size_t>(c / Dim), static_cast<int>(c % Dim)) ? 0 : 1;
  Eigen::VectorXd force(size);
  body.hold(start.data()->data(), force.data());
  double rounding = std::numeric_limits<double>::epsilon() *
                    body.diagonal().cwiseProduct(Eigen::Map<const Eigen::VectorXd>(start.data()->data(), size)).norm();
  force = -force;
  if (!loads.empty()) force += Eigen::Map<const Eigen::VectorXd>(loads.data()->data(), size);
  force = force.cwiseProduct(is_free).eval();
  const double norm = force.norm();
  Equilibrium<Dim> result{.displacements = std::move(start)};
  if (!(norm > rounding)) return result;  // balanced already

  const detail::FreeStiffness<Dim> matrix(body, is_free);
  const auto solve = [&](auto&& solver) {
    solver.setTolerance(std::max(settings.tolerance, rounding / norm));
    solver.setMaxIterations(settings.most_iterations > 0 ? static_cast<Eigen::Index>(settings.most_iterations) : 2 * size);
    solver.compute(matrix);
    const Eigen::VectorXd found = solver.solve(force);
    result.iterations = static_cast<std::size_t>(solver.iterations());
    result.residual = solver.error();
    if (solver.info() != Eigen::Success || !found.allFinite())
      throw SimulationError(
          "lattice_spring::equilibrium: forces do not balance, since something moves without force or hardly resists (supports, D near its "
          "limits), or iterations were too few",
          {.time = 0.0,
           .step = result.iterations,
           .group = "beads",
           .particle = -1,
           .field = "relative residual",
           .value = result.residual});
    Eigen::Map<Eigen::VectorXd>(result.displacements.data()->data(), size) += found;
  };
  if (body.symmetric()) solve(Eigen::ConjugateGradient<detail::FreeStiffness<Dim>, Eigen::Lower | Eigen::Upper, detail::InverseDiagonal>());
  else solve(Eigen::BiCGSTAB<detail::FreeStiffness<Dim>, detail::InverseDiagonal>());
  return result;
}

}  // namespace dmp::lattice_spring
