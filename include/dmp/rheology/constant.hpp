#pragma once
#include <dmp/core/field.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::rheology {

/// Newtonian fluid of one viscosity: a constant of its group, no column and no load.
struct Constant {
  using reads = Fields<>;
  using writes = Fields<field::DynamicViscosity>;
  Required<double> dynamic_viscosity;  ///< mu [Pa s], >= 0

  template <class Particle>
  void apply(Particle& particle) const noexcept {
    particle.dynamic_viscosity = static_cast<double>(dynamic_viscosity);
  }
};

inline void validate(const Constant& law) { require_not_negative("rheology::Constant: dynamic_viscosity", law.dynamic_viscosity, "Pa s"); }

}  // namespace dmp::rheology
