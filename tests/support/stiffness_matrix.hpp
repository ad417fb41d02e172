#pragma once
#include <cstddef>
#include <Eigen/Eigenvalues>
#include <dmp/lattice_spring/lattice.hpp>

namespace test {

/// Largest eigenvalue of the whole stiffness matrix of springs of stiffness 1.
[[nodiscard]] inline double largest_eigenvalue(const dmp::lattice_spring::Body<3>& body) {
  const auto size = static_cast<Eigen::Index>(3 * body.points.positions.size());
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size);
  for (const auto& bond : body.bonds) {
    const dmp::Vector<3> n = (body.points.positions[bond.j] - body.points.positions[bond.i]).normalized();
    const Eigen::Matrix3d block = bond.weight * n * n.transpose();
    const Eigen::Index i = 3 * static_cast<Eigen::Index>(bond.i), j = 3 * static_cast<Eigen::Index>(bond.j);
    stiffness.block<3, 3>(i, i) += block;
    stiffness.block<3, 3>(j, j) += block;
    stiffness.block<3, 3>(i, j) -= block;
    stiffness.block<3, 3>(j, i) -= block;
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness, Eigen::EigenvaluesOnly).eigenvalues()[size - 1];
}

}  // namespace test
