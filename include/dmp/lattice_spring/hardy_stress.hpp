#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/lattice_spring/body.hpp>
#include <dmp/lattice_spring/detail/checks.hpp>
#include <dmp/lattice_spring/tensor.hpp>
#include <dmp/neighbours/cell_grid.hpp>

namespace dmp::lattice_spring {

/// Volume common to two balls of radii R and r [m] with centres d [m] apart:
/// pi (R + r - d)^2 (d^2 + 2 d r - 3 r^2 + 2 d R + 6 r R - 3 R^2)/(12 d) where they cut each other, the smaller ball where it lies inside.
[[nodiscard]] inline double ball_overlap(double R, double r, double d) {
  require_not_negative("lattice_spring::ball_overlap: radius", R, "m");
  require_not_negative("lattice_spring::ball_overlap: radius", r, "m");
  require_not_negative("lattice_spring::ball_overlap: distance", d, "m");
  const double smaller = std::min(R, r);
  if (d >= R + r) return 0.0;
  if (d <= std::abs(R - r)) return 4.0 / 3.0 * std::numbers::pi * cube(smaller);
  return std::numbers::pi * square(R + r - d) * (d * d + 2.0 * d * (r + R) - 3.0 * square(r - R)) / (12.0 * d);
}

/// Stress averaged over a ball: sigma = (1/V_p) sum over the bonds, each once, of B L T n n^T, tension positive; V_p = (4/3) pi R_p^3, B
/// the share of the ball around the bond's midpoint with the bond as diameter that lies in the probe. Mean over all of space: the virial.
/// R_p = 1.5 mean bond length averages over about a coordination shell.
/// M. Kot, ChemEngineering 5 (2021) 3, doi:10.3390/chemengineering5010003 (the formula printed there lacks 1/V_p); R. J. Hardy, J. Chem.
/// Phys. 76 (1982) 622, doi:10.1063/1.442714.
class HardyStress {
 public:
  /// Positions, bonds and tensions [N] (weights included) as they are now.
  HardyStress(std::span<const neighbours::Bond> bonds, std::span<const double> tensions, std::span<const Vector<3>> positions) {
    detail::require_same_size("lattice_spring::HardyStress", "tensions", tensions.size(), bonds.size());
    detail::require_ends("lattice_spring::HardyStress", bonds, positions.size());
    double total = 0.0;
    for (std::size_t b = 0; b < bonds.size(); ++b) {
      const Vector<3> apart = positions[bonds[b].j] - positions[bonds[b].i];
      const double length = apart.norm();
      if (!(length > 0.0)) continue;  // no direction
      midpoint_.push_back(0.5 * (positions[bonds[b].i] + positions[bonds[b].j]));
      vector_.push_back(apart);
      tension_per_length_.push_back(tensions[b] / length);
      longest_ = std::max(longest_, length);
      total += length;
    }
    if (midpoint_.empty()) throw ParameterError("lattice_spring::HardyStress: bonds must number 1 or more with a length > 0 m, got none");
    mean_length_ = total / static_cast<double>(midpoint_.size());
    grid_.build(midpoint_, longest_);
  }

  [[nodiscard]] double mean_length() const noexcept { return mean_length_; }  ///< of the bonds [m]

  /// Stress [Pa] in the ball of radius `radius` [m] around `centre`; 0: 1.5 mean bond lengths.
  [[nodiscard]] Tensor<3> at(const Vector<3>& centre, double radius = 0.0) const {
    require_not_negative("lattice_spring::HardyStress: radius", radius, "m");
    if (radius == 0.0) radius = 1.5 * mean_length_;
    std::vector<std::uint32_t> found;
    grid_.find(centre, radius + 0.5 * longest_, neighbours::CellGrid<3>::nobody, found);
    std::sort(found.begin(), found.end());  // the same sum however the grid was made
    Tensor<3> sum = Tensor<3>::Zero();
    for (const std::uint32_t b : found) {
      const double half = 0.5 * vector_[b].norm();
      const double share = ball_overlap(radius, half, (midpoint_[b] - centre).norm()) / (4.0 / 3.0 * std::numbers::pi * cube(half));
      sum += share * tension_per_length_[b] * vector_[b] * vector_[b].transpose();
    }
    return sum / (4.0 / 3.0 * std::numbers::pi * cube(radius));
  }

 private:
  std::vector<Vector<3>> midpoint_, vector_;
  std::vector<double> tension_per_length_;
  double longest_ = 0.0, mean_length_ = 0.0;
  neighbours::CellGrid<3> grid_;
};

}  // namespace dmp::lattice_spring
