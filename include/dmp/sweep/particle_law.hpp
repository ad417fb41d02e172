#pragma once
#include <concepts>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <dmp/core/field.hpp>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/eos/concept.hpp>
#include <dmp/rheology/concept.hpp>
#include <dmp/thermal/concept.hpp>

namespace dmp::sweep {

/// Contract of a particle law, a property of the material that is evaluated once per particle and step, before the pairs.
///   using reads  = Fields<...>   what it needs; Fields<> makes it a constant of the group, which takes no memory
///   using writes = Fields<...>   what it can set
///   apply(particle)              sets the written members of `particle` from the read ones; members that nobody reads are not there
///   admits(particle), demand()   only of a law with a limited range: whether it can work with a particle, and what it asks for
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
      "dmp: not a material law: neither an EquationOfState, nor a ThermalLaw, nor a viscosity(temperature), nor an "
      "apparent_viscosity(shear_rate), nor a ParticleLaw with `using reads = Fields<...>;` and `using writes = Fields<...>;`");
  return ParticleLaw<L>;
}

/// An equation of state as a particle law: sets p / rho^2, the sound speed, and the temperature if it knows one.
template <class E>
struct PressureFrom {
  static constexpr bool is_thermal = !eos::EquationOfState<E>;
  static constexpr bool has_temperature = requires(const E eos, double x) { eos.temperature(x, x); };
  using reads = std::conditional_t<is_thermal, Fields<field::Density, field::SpecificEnergy>, Fields<field::Density>>;
  using writes = unite<Fields<field::PressureTerm, field::SoundSpeed>,
                       std::conditional_t<has_temperature, Fields<field::Temperature>, Fields<>>>;
  E eos;

  template <class Particle>
  void apply(Particle& particle) const noexcept {
    if constexpr (requires { particle.pressure_term; }) particle.pressure_term = pressure(particle) / square(particle.density);
    if constexpr (requires { particle.sound_speed; }) particle.sound_speed = sound_speed(particle);
    if constexpr (has_temperature && requires { particle.temperature; })
      particle.temperature = eos.temperature(particle.density, particle.specific_energy);
  }
  template <class Particle>
  [[nodiscard]] auto pressure(const Particle& particle) const noexcept {
    if constexpr (is_thermal) return eos.pressure(particle.density, particle.specific_energy);
    else return eos.pressure(particle.density);
  }
  template <class Particle>
  [[nodiscard]] auto sound_speed(const Particle& particle) const noexcept {
    if constexpr (is_thermal) return eos.sound_speed(particle.density, particle.specific_energy);
    else return eos.sound_speed(particle.density);
  }
  [[nodiscard]] double specific_heat() const noexcept
    requires requires(const E e) { e.specific_heat(); }
  {
    return eos.specific_heat();
  }
  template <class Particle>
  [[nodiscard]] bool admits(const Particle& particle) const noexcept
    requires(requires(const E e, double x) { e.admits(x, x); } || requires(const E e, double x) { e.admits(x); })
  {
    if constexpr (is_thermal) return eos.admits(particle.density, particle.specific_energy);
    else return eos.admits(particle.density);
  }
  [[nodiscard]] std::string demand() const
    requires requires(const E e) { e.demand(); }
  {
    return eos.demand();
  }
};
template <class E>
void validate(const PressureFrom<E>& law) {
  check_parameters(law.eos);
}

/// A law of one number of the particle, which it may restrict to a range: the base of the three below.
template <class L, class Read, class Write>
struct PropertyFrom {
  using reads = Fields<Read>;
  using writes = Fields<Write>;
  L law;

