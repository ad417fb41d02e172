#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>
#include <dmp/lattice_spring/body.hpp>
#include <dmp/lattice_spring/detail/checks.hpp>

namespace dmp::lattice_spring {

/// Number of bonds of each bead, weightless ones left out.
template <int Dim>
[[nodiscard]] std::vector<std::uint32_t> bonds_per_bead(const Body<Dim>& body) {
  detail::require_ends("lattice_spring::bonds_per_bead", body.bonds, body.points.positions.size());
  std::vector<std::uint32_t> count(body.points.positions.size(), 0);
  for (const neighbours::Bond& bond : body.bonds) {
    if (bond.weight == 0.0) continue;
    ++count[bond.i];
    ++count[bond.j];
  }
  return count;
}

/// Mean number of bonds per bead of those beads that `counts(position)` (inside(x) of a shape, say); 0 if there is none. 18 inside the
/// cubic lattice; a network in 3D is floppy below 6 and soft below 12.
template <int Dim, class Counts>
[[nodiscard]] double mean_coordination(const Body<Dim>& body, const Counts& counts) {
  const auto count = bonds_per_bead(body);
  double sum = 0.0, beads = 0.0;
  for (std::size_t i = 0; i < count.size(); ++i)
    if (counts(body.points.positions[i])) {
      sum += count[i];
      beads += 1.0;
    }
  return beads > 0.0 ? sum / beads : 0.0;
}
/// The same of all beads: 2 bonds/beads.
template <int Dim>
[[nodiscard]] double mean_coordination(const Body<Dim>& body) {
  return mean_coordination(body, [](const auto&) { return true; });
}

}  // namespace dmp::lattice_spring
