#pragma once
#include <dmp/core/field.hpp>

namespace dmp::tensile {

/// No correction of the tensile instability: leaves no field, no byte and no instruction.
struct None {
  using reads = Fields<>;
};
inline void validate(const None&) {}

}  // namespace dmp::tensile
