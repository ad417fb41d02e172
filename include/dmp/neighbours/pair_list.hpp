#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>
#include <dmp/core/aligned.hpp>
#include <dmp/core/pack.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/neighbours/cell_grid.hpp>
#include <dmp/neighbours/exclusions.hpp>

namespace dmp::neighbours {

/// For each particle of one group, the rows of its neighbours in another (or the same) group. A pair in the same block of the same group is
/// listed once, at the particle further up, and its law evaluated for both; all others (ghosts, other groups, other blocks) are listed at
/// each end that evolves. Each of these two lists is ordered by how much of the skin must have been used up before a pair can act: a sweep
/// reads only as far as its `level`. It fills whole packs of `pack` entries: with rows far away from everything, or, where pairs are listed
/// once, with one of two rows of the block so far apart that one of them cannot act. Rows of the same block are counted from its first and
/// take 16 bits; a block without two such rows, or of more than 65 536, has all its pairs listed at both ends.
class PairList {
 public:
  /// The particles that are listed: rows 0 .. owned - 1 of the source group; then rows far away from everything, at least one; then a ghost
  /// for each of `owner`.
  struct Sources {
    bool same_group;  ///< then a particle is not its own neighbour
    std::uint32_t owned, first_ghost;
    std::span<const std::uint32_t> owner;
    bool once = true;  ///< pairs of a block are listed once; otherwise at both ends like all others

    /// Row of the k-th of all owned particles and ghosts.
    [[nodiscard]] std::uint32_t row(std::uint32_t k) const noexcept { return k < owned ? k : k - owned + first_ghost; }
    [[nodiscard]] std::uint32_t original(std::uint32_t row) const noexcept { return row < owned ? row : owner[row - first_ghost]; }
  };
  /// Pairs of level 0 can act at once, those of level l > 0 not before the share of level l - 1 of the skin has been used up. Most
  /// particles use up little until lists wear out somewhere.
  static constexpr std::array<double, 4> share{0.125, 0.35, 0.65, 1.0};
  static constexpr std::size_t levels = share.size();
  static_assert(std::is_sorted(share.begin(), share.end()) && share.back() == 1.0);
  /// How far a list must be read when this share of the skin has been used up; all of it if that is not a number, as without a skin.
  [[nodiscard]] static constexpr std::size_t level_at(double share_used) noexcept {
    std::size_t level = 0;
    while (level + 1 < levels && !(share_used <= share[level])) ++level;
    return level;
  }

