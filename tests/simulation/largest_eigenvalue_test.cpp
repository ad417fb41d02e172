// The largest eigenvalue in closed form, which bounds of the time step of bonds ask for, beside Eigen's iterative solver.
#include <Eigen/Eigenvalues>
#include <random>
#include <doctest/doctest.h>
#include <dmp/simulation/holds.hpp>

using dmp::simulation::detail::largest_eigenvalue;

namespace {

template <int Dim>
void check(const Eigen::Matrix<double, Dim, Dim>& h) {
  const double expected = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Dim, Dim>>(h, Eigen::EigenvaluesOnly).eigenvalues()[Dim - 1];
  CAPTURE(h);
  CHECK(std::abs(largest_eigenvalue<Dim>(h) - expected) <= 1e-8 * h.norm());
}

template <int Dim>
void check_all() {
  using Matrix = Eigen::Matrix<double, Dim, Dim>;
  using Vector = Eigen::Matrix<double, Dim, 1>;
  check<Dim>(Matrix::Zero());
  check<Dim>(3.0 * Matrix::Identity());
  check<Dim>(-2.0 * Matrix::Identity());
  std::mt19937 generator(1);
  std::normal_distribution<double> number;
  for (int n = 0; n < 1000; ++n) {
    Matrix any;
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) any(a, b) = number(generator);
    const Vector x = any.col(0).normalized();
    const double scale = std::pow(10.0, n % 40 - 20);
    check<Dim>(scale * (any + any.transpose()));
    check<Dim>(scale * (x * x.transpose()));                                            // one bond
    check<Dim>(scale * (Matrix::Identity() - x * x.transpose()));                       // the largest twice
    check<Dim>(scale * (Matrix::Identity() + 1e-10 * (any + any.transpose())));         // nearly all the same
  }
}

}  // namespace

TEST_CASE("largest eigenvalue of symmetric matrices on the line, in the plane and in space, from 1e-20 to 1e19, also where some coincide") {
  check_all<1>();
  check_all<2>();
  check_all<3>();
}
