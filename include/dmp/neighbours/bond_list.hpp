#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>
#include <dmp/core/require.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/box.hpp>
#include <dmp/particles/view.hpp>

namespace dmp::neighbours {

/// One bond, between particle `i` of the first group and particle `j` of the second (rows as the groups were filled). The rest length
/// is the distance of the two at the start unless given.
struct Bond {
  std::uint32_t i, j;
  double rest_length = -1.0;  ///< r0 [m], >= 0; negative: the initial distance
  double weight = 1.0;        ///< what the law says times this, >= 0: bonds on a surface or an edge of a lattice are shared by fewer cells
};

/// Longest bond, in each direction, as a fraction of a periodic box: beyond one half the shortest way would be another bond.
inline constexpr double longest_periodic_bond = 0.45;

/// Vector from b to a, by the shortest way through the periodic faces.
template <int Dim>
[[nodiscard]] Vector<Dim> minimum_image(Vector<Dim> a_minus_b, const geometry::Box<Dim>& box) noexcept {
  for (int d = 0; d < Dim; ++d) {
    if (!box.periodic[static_cast<std::size_t>(d)]) continue;
    const double length = box.upper[d] - box.lower[d];
    if (std::fabs(a_minus_b[d]) > 0.5 * length) a_minus_b[d] -= length * std::round(a_minus_b[d] / length);
  }
  return a_minus_b;
}

/// The bonds of each particle of one group. A bond in the same block of the same group is listed once, at that end where fewer entries are
/// needed to fill packs; all others at each end that lies in this group. The bonds of a particle fill whole packs; what fills up has a
/// negative rest length and names the particle itself, or repeats the last partner if that is of another group.
class BondList {
 public:
  static constexpr double filler = -1.0;  ///< rest length of an entry that is no bond

  /// Entries of one particle, `size` of them.
  struct Entries {
    std::size_t size;
    const std::uint32_t* partner;   ///< row, times the stride of records
    const std::uint32_t*
        reaction;  ///< row to which the reaction is added, times the stride of sums: the partner's, or one that nobody wants
    const double* rest_length;
    const double* weight;
    std::size_t weight_step;  ///< 0: all weights are 1, and one pack of them is there
  };

  /// Doubles from one row to the next, in the records of partners and in the sums of this group.
  struct Strides {
    std::uint32_t records = 1, sums = 1;
  };
  /// `same_group`: both ends lie in this group; if not, `own_is_j` picks the end that does. `pack` entries make a whole pack.
  void build(const Blocks& blocks, std::span<const Bond> bonds, bool same_group, bool own_is_j, std::size_t pack, Strides strides) {
    strides_ = strides;
    pack_ = pack;
    const std::size_t particles = blocks.end(blocks.size() - 1);
    std::vector<std::uint32_t> block_of(particles);
    for (std::size_t b = 0; b < blocks.size(); ++b)
      for (std::size_t i = blocks.begin(b); i < blocks.end(b); ++i) block_of[i] = static_cast<std::uint32_t>(b);
    const std::vector<bool> at_j = same_group ? fill_packs(block_of, bonds, pack) : std::vector<bool>(bonds.size(), own_is_j);
    const auto each = [&](auto&& put) {  // put(own row, partner, listed once, bond)
      for (std::size_t b = 0; b < bonds.size(); ++b) {
        const Bond& bond = bonds[b];
        const bool once = same_group && block_of[bond.i] == block_of[bond.j];
        const std::uint32_t own = at_j[b] ? bond.j : bond.i, other = at_j[b] ? bond.i : bond.j;
        put(own, other, once, bond);
        if (same_group && !once) put(other, own, false, bond);
      }
    };
    std::vector<std::uint32_t> count(particles, 0);
    each([&count](std::uint32_t own, std::uint32_t, bool, const Bond&) { ++count[own]; });
    const bool weighted = std::any_of(bonds.begin(), bonds.end(), [](const Bond& bond) { return bond.weight != 1.0; });
    offset_.assign(particles + 1, 0);
    for (std::size_t i = 0; i < particles; ++i)
      offset_[i + 1] = offset_[i] + static_cast<std::uint32_t>((count[i] + pack - 1) / pack * pack);
    partner_.assign(offset_[particles], 0);
    reaction_.assign(offset_[particles], 0);
    rest_length_.assign(offset_[particles], filler);
    weight_.assign(weighted ? offset_[particles] : pack, 1.0);
    weight_step_ = weighted ? 1 : 0;
    crosses_.assign(particles, 0);
    const auto nowhere = [&](std::size_t i, std::uint32_t entry) {
      return strides.sums * static_cast<std::uint32_t>(blocks.far_row(block_of[i]) + entry % pack);
    };
    std::vector<std::uint32_t> cursor(offset_.begin(), offset_.end() - 1);
    each([&](std::uint32_t own, std::uint32_t other, bool once, const Bond& bond) {
      const std::uint32_t to = cursor[own]++;
      partner_[to] = strides.records * other;
      reaction_[to] = once ? strides.sums * other : nowhere(own, to);
      rest_length_[to] = bond.rest_length;
      if (weighted) weight_[to] = bond.weight;
    });
    for (std::size_t i = 0; i < particles; ++i)
      for (std::uint32_t k = cursor[i]; k < offset_[i + 1]; ++k) {
        partner_[k] = same_group ? strides.records * static_cast<std::uint32_t>(i) : partner_[k - 1];
        reaction_[k] = nowhere(i, k);
      }
  }

