// include/dmp/thermal.hpp - temperature by specific energy, and conductivity. Contract: thermal/concept.hpp.
#pragma once
#include <dmp/thermal/concept.hpp>       // The contract, and what a law that misses it is told.
#include <dmp/thermal/linear.hpp>        // Liquid or solid of constant specific heat.
#include <dmp/thermal/gas.hpp>           // Ideal gas, by its molar mass.
#include <dmp/thermal/conductivity.hpp>  // Thermal conductivity of a group, one value.
