#pragma once
#include <Eigen/Core>

namespace dmp::lattice_spring {

/// A second-rank tensor: rotation, stress, sum of k n n^T over the bonds of a bead.
template <int Dim>
using Tensor = Eigen::Matrix<double, Dim, Dim>;

}  // namespace dmp::lattice_spring