  /// Gives each bond a memory, 0 now, and the length it has now. Where a bond is listed at both ends, both remember the same.
  template <int Dim>
  void remember(std::span<const Vector<Dim>> own, std::span<const Vector<Dim>> partners, const geometry::Box<Dim>& box) {
    memory_.assign(partner_.size(), 0.0);
    length_.assign(partner_.size(), 0.0);
    for (std::size_t i = 0; i + 1 < offset_.size(); ++i)
      for (std::uint32_t k = offset_[i]; k < offset_[i + 1]; ++k)
        length_[k] = minimum_image<Dim>(own[i] - partners[partner_[k] / strides_.records], box).norm();
  }
  /// What may change in the entries of particle i, as `of(i)` has them: the rest length, `filler` once the bond is broken; and where bonds
  /// remember, a number and the length of the bond when it was last looked at [m].
  struct Memory {
    double* rest_length;
    double* memory;
    double* length;
  };
  [[nodiscard]] Memory memory_of(std::size_t i) noexcept {
    const std::size_t first = memory_.empty() ? 0 : offset_[i];
    return {rest_length_.data() + offset_[i], memory_.data() + first, length_.data() + first};
  }
  [[nodiscard]] const double* memories_of(std::size_t i) const noexcept { return memory_.data() + offset_[i]; }
  /// All of it, for checkpoints: entry by entry, so that the width of packs is part of the name.
  [[nodiscard]] particles::GroupView view(std::string name) {
    name += " in packs of " + std::to_string(pack_);
    particles::GroupView result{std::move(name), "bonds", true, {}, {{"rest_length", "m", 1, rest_length_, false}}};
    if (!memory_.empty()) {
      result.columns.push_back({"memory", "", 1, memory_, false});
      result.columns.push_back({"length", "m", 1, length_, false});
    }
    return result;
  }
  /// Row of the partner of entry k of particle i.
  [[nodiscard]] std::size_t partner_of(std::size_t i, std::size_t k) const noexcept { return partner_[offset_[i] + k] / strides_.records; }
  /// Entries that are bonds.
  [[nodiscard]] std::size_t whole() const noexcept {
    return static_cast<std::size_t>(std::count_if(rest_length_.begin(), rest_length_.end(), [](double length) { return length >= 0.0; }));
  }
  /// Where `of(i)` has the bond of particle i of this group and `partner`; its size if the bond is not listed there. What fills up comes
  /// after the bonds.
  [[nodiscard]] std::size_t find(std::size_t i, std::uint32_t partner) const noexcept {
    const auto first = partner_.begin() + offset_[i], last = partner_.begin() + offset_[i + 1];
    return static_cast<std::size_t>(std::find(first, last, strides_.records * partner) - first);
  }

  /// Marks the particles with bonds through periodic faces, as positions are now; until they are put back into the box, nothing changes.
  template <int Dim>
  void mark_crossing(std::span<const Vector<Dim>> own, std::span<const Vector<Dim>> partners, const geometry::Box<Dim>& box) {
    for (std::size_t i = 0; i + 1 < offset_.size(); ++i) {
      crosses_[i] = 0;
      for (std::uint32_t k = offset_[i]; k < offset_[i + 1]; ++k) {
        const Vector<Dim> apart = own[i] - partners[partner_[k] / strides_.records];
        if (rest_length_[k] >= 0.0 && apart != minimum_image<Dim>(apart, box)) crosses_[i] = 1;
      }
    }
  }
  /// To be read without the list: what a loop that also writes keeps in registers.
  struct Reader {
    const std::uint32_t* offset;
    Entries all;
    const std::uint8_t* crossing;

