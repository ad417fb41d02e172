#pragma once

namespace dmp {

/// A parameter without default: an aggregate that leaves it out does not compile.
///   struct Harmonic { Required<double> stiffness; };   Harmonic{}  // error, Harmonic{.stiffness = 2.0} // fine
/// Converts to T by itself; copy to a T before multiplying an Eigen vector, whose operators do not see through it.
template <class T>
struct Required {
  constexpr Required(T given) noexcept : value(given) {}
  constexpr operator T() const noexcept { return value; }
  T value;
};

}  // namespace dmp
