#pragma once
// Scenes: groups, what they do to each other, the run, and what is seen of it.
#include <dmp/simulation/checks.hpp>          // What is asked of a scene before and while it runs.
#include <dmp/simulation/composition.hpp>     // From the items of a scene to what each group must hold, at compile time.
#include <dmp/simulation/contacts.hpp>        // Contact planes of confined_by.
#include <dmp/simulation/dashpots.hpp>        // Dashpots of implicit_bonds.
#include <dmp/simulation/describe.hpp>        // What a scene consists of: columns, records, interactions, sweeps, binding law.
#include <dmp/simulation/engine.hpp>          // One time step.
#include <dmp/simulation/forces.hpp>          // Sums over pairs and bonds.
#include <dmp/simulation/group.hpp>           // One group: columns, records, ghosts, grid.
#include <dmp/simulation/holds.hpp>           // How bonds hold each particle, for the bound of the step.
#include <dmp/simulation/items.hpp>           // group, interaction, bonds, material, forced_by, confined_by: what a scene is made of.
#include <dmp/simulation/limits.hpp>          // Bounds of the time step, from all laws of a scene.
#include <dmp/simulation/lists.hpp>           // Who is near whom, and when lists are worn.
#include <dmp/simulation/load.hpp>            // What a forcing does to a group as a whole: force on a plate, width of a contact.
#include <dmp/simulation/model.hpp>           // Groups and items of a scene.
#include <dmp/simulation/output.hpp>          // VtkOutput: all groups for ParaView.
#include <dmp/simulation/packing.hpp>         // What laws see of each particle, packed into records.
#include <dmp/simulation/probe.hpp>           // Looking in: a field at a point, bonds of length zero.
#include <dmp/simulation/progress.hpp>        // Bar with the time left.
#include <dmp/simulation/relax.hpp>           // To a minimum of the energy instead of through time (FIRE).
#include <dmp/simulation/relax_in_steps.hpp>  // From one state of rest to the next, in smaller steps where beads would fold.
#include <dmp/simulation/rules.hpp>           // What the items of a scene must agree on.
#include <dmp/simulation/scene.hpp>           // scene, run, observers, checkpoint and restart.
#include <dmp/simulation/state.hpp>           // The state as plain numbers: checks, snapshots, checkpoints.
