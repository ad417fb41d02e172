// expect: dmp: not a BondPotential: no `double largest_stiffness() const` [N/m], which bounds the time step
#include <dmp/bond/concept.hpp>

namespace {
struct Rope {
  double pull;
  auto tension(const auto& bond) const { return pull * bond.length / bond.rest_length; }
};
}  // namespace

static_assert(dmp::bond::explain_bond_potential<Rope>());
