// include/dmp/kernel.hpp - smoothing kernels. Contract: kernel/concept.hpp.
#pragma once
#include <dmp/kernel/concept.hpp>       // The contract, and what a law that misses it is told.
#include <dmp/kernel/lucy.hpp>          // Lucy 1977. Cheap, no division; the kernel of the published cases.
#include <dmp/kernel/cubic_spline.hpp>  // M4 B-spline. For comparison with older SPH; particles pair when they have many neighbours.
#include <dmp/kernel/quartic.hpp>       // (1 - q^2)^4. Density summation, as in LAMMPS `sph/rhosum`.
#include <dmp/kernel/wendland_c2.hpp>   // Wendland 1995. Resists pairing; needs more neighbours than Lucy.
#include <dmp/kernel/wendland_c4.hpp>   // Wendland 1995. Smoother and narrower; the most accurate here at many neighbours.
