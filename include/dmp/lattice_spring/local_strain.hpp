#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>
#include <Eigen/Cholesky>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/lattice_spring/detail/checks.hpp>
#include <dmp/lattice_spring/tensor.hpp>
#include <dmp/neighbours/cell_grid.hpp>

namespace dmp::lattice_spring {

/// Displacement gradient G of some beads by least squares: u_i - <u> = G (x_i - <x>). Exact for any uniform strain; the small strain is
/// (G + G^T)/2. ParameterError if the beads lie in one plane (on one line in 2D).
template <int Dim>
[[nodiscard]] Tensor<Dim> displacement_gradient(std::span<const Vector<Dim>> positions, std::span<const Vector<Dim>> displacements,
                                                std::span<const std::uint32_t> beads) {
  detail::require_same_size("lattice_spring::displacement_gradient", "displacements", displacements.size(), positions.size());
  Vector<Dim> mean_x = Vector<Dim>::Zero(), mean_u = mean_x;
  for (const std::uint32_t i : beads) {
    mean_x += positions[i] / static_cast<double>(beads.size());
    mean_u += displacements[i] / static_cast<double>(beads.size());
  }
  Tensor<Dim> xx = Tensor<Dim>::Zero(), xu = xx;
  for (const std::uint32_t i : beads) {
    const Vector<Dim> x = positions[i] - mean_x;
    xx += x * x.transpose();
    xu += x * (displacements[i] - mean_u).transpose();
  }
  const Eigen::LDLT<Tensor<Dim>> factors(xx);
  const Vector<Dim> pivots = factors.vectorD();
  if (!(pivots.minCoeff() > 1e-12 * pivots.maxCoeff()))
    throw ParameterError("lattice_spring::displacement_gradient: more than " + std::to_string(Dim) +
                         " beads, not in one plane, are needed, got " + std::to_string(beads.size()));
  return factors.solve(xu).transpose();
}

/// Strain at a point: that of the beads in a ball around it, by least squares.
template <int Dim>
class LocalStrain {
 public:
  /// Positions without strain, and displacements [m].
  LocalStrain(std::span<const Vector<Dim>> positions, std::span<const Vector<Dim>> displacements, double radius)
      : positions_(positions.begin(), positions.end()), displacements_(displacements.begin(), displacements.end()), radius_(radius) {
    require_positive("lattice_spring::LocalStrain: radius", radius, "m");
    detail::require_same_size("lattice_spring::LocalStrain", "displacements", displacements.size(), positions.size());
    grid_.build(positions_, radius);
  }
  /// Displacement gradient in the ball around `centre`.
  [[nodiscard]] Tensor<Dim> at(const Vector<Dim>& centre) const {
    std::vector<std::uint32_t> found;
    grid_.find(centre, radius_, neighbours::CellGrid<Dim>::nobody, found);
    std::erase_if(found, [&](std::uint32_t i) { return !((positions_[i] - centre).norm() <= radius_); });
    std::sort(found.begin(), found.end());
    return displacement_gradient<Dim>(positions_, displacements_, found);
  }

 private:
  std::vector<Vector<Dim>> positions_, displacements_;
  double radius_;
  neighbours::CellGrid<Dim> grid_;
};

}  // namespace dmp::lattice_spring
