#pragma once
#include <cstdint>
#include <vector>
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <dmp/lattice_spring/small_strain.hpp>

namespace dmp::lattice_spring::detail {
template <int Dim>
class FreeStiffness;
}  // namespace dmp::lattice_spring::detail

namespace Eigen::internal {
template <int Dim>
struct traits<dmp::lattice_spring::detail::FreeStiffness<Dim>> : traits<SparseMatrix<double>> {};
}  // namespace Eigen::internal

namespace dmp::lattice_spring::detail {

/// K of a body between the components that are free, for Eigen's iterative solvers: rows and columns of the others are 0, so that what
/// begins with 0 there stays so.
template <int Dim>
class FreeStiffness : public Eigen::EigenBase<FreeStiffness<Dim>> {
 public:
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  enum : int { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic, IsRowMajor = false };

  FreeStiffness(const SmallStrain<Dim>& body, const Eigen::VectorXd& is_free) : body_(&body), is_free_(&is_free) {}
  [[nodiscard]] Eigen::Index rows() const { return body_->size(); }
  [[nodiscard]] Eigen::Index cols() const { return body_->size(); }
  template <class Rhs>
  [[nodiscard]] Eigen::Product<FreeStiffness, Rhs, Eigen::AliasFreeProduct> operator*(const Eigen::MatrixBase<Rhs>& x) const {
    return {*this, x.derived()};
  }
  /// y += alpha K x
  template <class To>
  void add_product(To& y, const Eigen::Ref<const Eigen::VectorXd>& x, double alpha) const {
    product_.resize(rows());
    body_->hold(x.data(), product_.data());
    y += alpha * product_.cwiseProduct(*is_free_);
  }
  [[nodiscard]] Eigen::VectorXd inverse_diagonal() const {
    const Eigen::VectorXd diagonal = body_->diagonal();
    const double least = 1e-12 * diagonal.cwiseAbs().maxCoeff();
    Eigen::VectorXd inverse = *is_free_;
    for (Eigen::Index c = 0; c < inverse.size(); ++c) inverse[c] = diagonal[c] > least && inverse[c] != 0.0 ? 1.0 / diagonal[c] : 1.0;
    return inverse;
  }

 private:
  const SmallStrain<Dim>* body_;
  const Eigen::VectorXd* is_free_;  // 1 where free, 0 elsewhere
  mutable Eigen::VectorXd product_;
};

/// Jacobi's preconditioner of a matrix that knows its inverse diagonal.
class InverseDiagonal {
 public:
  template <class Matrix>
  InverseDiagonal& analyzePattern(const Matrix&) {
    return *this;
  }
  template <class Matrix>
  InverseDiagonal& factorize(const Matrix& matrix) {
    inverse_ = matrix.inverse_diagonal();
    return *this;
  }
  template <class Matrix>
  InverseDiagonal& compute(const Matrix& matrix) {
    return factorize(matrix);
  }
  template <class Rhs>
  [[nodiscard]] Eigen::VectorXd solve(const Rhs& b) const {
    return inverse_.cwiseProduct(b);
  }
  [[nodiscard]] Eigen::ComputationInfo info() const { return Eigen::Success; }

 private:
  Eigen::VectorXd inverse_;
};

}  // namespace dmp::lattice_spring::detail

namespace Eigen::internal {
template <int Dim, class Rhs>
struct generic_product_impl<dmp::lattice_spring::detail::FreeStiffness<Dim>, Rhs, SparseShape, DenseShape, GemvProduct>
    : generic_product_impl_base<dmp::lattice_spring::detail::FreeStiffness<Dim>, Rhs,
                                generic_product_impl<dmp::lattice_spring::detail::FreeStiffness<Dim>, Rhs>> {
  template <class To>
  static void scaleAndAddTo(To& to, const dmp::lattice_spring::detail::FreeStiffness<Dim>& matrix, const Rhs& x, const double& alpha) {
    matrix.add_product(to, x, alpha);
  }
};
}  // namespace Eigen::internal
