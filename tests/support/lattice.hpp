#pragma once
#include <cmath>
#include <dmp/core/components.hpp>

namespace test {

/// Calls f(position, volume) for every site but the origin of a lattice of unit spacing within `radius`.
/// Square lattice in 2D, cubic in 3D, a row in 1D.
template <int Dim, class Function>
void for_each_site(double radius, const Function& f) {
  const int n = static_cast<int>(radius) + 1;
  const int n_y = Dim > 1 ? n : 0, n_z = Dim > 2 ? n : 0;
  for (int z = -n_z; z <= n_z; ++z)
    for (int y = -n_y; y <= n_y; ++y)
      for (int x = -n; x <= n; ++x) {
        const double all[3] = {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
        dmp::Components<Dim, double> site{};
        for (int d = 0; d < Dim; ++d) site[d] = all[d];
        const double squared = dot(site, site);
        if (squared > 0.0 && squared <= radius * radius) f(site, 1.0);
      }
}

/// The same for the hexagonal lattice, 0.8660 area units per site.
template <class Function>
void for_each_hexagonal_site(double radius, const Function& f) {
  const double row = std::sqrt(0.75);
  const int n = static_cast<int>(radius / row) + 1;
  for (int b = -n; b <= n; ++b)
    for (int a = -2 * n; a <= 2 * n; ++a) {
      const dmp::Components<2, double> site{a + 0.5 * b, row * b};
      const double squared = dot(site, site);
      if (squared > 0.0 && squared <= radius * radius) f(site, row);
    }
}

}  // namespace test
