// expect: dmp: not a BondPotential: a law with a dispersive share sees neither velocities nor a memory
#include <dmp/dmp.hpp>

namespace {
struct Both : dmp::bond::KelvinVoigt {
  double dispersive_share = 0.5;
};
static_assert(dmp::bond::explain_bond_potential<Both>());
}  // namespace
