#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>
#include <dmp/dmp.hpp>

/// Springs with dispersion, summed one by one.
namespace test {

/// U = sum over bonds of (1/2)(1 - |D|) k (L - L0)^2 + sum over beads of (D/4) theta^2/S [J], k with the weight of the bond. In long
/// double, for differences of it.
template <int Dim>
[[nodiscard]] long double dispersive_energy(double stiffness, double share, std::span<const dmp::neighbours::Bond> bonds,
                                            std::span<const dmp::Vector<Dim>> positions,
                                            const dmp::geometry::Box<Dim>& box = dmp::geometry::Box<Dim>::unbounded()) {
  std::vector<long double> theta(positions.size(), 0.0L), sum(positions.size(), 0.0L);
  long double energy = 0.0L;
  for (const auto& bond : bonds) {
    const dmp::Vector<Dim> apart = dmp::neighbours::minimum_image<Dim>(positions[bond.i] - positions[bond.j], box);
    long double squared = 0.0L;
    for (int d = 0; d < Dim; ++d) squared += static_cast<long double>(apart[d]) * static_cast<long double>(apart[d]);
    const long double k = static_cast<long double>(stiffness) * bond.weight, change = std::sqrt(squared) - bond.rest_length;
    energy += 0.5L * (1.0L - std::fabs(share)) * k * change * change;
    for (const std::uint32_t end : {bond.i, bond.j}) {
      theta[end] += k * bond.rest_length * change;
      sum[end] += k * bond.rest_length * bond.rest_length;
    }
  }
  for (std::size_t i = 0; i < theta.size(); ++i)
    if (sum[i] > 0.0L) energy += 0.25L * share * theta[i] * theta[i] / sum[i];
  return energy;
}

/// A body cut into parts: part_of(bead) says in which of them it goes, and bonds[a][b], a <= b, join beads of parts a and b.
template <int Dim, std::size_t Parts>
struct Divided {
  std::array<dmp::geometry::Points<Dim>, Parts> points;
  std::array<std::array<std::vector<dmp::neighbours::Bond>, Parts>, Parts> bonds;
  std::vector<std::size_t> part;   ///< of each bead
  std::vector<std::uint32_t> row;  ///< of each bead in its part

  template <class PartOf>
  Divided(const dmp::lattice_spring::Body<Dim>& body, const PartOf& part_of) {
    for (const auto& x : body.points.positions) {
      part.push_back(part_of(x));
      auto& mine = points[part.back()].positions;
      row.push_back(static_cast<std::uint32_t>(mine.size()));
      mine.push_back(x);
    }
    for (dmp::neighbours::Bond bond : body.bonds) {
      if (part[bond.i] > part[bond.j]) std::swap(bond.i, bond.j);
      auto& list = bonds[part[bond.i]][part[bond.j]];
      bond.i = row[bond.i];
      bond.j = row[bond.j];
      list.push_back(bond);
    }
  }
};

}  // namespace test
