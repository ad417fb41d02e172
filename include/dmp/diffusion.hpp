// include/dmp/diffusion.hpp - smoothing of the density. Contract: diffusion/concept.hpp.
#pragma once
#include <dmp/diffusion/concept.hpp>             // The contract, and what a law that misses it is told.
#include <dmp/diffusion/none.hpp>                // No diffusion of density: costs nothing.
#include <dmp/diffusion/molteni_colagrossi.hpp>  // delta-SPH: removes the pressure noise of weakly compressible flow.
