#pragma once
// Time steppers. Contract: integrator/concept.hpp.
#include <dmp/integrator/extrapolated_verlet.hpp>  // Default of SPH scenes. Second order with viscosity and dashpots.
#include <dmp/integrator/lammps_verlet.hpp>        // The same with the half-step density of LAMMPS, for comparisons.
#include <dmp/integrator/leapfrog.hpp>             // Kick-drift-kick, reversible. Default of bond-only scenes.
#include <dmp/integrator/symplectic_euler.hpp>     // One kick per step. First order.
