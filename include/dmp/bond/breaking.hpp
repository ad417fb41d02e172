#pragma once
#include <dmp/bond/concept.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::bond {

/// Breaks in tension: (r - r0)/r0 > strain. A bond of rest length zero breaks as soon as it has a length.
struct LargestStrain {
  Required<double> strain;  ///< [-], >= 0

  [[nodiscard]] auto breaks(const auto&, const auto& bond) const noexcept { return bond.length > (1.0 + strain) * bond.rest_length; }
};
inline void validate(const LargestStrain& criterion) {
  require(criterion.strain >= 0.0 && criterion.strain - criterion.strain == 0.0, "bond::LargestStrain: strain must be finite and >= 0",
          criterion.strain);
}

/// Breaks when the law has stored more, in tension or compression: U > energy.
struct LargestEnergy {
  Required<double> energy;  ///< of one bond of weight 1 [J], >= 0

  [[nodiscard]] auto breaks(const auto& law, const auto& bond) const noexcept { return law.energy(bond) > energy; }
};
inline void validate(const LargestEnergy& criterion) { require_not_negative("bond::LargestEnergy: energy", criterion.energy, "J"); }

/// A bond law whose bonds break: Breaking{Harmonic{.stiffness = 100.0}, LargestStrain{.strain = 0.05}}.
/// Broken is broken: a bond is judged at the positions of each evaluation of its force, exerts none from that one on, and is never made
/// again. Both ends judge alike, so momentum is kept and the order of the bonds does not matter. The energy stored at that moment, by up to
/// the work of one step more than the criterion says, is lost to the particles. From the next step on, the two are a pair for interactions
/// that had left them out (excluding_bonded).
/// M. Sahputra, A. Alexiadis, M. J. Adams, ChemEngineering 4 (2020) 30, doi:10.3390/chemengineering4020030, has bonds of limited extent.
template <class Law, class Criterion>
struct Breaking : Law {
  static_assert(!CanBreak<Law>, "dmp: bond::Breaking: the law breaks already; write one criterion");
  Criterion criterion;

  [[nodiscard]] auto breaks(const auto& bond) const noexcept { return criterion.breaks(static_cast<const Law&>(*this), bond); }
};
template <class Law, class Criterion>
Breaking(Law, Criterion) -> Breaking<Law, Criterion>;

template <class Law, class Criterion>
void validate(const Breaking<Law, Criterion>& law) {
  check_parameters(static_cast<const Law&>(law));
  check_parameters(law.criterion);
}

}  // namespace dmp::bond
