#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>
#include <Eigen/Core>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/lattice_spring/body.hpp>
#include <dmp/lattice_spring/detail/checks.hpp>
#include <dmp/lattice_spring/local_stiffness.hpp>
#include <dmp/lattice_spring/springs.hpp>
#include <dmp/lattice_spring/tensor.hpp>

namespace dmp::lattice_spring {

/// A body of springs at small displacements u [m] from where it is stress-free: tensions and forces are linear in u, forces = -K u.
/// Elongation e = n . (u_j - u_i); tension T = (1 - |D|) k e + g (q_i + q_j), with q = (D/2)/S sum of h e over the springs of a bead, and
///   energy_consistent  h = g = k L, S = sum of k L^2        by_number  h = k L, g = 1/L, S = number of springs
/// Springs of weight 0 are none. With D = 0 there is one pass over the springs and nothing per bead.
/// M. Kot, ChemEngineering 5 (2021) 3, doi:10.3390/chemengineering5010003, section 2.
template <int Dim>
class SmallStrain {
 public:
  SmallStrain(const Body<Dim>& body, const Springs& springs) : share_(springs.dispersive_share), symmetric_(true) {
    validate(springs);
    const auto& x = body.points.positions;
    detail::require_ends("lattice_spring::SmallStrain", body.bonds, x.size());
    beads_ = x.size();
    all_bonds_ = body.bonds.size();
    const bool by_number = springs.dispersion == Dispersion::by_number;
    symmetric_ = share_ == 0.0 || !by_number;
    springs_.reserve(all_bonds_);
    if (share_ != 0.0) inverse_.assign(beads_, 0.0);
    for (std::uint32_t b = 0; b < all_bonds_; ++b) {
      const neighbours::Bond& bond = body.bonds[b];
      require_not_negative("lattice_spring::SmallStrain: weight of a bond", bond.weight, "");
      if (bond.weight == 0.0) continue;
      const Vector<Dim> apart = x[bond.j] - x[bond.i];
      const double length = apart.norm(), k = springs.stiffness * bond.weight;
      if (!(length > 0.0))
        throw ParameterError("lattice_spring::SmallStrain: the ends of a bond must not coincide, got bond (" + std::to_string(bond.i) +
                             ", " + std::to_string(bond.j) + ")");
      springs_.push_back({bond.i, bond.j, apart / length, k * (1.0 - std::abs(share_) + springs.added_share)});
      bond_.push_back(b);
      if (share_ == 0.0) continue;
      take_.push_back(k * length);
      give_.push_back(by_number ? 1.0 / length : k * length);
      for (const std::uint32_t end : {bond.i, bond.j}) inverse_[end] += by_number ? 1.0 : k * length * length;
    }
    for (double& sum : inverse_) sum = sum > 0.0 ? 0.5 * share_ / sum : 0.0;
  }

  [[nodiscard]] std::size_t beads() const noexcept { return beads_; }
  [[nodiscard]] bool symmetric() const noexcept { return symmetric_; }  ///< whether there is an energy

  /// Tension of each bond [N], > 0 pulls its ends together.
  [[nodiscard]] std::vector<double> tensions(std::span<const Vector<Dim>> displacements) const {
    detail::require_same_size("lattice_spring::SmallStrain", "displacements", displacements.size(), beads_);
    std::vector<double> result(all_bonds_, 0.0);
    visit(displacements.data()->data(), [&](std::size_t s, double tension) { result[bond_[s]] = tension; });
    return result;
  }
  /// Forces on the beads [N], -K u.
  [[nodiscard]] std::vector<Vector<Dim>> forces(std::span<const Vector<Dim>> displacements) const {
    detail::require_same_size("lattice_spring::SmallStrain", "displacements", displacements.size(), beads_);
    std::vector<Vector<Dim>> result(beads_);
    hold(displacements.data()->data(), result.data()->data());
    for (Vector<Dim>& force : result) force = -force;
    return result;
  }
  /// K u [N], the force that it takes to hold each bead at its displacement; all components in a row.
  void hold(const double* displacements, double* forces) const {
    std::fill(forces, forces + size(), 0.0);
    visit(displacements, [&](std::size_t s, double tension) {
      const Spring& spring = springs_[s];
      for (int d = 0; d < Dim; ++d) {
        forces[Dim * spring.i + static_cast<std::size_t>(d)] -= tension * spring.direction[d];
        forces[Dim * spring.j + static_cast<std::size_t>(d)] += tension * spring.direction[d];
      }
    });
  }
  [[nodiscard]] Eigen::Index size() const noexcept { return static_cast<Eigen::Index>(Dim * beads_); }  ///< components of u

  /// (1/2) u K u [J].
  [[nodiscard]] double energy(std::span<const Vector<Dim>> displacements) const {
    detail::require_same_size("lattice_spring::SmallStrain", "displacements", displacements.size(), beads_);
    double sum = 0.0;
    visit(displacements.data()->data(), [&](std::size_t s, double tension) {
      const Spring& spring = springs_[s];
      sum += 0.5 * tension * spring.direction.dot(displacements[spring.j] - displacements[spring.i]);
    });
    return sum;
  }

