#pragma once
#include <vector>
#include <dmp/geometry/fill.hpp>
#include <dmp/neighbours/bond_list.hpp>

namespace dmp::lattice_spring {

/// A solid of beads and bonds: `points` for a group of a scene, `bonds` for bonds<...>(law, body.bonds).
/// The weights of the bonds multiply the law; `points.volume` is the volume per bead, so that mass = density * points.volume.
template <int Dim>
struct Body {
  geometry::Points<Dim> points;
  std::vector<neighbours::Bond> bonds;
  double volume = 0.0;  ///< of the whole body [m^Dim]; 0 = unknown
};

}  // namespace dmp::lattice_spring
