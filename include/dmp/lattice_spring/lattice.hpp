#pragma once
#include <array>
#include <concepts>
#include <cstddef>
#include <numbers>
#include <string>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/lattice_spring/detail/checks.hpp>
#include <dmp/lattice_spring/tensor.hpp>

/// Lattices of springs that are isotropic at small strain: nodes at node + basis() (i, j, k), bonds to some neighbours, cells that fill
/// space. A turned lattice turns about `node`, which is always one of its points.
namespace dmp::lattice_spring {

/// Offset from one node to another in lattice steps.
template <int Dim>
using Steps = std::array<int, Dim>;

/// A bond from every node to the one `to` steps away, the later of the two; `weight` times the stiffness of the law inside a body.
template <int Dim>
struct LatticeBond {
  Steps<Dim> to;
  double weight;
};

/// Contract of a lattice of springs.
///   dimension        static constexpr int
///   node             [m], position of one node
///   basis()          [m], columns: the steps along i, j, k, turned
///   bonds()          static; std::array of LatticeBond, to nodes later in the order k, j, i
///   cells()          static; std::array of cells, each the Steps to its corners (0, ..., 0) among them; equal volumes, together one node's
///   validate(lattice)
template <class L>
concept SpringLattice = requires(const L lattice) {
  { L::dimension } -> std::convertible_to<int>;
  { lattice.node } -> std::convertible_to<Vector<L::dimension>>;
  { lattice.basis() } -> std::convertible_to<Tensor<L::dimension>>;
  { L::bonds()[0] } -> std::convertible_to<LatticeBond<L::dimension>>;
  { L::cells()[0][0] } -> std::convertible_to<Steps<L::dimension>>;
  {validate(lattice)};
};

/// Simple cubic lattice with springs of one stiffness k to the 6 nearest and the 12 face-diagonal neighbours: lambda = mu = k/l,
/// E = 2.5 k/l, nu = 1/4. A generic direction: .orientation = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix().
/// M. Sahputra, A. Alexiadis, M. J. Adams, ChemEngineering 4 (2020) 30, doi:10.3390/chemengineering4020030.
struct CubicLattice {
  static constexpr int dimension = 3;
  Required<double> spacing;                       ///< l [m], > 0
  Vector<3> node = Vector<3>::Zero();             ///< [m]
  Tensor<3> orientation = Tensor<3>::Identity();  ///< a rotation about `node`

  [[nodiscard]] Tensor<3> basis() const { return orientation * double(spacing); }
  [[nodiscard]] static constexpr std::array<LatticeBond<3>, 9> bonds() noexcept {
    return {{{{1, 0, 0}, 1.0},
             {{0, 1, 0}, 1.0},
             {{0, 0, 1}, 1.0},
             {{1, 1, 0}, 1.0},
             {{-1, 1, 0}, 1.0},
             {{1, 0, 1}, 1.0},
             {{-1, 0, 1}, 1.0},
             {{0, 1, 1}, 1.0},
             {{0, -1, 1}, 1.0}}};
  }
  [[nodiscard]] static constexpr std::array<std::array<Steps<3>, 8>, 1> cells() noexcept {
    return {{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}}}};
  }
};

/// Triangular lattice in 2D, one stiffness k to the 6 nearest neighbours: lambda = mu = sqrt(3)/4 k, E = (2/sqrt(3)) k, nu = 1/3
/// [N/m, per metre of depth Pa]. Steps: along x, and at 60 degrees to it.
struct TriangularLattice {
  static constexpr int dimension = 2;
  Required<double> spacing;                       ///< l [m], > 0
  Vector<2> node = Vector<2>::Zero();             ///< [m]
  Tensor<2> orientation = Tensor<2>::Identity();  ///< a rotation about `node`

  [[nodiscard]] Tensor<2> basis() const {
    const Tensor<2> steps{{1.0, 0.5}, {0.0, 0.5 * std::numbers::sqrt3}};
    return orientation * steps * double(spacing);
  }
  [[nodiscard]] static constexpr std::array<LatticeBond<2>, 3> bonds() noexcept { return {{{{1, 0}, 1.0}, {{0, 1}, 1.0}, {{-1, 1}, 1.0}}}; }
  [[nodiscard]] static constexpr std::array<std::array<Steps<2>, 3>, 2> cells() noexcept {
    return {{{{{0, 0}, {1, 0}, {0, 1}}}, {{{0, 0}, {0, 1}, {-1, 1}}}}};
  }
};

/// Square lattice in 2D with diagonals. It is isotropic if the edges are twice as stiff as the diagonals: those have weight 1/2. With the
/// stiffness k of an edge inside a body, lambda = mu = k/2, E = (4/3) k, nu = 1/3 [N/m].
struct SquareLattice {
  static constexpr int dimension = 2;
  Required<double> spacing;                       ///< l [m], > 0
  Vector<2> node = Vector<2>::Zero();             ///< [m]
  Tensor<2> orientation = Tensor<2>::Identity();  ///< a rotation about `node`

  [[nodiscard]] Tensor<2> basis() const { return orientation * double(spacing); }
  [[nodiscard]] static constexpr std::array<LatticeBond<2>, 4> bonds() noexcept {
    return {{{{1, 0}, 1.0}, {{0, 1}, 1.0}, {{1, 1}, 0.5}, {{-1, 1}, 0.5}}};
  }
  [[nodiscard]] static constexpr std::array<std::array<Steps<2>, 4>, 1> cells() noexcept { return {{{{{0, 0}, {1, 0}, {0, 1}, {1, 1}}}}}; }
};

namespace detail {
template <class L>
void validate_lattice(const std::string& name, const L& lattice) {
  require_positive((name + ": spacing").c_str(), lattice.spacing, "m");
  require_finite<L::dimension>((name + ": node").c_str(), lattice.node, "m");
  require_rotation<L::dimension>((name + ": orientation").c_str(), lattice.orientation);
}
}  // namespace detail
inline void validate(const CubicLattice& lattice) { detail::validate_lattice("lattice_spring::CubicLattice", lattice); }
inline void validate(const TriangularLattice& lattice) { detail::validate_lattice("lattice_spring::TriangularLattice", lattice); }
inline void validate(const SquareLattice& lattice) { detail::validate_lattice("lattice_spring::SquareLattice", lattice); }

}  // namespace dmp::lattice_spring
