#pragma once
// Smoothed particle hydrodynamics.
#include <dmp/sph/density_sum.hpp>          // Density from the particles around, or put back to it every so often.
#include <dmp/sph/heat_conduction.hpp>      // Fourier's law inside and between phases.
#include <dmp/sph/shear_rate.hpp>           // Shear rate from the velocities around, for shear-thinning fluids.
#include <dmp/sph/shepard_density.hpp>      // Density averaged over the particles around.
#include <dmp/sph/weakly_compressible.hpp>  // Continuity, momentum and, if wanted, energy, fused in one pass over the pairs.
