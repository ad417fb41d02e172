#pragma once
// Who is near whom, and who is bonded to whom.
#include <dmp/neighbours/bond_list.hpp>        // Bonds of each particle, with rest lengths; checks of bonds.
#include <dmp/neighbours/cell_grid.hpp>        // Particles sorted into cells; all within a distance.
#include <dmp/neighbours/cells.hpp>            // Equal cells over a cloud of points.
#include <dmp/neighbours/counting_sort.hpp>    // Rows in the order of a whole number, on all threads.
#include <dmp/neighbours/exclusions.hpp>       // Pairs that bonds join and short-range laws skip.
#include <dmp/neighbours/ghosts.hpp>           // Images of particles behind periodic faces.
#include <dmp/neighbours/pair_list.hpp>        // Neighbour lists in whole packs, each pair of a block once.
#include <dmp/neighbours/relative_motion.hpp>  // When lists are worn, place by place.
#include <dmp/neighbours/spatial_order.hpp>    // Neighbours in space, neighbours in memory.
