#pragma once

namespace dmp {

/// How two unequal viscosities, or conductivities, make that of a pair; both give 2 mu when they are equal.
struct ArithmeticMean {
  template <class T>
  [[nodiscard]] static T twice(const T& a, const T& b) noexcept {  // mu_i + mu_j
    return a + b;
  }
};
/// 4 mu_i mu_j/(mu_i + mu_j): keeps the flux of momentum or heat continuous where the coefficient jumps. 0 when both are 0.
/// P. W. Cleary, J. J. Monaghan, J. Comput. Phys. 148 (1999) 227-264, doi:10.1006/jcph.1998.6118, eq. 28 (written for heat).
struct HarmonicMean {
  template <class T>
  [[nodiscard]] static T twice(const T& a, const T& b) noexcept {
    return 4.0 * a * b / (a + b + 1e-30);
  }
};

}  // namespace dmp
