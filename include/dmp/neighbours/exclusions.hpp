#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dmp::neighbours {

/// Who is bonded to whom, over all groups of a scene: particle `row` of a group is node first[group] + row.
using BondGraph = std::vector<std::vector<std::uint32_t>>;

/// Pairs that short-range laws skip because bonds join them, directly or through a few others. Empty costs nothing but a look.
class Exclusions {
 public:
  /// Nodes of one group in the graph.
  struct Nodes {
    std::uint32_t first, count;
  };

  /// Excludes, for each particle of `from`, those of `to` within `reach` bonds: 1 the bonded ones, 3 as LAMMPS' special_bonds 0 0 0.
  void build(const BondGraph& graph, Nodes from, Nodes to, int reach) {
    excluded_.assign(from.count, {});
    for (std::uint32_t i = 0; i < from.count; ++i) {
      std::vector<std::uint32_t> reached{from.first + i};
      std::size_t first = 0;
      for (int step = 0; step < reach; ++step) {
        const std::size_t last = reached.size();
        for (; first < last; ++first)
          for (const std::uint32_t partner : graph[reached[first]])
            if (std::find(reached.begin(), reached.end(), partner) == reached.end()) reached.push_back(partner);
      }
      for (const std::uint32_t node : reached)
        if (node >= to.first && node < to.first + to.count && node != from.first + i) excluded_[i].push_back(node - to.first);
      std::sort(excluded_[i].begin(), excluded_[i].end());
    }
  }

  [[nodiscard]] bool any(std::uint32_t i) const noexcept { return !excluded_.empty() && !excluded_[i].empty(); }
  /// Whether particle i skips particle j of the other group.
  [[nodiscard]] bool holds(std::uint32_t i, std::uint32_t j) const noexcept {
    return any(i) && std::binary_search(excluded_[i].begin(), excluded_[i].end(), j);
  }

 private:
  std::vector<std::vector<std::uint32_t>> excluded_;
};

}  // namespace dmp::neighbours
