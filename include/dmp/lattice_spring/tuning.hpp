#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/lattice_spring/body.hpp>
#include <dmp/lattice_spring/equilibrium.hpp>
#include <dmp/lattice_spring/interior.hpp>
#include <dmp/lattice_spring/network_elasticity.hpp>
#include <dmp/lattice_spring/small_strain.hpp>
#include <dmp/lattice_spring/springs.hpp>

namespace dmp::lattice_spring {

/// How far, and how long, a network is tuned.
struct Tuning {
  double largest_change = 0.5;     ///< of the weight of a bond from what it was, relative: keeps weights > 0
  double imbalance = 3e-4;         ///< S_kL of the inner beads at which it ends
  double least_step = 0.002;       ///< it ends also when no weight changes by more than this in a step, relative
  std::size_t most_steps = 25;     ///< linear solves
  double solver_tolerance = 1e-4;  ///< of each of them
};
inline void validate(const Tuning& tuning) {
  require(tuning.largest_change > 0.0 && tuning.largest_change < 1.0, "lattice_spring::Tuning: largest_change must be > 0 and < 1",
          tuning.largest_change);
  require_not_negative("lattice_spring::Tuning: imbalance", tuning.imbalance, "");
  require_not_negative("lattice_spring::Tuning: least_step", tuning.least_step, "");
  require(tuning.most_steps >= 1, "lattice_spring::Tuning: most_steps must be >= 1", static_cast<double>(tuning.most_steps));
  require(tuning.solver_tolerance > 0.0 && tuning.solver_tolerance < 1.0, "lattice_spring::Tuning: solver_tolerance must be > 0 and < 1",
          tuning.solver_tolerance);
}

/// Why a tuning ended. `nothing_to_do`: no bead lies a bond length below the surface; weights are as before. `stagnated`: bonds at the
/// limit of change keep the rest from balance, or a further step changes nothing.
enum class TuningEnd { nothing_to_do, balanced, stagnated, most_steps };

struct TuningReport {
  TuningEnd end = TuningEnd::nothing_to_do;
  std::size_t steps = 0;
  std::size_t solves = 0, iterations = 0;              ///< of K u = f, and of conjugate gradients in them: each one pass over all bonds
  double imbalance_before = 0.0, imbalance = 0.0;      ///< S_kL of the inner beads
  double smallest_factor = 1.0, largest_factor = 1.0;  ///< of weights, with the common factor of the interior
};

namespace detail {

/// Inner beads of a body and what kL-tune does to the weights of its bonds.
template <int Dim>
class Balance {
 public:
  template <class S>
  Balance(Body<Dim>& body, const S& shape, double reach, const Tuning& tuning)
      : body_(&body), tuning_(tuning), supports_(body.points.positions.size()), inner_(body.points.positions.size(), 0) {
    const auto& x = body.points.positions;
    for (std::size_t i = 0; i < x.size(); ++i) {
      inner_[i] = depth_in(shape, x[i]) >= reach ? 1 : 0;
      count_ += inner_[i];
      if (inner_[i] == 0) supports_.hold(i);
    }
    for (std::size_t b = 0; b < body.bonds.size(); ++b) {
      const neighbours::Bond& bond = body.bonds[b];
      const Vector<Dim> apart = x[bond.j] - x[bond.i];
      original_.push_back(bond.weight);
      apart_.push_back(apart);
      squared_.push_back(apart.squaredNorm());
      middle_.push_back(depth_in(shape, Vector<Dim>(0.5 * (x[bond.i] + x[bond.j]))) >= reach ? 1 : 0);
    }
    level_ = level();
  }
  [[nodiscard]] std::size_t inner_beads() const noexcept { return count_; }
  [[nodiscard]] const std::vector<Vector<Dim>>& apart() const noexcept { return apart_; }
  [[nodiscard]] double squared_length(std::size_t bond) const noexcept { return squared_[bond]; }
  /// Sum of w L^2 over the bonds inside, which the interior's bulk modulus goes by.
  [[nodiscard]] double level() const {
    double sum = 0.0;
    for (std::size_t b = 0; b < middle_.size(); ++b)
      if (middle_[b] != 0) sum += body_->bonds[b].weight * squared_[b];
    return sum;
  }
  [[nodiscard]] double level_before() const noexcept { return level_; }

  [[nodiscard]] double imbalance() const {
    std::vector<Vector<Dim>> force(inner_.size(), Vector<Dim>::Zero());
    std::vector<double> sum(inner_.size(), 0.0);
    for (std::size_t b = 0; b < apart_.size(); ++b) {
      const neighbours::Bond& bond = body_->bonds[b];
      const Vector<Dim> part = bond.weight * apart_[b];
      const double size = bond.weight * std::sqrt(squared_[b]);
      force[bond.i] += part;
      force[bond.j] -= part;
      sum[bond.i] += size;
      sum[bond.j] += size;
    }
    double total = 0.0;
    for (std::size_t i = 0; i < inner_.size(); ++i)
      if (inner_[i] != 0 && sum[i] > 0.0) total += force[i].norm() / sum[i];
    return count_ > 0 ? total / static_cast<double>(count_) : 0.0;
  }

