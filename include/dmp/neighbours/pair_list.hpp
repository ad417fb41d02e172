#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>
#include <dmp/core/require.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/neighbours/cell_grid.hpp>
#include <dmp/neighbours/exclusions.hpp>

namespace dmp::neighbours {

/// For each particle of one group, the rows of its neighbours in another (or the same) group: full lists, every pair seen from both sides.
/// The list of a particle is filled up to whole packs of `pack` entries with `filler`, a row far away from everything.
class PairList {
 public:
  /// The particles that are listed: rows 0 .. owned - 1 of the source group, then one ghost for each of `owner`, then the filler.
  struct Sources {
    bool same_group;  ///< then a particle is not its own neighbour
    std::uint32_t owned;
    std::span<const std::uint32_t> owner;
  };

  /// `ranges` divides the particles that get lists among the threads; `radius` [m] is the cut-off and the skin.
  template <int Dim>
  void build(const Ranges& ranges, std::span<const Vector<Dim>> positions, const CellGrid<Dim>& grid, double radius, const Sources& sources,
             const Exclusions& excluded, std::size_t pack) {
    const auto filler = static_cast<std::uint32_t>(sources.owned + sources.owner.size());
    rows_.resize(ranges.size());
    offset_.resize(positions.size() + ranges.size());
    for_each_range(ranges, [&](std::size_t range, std::size_t first, std::size_t last) {
      auto& rows = rows_[range];
      rows.clear();
      for (std::size_t i = first; i < last; ++i) {
        offset_[i + range] = static_cast<std::uint32_t>(rows.size());
        const std::size_t begin = rows.size();
        const auto row = static_cast<std::uint32_t>(i);
        grid.find(positions[i], radius, sources.same_group ? row : CellGrid<Dim>::nobody, rows);
        excluded.remove(row, rows, begin, sources.owned, sources.owner);
        while (rows.size() % pack != 0) rows.push_back(filler);
        if (rows.size() > std::numeric_limits<std::uint32_t>::max())
          throw ParameterError(
              "neighbours::PairList: more than 2^32 neighbours in one thread's range; use more threads or a smaller support radius");
      }
      offset_[last + range] = static_cast<std::uint32_t>(rows.size());
    });
  }

  /// Neighbours of particle i, which lies in `range`.
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t range, std::size_t i) const noexcept {
    const std::uint32_t first = offset_[i + range], last = offset_[i + range + 1];
    return {rows_[range].data() + first, last - first};
  }
  [[nodiscard]] std::size_t bytes() const noexcept {
    std::size_t result = offset_.capacity() * sizeof(std::uint32_t);
    for (const auto& rows : rows_) result += rows.capacity() * sizeof(std::uint32_t);
    return result;
  }

 private:
  std::vector<std::uint32_t> offset_;             // of particle i in range r: offset_[i + r] .. offset_[i + r + 1]
  std::vector<std::vector<std::uint32_t>> rows_;  // one vector per range
};

}  // namespace dmp::neighbours
