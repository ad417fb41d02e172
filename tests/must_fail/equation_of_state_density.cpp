// expect: dmp: not an EquationOfState: no `T density(T pressure) const` [kg/m^3], the inverse of pressure
#include <dmp/eos/concept.hpp>

namespace {
struct Isothermal {
  double rest_density, temperature;
  template <class T>
  T pressure(const T& density) const {
    return 287.0 * temperature * density;
  }
  template <class T>
  T sound_speed(const T& density) const {
    return 340.0 + 0.0 * density;
  }
};
void validate(const Isothermal&) {}
}  // namespace

static_assert(dmp::eos::explain_equation_of_state<Isothermal>());
