#pragma once
#include <dmp/integrator.hpp>
#include <dmp/kernel.hpp>
#include <dmp/particles/precision.hpp>
#include <dmp/simulation/scene.hpp>

#include "support/options.hpp"

/// The choices of an example, unless it is compiled with another one in their place, as in -DEXAMPLE_KERNEL=CubicSpline
/// (bench/work_precision does). Bounds of errors are those of the example's own choices.
namespace example {

#ifdef EXAMPLE_KERNEL
template <class Own>
using Kernel = dmp::kernel::EXAMPLE_KERNEL<Own::dimension>;
#else
template <class Own>
using Kernel = Own;
#endif

#ifdef EXAMPLE_INTEGRATOR
template <class>
using Integrator = dmp::integrator::EXAMPLE_INTEGRATOR;
#else
template <class Own>
using Integrator = Own;
#endif

#ifdef EXAMPLE_PRECISION
template <class>
using Precision = dmp::precision::EXAMPLE_PRECISION;
#else
template <class Own>
using Precision = Own;
#endif

/// To run until `end` [s], by the fraction --safety of the bounds of the time step where that is given, otherwise by `time_step` [s]
/// (0: the scene chooses it).
[[nodiscard]] inline dmp::simulation::RunOptions until(double end, double time_step, const Options& options) {
  if (options.safety > 0.0) return {.until = end, .safety = options.safety};
  return {.until = end, .time_step = time_step};
}

}  // namespace example
