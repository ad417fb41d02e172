#pragma once
// Groups and their storage.
#include <dmp/particles/clamp.hpp>      // How a driven group of held particles goes along a line.
#include <dmp/particles/columns.hpp>    // Structure of arrays: one column per field.
#include <dmp/particles/mobility.hpp>   // Mobile, Stationary, Frozen, Driven, Roller.
#include <dmp/particles/precision.hpp>  // Double or single precision of pair laws.
#include <dmp/particles/records.hpp>    // What laws read of a particle, packed for vector loads.
#include <dmp/particles/sums.hpp>       // What pairs and bonds add to partners.
#include <dmp/particles/view.hpp>       // Groups and columns without their types, for output and checks.
