// expect: dmp: not a BondPotential: no `T energy(const Bond& bond) const` [J], the stored energy
#include <dmp/bond/concept.hpp>

namespace {
struct Rope {
  double pull;
  auto tension(const auto& bond) const { return pull * bond.length / bond.rest_length; }
  double largest_stiffness() const { return pull; }
};
void validate(const Rope&) {}
}  // namespace

static_assert(dmp::bond::explain_bond_potential<Rope>());
