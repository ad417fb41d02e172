#pragma once
#include <dmp/integrator.hpp>
#include <dmp/kernel.hpp>
#include <dmp/particles/precision.hpp>
#include <dmp/simulation/scene.hpp>

#include "support/options.hpp"

// What stands in the place of the example's own choice, a type `Own`.
#ifndef EXAMPLE_KERNEL
#define EXAMPLE_KERNEL Own
#endif
#ifndef EXAMPLE_INTEGRATOR
#define EXAMPLE_INTEGRATOR Own
#endif
#ifndef EXAMPLE_PRECISION
#define EXAMPLE_PRECISION Own
#endif

/// The choices of an example, unless it is compiled with another one in their place, as in -DEXAMPLE_INTEGRATOR=dmp::integrator::Leapfrog
/// or '-DEXAMPLE_KERNEL=dmp::kernel::CubicSpline<Own::dimension>' (bench/work_precision.py does). Bounds of errors are those of the
/// example's own choices.
namespace example {

template <class Own>
using Kernel = EXAMPLE_KERNEL;
template <class Own>
using Integrator = EXAMPLE_INTEGRATOR;
template <class Own>
using Precision = EXAMPLE_PRECISION;

/// To run until `end` [s], by the fraction --safety of the bounds of the time step where that is given, otherwise by `time_step` [s]
/// (0: the scene chooses it).
[[nodiscard]] inline dmp::simulation::RunOptions until(double end, double time_step, const Options& options) {
  if (options.safety > 0.0) return {.until = end, .safety = options.safety};
  return {.until = end, .time_step = time_step};
}

}  // namespace example