  /// Diagonal of K [N/m].
  [[nodiscard]] Eigen::VectorXd diagonal() const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(size());
    Eigen::VectorXd given = Eigen::VectorXd::Zero(share_ == 0.0 ? 0 : size()), taken = given;
    for (std::size_t s = 0; s < springs_.size(); ++s) {
      const Spring& spring = springs_[s];
      const auto i = static_cast<Eigen::Index>(Dim * spring.i), j = static_cast<Eigen::Index>(Dim * spring.j);
      const Vector<Dim> n = spring.direction, squared = n.cwiseAbs2();
      sum.template segment<Dim>(i) += spring.direct * squared;
      sum.template segment<Dim>(j) += spring.direct * squared;
      if (share_ == 0.0) continue;
      sum.template segment<Dim>(i) += give_[s] * take_[s] * inverse_[spring.j] * squared;
      sum.template segment<Dim>(j) += give_[s] * take_[s] * inverse_[spring.i] * squared;
      given.template segment<Dim>(i) += give_[s] * n;
      given.template segment<Dim>(j) -= give_[s] * n;
      taken.template segment<Dim>(i) += take_[s] * n;
      taken.template segment<Dim>(j) -= take_[s] * n;
    }
    for (Eigen::Index c = 0; c < given.size(); ++c) sum[c] += given[c] * taken[c] * inverse_[static_cast<std::size_t>(c / Dim)];
    return sum;
  }

  /// Beads that springs do not hold in every direction that is free: smallest eigenvalue of sum of k n n^T there below 1e-9 of the largest;
  /// `held(bead, direction)` says what is not free.
  template <class Held>
  [[nodiscard]] std::vector<std::uint32_t> mechanisms(const Held& held) const {
    std::vector<Tensor<Dim>> stiffness(beads_, Tensor<Dim>::Zero());
    for (const Spring& spring : springs_)
      for (const std::uint32_t end : {spring.i, spring.j}) stiffness[end] += spring.direction * spring.direction.transpose();
    std::vector<std::uint32_t> free;
    std::vector<Tensor<Dim>> own;
    for (std::uint32_t i = 0; i < beads_; ++i) {
      int count = 0;
      for (int d = 0; d < Dim; ++d) count += held(i, d) ? 1 : 0;
      if (count == Dim) continue;
      const double scale = stiffness[i].trace();
      for (int d = 0; d < Dim; ++d)
        if (held(i, d)) {
          stiffness[i].row(d).setZero();
          stiffness[i].col(d).setZero();
          stiffness[i](d, d) = scale;
        }
      free.push_back(i);
      own.push_back(stiffness[i]);
    }
    std::vector<std::uint32_t> loose = lattice_spring::mechanisms<Dim>(own);
    for (std::uint32_t& bead : loose) bead = free[bead];
    return loose;
  }

 private:
  struct Spring {
    std::uint32_t i, j;
    Vector<Dim> direction;  // from i to j
    double direct;          // k (1 - |D|), and what is added
  };
  [[nodiscard]] static double elongation(const Spring& spring, const double* u) noexcept {
    double sum = 0.0;
    for (int d = 0; d < Dim; ++d)
      sum += spring.direction[d] * (u[Dim * spring.j + static_cast<std::size_t>(d)] - u[Dim * spring.i + static_cast<std::size_t>(d)]);
    return sum;
  }
  /// Calls function(spring, tension) for all springs.
  template <class Function>
  void visit(const double* u, Function&& function) const {
    if (share_ == 0.0) {
      for (std::size_t s = 0; s < springs_.size(); ++s) function(s, springs_[s].direct * elongation(springs_[s], u));
      return;
    }
    std::vector<double> q(beads_, 0.0), e(springs_.size());
    for (std::size_t s = 0; s < springs_.size(); ++s) {
      const Spring& spring = springs_[s];
      e[s] = elongation(spring, u);
      q[spring.i] += take_[s] * e[s];
      q[spring.j] += take_[s] * e[s];
    }
    for (std::size_t i = 0; i < beads_; ++i) q[i] *= inverse_[i];
    for (std::size_t s = 0; s < springs_.size(); ++s)
      function(s, springs_[s].direct * e[s] + give_[s] * (q[springs_[s].i] + q[springs_[s].j]));
  }

  std::size_t beads_ = 0, all_bonds_ = 0;
  double share_;
  bool symmetric_;
  std::vector<Spring> springs_;
  std::vector<std::uint32_t> bond_;  // of each spring
  std::vector<double> take_, give_;  // of each spring, D != 0 only
  std::vector<double> inverse_;      // (D/2)/S of each bead, D != 0 only
};

}  // namespace dmp::lattice_spring
