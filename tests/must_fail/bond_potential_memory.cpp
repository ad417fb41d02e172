// expect: dmp: not a BondPotential: `memory_after(dt)` gives no function `T (const Bond& bond)`, the memory at the end of a step of dt [s]
#include <dmp/bond/concept.hpp>

namespace {
struct Forgetful {
  double k;
  auto tension(const auto& bond) const { return bond.memory; }
  double largest_stiffness() const { return k; }
  double memory_after(double dt) const { return k * dt; }
};
}  // namespace

static_assert(dmp::bond::explain_bond_potential<Forgetful>());
