#pragma once
#include <Eigen/Core>
#include <dmp/core/components.hpp>

namespace dmp {

/// Position, velocity, force of one particle in Dim = 1, 2 or 3 dimensions.
template <int Dim>
using Vector = Eigen::Matrix<double, Dim, 1>;

/// From a vector to what laws see of it, and back.
template <int Dim>
[[nodiscard]] Components<Dim, double> to_components(const Vector<Dim>& v) noexcept {
  Components<Dim, double> result;
  for (int d = 0; d < Dim; ++d) result[d] = v[d];
  return result;
}
template <int Dim>
[[nodiscard]] Vector<Dim> to_vector(const Components<Dim, double>& c) noexcept {
  Vector<Dim> result;
  for (int d = 0; d < Dim; ++d) result[d] = c[d];
  return result;
}

}  // namespace dmp
