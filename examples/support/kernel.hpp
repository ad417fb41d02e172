#pragma once
#include <dmp/kernel.hpp>

#ifndef EXAMPLE_KERNEL
#define EXAMPLE_KERNEL Lucy
#endif

namespace example {

/// The kernel of the example: Lucy's, unless compiled with another (bench/work_precision does).
template <int Dim>
using Kernel = dmp::kernel::EXAMPLE_KERNEL<Dim>;

}  // namespace example
