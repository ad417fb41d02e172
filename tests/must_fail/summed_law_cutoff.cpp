// expect: dmp: not a SummedLaw: no `double cutoff() const` [m]
#include <dmp/sweep/summed_law.hpp>

namespace {
struct Crowd {
  using reads = dmp::Fields<>;
  using sums = dmp::Fields<dmp::field::Density>;
  using sets = dmp::Fields<dmp::field::Density>;
  static constexpr bool uses_velocity = false;
  void add(const auto&, const auto&, const auto& j, auto& total) const { total.density += j.mass; }
  void set(auto& particle, const auto& total) const { particle.density = total.density; }
};
}  // namespace

static_assert(dmp::sweep::explain_summed_law<Crowd>());
