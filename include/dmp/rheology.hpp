// include/dmp/rheology.hpp - dynamic viscosity of a group.
#pragma once
#include <dmp/rheology/constant.hpp>  // Newtonian fluid of one viscosity.
