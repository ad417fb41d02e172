#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <Eigen/LU>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/lattice_spring/tensor.hpp>
#include <dmp/neighbours/bond_list.hpp>

namespace dmp::lattice_spring::detail {

template <int Dim>
void require_finite(const char* what, const Vector<Dim>& vector, const char* unit) {
  for (int d = 0; d < Dim; ++d) dmp::require_finite(what, vector[d], unit);
}

/// A rotation: columns of unit length at right angles, and right-handed.
template <int Dim>
void require_rotation(const char* what, const Tensor<Dim>& matrix) {
  constexpr double tolerance = 1e-9;
  const double deviation = (matrix.transpose() * matrix - Tensor<Dim>::Identity()).cwiseAbs().maxCoeff();
  if (!(deviation <= tolerance))
    throw ParameterError(std::string(what) + " must be a rotation, |R^T R - 1| <= 1e-9, got a matrix with " + to_text(deviation));
  if (!(matrix.determinant() > 0.0))
    throw ParameterError(std::string(what) + " must be a rotation, determinant 1, got a reflection, determinant " +
                         to_text(matrix.determinant()));
}

/// Both ends of every bond are there.
inline void require_ends(const char* who, std::span<const neighbours::Bond> bonds, std::size_t beads) {
  for (const neighbours::Bond& bond : bonds)
    if (bond.i >= beads || bond.j >= beads)
      throw ParameterError(std::string(who) + ": both ends of a bond must exist (" + std::to_string(beads) + " beads), got bond (" +
                           std::to_string(bond.i) + ", " + std::to_string(bond.j) + ")");
}

inline void require_same_size(const char* who, const char* what, std::size_t size, std::size_t wanted) {
  if (size != wanted)
    throw ParameterError(std::string(who) + ": " + what + " must number " + std::to_string(wanted) + ", got " + std::to_string(size));
}

}  // namespace dmp::lattice_spring::detail
