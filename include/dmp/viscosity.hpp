// include/dmp/viscosity.hpp - viscous pair laws. Contract: viscosity/concept.hpp. Means of two unequal viscosities: core/mean.hpp.
#pragma once
#include <dmp/viscosity/artificial.hpp>       // Damps approaching pairs, strength alpha; for stability, no model of mu.
#include <dmp/viscosity/concept.hpp>          // The contract, and what a law that misses it is told.
#include <dmp/viscosity/monaghan.hpp>         // Laminar, acts along r_ij; keeps angular momentum, less accurate mu.
#include <dmp/viscosity/morris.hpp>           // Laminar, acts along v_ij; the default when mu is given.
#include <dmp/viscosity/none.hpp>             // No viscosity: costs nothing.
#include <dmp/viscosity/shock_capturing.hpp>  // Artificial with the local sound speed and a quadratic term.
