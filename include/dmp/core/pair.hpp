#pragma once
#include <dmp/core/components.hpp>

namespace dmp {

/// Geometry of one directed pair, i sums over j. Everything is i minus j: r_ij = r_i - r_j, v_ij = v_i - v_j.
template <int Dim, class T>
struct Pair {
  Components<Dim, T> separation;         ///< r_ij [m]
  Components<Dim, T> relative_velocity;  ///< v_ij [m/s], of the velocity that the integrator shows to laws
  T distance_squared;                    ///< r^2 [m^2]
  T distance;                            ///< r [m], >= 0
  T approach;                            ///< r_ij . v_ij [m^2/s], < 0 while the two approach
};

}  // namespace dmp
