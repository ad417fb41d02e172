#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>
#include <Eigen/Eigenvalues>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/lattice_spring/body.hpp>
#include <dmp/lattice_spring/detail/checks.hpp>
#include <dmp/lattice_spring/tensor.hpp>

namespace dmp::lattice_spring {

/// H_i = sum of k w n n^T [N/m] over the bonds of bead i, w their weights, n their directions: what holds the bead if all others stand
/// still. Of several lists with a law each: the sum of theirs. The same with damping coefficients for dashpots [N s/m].
template <int Dim>
[[nodiscard]] std::vector<Tensor<Dim>> local_stiffness(std::span<const Vector<Dim>> positions, std::span<const neighbours::Bond> bonds,
                                                       double stiffness) {
  require_not_negative("lattice_spring::local_stiffness: stiffness", stiffness, "N/m");
  detail::require_ends("lattice_spring::local_stiffness", bonds, positions.size());
  std::vector<Tensor<Dim>> sum(positions.size(), Tensor<Dim>::Zero());
  for (const neighbours::Bond& bond : bonds) {
    const Vector<Dim> apart = positions[bond.j] - positions[bond.i];
    const double squared = apart.squaredNorm();
    if (!(squared > 0.0)) continue;  // no direction
    const Tensor<Dim> part = (stiffness * bond.weight / squared) * apart * apart.transpose();
    sum[bond.i] += part;
    sum[bond.j] += part;
  }
  return sum;
}
template <int Dim>
[[nodiscard]] std::vector<Tensor<Dim>> local_stiffness(const Body<Dim>& body, double stiffness) {
  return local_stiffness<Dim>(body.points.positions, body.bonds, stiffness);
}

/// Beads that bonds do not hold in every direction: fewer than Dim bonds, or all in one plane (one line in 2D). They can move without
/// force. Smallest eigenvalue of H_i below 1e-9 of the largest.
template <int Dim>
[[nodiscard]] std::vector<std::uint32_t> mechanisms(std::span<const Tensor<Dim>> local_stiffness) {
  constexpr double least_ratio = 1e-9;
  std::vector<std::uint32_t> loose;
  Eigen::SelfAdjointEigenSolver<Tensor<Dim>> solver;
  for (std::size_t i = 0; i < local_stiffness.size(); ++i) {
    solver.compute(local_stiffness[i], Eigen::EigenvaluesOnly);
    const auto& eigenvalues = solver.eigenvalues();  // ascending
    if (!(eigenvalues[Dim - 1] > 0.0) || eigenvalues[0] < least_ratio * eigenvalues[Dim - 1])
      loose.push_back(static_cast<std::uint32_t>(i));
  }
  return loose;
}
template <int Dim>
[[nodiscard]] std::vector<std::uint32_t> mechanisms(const Body<Dim>& body) {
  return mechanisms<Dim>(local_stiffness(body, 1.0));
}

/// Bound of the highest rate in the motion of beads of one mass [kg]: 2 max lambda_max(H_i)/m. It is omega^2 [1/s^2] of springs, and c
/// [1/s] of dashpots (H_i from damping coefficients). From (u_i - u_j)^2 <= 2 (u_i^2 + u_j^2) along each bond; reached by the cubic
/// lattice, omega^2 = 12 k/m.
template <int Dim>
[[nodiscard]] double highest_rate(std::span<const Tensor<Dim>> local_stiffness, double mass) {
  require_positive("lattice_spring::highest_rate: mass", mass, "kg");
  double largest = 0.0;
  Eigen::SelfAdjointEigenSolver<Tensor<Dim>> solver;
  for (const Tensor<Dim>& one : local_stiffness) {
    if (!(one.trace() > largest)) continue;  // cannot be the largest
    solver.compute(one, Eigen::EigenvaluesOnly);
    largest = std::max(largest, solver.eigenvalues()[Dim - 1]);
  }
  return 2.0 * largest / mass;
}

/// Largest stable step [s] of the leapfrog whose dashpots see the velocity at the half step: omega^2 dt^2 + 2 c dt < 4, so
/// 4/(c + sqrt(c^2 + 4 omega^2)); 2/omega without dashpots, 2/c without springs, infinity without either.
[[nodiscard]] inline double stable_time_step(double omega_squared, double damping_rate = 0.0) {
  require_not_negative("lattice_spring::stable_time_step: omega_squared", omega_squared, "1/s^2");
  require_not_negative("lattice_spring::stable_time_step: damping_rate", damping_rate, "1/s");
  const double sum = damping_rate + std::sqrt(damping_rate * damping_rate + 4.0 * omega_squared);
  return sum > 0.0 ? 4.0 / sum : std::numeric_limits<double>::infinity();
}
/// The same for a body of Kelvin-Voigt bonds, all with one stiffness [N/m] and one damping [N s/m], and beads of one mass [kg].
template <int Dim>
[[nodiscard]] double stable_time_step(const Body<Dim>& body, double mass, double stiffness, double damping = 0.0) {
  require_not_negative("lattice_spring::stable_time_step: stiffness", stiffness, "N/m");
  require_not_negative("lattice_spring::stable_time_step: damping", damping, "N s/m");
  const double per_stiffness = highest_rate<Dim>(local_stiffness(body, 1.0), mass);
  return stable_time_step(per_stiffness * stiffness, per_stiffness * damping);
}

}  // namespace dmp::lattice_spring
