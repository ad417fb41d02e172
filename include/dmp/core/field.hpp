#pragma once
#include <string_view>
#include <type_traits>
#include <dmp/core/components.hpp>

namespace dmp {

/// A set of fields, as laws declare them: `using reads = Fields<field::Density, field::PressureTerm>;`
template <class... Field>
struct Fields {
  static constexpr int count = sizeof...(Field);
};

template <class Field, class List>
inline constexpr bool contains = false;
template <class Field, class... Others>
inline constexpr bool contains<Field, Fields<Others...>> = (std::is_same_v<Field, Others> || ...);

namespace detail {
template <class Done, class... Lists>
struct Unite {
  using type = Done;
};
template <class... Done, class First, class... Rest, class... Lists>
struct Unite<Fields<Done...>, Fields<First, Rest...>, Lists...>
    : Unite<std::conditional_t<contains<First, Fields<Done...>>, Fields<Done...>, Fields<Done..., First>>, Fields<Rest...>, Lists...> {};
template <class... Done, class... Lists>
struct Unite<Fields<Done...>, Fields<>, Lists...> : Unite<Fields<Done...>, Lists...> {};

template <class Done, class List, class Without>
struct Subtract;
template <class... Done, class... Rest, class Without>
struct Subtract<Fields<Done...>, Fields<Rest...>, Without> {
  template <class Field>
  using kept = std::conditional_t<contains<Field, Without>, Fields<>, Fields<Field>>;
  using type = typename Unite<Fields<Done...>, kept<Rest>...>::type;
};
}  // namespace detail

/// The union of several sets, each field once, in order of appearance; and what is in `List` but not in `Without`.
template <class... Lists>
using unite = typename detail::Unite<Fields<>, Lists...>::type;
template <class List, class Without>
using subtract = typename detail::Subtract<Fields<>, List, Without>::type;

/// What is in both.
template <class A, class B>
using intersect = subtract<A, subtract<A, B>>;

template <class... Field, class Function>
constexpr void for_each_field(Fields<Field...>, Function&& function) {
  (function(Field{}), ...);
}

/// Numbers of a field per particle: a scalar, a vector, or a tensor (`is_tensor`, of row after row), which only summed laws have.
template <class Field, int Dim>
inline constexpr int numbers_of = [] {
  if constexpr (requires { Field::is_tensor; }) return Dim * Dim;
  else return Field::is_vector ? Dim : 1;
}();

/// The fields that laws read and write. Each has a name (output, errors), a unit, and a `Slot`: the member through which a law sees
/// it (`i.density`). A state that must stay > 0 says `is_positive`; a rate says what it
/// `integrates`. A law may bring fields of its own: any struct of this shape will do.
namespace field {

struct Position {
  static constexpr std::string_view name = "position", unit = "m";
  static constexpr bool is_vector = true;
  template <int Dim, class T>
  struct Slot {
    Components<Dim, T> position;
  };
  static constexpr auto& of(auto& slots) { return slots.position; }
};
/// What pair and bond laws see as velocity is the integrator's choice (extrapolated or half-step): integrator/concept.hpp.
struct Velocity {
  static constexpr std::string_view name = "velocity", unit = "m/s";
  static constexpr bool is_vector = true;
  template <int Dim, class T>
  struct Slot {
    Components<Dim, T> velocity;
  };
  static constexpr auto& of(auto& slots) { return slots.velocity; }
};
struct Acceleration {
  static constexpr std::string_view name = "acceleration", unit = "m/s^2";
  static constexpr bool is_vector = true;
  template <int Dim, class T>
  struct Slot {
    Components<Dim, T> acceleration;
  };
  static constexpr auto& of(auto& slots) { return slots.acceleration; }
};
/// Sum of the laws that speak in newtons; divided by the mass and added to the acceleration when the sweep has summed it.
struct Force {
  static constexpr std::string_view name = "force", unit = "N";
  static constexpr bool is_vector = true;
  template <int Dim, class T>
  struct Slot {
    Components<Dim, T> force;
  };
  static constexpr auto& of(auto& slots) { return slots.force; }
};
struct Mass {  // one value per group
  static constexpr std::string_view name = "mass", unit = "kg";
  static constexpr bool is_vector = false;
  template <int Dim, class T>
  struct Slot {
    T mass;
  };
  static constexpr auto& of(auto& slots) { return slots.mass; }
};
struct Density {
  static constexpr std::string_view name = "density", unit = "kg/m^3";
  static constexpr bool is_vector = false, is_positive = true;
  template <int Dim, class T>
  struct Slot {
    T density;
  };
  static constexpr auto& of(auto& slots) { return slots.density; }
};
struct DensityRate {
  using integrates = Density;
  static constexpr std::string_view name = "density_rate", unit = "kg/m^3/s";
  static constexpr bool is_vector = false;
  template <int Dim, class T>
  struct Slot {
    T density_rate;
  };
  static constexpr auto& of(auto& slots) { return slots.density_rate; }
};
/// p / rho^2, evaluated once per particle by the equation of state; pairs only add it.
struct PressureTerm {
  static constexpr std::string_view name = "pressure_term", unit = "Pa m^6/kg^2";
  static constexpr bool is_vector = false;
  template <int Dim, class T>
  struct Slot {
    T pressure_term;
  };
  static constexpr auto& of(auto& slots) { return slots.pressure_term; }
};
struct DynamicViscosity {
  static constexpr std::string_view name = "dynamic_viscosity", unit = "Pa s";
  static constexpr bool is_vector = false;
  template <int Dim, class T>
  struct Slot {
    T dynamic_viscosity;
  };
  static constexpr auto& of(auto& slots) { return slots.dynamic_viscosity; }
};
struct Temperature {
  static constexpr std::string_view name = "temperature", unit = "K";
  static constexpr bool is_vector = false, is_positive = true;
  template <int Dim, class T>
  struct Slot {
    T temperature;
  };
  static constexpr auto& of(auto& slots) { return slots.temperature; }
};
struct SpecificEnergy {
  static constexpr std::string_view name = "specific_energy", unit = "J/kg";
  static constexpr bool is_vector = false;
  template <int Dim, class T>
  struct Slot {
    T specific_energy;
  };
  static constexpr auto& of(auto& slots) { return slots.specific_energy; }
};
struct SpecificEnergyRate {
  using integrates = SpecificEnergy;
  static constexpr std::string_view name = "specific_energy_rate", unit = "W/kg";
  static constexpr bool is_vector = false;
  template <int Dim, class T>
  struct Slot {
    T specific_energy_rate;
  };
  static constexpr auto& of(auto& slots) { return slots.specific_energy_rate; }
};
struct SoundSpeed {
  static constexpr std::string_view name = "sound_speed", unit = "m/s";
  static constexpr bool is_vector = false;
  template <int Dim, class T>
  struct Slot {
    T sound_speed;
  };
  static constexpr auto& of(auto& slots) { return slots.sound_speed; }
};
struct ThermalConductivity {
  static constexpr std::string_view name = "thermal_conductivity", unit = "W/(m K)";
  static constexpr bool is_vector = false;
  template <int Dim, class T>
  struct Slot {
    T thermal_conductivity;
  };
  static constexpr auto& of(auto& slots) { return slots.thermal_conductivity; }
};
/// sqrt(2 D:D), D = (grad v + grad v^T)/2.
struct ShearRate {
  static constexpr std::string_view name = "shear_rate", unit = "1/s";
  static constexpr bool is_vector = false;
  template <int Dim, class T>
  struct Slot {
    T shear_rate;
  };
  static constexpr auto& of(auto& slots) { return slots.shear_rate; }
};
/// Mean strain of the bonds of a particle, weighted by k r0^2: what bonds with a dispersive share see of their ends.
struct BondStrain {
  static constexpr std::string_view name = "bond_strain", unit = "-";
  static constexpr bool is_vector = false;
  template <int Dim, class T>
  struct Slot {
    T bond_strain;
  };
  static constexpr auto& of(auto& slots) { return slots.bond_strain; }
};

}  // namespace field

/// The fields of one particle (T = double) or of a pack of particles, as members: view.density, view.position, ...
template <int Dim, class T, class List>
struct View;
template <int Dim, class T, class... Field>
struct View<Dim, T, Fields<Field...>> : Field::template Slot<Dim, T>... {};

/// Copies the fields of `List` from one view to another; spreads them from a view of doubles to one of packs T.
template <class... Field>
void copy_fields(Fields<Field...>, auto& to, const auto& from) noexcept {
  ((Field::of(to) = Field::of(from)), ...);
}
template <class T, class... Field>
void spread_fields(Fields<Field...>, auto& to, const auto& from) noexcept {
  ((Field::of(to) = T(Field::of(from))), ...);
}

}  // namespace dmp
