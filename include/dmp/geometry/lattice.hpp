#pragma once
#include <array>
#include <concepts>
#include <numbers>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/detail/checks.hpp>

/// Lattices, to fill shapes with particles. A lattice is a rectangular cell, repeated without end, and the sites in it. The sites lie
/// symmetrically in the cell, none on its faces: a box of whole cells is filled alike up to each of its walls and across periodic ones.
namespace dmp::geometry {

/// Contract of a lattice.
///   dimension           static constexpr int
///   origin              [m], a corner of one cell
///   cell()              edge lengths of the cell [m]
///   sites()             std::array of the sites, in fractions of the edges, 0 <= fraction < 1
///   nearest_distance()  [m], between neighbouring points
///   validate(lattice)   free function; throws ParameterError on bad parameters
template <class L>
concept Lattice = requires(const L lattice) {
  { lattice.origin } -> std::convertible_to<Vector<L::dimension>>;
  { lattice.cell() } -> std::convertible_to<Vector<L::dimension>>;
  { lattice.sites()[0] } -> std::convertible_to<Vector<L::dimension>>;
  { lattice.sites().size() } -> std::convertible_to<std::size_t>;
  { lattice.nearest_distance() } -> std::convertible_to<double>;
  { validate(lattice) };
};

/// Volume per point [m^Dim]: mass of a particle = density * volume.
template <Lattice L>
[[nodiscard]] double volume_per_point(const L& lattice) {
  return lattice.cell().prod() / static_cast<double>(lattice.sites().size());
}

/// Points at origin + (i + 1/2) spacing in each direction; the square lattice in 2D. Volume per point spacing^Dim.
template <int Dim>
struct Cubic {
  static constexpr int dimension = Dim;
  Required<double> spacing;                   ///< [m], > 0
  Vector<Dim> origin = Vector<Dim>::Zero();  ///< [m]

  [[nodiscard]] Vector<Dim> cell() const { return Vector<Dim>::Constant(spacing); }
  [[nodiscard]] std::array<Vector<Dim>, 1> sites() const { return {Vector<Dim>::Constant(0.5)}; }
  [[nodiscard]] double nearest_distance() const noexcept { return spacing; }
};
template <int Dim>
void validate(const Cubic<Dim>& lattice) {
  require_positive("geometry::Cubic: spacing", lattice.spacing, "m");
  detail::require_finite<Dim>("geometry::Cubic: origin", lattice.origin, "m");
}

/// Triangular lattice in 2D: rows along x, sqrt(3)/2 spacing apart, every other one shifted by half a spacing; each point has six
/// neighbours at `spacing`. Cell spacing x sqrt(3) spacing with two points; volume per point sqrt(3)/2 spacing^2.
struct Hexagonal {
  static constexpr int dimension = 2;
  Required<double> spacing;              ///< [m], > 0
  Vector<2> origin = Vector<2>::Zero();  ///< [m]

  [[nodiscard]] Vector<2> cell() const { return {spacing, std::numbers::sqrt3 * spacing}; }
  [[nodiscard]] std::array<Vector<2>, 2> sites() const { return {Vector<2>{0.25, 0.25}, Vector<2>{0.75, 0.75}}; }
  [[nodiscard]] double nearest_distance() const noexcept { return spacing; }
};
inline void validate(const Hexagonal& lattice) {
  require_positive("geometry::Hexagonal: spacing", lattice.spacing, "m");
  detail::require_finite<2>("geometry::Hexagonal: origin", lattice.origin, "m");
}

/// Face-centred cubic lattice in 3D: four points per cubic cell, each with twelve neighbours at lattice_constant / sqrt(2).
/// Volume per point lattice_constant^3 / 4.
struct FaceCentredCubic {
  static constexpr int dimension = 3;
  Required<double> lattice_constant;     ///< edge of the cubic cell [m], > 0
  Vector<3> origin = Vector<3>::Zero();  ///< [m]

  [[nodiscard]] Vector<3> cell() const { return Vector<3>::Constant(lattice_constant); }
  [[nodiscard]] std::array<Vector<3>, 4> sites() const {
    return {Vector<3>{0.25, 0.25, 0.25}, Vector<3>{0.75, 0.75, 0.25}, Vector<3>{0.75, 0.25, 0.75}, Vector<3>{0.25, 0.75, 0.75}};
  }
  [[nodiscard]] double nearest_distance() const noexcept { return lattice_constant / std::numbers::sqrt2; }
};
inline void validate(const FaceCentredCubic& lattice) {
  require_positive("geometry::FaceCentredCubic: lattice_constant", lattice.lattice_constant, "m");
  detail::require_finite<3>("geometry::FaceCentredCubic: origin", lattice.origin, "m");
}

}  // namespace dmp::geometry
