#pragma once
#include <Eigen/Eigenvalues>
#include <dmp/core/vector.hpp>
#include <dmp/lattice_spring/tensor.hpp>

namespace dmp::lattice_spring {

/// Principal stresses, the largest (most tensile) first: s1 >= s2 >= s3.
template <int Dim>
[[nodiscard]] Vector<Dim> principal_stresses(const Tensor<Dim>& stress) {
  const Eigen::SelfAdjointEigenSolver<Tensor<Dim>> solver(0.5 * (stress + stress.transpose()), Eigen::EigenvaluesOnly);
  return solver.eigenvalues().reverse();
}

/// Largest shear stress in any plane: (s1 - s3)/2.
template <int Dim>
[[nodiscard]] double largest_shear_stress(const Tensor<Dim>& stress) {
  const Vector<Dim> principal = principal_stresses<Dim>(stress);
  return 0.5 * (principal[0] - principal[Dim - 1]);
}

}  // namespace dmp::lattice_spring