    [[nodiscard, gnu::always_inline]] bool crosses(std::size_t i) const noexcept { return crossing[i] != 0; }
    /// Of particle i, whole packs.
    [[nodiscard, gnu::always_inline]] Entries of(std::size_t i) const noexcept {
      const std::uint32_t first = offset[i];
      return {offset[i + 1] - first,
              all.partner + first,
              all.reaction + first,
              all.rest_length + first,
              all.weight + all.weight_step * first,
              all.weight_step};
    }
  };
  [[nodiscard]] Reader reader() const noexcept {
    return {offset_.data(), {partner_.size(), partner_.data(), reaction_.data(), rest_length_.data(), weight_.data(), weight_step_},
            crosses_.data()};
  }
  [[nodiscard]] bool crosses(std::size_t i) const noexcept { return reader().crosses(i); }
  [[nodiscard]] Entries of(std::size_t i) const noexcept { return reader().of(i); }
  [[nodiscard]] bool empty() const noexcept { return partner_.empty(); }
  /// Entries of a block, what a sweep over it costs.
  [[nodiscard]] double entries(const Blocks& blocks, std::size_t block) const noexcept {
    return empty() ? 0.0 : static_cast<double>(offset_[blocks.end(block)] - offset_[blocks.begin(block)]);
  }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return (offset_.size() + partner_.size() + reaction_.size()) * sizeof(std::uint32_t) +
           (rest_length_.size() + weight_.size() + memory_.size() + length_.size()) * sizeof(double) + crosses_.size();
  }

 private:
  /// Of each bond, whether it is listed at its end j rather than i. Particles take as many of their bonds within the block as fill whole
  /// packs, one after the other, and leave the rest to partners who have others too.
  [[nodiscard]] static std::vector<bool> fill_packs(std::span<const std::uint32_t> block_of, std::span<const Bond> bonds,
                                                    std::size_t pack) {
    std::vector<std::uint32_t> listed(block_of.size(), 0), first(block_of.size() + 1, 0), order(bonds.size());
    const auto lower = [&bonds](std::size_t b) { return std::min(bonds[b].i, bonds[b].j); };
    const auto within = [&](std::size_t b) { return block_of[bonds[b].i] == block_of[bonds[b].j]; };
    for (std::size_t b = 0; b < bonds.size(); ++b) {
      if (within(b)) ++first[lower(b) + 1];
      else ++listed[bonds[b].i], ++listed[bonds[b].j];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::size_t b = 0; b < bonds.size(); ++b)
      if (within(b)) order[next[lower(b)]++] = static_cast<std::uint32_t>(b);
    std::vector<bool> at_j(bonds.size(), false);
    for (std::uint32_t i = 0; i < block_of.size(); ++i) {
      const std::span<const std::uint32_t> open(order.data() + first[i], first[i + 1] - first[i]);  // to partners, who come later
      const auto partner = [&](std::uint32_t b) { return bonds[b].i + bonds[b].j - i; };
      const auto has_others = [&](std::uint32_t b) { return listed[partner(b)] > 0 || first[partner(b) + 1] > first[partner(b)]; };
      std::size_t left = (listed[i] + open.size()) % pack;
      if (static_cast<std::size_t>(std::count_if(open.begin(), open.end(), has_others)) < left) left = 0;  // a pack is needed anyway
      for (const std::uint32_t b : open) {
        const bool here = left == 0 || !has_others(b);
        if (!here) --left;
        at_j[b] = (bonds[b].i == i) != here;
        ++listed[here ? i : partner(b)];
      }
    }
    return at_j;
  }

  std::vector<std::uint32_t> offset_{0}, partner_, reaction_;
  std::vector<double> rest_length_, weight_, memory_, length_;
  std::size_t weight_step_ = 0, pack_ = 1;
  Strides strides_;
  std::vector<std::uint8_t> crosses_;
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
    if (!(bond.weight >= 0.0 && bond.weight - bond.weight == 0.0)) fail(bond, "weight must be >= 0 and finite");
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
