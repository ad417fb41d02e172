#pragma once
#include <concepts>
#include <dmp/core/vector.hpp>

namespace dmp::geometry {

/// A vector without default, as Required<> (core/required.hpp) is for numbers: an aggregate that leaves it out does not compile.
/// It is an Eigen vector in every other respect, and takes its components in braces: `.lower = {0.0, 0.0}`.
template <int Dim>
struct RequiredVector : Vector<Dim> {
  using Vector<Dim>::operator=;

  template <class Expression>
  RequiredVector(const Eigen::MatrixBase<Expression>& given) : Vector<Dim>(given) {}
  template <std::convertible_to<double>... Number>
    requires(sizeof...(Number) == Dim)
  RequiredVector(Number... component) : Vector<Dim>(static_cast<double>(component)...) {}
};

}  // namespace dmp::geometry
