#pragma once
#include <cstddef>
#include <random>
#include <vector>
#include <dmp/core/vector.hpp>

namespace bench {

/// n^3 particles of a cubic lattice of spacing 1, each moved at random by up to 0.2 in each direction.
inline std::vector<dmp::Vector<3>> jittered_lattice(int n) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> jitter(-0.2, 0.2);
  std::vector<dmp::Vector<3>> positions;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        positions.emplace_back(i + 0.5 + jitter(generator), j + 0.5 + jitter(generator), k + 0.5 + jitter(generator));
  return positions;
}

}  // namespace bench
