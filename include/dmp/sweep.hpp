#pragma once
// The only loops over pairs and bonds.
#include <dmp/sweep/bonds.hpp>         // Forces of the bonds of one particle, in vector registers.
#include <dmp/sweep/gather.hpp>        // Sums over the neighbours of one particle, in vector registers.
#include <dmp/sweep/pair_law.hpp>      // Contract of pair laws; a pair potential as one.
#include <dmp/sweep/particle_law.hpp>  // Contract of material laws; an equation of state as one.
#include <dmp/sweep/step_limit.hpp>    // Bounds of the time step.
#include <dmp/sweep/summed_law.hpp>    // Contract of properties that are found from the neighbours.
