// include/dmp/viscosity.hpp - viscous pair laws. Contract: viscosity/concept.hpp.
#pragma once
#include <dmp/viscosity/concept.hpp>     // The contract, and what a law that misses it is told.
#include <dmp/viscosity/mean.hpp>        // Means of two unequal viscosities: arithmetic, harmonic.
#include <dmp/viscosity/none.hpp>        // No viscosity: costs nothing.
#include <dmp/viscosity/morris.hpp>      // Laminar, acts along v_ij; the default when mu is given.
#include <dmp/viscosity/monaghan.hpp>    // Laminar, acts along r_ij; keeps angular momentum, less accurate mu.
#include <dmp/viscosity/artificial.hpp>  // Damps approaching pairs, strength alpha; for shocks and stability, no model of mu.
