#pragma once
#include <concepts>
#include <type_traits>
#include <dmp/core/field.hpp>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/eos/concept.hpp>

namespace dmp::sweep {

/// Contract of a particle law, a property of the material that is evaluated once per particle and step, before the pairs.
///   using reads  = Fields<...>   what it needs; Fields<> makes it a constant of the group, which takes no memory
///   using writes = Fields<...>   what it sets
///   apply(particle)              sets the written members of `particle` from the read ones
template <class L>
concept ParticleLaw = std::is_trivially_copyable_v<L> && requires(const L law) {
  typename L::reads;
  typename L::writes;
};

template <class L>
consteval bool explain_particle_law() {
  static_assert(
      requires {
        typename L::reads;
        typename L::writes;
      },
      "dmp: not a material law: neither an EquationOfState, nor a viscosity(temperature), nor a ParticleLaw with `using reads = "
      "Fields<...>;` and `using writes = Fields<...>;`");
  return ParticleLaw<L>;
}

/// An equation of state as a particle law: sets p / rho^2.
template <class E>
struct PressureFrom {
  using reads = std::conditional_t<eos::EquationOfState<E>, Fields<field::Density>, Fields<field::Density, field::SpecificEnergy>>;
  using writes = Fields<field::PressureTerm>;
  E eos;

  template <class Particle>
  void apply(Particle& particle) const noexcept {
    particle.pressure_term = pressure(particle) / square(particle.density);
  }
  template <class Particle>
  [[nodiscard]] auto pressure(const Particle& particle) const noexcept {
    if constexpr (eos::EquationOfState<E>) return eos.pressure(particle.density);
    else return eos.pressure(particle.density, particle.specific_energy);
  }
  template <class Particle>
  [[nodiscard]] auto sound_speed(const Particle& particle) const noexcept {
    if constexpr (eos::EquationOfState<E>) return eos.sound_speed(particle.density);
    else return eos.sound_speed(particle.density, particle.specific_energy);
  }
};
template <class E>
void validate(const PressureFrom<E>& law) {
  check_parameters(law.eos);
}

/// A law mu(T) of the viscosity [Pa s] over the temperature [K], as a particle law: `T viscosity(T temperature) const`.
template <class L>
concept ViscosityOfTemperature = std::is_trivially_copyable_v<L> && requires(const L law, double temperature) {
  { law.viscosity(temperature) } -> std::same_as<double>;
};
template <ViscosityOfTemperature L>
struct ViscosityFrom {
  using reads = Fields<field::Temperature>;
  using writes = Fields<field::DynamicViscosity>;
  L law;

  template <class Particle>
  void apply(Particle& particle) const noexcept {
    particle.dynamic_viscosity = law.viscosity(particle.temperature);
  }
};
template <class L>
void validate(const ViscosityFrom<L>& law) {
  check_parameters(law.law);
}

/// What a material holds for a law that its user named.
template <class L>
[[nodiscard]] constexpr auto as_particle_law(const L& law) {
  if constexpr (eos::EquationOfState<L> || eos::ThermalEquationOfState<L>) {
    return PressureFrom<L>{law};
  } else if constexpr (ViscosityOfTemperature<L>) {
    return ViscosityFrom<L>{law};
  } else {
    if constexpr (
        requires { law.rest_density; } || requires { law.pressure(1.0); })
      static_assert(eos::explain_equation_of_state<L>());
    else static_assert(explain_particle_law<L>());
    return law;
  }
}

}  // namespace dmp::sweep
