#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/box.hpp>

namespace dmp::neighbours {

/// One bond, between particle `i` of the first group and particle `j` of the second (rows as the groups were filled). The rest length
/// is the distance of the two at the start unless given.
struct Bond {
  std::uint32_t i, j;
  double rest_length = -1.0;  ///< r0 [m], >= 0; negative: the initial distance
};

/// Longest bond, in each direction, as a fraction of a periodic box: beyond one half the shortest way would be another bond.
inline constexpr double longest_periodic_bond = 0.45;

/// Vector from b to a, by the shortest way through the periodic faces.
template <int Dim>
[[nodiscard]] Vector<Dim> minimum_image(Vector<Dim> a_minus_b, const geometry::Box<Dim>& box) noexcept {
  for (int d = 0; d < Dim; ++d) {
    if (!box.periodic[static_cast<std::size_t>(d)]) continue;
    const double length = box.upper[d] - box.lower[d];
    if (a_minus_b[d] > 0.5 * length) a_minus_b[d] -= length;
    if (a_minus_b[d] < -0.5 * length) a_minus_b[d] += length;
  }
  return a_minus_b;
}

/// The bonds of each particle of one group: who is at the other end, and the rest length. Every bond stands here once per end that moves.
/// The bonds of a particle fill whole packs; what fills up has a negative rest length and repeats the last partner.
class BondList {
 public:
  static constexpr double filler = -1.0;  ///< rest length of an entry that is no bond

  /// `own_is_j` picks the end that lies in this group, for bonds whose ends lie in two groups; `pack` entries make a whole pack.
  void build(std::size_t particles, std::span<const Bond> bonds, bool both_ends, bool own_is_j, std::size_t pack) {
    std::vector<std::uint32_t> count(particles, 0);
    const auto each = [&](auto&& put) {
      for (const Bond& bond : bonds) {
        if (both_ends || !own_is_j) put(bond.i, bond.j, bond.rest_length);
        if (both_ends || own_is_j) put(bond.j, bond.i, bond.rest_length);
      }
    };
    each([&count](std::uint32_t own, std::uint32_t, double) { ++count[own]; });
    offset_.assign(particles + 1, 0);
    for (std::size_t i = 0; i < particles; ++i)
      offset_[i + 1] = offset_[i] + static_cast<std::uint32_t>((count[i] + pack - 1) / pack * pack);
    partner_.assign(offset_[particles], 0);
    rest_length_.assign(offset_[particles], filler);
    std::vector<std::uint32_t> cursor(offset_.begin(), offset_.end() - 1);
    each([&](std::uint32_t own, std::uint32_t other, double rest_length) {
      const std::uint32_t to = cursor[own]++;
      partner_[to] = other;
      rest_length_[to] = rest_length;
    });
    for (std::size_t i = 0; i < particles; ++i)
      for (std::uint32_t k = cursor[i]; k < offset_[i + 1]; ++k) partner_[k] = partner_[cursor[i] - 1];
  }

  /// Partners and rest lengths of particle i, whole packs.
  [[nodiscard]] std::span<const std::uint32_t> packs(std::size_t i) const noexcept {
    return {partner_.data() + offset_[i], offset_[i + 1] - offset_[i]};
  }
  [[nodiscard]] const double* rest_lengths(std::size_t i) const noexcept { return rest_length_.data() + offset_[i]; }
  /// The same without what fills up.
  [[nodiscard]] std::span<const std::uint32_t> partners(std::size_t i) const noexcept {
    std::size_t count = offset_[i + 1] - offset_[i];
    while (count > 0 && rest_lengths(i)[count - 1] < 0.0) --count;
    return packs(i).first(count);
  }
  [[nodiscard]] bool empty() const noexcept { return partner_.empty(); }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return offset_.size() * sizeof(std::uint32_t) + partner_.size() * (sizeof(std::uint32_t) + sizeof(double));
  }

 private:
  std::vector<std::uint32_t> offset_{0}, partner_;
  std::vector<double> rest_length_;
};

/// Fills in the rest lengths left open, and rejects what is not a bond: an end that does not exist, both ends the same particle, length
/// zero, the same bond twice, or longer than 0.45 of a periodic box (at half of it the shortest way becomes ambiguous).
template <int Dim>
void complete_bonds(std::vector<Bond>& bonds, std::span<const Vector<Dim>> first, std::span<const Vector<Dim>> second, bool same_group,
                    const geometry::Box<Dim>& box, const std::string& name) {
  const auto fail = [&](const Bond& bond, const std::string& rule) {
    throw ParameterError("bonds of " + name + ": " + rule + ", got bond (" + std::to_string(bond.i) + ", " + std::to_string(bond.j) + ")");
  };
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;
  ends.reserve(bonds.size());
  for (Bond& bond : bonds) {
    if (bond.i >= first.size() || bond.j >= second.size())
      fail(bond, "both ends must exist (" + std::to_string(first.size()) + " and " + std::to_string(second.size()) + " particles)");
    if (same_group && bond.i == bond.j) fail(bond, "a particle cannot be bonded to itself");
    const Vector<Dim> apart = minimum_image<Dim>(first[bond.i] - second[bond.j], box);
    const double length = apart.norm();
    if (bond.rest_length < 0.0) {
      bond.rest_length = length;
      if (!(length > 0.0)) fail(bond, "length must be > 0 m (the two ends coincide; give a rest_length if that is meant)");
    }
    if (!(bond.rest_length - bond.rest_length == 0.0)) fail(bond, "rest_length must be finite");
    for (int d = 0; d < Dim; ++d)
      if (box.periodic[static_cast<std::size_t>(d)] &&
          std::max(std::fabs(apart[d]), bond.rest_length) > longest_periodic_bond * (box.upper[d] - box.lower[d]))
        fail(bond, "length must be <= 0.45 of the periodic box");
    ends.emplace_back(same_group ? std::min(bond.i, bond.j) : bond.i, same_group ? std::max(bond.i, bond.j) : bond.j);
  }
  std::sort(ends.begin(), ends.end());
  const auto twice = std::adjacent_find(ends.begin(), ends.end());
  if (twice != ends.end()) fail({twice->first, twice->second}, "the same two particles must not be bonded twice");
}

}  // namespace dmp::neighbours