  /// Forces k L n on the inner beads, and what moves them into equilibrium, K u = f. Each weight becomes w (1 + n . (u_j - u_i)/L) as far
  /// as it may change; `relaxation` times that change. Returns the largest relative change.
  double step(double tolerance, double relaxation) {
    std::vector<Vector<Dim>> force(inner_.size(), Vector<Dim>::Zero());
    for (std::size_t b = 0; b < apart_.size(); ++b) {
      const neighbours::Bond& bond = body_->bonds[b];
      force[bond.i] += bond.weight * apart_[b];
      force[bond.j] -= bond.weight * apart_[b];
    }
    const auto found = equilibrium<Dim>(SmallStrain<Dim>(*body_, {.stiffness = 1.0}), supports_,
                                        std::vector<Vector<Dim>>(inner_.size(), Vector<Dim>::Zero()), force,
                                        {.tolerance = tolerance, .mechanisms = Mechanisms::leave});
    ++solves_;
    iterations_ += found.iterations;
    const auto& u = found.displacements;
    double largest = 0.0;
    for (std::size_t b = 0; b < apart_.size(); ++b) {
      const neighbours::Bond& bond = body_->bonds[b];
      if (squared_[b] > 0.0)
        largest = std::max(largest, change(b, bond.weight * (1.0 + relaxation * apart_[b].dot(u[bond.j] - u[bond.i]) / squared_[b])));
    }
    return largest;
  }
  /// Gives a bond another weight, as near as it may; returns by how much it changes, relative.
  double change(std::size_t b, double weight) {
    const double range = tuning_.largest_change * original_[b], now = body_->bonds[b].weight;
    const double next = std::clamp(weight, original_[b] - range, original_[b] + range);
    body_->bonds[b].weight = next;
    return now > 0.0 ? std::abs(next / now - 1.0) : 0.0;
  }

  /// Brings the interior back to the bulk modulus it had: all weights by one factor.
  void finish(TuningReport& report) {
    const double now = level();
    const double factor = now > 0.0 ? level_ / now : 1.0;
    report.smallest_factor = std::numeric_limits<double>::infinity();
    report.largest_factor = 0.0;
    for (std::size_t b = 0; b < apart_.size(); ++b) {
      double& weight = body_->bonds[b].weight;
      weight *= factor;
      if (original_[b] == 0.0) continue;
      report.smallest_factor = std::min(report.smallest_factor, weight / original_[b]);
      report.largest_factor = std::max(report.largest_factor, weight / original_[b]);
    }
    report.imbalance = imbalance();
    report.solves = solves_;
    report.iterations = iterations_;
  }

 private:
  Body<Dim>* body_;
  Tuning tuning_;
  Supports<Dim> supports_;
  std::vector<std::uint8_t> inner_, middle_;
  std::vector<double> original_, squared_;
  std::vector<Vector<Dim>> apart_;
  std::size_t count_ = 0, solves_ = 0, iterations_ = 0;
  double level_ = 0.0;
};

}  // namespace detail

/// kL-tune: weights for which sum of k L n vanishes on every bead at least `reach` [m], the longest bond, below the surface of `shape`, so
/// that a uniform strain leaves no force there. Each step lets the inner beads of the uniformly stretched network relax, K u = f, and gives
/// each bond the tension that it then has: k (1 + n . (u_j - u_i)/L), within the limit of change. Without that limit one step would do;
/// with it, some 25 bring the imbalance of a network with 18 bonds per bead from 0.11 to 0.0004, and bonds at the limit keep it from 0. At
/// the end all weights are multiplied by one number, which gives the interior the (affine) bulk modulus back that it had. Points do not
/// move. Bonds between border beads stay as they are, but for that number.
/// M. Kot, ChemEngineering 5 (2021) 3, doi:10.3390/chemengineering5010003, section 4; solved at once, not by steepest descent as there.
template <int Dim, SolidShape S>
[[nodiscard]] TuningReport tune_balance(Body<Dim>& body, const S& shape, double reach, const Tuning& tuning = {}) {
  validate(tuning);
  validate(shape);
  require_positive("lattice_spring::tune_balance: reach", reach, "m");
  detail::require_ends("lattice_spring::tune_balance", body.bonds, body.points.positions.size());
  detail::Balance<Dim> balance(body, shape, reach, tuning);
  TuningReport report;
  if (balance.inner_beads() == 0) return report;
  report.imbalance_before = balance.imbalance();
  report.end = TuningEnd::most_steps;
  double imbalance = report.imbalance_before;
  for (; report.steps < tuning.most_steps; ++report.steps) {
    if (imbalance <= tuning.imbalance) {
      report.end = TuningEnd::balanced;
      break;
    }
    if (balance.step(tuning.solver_tolerance, report.steps == 0 ? 1.0 : 1.8) < tuning.least_step) {  // 1.8: half as many steps
      ++report.steps;
      report.end = TuningEnd::stagnated;
      break;
    }
    imbalance = balance.imbalance();
  }
  if (report.steps > 0) balance.finish(report);
  else report.imbalance = imbalance;
  if (report.imbalance <= tuning.imbalance) report.end = TuningEnd::balanced;
  return report;
}

}  // namespace dmp::lattice_spring
