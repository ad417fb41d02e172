// include/dmp/potential.hpp - short-range pair potentials. Contract: potential/concept.hpp.
#pragma once
#include <dmp/potential/concept.hpp>        // The contract, and what a law that misses it is told.
#include <dmp/potential/lennard_jones.hpp>  // Lennard-Jones 12-6, truncated; repulsion alone at a cut-off of 2^(1/6) sigma.
