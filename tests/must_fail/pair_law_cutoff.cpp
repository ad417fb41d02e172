// expect: dmp: not a PairLaw: no `double cutoff() const` [m]
#include <dmp/sweep/pair_law.hpp>

namespace {
struct Push {
  using reads = dmp::Fields<>;
  using writes = dmp::Fields<dmp::field::Force>;
  static constexpr bool uses_velocity = false;
  void add(const auto& pair, const auto&, const auto&, auto& sums) const { sums.force += pair.separation; }
  void step_limits(const dmp::sweep::StepState&, dmp::sweep::StepLimit&) const {}
};
}  // namespace

static_assert(dmp::sweep::explain_pair_law<Push>());
