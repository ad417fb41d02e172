#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <type_traits>
#include <vector>
#include <dmp/bond/concept.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/box.hpp>
#include <dmp/lattice_spring/body.hpp>
#include <dmp/lattice_spring/detail/checks.hpp>

namespace dmp::lattice_spring {

/// Writes the distances at `positions` into the rest lengths left open. A scene does that with its own copy of the bonds; whoever asks for
/// tensions later does it before the run. Through periodic faces by the shortest way.
template <int Dim>
void measure_rest_lengths(std::vector<neighbours::Bond>& bonds, std::span<const Vector<Dim>> positions,
                          const geometry::Box<Dim>& box = geometry::Box<Dim>::unbounded()) {
  detail::require_ends("lattice_spring::measure_rest_lengths", bonds, positions.size());
  for (neighbours::Bond& bond : bonds)
    if (bond.rest_length < 0.0) bond.rest_length = neighbours::minimum_image<Dim>(positions[bond.j] - positions[bond.i], box).norm();
}

/// Tension of each bond [N], weight included, > 0 pulls its ends together. A law with dashpots needs the velocities, any other does not. Of
/// a law with a dispersive share, `bonds` are all that the beads have of such laws.
template <int Dim, class Law>
  requires(bond::BondPotential<Law> && !bond::HasMemory<Law>)
[[nodiscard]] std::vector<double> tensions(const Law& law, std::span<const neighbours::Bond> bonds, std::span<const Vector<Dim>> positions,
                                           std::span<const Vector<Dim>> velocities = {},
                                           const geometry::Box<Dim>& box = geometry::Box<Dim>::unbounded()) {
  check_parameters(law);
  detail::require_ends("lattice_spring::tensions", bonds, positions.size());
  if constexpr (bond::UsesVelocity<Law>)
    detail::require_same_size("lattice_spring::tensions", "velocities, which this law needs,", velocities.size(), positions.size());
  const auto apart_at = [&](const neighbours::Bond& bond) -> Vector<Dim> {
    return neighbours::minimum_image<Dim>(positions[bond.j] - positions[bond.i], box);
  };
  std::vector<double> result, strain;
  result.reserve(bonds.size());
  if constexpr (bond::IsDispersive<Law>) {
    strain.assign(positions.size(), 0.0);
    std::vector<double> sum(positions.size(), 0.0);
    for (const neighbours::Bond& bond : bonds) {
      const double lever = law.stiffness * bond.weight * bond.rest_length;
      for (const std::uint32_t end : {bond.i, bond.j}) {
        strain[end] += lever * (apart_at(bond).norm() - bond.rest_length);
        sum[end] += lever * bond.rest_length;
      }
    }
    for (std::size_t i = 0; i < sum.size(); ++i) strain[i] = sum[i] > 0.0 ? strain[i] / sum[i] : 0.0;
  }
  for (const neighbours::Bond& bond : bonds) {
    if (!(bond.rest_length >= 0.0))
      throw ParameterError("lattice_spring::tensions: rest_length must be known (measure_rest_lengths before the run), got " +
                           to_text(bond.rest_length) + " m of bond (" + std::to_string(bond.i) + ", " + std::to_string(bond.j) + ")");
    const Vector<Dim> apart = apart_at(bond);
    bond::detail::State<Law> state{};
    state.length = apart.norm();
    state.rest_length = bond.rest_length;
    if constexpr (bond::UsesVelocity<Law>)
      state.length_rate = state.length > 0.0 ? apart.dot(velocities[bond.j] - velocities[bond.i]) / state.length : 0.0;
    if constexpr (bond::IsDispersive<Law>) state.strain_of_ends = strain[bond.i] + strain[bond.j];
    result.push_back(bond.weight * law.tension(state));
  }
  return result;
}

}  // namespace dmp::lattice_spring
