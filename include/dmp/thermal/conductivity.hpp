#pragma once
#include <dmp/core/field.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::thermal {

/// Material of one thermal conductivity: a constant of its group, no column and no load.
struct Conductivity {
  using reads = Fields<>;
  using writes = Fields<field::ThermalConductivity>;
  Required<double> thermal_conductivity;  ///< kappa [W/(m K)], >= 0; 0 insulates

  template <class Particle>
  void apply(Particle& particle) const noexcept {
    particle.thermal_conductivity = static_cast<double>(thermal_conductivity);
  }
};

inline void validate(const Conductivity& law) {
  require_not_negative("thermal::Conductivity: thermal_conductivity", law.thermal_conductivity, "W/(m K)");
}

}  // namespace dmp::thermal
