#pragma once
// Smoothed particle hydrodynamics.
#include <dmp/sph/weakly_compressible.hpp>  // Continuity and momentum of a barotropic fluid, fused in one pass over the pairs.
