#pragma once
#include <cstddef>
#include <string>
#include <utility>
#include <vector>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/shape.hpp>
#include <dmp/lattice_spring/body.hpp>
#include <dmp/lattice_spring/detail/checks.hpp>

namespace dmp::lattice_spring {

/// The bonds of a body in `parts` lists, to give each its own law: rule(x_i, x_j) says in which list, 0 .. parts - 1.
///   const auto [soft, hard] = ...;  scene(..., bonds<Beads, Beads>(soft_law, lists[0]), bonds<Beads, Beads>(hard_law, lists[1]))
template <int Dim, class Rule>
[[nodiscard]] std::vector<std::vector<neighbours::Bond>> split(const Body<Dim>& body, std::size_t parts, const Rule& rule) {
  const auto& x = body.points.positions;
  detail::require_ends("lattice_spring::split", body.bonds, x.size());
  std::vector<std::vector<neighbours::Bond>> lists(parts);
  for (const neighbours::Bond& bond : body.bonds) {
    const auto list = static_cast<std::size_t>(rule(x[bond.i], x[bond.j]));
    if (!(list < parts))
      throw ParameterError("lattice_spring::split: the rule must name one of " + std::to_string(parts) + " lists, from 0, got " +
                           std::to_string(list));
    lists[list].push_back(bond);
  }
  return lists;
}

/// To whom the bonds belong that have one end in the core and one in the shell: their law is the shell's, the core's, or one of their own.
enum class InterfaceBonds { shell, core, separate };

/// The bonds of a core-shell body. `interface` is empty unless its bonds are to be separate.
struct CoreShell {
  std::vector<neighbours::Bond> core, shell, interface;
};

/// Bonds with both ends inside the shape `core`, with both ends outside, and across. The force of a sphere whose shell is ten times softer
/// differs by a third between the two extremes.
template <int Dim, class S>
  requires geometry::Shape<S, Dim>
[[nodiscard]] CoreShell split_core_shell(const Body<Dim>& body, const S& core, InterfaceBonds across = InterfaceBonds::shell) {
  validate(core);
  const std::size_t list_across = across == InterfaceBonds::core ? 0 : across == InterfaceBonds::shell ? 1 : 2;
  auto lists = split(body, 3, [&](const Vector<Dim>& a, const Vector<Dim>& b) -> std::size_t {
    const bool a_inside = core.contains(a), b_inside = core.contains(b);
    return a_inside != b_inside ? list_across : a_inside ? 0 : 1;
  });
  return {.core = std::move(lists[0]), .shell = std::move(lists[1]), .interface = std::move(lists[2])};
}

/// Stiffness of two half bonds in series: 2 a b/(a + b) [N/m], for bonds across an interface; 0 if both are 0.
[[nodiscard]] inline double harmonic_mean(double a, double b) {
  require_not_negative("lattice_spring::harmonic_mean: stiffness", a, "N/m");
  require_not_negative("lattice_spring::harmonic_mean: stiffness", b, "N/m");
  return a + b > 0.0 ? 2.0 * a * b / (a + b) : 0.0;
}

}  // namespace dmp::lattice_spring
