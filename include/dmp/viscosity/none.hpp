#pragma once
#include <dmp/core/field.hpp>

namespace dmp::viscosity {

/// No viscosity: leaves no field, no byte and no instruction.
struct None {
  using reads = Fields<>;
  [[nodiscard]] constexpr double damping_rate(double, double, double, int) const noexcept { return 0.0; }
};
inline void validate(const None&) {}

}  // namespace dmp::viscosity
