#pragma once
#include <Eigen/Core>

namespace dmp {

/// Position, velocity, force of one particle in Dim = 1, 2 or 3 dimensions.
template <int Dim>
using Vector = Eigen::Matrix<double, Dim, 1>;

}  // namespace dmp
