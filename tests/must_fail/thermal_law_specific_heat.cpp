// expect: dmp: not a ThermalLaw: no `double specific_heat() const` [J/(kg K)], the least de/dT, which bounds the time step
#include <dmp/thermal/concept.hpp>

namespace {
struct Ice {
  template <class T>
  T temperature(const T& specific_energy) const {
    return specific_energy * (1.0 / 2100.0);
  }
  template <class T>
  T specific_energy(const T& temperature) const {
    return 2100.0 * temperature;
  }
};
}  // namespace

static_assert(dmp::thermal::explain_thermal_law<Ice>());
