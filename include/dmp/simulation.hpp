#pragma once
// Scenes: groups, what they do to each other, the run, and what is seen of it.
#include <dmp/simulation/describe.hpp>  // What a scene consists of: columns, records, interactions, sweeps, binding law.
#include <dmp/simulation/items.hpp>     // group, interaction, bonds, material, forced_by: what a scene is made of.
#include <dmp/simulation/output.hpp>    // VtkOutput: all groups for ParaView.
#include <dmp/simulation/scene.hpp>     // scene, run, observers, checkpoint and restart.
