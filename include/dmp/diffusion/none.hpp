#pragma once
#include <dmp/core/field.hpp>

namespace dmp::diffusion {

/// No diffusion of density: leaves no field, no byte and no instruction.
struct None {
  using reads = Fields<>;
};
inline void validate(const None&) {}

}  // namespace dmp::diffusion
