#pragma once
#include <type_traits>
#include <dmp/kernel.hpp>

#ifndef EXAMPLE_KERNEL
#define EXAMPLE_KERNEL Lucy
#endif

namespace example {

/// The kernel of the example: Lucy's, unless compiled with another (bench/work_precision does).
template <int Dim>
using Kernel = dmp::kernel::EXAMPLE_KERNEL<Dim>;

/// The time step [s] that a case asks for, which is within the bounds of Lucy's kernel; 0, a step chosen by the scene, with another.
template <int Dim>
[[nodiscard]] constexpr double step_of_case(double time_step) {
  return std::is_same_v<Kernel<Dim>, dmp::kernel::Lucy<Dim>> ? time_step : 0.0;
}

}  // namespace example