  /// `grid` holds the owned sources, then the ghosts. Pairs within `cutoff` + `skin` [m] are listed, and
  /// perhaps some that are farther apart by less than the margin of the grid. Lists fill whole packs of so many, a power of two.
  template <int Dim>
  void build(const Blocks& blocks, std::span<const Vector<Dim>> positions, const CellGrid<Dim>& grid, double cutoff, double skin,
             const Sources& sources, const Exclusions& excluded, std::size_t pack) {
    require(std::has_single_bit(pack), "neighbours::PairList: pack must be a power of two", static_cast<double>(pack));
    pack_ = pack;
    const int shift = std::countr_zero(pack);
    const auto packs = [&](std::size_t entries) { return static_cast<std::uint16_t>((entries + pack - 1) >> shift); };
    at_.resize(positions.size());
    rows_.resize(blocks.size());
    found_.resize(blocks.ranges().size());
    std::array<float, levels> within;  // squared distance, as a fraction of the longest; rounded up
    const double longest = cutoff + skin + grid.margin();
    for (std::size_t l = 0; l < levels; ++l) {
      const double radius = cutoff + skin * share[l] + grid.margin();
      within[l] = static_cast<float>(radius * radius / (longest * longest) * (1.0 + 1e-6));
    }
    for_each_block(blocks, [&](std::size_t thread, std::size_t block) {
      auto& [found, once, others] = found_[thread];
      std::size_t end_once = 0, end_others = 0;  // of the lists of this block
      const std::size_t first = blocks.begin(block), last = blocks.end(block);
      const auto block_first = static_cast<std::uint32_t>(first);
      FarApart<Dim> far_apart;
      if (sources.same_group && sources.once) far_apart = find_far_apart(positions, first, last, longest);
      const auto once_size = static_cast<std::uint32_t>(far_apart.found ? last - first : 0);
      for (std::size_t i = first; i < last; ++i) {
        const auto row = static_cast<std::uint32_t>(i);
        const std::uint32_t left_out = once_size > 0 ? block_first : row;  // those further up list it; and itself
        found.size = 0;
        grid.find(positions[i], cutoff + skin, found, {left_out, sources.same_group ? row + 1 - left_out : 0});
        check_size(found.size);
        name_rows(found, row, sources, excluded);
        At& at = at_[i];
        at.first_once = static_cast<std::uint32_t>(end_once >> shift);
        at.first_other = static_cast<std::uint32_t>(end_others >> shift);
        const std::size_t begin_once = end_once, begin_others = end_others;
        make_room(once, end_once + found.size + pack + Lanes::width);
        make_room(others, end_others + found.size + pack + Lanes::width);
        for (std::size_t l = 0; l < levels; ++l) {
          const Lanes from(l > 0 ? within[l - 1] : 0.0f), to(within[l]);
          for (std::size_t k = 0; k < found.size; k += Lanes::width) {
            const Lanes fraction = Lanes::load(found.fraction.data() + k);
            typename Lanes::Rows numbers;
            __builtin_memcpy(&numbers, found.rows.data() + k, sizeof(numbers));
            const auto in_level = fraction >= from && fraction < to;
            const typename Lanes::Rows in_block = numbers - block_first;
            const Mask<float, Lanes::width> listed_once{in_block < once_size};
            const unsigned here = (in_level && listed_once).bits(), elsewhere = in_level.bits() & ~here;
            compress<Lanes::width>(in_block, here, once.data() + end_once);
            end_once += static_cast<std::size_t>(__builtin_popcount(here));
            compress<Lanes::width>(numbers, elsewhere, others.data() + end_others);
            end_others += static_cast<std::size_t>(__builtin_popcount(elsewhere));
          }
          at.once[l] = packs(end_once - begin_once);
          at.others[l] = packs(end_others - begin_others);
        }
        // Whole packs of fillers, of which the next list overwrites what is too many: no branch, which would be foretold wrongly.
        std::fill_n(once.data() + end_once, pack, far_apart.from(positions[i]));
        std::fill_n(others.data() + end_others, pack, sources.owned);
        end_once = begin_once + pack * at.once.back();
        end_others = begin_others + pack * at.others.back();
      }
      keep<std::uint16_t>({once.data(), end_once}, rows_[block].once);
      keep<std::uint32_t>({others.data(), end_others}, rows_[block].others);
    });
  }

  struct Neighbours {
    std::span<const std::uint16_t> once;    ///< of the same block, further down, counted from its first row: the law serves both
    std::span<const std::uint32_t> others;  ///< those that are listed at each end
  };
  /// Of particle i, which lies in `block`, the neighbours that can act while no more than share[level] of the skin has been used up.
  [[nodiscard, gnu::always_inline]] Neighbours of(std::size_t block, std::size_t i, std::size_t level = levels - 1) const noexcept {
    const At& at = at_[i];
    const RowsOfBlock& rows = rows_[block];
    return {{rows.once.data() + pack_ * at.first_once, pack_ * at.once[level]},
            {rows.others.data() + pack_ * at.first_other, pack_ * at.others[level]}};
  }
  /// Entries of a block, what a sweep over it costs.
  [[nodiscard]] double entries(const Blocks& blocks, std::size_t block) const noexcept {
    if (at_.empty() || blocks.begin(block) == blocks.end(block)) return 0.0;
    return static_cast<double>(rows_[block].once.size() + rows_[block].others.size());
  }
  [[nodiscard]] std::size_t bytes() const noexcept {
    std::size_t result = at_.capacity() * sizeof(At) + rows_.capacity() * sizeof(RowsOfBlock);
    for (const auto& rows : rows_) result += rows.bytes();
    for (const auto& [found, once, others] : found_)
      result += (found.rows.capacity() + found.fraction.capacity() + others.capacity()) * sizeof(std::uint32_t) +
                once.capacity() * sizeof(std::uint16_t);
    return result;
  }

