// include/dmp/tensile.hpp - corrections of the tensile instability. Contract: tensile/concept.hpp.
#pragma once
#include <dmp/tensile/concept.hpp>   // The contract, and what a law that misses it is told.
#include <dmp/tensile/none.hpp>      // No correction: costs nothing.
#include <dmp/tensile/monaghan.hpp>  // Artificial repulsion, Monaghan 2000: particles under tension do not clump.