  template <class Particle>
  [[nodiscard]] bool admits(const Particle& particle) const noexcept
    requires requires(const L l, double x) { l.admits(x); }
  {
    return law.admits(Read::of(particle));
  }
  [[nodiscard]] std::string demand() const
    requires requires(const L l) { l.demand(); }
  {
    return law.demand();
  }
};
/// T(e), mu(T) and mu(shear rate) as particle laws.
template <thermal::ThermalLaw L>
struct TemperatureFrom : PropertyFrom<L, field::SpecificEnergy, field::Temperature> {
  template <class Particle>
  void apply(Particle& particle) const noexcept {
    if constexpr (requires { particle.temperature; }) particle.temperature = this->law.temperature(particle.specific_energy);
  }
  [[nodiscard]] double specific_heat() const noexcept { return this->law.specific_heat(); }
};
template <rheology::ViscosityOfTemperature L>
struct ViscosityFrom : PropertyFrom<L, field::Temperature, field::DynamicViscosity> {
  template <class Particle>
  void apply(Particle& particle) const noexcept {
    if constexpr (requires { particle.dynamic_viscosity; }) particle.dynamic_viscosity = this->law.viscosity(particle.temperature);
  }
};
template <rheology::ViscosityOfShearRate L>
struct ApparentViscosityFrom : PropertyFrom<L, field::ShearRate, field::DynamicViscosity> {
  template <class Particle>
  void apply(Particle& particle) const noexcept {
    if constexpr (requires { particle.dynamic_viscosity; }) particle.dynamic_viscosity = this->law.apparent_viscosity(particle.shear_rate);
  }
};
template <class L, class Read, class Write>
void validate(const PropertyFrom<L, Read, Write>& law) {
  check_parameters(law.law);
}

template <class... L>
struct ChosenOf;

/// What a material holds for a law that its user named.
template <class L>
[[nodiscard]] constexpr auto as_particle_law(const L& law) {
  if constexpr (eos::EquationOfState<L> || eos::ThermalEquationOfState<L>) {
    return PressureFrom<L>{law};
  } else if constexpr (thermal::ThermalLaw<L>) {
    return TemperatureFrom<L>{{law}};
  } else if constexpr (rheology::ViscosityOfTemperature<L>) {
    return ViscosityFrom<L>{{law}};
  } else if constexpr (rheology::ViscosityOfShearRate<L>) {
    return ApparentViscosityFrom<L>{{law}};
  } else {
    if constexpr (
        requires { law.rest_density; } || requires { law.pressure(1.0); } || requires { law.pressure(1.0, 1.0); })
      static_assert(eos::explain_equation_of_state<L>());
    else if constexpr (requires { law.temperature(1.0); }) static_assert(thermal::explain_thermal_law<L>());
    else static_assert(explain_particle_law<L>());
    return law;
  }
}

/// One of several laws, chosen at run time. It is looked up once per pass over the particles, never per particle.
template <class... L>
struct ChosenOf {
  using reads = unite<typename L::reads...>;
  using writes = unite<typename L::writes...>;
  std::variant<L...> choice;
};
template <class... L>
[[nodiscard]] constexpr auto as_particle_law(const std::variant<L...>& choice) {
  using Chosen = ChosenOf<decltype(as_particle_law(std::declval<L>()))...>;
  return std::visit([](const auto& law) { return Chosen{{as_particle_law(law)}}; }, choice);
}
template <class... L>
void validate(const ChosenOf<L...>& chosen) {
  std::visit([](const auto& law) { check_parameters(law); }, chosen.choice);
}

namespace detail {
template <class Function>
void choose_first(Function&& function) {
  function();
}
template <class Function, class First, class... Rest>
void choose_first(Function&& function, const First& first, const Rest&... rest) {
  const auto go_on = [&](const auto& law) { choose_first([&](const auto&... others) { function(law, others...); }, rest...); };
  if constexpr (requires { first.choice; }) std::visit(go_on, first.choice);
  else go_on(first);
}
}  // namespace detail

/// Calls function(laws...) with the laws themselves: of each ChosenOf the one that has been chosen.
template <class Function, class... Law>
void with_chosen(Function&& function, const Law&... law) {
  if constexpr ((requires { law.choice; } || ...)) detail::choose_first(function, law...);
  else function(law...);
}

/// Whether a law restricts the particles it can work with; then it must say what it demands.
template <class L, class Particle>
concept Restricted = requires(const L law, const Particle particle) { law.admits(particle); };

}  // namespace dmp::sweep
