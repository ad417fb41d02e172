#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>
#include <Eigen/LU>
#include <dmp/core/vector.hpp>
#include <dmp/lattice_spring/body.hpp>
#include <dmp/lattice_spring/detail/checks.hpp>
#include <dmp/lattice_spring/tensor.hpp>

namespace dmp::lattice_spring {

/// Beads around which a body has turned inside out: central springs do not resist that, and plates that move by more than about a bond
/// length at once push the outermost layer through the next, after which the body is softer for good. Of each bead, Dim of its bonds that
/// stood well apart at `start` are watched: the sign of (r1 x r2) . r3. Beads without Dim bonds in different directions are left out.
template <int Dim>
[[nodiscard]] std::vector<std::uint32_t> folded_beads(std::span<const neighbours::Bond> bonds, std::span<const Vector<Dim>> start,
                                                      std::span<const Vector<Dim>> now) {
  detail::require_ends("lattice_spring::folded_beads", bonds, start.size());
  detail::require_same_size("lattice_spring::folded_beads", "positions now", now.size(), start.size());
  std::vector<std::size_t> first(start.size() + 1, 0);
  for (const neighbours::Bond& bond : bonds) ++first[bond.i + 1], ++first[bond.j + 1];
  for (std::size_t i = 0; i < start.size(); ++i) first[i + 1] += first[i];
  std::vector<std::uint32_t> partner(first.back());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  for (const neighbours::Bond& bond : bonds) partner[next[bond.i]++] = bond.j, partner[next[bond.j]++] = bond.i;

  constexpr double least_sine = 1e-3;  // of a bond with the plane of those before it
  std::vector<std::uint32_t> folded;
  for (std::uint32_t i = 0; i < start.size(); ++i) {
    Tensor<Dim> before, after, across = Tensor<Dim>::Identity();  // across: onto what the bonds taken so far leave open
    bool complete = true;
    for (int taken = 0; taken < Dim && complete; ++taken) {
      double best = least_sine;
      std::uint32_t chosen = i;
      for (std::size_t b = first[i]; b < first[i + 1]; ++b) {
        const Vector<Dim> along = start[partner[b]] - start[i];
        const double length = along.norm(), sine = length > 0.0 ? (across * along).norm() / length : 0.0;
        if (sine > best * (1.0 + 1e-9)) best = sine, chosen = partner[b];
      }
      complete = chosen != i;
      if (!complete) break;
      before.col(taken) = start[chosen] - start[i];
      after.col(taken) = now[chosen] - now[i];
      const Vector<Dim> open = (across * before.col(taken)).normalized();
      across -= open * open.transpose();
    }
    if (complete && before.determinant() * after.determinant() <= 0.0) folded.push_back(i);
  }
  return folded;
}

}  // namespace dmp::lattice_spring
