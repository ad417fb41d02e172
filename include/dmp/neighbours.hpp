#pragma once
// Who is near whom, and who is bonded to whom.
#include <dmp/neighbours/bond_list.hpp>   // Bonds of each particle, with rest lengths; checks of bonds.
#include <dmp/neighbours/cell_grid.hpp>   // Particles sorted into cells; all within a distance.
#include <dmp/neighbours/exclusions.hpp>  // Pairs that bonds join and short-range laws skip.
#include <dmp/neighbours/ghosts.hpp>      // Images of particles behind periodic faces.
#include <dmp/neighbours/pair_list.hpp>   // Full neighbour lists in whole packs.
