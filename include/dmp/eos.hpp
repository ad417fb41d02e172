// include/dmp/eos.hpp - equations of state. Contract: eos/concept.hpp.
#pragma once
#include <dmp/eos/concept.hpp>                   // The contract, and what a law that misses it is told.
#include <dmp/eos/tait.hpp>                      // Nearly incompressible liquid; stiffens under compression.
#include <dmp/eos/linear.hpp>                    // Liquid of constant sound speed; the cheapest.
#include <dmp/eos/constant_density.hpp>          // No pressure, one density: heat in solids and in fluids at rest.
#include <dmp/eos/ideal_gas.hpp>                 // Gas: pressure from density and specific energy.
#include <dmp/eos/noble_abel_stiffened_gas.hpp>  // Hot or shocked liquid, and its vapour: pressure and temperature from density and energy.
