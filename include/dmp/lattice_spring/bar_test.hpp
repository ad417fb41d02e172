#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/shape.hpp>
#include <dmp/lattice_spring/body.hpp>
#include <dmp/lattice_spring/equilibrium.hpp>
#include <dmp/lattice_spring/local_strain.hpp>
#include <dmp/lattice_spring/section_force.hpp>
#include <dmp/lattice_spring/small_strain.hpp>
#include <dmp/lattice_spring/springs.hpp>

namespace dmp::lattice_spring {

/// Ends of a bar that move along it and may grow thicker or thinner, or not.
enum class Grips { sliding, clamped };

/// A bar along x, drawn by small uniform displacements of its ends, its sides free.
template <int Dim>
struct BarTest {
  geometry::Cuboid<Dim> outline;  ///< [m], of which length and sections are taken
  Required<double> grip;          ///< [m]: beads nearer than this to an end are its grip
  Grips grips = Grips::sliding;
  EquilibriumSettings solver{};
};
template <int Dim>
void validate(const BarTest<Dim>& test) {
  static_assert(Dim >= 2);
  validate(test.outline);
  require_positive("lattice_spring::BarTest: grip", test.grip, "m");
  validate(test.solver);
}

struct BarElasticity {
  double youngs_modulus = 0.0;            ///< E = F_x/(A_x e) [Pa]
  double youngs_modulus_corrected = 0.0;  ///< less nu times the stresses across, which are about 0 with free sides: eq. 24
  double poisson_ratio = 0.0;             ///< -(strain across)/e, of the beads in the middle half, by least squares
  std::size_t iterations = 0;
};

/// Young's modulus and Poisson ratio of a bar. Section forces are means over 8 planes in the middle half (lengthwise forces are the same on
/// all). M. Kot, ChemEngineering 5 (2021) 3, doi:10.3390/chemengineering5010003, eq. 24.
template <int Dim>
[[nodiscard]] BarElasticity measure_bar(const Body<Dim>& body, const Springs& springs, const BarTest<Dim>& test) {
  validate(test);
  const auto& x = body.points.positions;
  const Vector<Dim>&lower = test.outline.lower, size = test.outline.upper - lower;
  const SmallStrain<Dim> strained(body, springs);
  Supports<Dim> supports(x.size());
  std::vector<Vector<Dim>> u(x.size(), Vector<Dim>::Zero());  // for a strain of 1: all is linear
  std::vector<std::uint32_t> middle;
  std::array<bool, 2> gripped{};
  for (std::uint32_t i = 0; i < x.size(); ++i) {
    const double from_end = x[i][0] - lower[0];
    u[i][0] = from_end;
    if (std::abs(from_end - 0.5 * size[0]) < 0.25 * size[0]) middle.push_back(i);
    const bool first = from_end < test.grip, last = size[0] - from_end < test.grip;
    gripped = {gripped[0] || first, gripped[1] || last};
    if (!first && !last) continue;
    if (test.grips == Grips::clamped) supports.hold(i);
    else supports.hold(i, 0);
  }
  if (!gripped[0] || !gripped[1])
    throw ParameterError("lattice_spring::measure_bar: each end of the outline must have beads within grip, " + to_text(test.grip) +
                         " m, got none at one");
  const auto found = equilibrium<Dim>(strained, supports, std::move(u), {}, test.solver);
  const auto tension = strained.tensions(found.displacements);

  const Tensor<Dim> gradient = displacement_gradient<Dim>(x, found.displacements, middle);
  constexpr int planes = 8;
  Vector<Dim> stress = Vector<Dim>::Zero();  // normal to each section
  for (int d = 0; d < Dim; ++d)
    for (int plane = 0; plane < planes; ++plane) {
      const double at = lower[d] + size[d] * (0.25 + 0.5 * (plane + 0.4142) / planes);  // not through the beads of a lattice
      stress[d] += section_force<Dim>(body.bonds, tension, x, d, at)[d] * size[d] / size.prod() / planes;
    }
  BarElasticity result{.youngs_modulus = stress[0], .iterations = found.iterations};
  double across = 0.0;
  for (int d = 1; d < Dim; ++d) across += gradient(d, d) / (Dim - 1);
  result.poisson_ratio = -across;
  result.youngs_modulus_corrected = stress[0] - result.poisson_ratio * (stress.sum() - stress[0]);
  return result;
}

}  // namespace dmp::lattice_spring
