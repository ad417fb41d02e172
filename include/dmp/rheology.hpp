// include/dmp/rheology.hpp - dynamic viscosity: constant, over temperature, or over shear rate. Contracts: rheology/concept.hpp.
#pragma once
#include <dmp/rheology/andrade.hpp>            // Liquid over temperature, four parameters.
#include <dmp/rheology/any.hpp>                // A law of the temperature by its name, at run time.
#include <dmp/rheology/arrhenius.hpp>          // Liquid over temperature, two parameters.
#include <dmp/rheology/carreau.hpp>            // Over shear rate between two plateaus, smooth at rest: polymers, blood.
#include <dmp/rheology/clamped.hpp>            // A law of the temperature that goes on with the ends of its range.
#include <dmp/rheology/concept.hpp>            // The contracts of laws of the temperature and of the shear rate.
#include <dmp/rheology/constant.hpp>           // Newtonian fluid of one viscosity.
#include <dmp/rheology/cross.hpp>              // Over shear rate between two plateaus: suspensions, polymer solutions.
#include <dmp/rheology/power_law.hpp>          // Over shear rate, a power of it within stated limits: pastes, quick estimates.
#include <dmp/rheology/power_law_gas.hpp>      // Gas over temperature, near one temperature.
#include <dmp/rheology/sutherland.hpp>         // Gas over temperature, hundreds of kelvins wide: air.
#include <dmp/rheology/temperature_range.hpp>  // Where a law of the temperature holds.
