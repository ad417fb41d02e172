// include/dmp/bond.hpp - tension and energy of a bond. Contract: bond/concept.hpp.
#pragma once
#include <dmp/bond/breaking.hpp>      // Any bond law with an end: at a largest strain or energy.
#include <dmp/bond/concept.hpp>       // The contract, and what a law that misses it is told.
#include <dmp/bond/dispersive.hpp>    // Spring that acts in part through all bonds of its ends: any Poisson ratio.
#include <dmp/bond/harmonic.hpp>      // Linear spring, U = (1/2) k (r - r0)^2.
#include <dmp/bond/kelvin_voigt.hpp>  // Linear spring and dashpot in parallel: a viscoelastic solid.
#include <dmp/bond/maxwell.hpp>       // Linear spring and dashpot in series: a viscoelastic liquid, which forgets its shape.
#include <dmp/bond/standard_linear_solid.hpp>  // Spring in parallel with a Maxwell branch: a solid whose stress relaxes to a rest.
