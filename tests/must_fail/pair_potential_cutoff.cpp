// expect: dmp: not a PairPotential: no `cutoff` [m]
#include <dmp/potential/concept.hpp>

namespace {
struct InverseSquare {
  double strength;
  template <class T>
  T force_factor(const T& distance_squared) const {
    return strength / (distance_squared * distance_squared);
  }
  template <class T>
  T energy(const T& distance_squared) const {
    return 0.5 * strength / distance_squared;
  }
  double largest_stiffness() const { return strength; }
};
void validate(const InverseSquare&) {}
}  // namespace

static_assert(dmp::potential::explain_pair_potential<InverseSquare>());
