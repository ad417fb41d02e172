#pragma once
#include <string_view>
#include <type_traits>
#include <dmp/core/components.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>

/// What happens to the particles of a group, decided at compile time.
namespace dmp::particles {

/// Moves, and its state (density, ...) evolves.
struct Mobile {
  static constexpr std::string_view name = "mobile";
  static constexpr bool moves = true, evolves = true;
};

/// Stays in place while its state evolves: a wall whose density, hence pressure, answers to the fluid. (LAMMPS: fix sph/stationary.)
struct Stationary {
  static constexpr std::string_view name = "stationary";
  static constexpr bool moves = false, evolves = true;
};

/// Nothing changes; never integrated, swept, or searched against itself. A wall velocity is seen by viscosity though the particles stay:
/// a plate that slides along itself.
template <int Dim>
struct Frozen {
  static constexpr std::string_view name = "frozen";
  static constexpr bool moves = false, evolves = false;
  Vector<Dim> wall_velocity = Vector<Dim>::Zero();  ///< [m/s]
};

/// Follows a prescribed motion while its state evolves. Motion: `Vector position(const Vector& start, double time) const` [m] and
/// `Vector velocity(const Vector& start, double time) const` [m/s], its time derivative.
template <class Motion>
struct Driven {
  static constexpr std::string_view name = "driven";
  static constexpr bool moves = true, evolves = true;
  Motion motion;
};
template <class Motion>
Driven(Motion) -> Driven<Motion>;

/// Follows a prescribed motion along one direction, and the forces across it: a support on rollers, grips that let a bar become thinner.
/// Motion: as of Driven, with `direction` (of length 1) besides: particles::Clamp.
template <class Motion>
struct Roller {
  static constexpr std::string_view name = "roller";
  static constexpr bool moves = true, evolves = true;
  Motion motion;
  /// The part of a vector that is prescribed.
  template <class V>
  [[nodiscard]] V held(const V& vector) const noexcept {
    const auto along = to_vector<V::RowsAtCompileTime>(motion.direction.value);
    return along.dot(vector) * along;
  }
};
template <class Motion>
Roller(Motion) -> Roller<Motion>;

template <class M>
inline constexpr bool is_driven = false;
template <class Motion>
inline constexpr bool is_driven<Driven<Motion>> = true;
template <class M>
inline constexpr bool is_roller = false;
template <class Motion>
inline constexpr bool is_roller<Roller<Motion>> = true;
/// Forces move it, all of it or a part.
template <class M>
inline constexpr bool is_mobile = std::is_same_v<M, Mobile> || is_roller<M>;

}  // namespace dmp::particles
