#pragma once
#include <dmp/core/field.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::eos {

/// Density of a group that never changes, such as a solid or a fluid at rest that conducts heat: a constant of its group, no column
/// and no load. It takes the place of an equation of state where no pressure is asked for.
struct ConstantDensity {
  using reads = Fields<>;
  using writes = Fields<field::Density>;
  Required<double> density;  ///< rho [kg/m^3], > 0

  template <class Particle>
  void apply(Particle& particle) const noexcept {
    particle.density = static_cast<double>(density);
  }
};

inline void validate(const ConstantDensity& law) { require_positive("eos::ConstantDensity: density", law.density, "kg/m^3"); }

}  // namespace dmp::eos
