// include/dmp/forcing.hpp - accelerations of place, velocity and time. Contract: forcing/concept.hpp.
#pragma once
#include <dmp/forcing/concept.hpp>     // The contract, and what a law that misses it is told.
#include <dmp/forcing/constant.hpp>    // Gravity, or a steady drive.
#include <dmp/forcing/sinusoidal.hpp>  // Steady drive with an oscillation on top.
#include <dmp/forcing/pulsed.hpp>      // Heart beat: short push, weak backward pull.
#include <dmp/forcing/drag.hpp>        // Linear drag towards rest (LAMMPS `fix viscous`).
#include <dmp/forcing/plane.hpp>       // Rigid plane that pushes back what is behind it; may move.
#include <dmp/forcing/contact_plane.hpp>  // Rigid plane that nothing gets behind; for confined_by, not itself a forcing.
#include <dmp/forcing/ramp.hpp>        // Motion with a smooth start, constant speed and hold: of planes, not itself a forcing.