 private:
  struct At {
    std::uint32_t first_once, first_other;           // packs, counted from the start of the block
    std::array<std::uint16_t, levels> once, others;  // packs of each level, with those before
  };
  struct RowsOfBlock {
    AlignedVector<std::uint16_t> once;
    AlignedVector<std::uint32_t> others;
    [[nodiscard]] std::size_t bytes() const noexcept {
      return once.capacity() * sizeof(std::uint16_t) + others.capacity() * sizeof(std::uint32_t);
    }
  };
  using Lanes = Pack<float, selecting_width>;
  struct alignas(64) FoundOfThread {  // no two threads share a cache line
    Found found;
    AlignedVector<std::uint16_t> once;  // of a block
    AlignedVector<std::uint32_t> others;
  };
  template <class Row>
  static void make_room(AlignedVector<Row>& rows, std::size_t count) {
    if (rows.size() < count) rows.resize(2 * count);
  }
  /// Copies with a margin of 1/32 for the next lists, where a vector that grows would take twice what is needed.
  template <class Row>
  static void keep(std::span<const Row> rows, AlignedVector<Row>& kept) {
    if (kept.capacity() < rows.size()) {
      kept = {};
      kept.reserve(rows.size() + rows.size() / 32);
    }
    kept.assign(rows.begin(), rows.end());
  }

  /// Two particles of a block, counted from its first, so far apart that nobody is in reach of both.
  template <int Dim>
  struct FarApart {
    bool found = false;
    std::uint16_t one = 0, other = 0;
    Vector<Dim> at_one = Vector<Dim>::Zero();
    double reach = 0.0;

    [[nodiscard]] std::uint16_t from(const Vector<Dim>& x) const noexcept { return (x - at_one).norm() > reach ? one : other; }
  };
  template <int Dim>
  [[nodiscard]] static FarApart<Dim> find_far_apart(std::span<const Vector<Dim>> positions, std::size_t first, std::size_t last,
                                                    double reach) {
    FarApart<Dim> result;
    if (first == last || last - first > Blocks::most_rows) return result;
    result.at_one = positions[first];
    result.reach = (1.0 + 1e-6) * reach;
    double farthest = 0.0;
    for (std::size_t k = first; k < last; ++k)
      if (const double distance = (positions[k] - result.at_one).squaredNorm(); distance > farthest) {
        farthest = distance;
        result.other = static_cast<std::uint16_t>(k - first);
      }
    result.found = std::sqrt(farthest) > 2.0 * result.reach;
    return result;
  }

  /// Packs of one particle are counted in 16 bits.
  void check_size(std::size_t found) const {
    if (found > 0xffff * pack_)
      throw ParameterError("neighbours::PairList: a particle must not have more than " + std::to_string(0xffff * pack_) +
                           " neighbours, got " + std::to_string(found));
  }

  /// Names found particles by their rows, and takes out those that are excluded: their fraction becomes infinite.
  static void name_rows(Found& found, std::uint32_t i, const Sources& sources, const Exclusions& excluded) {
    const std::size_t size = found.size;
    constexpr float never = std::numeric_limits<float>::infinity();
    found.make_room(Lanes::width);
    std::uint32_t* const __restrict rows = found.rows.data();
    float* const __restrict fraction = found.fraction.data();
    const std::uint32_t owned = sources.owned, to_ghosts = sources.first_ghost - sources.owned;
    for (std::size_t k = 0; k < size; ++k) rows[k] += rows[k] < owned ? 0u : to_ghosts;
    if (excluded.any(i))
      for (std::size_t k = 0; k < size; ++k)
        if (excluded.holds(i, sources.original(rows[k]))) fraction[k] = never;
    std::fill(fraction + size, fraction + size + Lanes::width, never);
  }

  std::size_t pack_ = 1;
  std::vector<At> at_;
  std::vector<RowsOfBlock> rows_;
  std::vector<FoundOfThread> found_;
};

}  // namespace dmp::neighbours
