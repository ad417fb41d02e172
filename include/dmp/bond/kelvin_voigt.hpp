#pragma once
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::bond {

/// Kelvin-Voigt bond: spring and dashpot in parallel.  tension = k (r - r0) + c dr/dt [N], U = (1/2) k (r - r0)^2 [J].
/// The dashpot acts along the bond, so rigid motion is free; it dissipates c (dr/dt)^2 >= 0 [W]. k = 0 is a dashpot alone; c = 0 is a
/// spring alone, whose forces Harmonic finds too, without loading velocities.
/// M. Sahputra, A. Alexiadis, M. J. Adams, ChemEngineering 4 (2020) 30, doi:10.3390/chemengineering4020030.
struct KelvinVoigt {
  Required<double> stiffness;  ///< k [N/m], >= 0
  Required<double> damping;    ///< c [N s/m], >= 0

  [[nodiscard]] auto tension(const auto& bond) const noexcept {
    return stiffness * (bond.length - bond.rest_length) + damping * bond.length_rate;
  }
  [[nodiscard]] auto energy(const auto& bond) const noexcept { return 0.5 * stiffness * square(bond.length - bond.rest_length); }
  [[nodiscard]] double largest_stiffness() const noexcept { return stiffness; }
  [[nodiscard]] double largest_damping() const noexcept { return damping; }
};

inline void validate(const KelvinVoigt& law) {
  require_not_negative("bond::KelvinVoigt: stiffness", law.stiffness, "N/m");
  require_not_negative("bond::KelvinVoigt: damping", law.damping, "N s/m");
}

}  // namespace dmp::bond
