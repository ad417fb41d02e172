#pragma once
#include <concepts>
#include <type_traits>

namespace dmp::bond {

/// What a bond law sees. A law that states its `largest_damping` is compiled into a loop that also loads velocities, any other is not.
template <class T>
struct Stretch {
  T length;       ///< r [m], > 0
  T rest_length;  ///< r0 [m], >= 0
};
template <class T>
struct MovingStretch : Stretch<T> {
  T length_rate;  ///< dr/dt [m/s], > 0 while the bond lengthens
};
/// What a law with memory sees beside one of the two.
template <class Seen, class T>
struct Remembering : Seen {
  T length_change;  ///< [m], by which the bond has lengthened over the step
  T memory;         ///< a number of the law's own, such as the force of a branch [N]; 0 at first
};
/// What a law with a dispersive share sees beside a stretch.
template <class Seen, class T>
struct Dispersing : Seen {
  T strain_of_ends;  ///< [-], mean strain of the bonds of one end, plus that of the other
};
/// All that there is to be seen.
template <class T>
using FullState = Dispersing<Remembering<MovingStretch<T>, T>, T>;
template <class Bond>
concept SeesStrainOfEnds = requires(const Bond bond) {
  bond.strain_of_ends;
};

template <class B>
concept UsesVelocity = requires(const B law) {
  { law.largest_damping() } -> std::convertible_to<double>;
};
/// Only a law that states `memory_after` is compiled into a loop that loads and stores a memory.
template <class B>
concept HasMemory = requires(const B law, double dt) {
  law.memory_after(dt);
};

/// Only a law that states its `dispersive_share` is compiled into loops that sum the strains of the bonds of each particle.
template <class B>
concept IsDispersive = requires(const B law) {
  { law.dispersive_share } -> std::convertible_to<double>;
  { law.stiffness } -> std::convertible_to<double>;
};

/// Only a law that states `breaks` is compiled into a loop that takes bonds away.
template <class B>
concept CanBreak = requires(const B law, const Remembering<MovingStretch<double>, double> bond) { law.breaks(bond); };

namespace detail {
template <class B>
using Seen = std::conditional_t<UsesVelocity<B>, MovingStretch<double>, Stretch<double>>;
template <class B>
using State = std::conditional_t<HasMemory<B>, Remembering<Seen<B>, double>,
                                 std::conditional_t<IsDispersive<B>, Dispersing<Seen<B>, double>, Seen<B>>>;
}  // namespace detail

/// Contract of a bond law.
///   tension(bond)        [N], > 0 pulls the ends together; the force on i is -tension n_ij
///   energy(bond)         [J], stored (elastic) energy, of which the elastic tension is the derivative; only conformance asks for it
///   largest_stiffness()  [N/m], largest dT/dr, for the time step; what a bond under tension holds across, T/r, the scene adds
///   largest_damping()    [N s/m], largest dT/d(dr/dt), for the time step; only of a law that uses `length_rate`
///   memory_after(dt)     only of a law with one number of memory per bond: a function of the bond that gives the memory at the end of a
///                        step of dt [s] from that at its beginning and `length_change`. The function is asked once per bond and step,
///                        before the tension, which sees the new memory; what depends on dt alone is computed outside of it, once.
///                        dt = 0 is a sudden change of length, and if there is none the memory stays as it is.
///   dispersive_share, stiffness  members, only of a law whose tension depends on how all bonds of its two ends are strained: it sees
///                        `strain_of_ends` = theta/S of one end plus that of the other, theta = sum of k r0 (r - r0), S = sum of k r0^2
///                        over the bonds of a particle by laws with a dispersive share D, k = `stiffness` times the weight of the bond
///   breaks(bond)         only of a law whose bonds break: whether this one does, now and for good. Asked once per evaluation of the force;
///                        the answer must depend on the length and memory alone, so that both ends give the same.
template <class B>
concept BondPotential = std::is_trivially_copyable_v<B> && requires(const B law, const detail::State<B> bond) {
  { law.tension(bond) } -> std::same_as<double>;
  { law.largest_stiffness() } -> std::convertible_to<double>;
};

template <class B>
consteval bool explain_bond_potential() {
  using State = detail::State<B>;
  static_assert(
      requires(const B b, const State s) {
        { b.tension(s) } -> std::same_as<double>;
      },
      "dmp: not a BondPotential: no `T tension(const Bond& bond) const` [N], > 0 pulls the ends together; bond has length, rest_length, "
      "length_rate");
  static_assert(
      requires(const B b) {
        { b.largest_stiffness() } -> std::convertible_to<double>;
      },
      "dmp: not a BondPotential: no `double largest_stiffness() const` [N/m], which bounds the time step");
  static_assert(!IsDispersive<B> || !(UsesVelocity<B> || HasMemory<B>),
                "dmp: not a BondPotential: a law with a dispersive share sees neither velocities nor a memory");
  static_assert(CanBreak<B> || !requires(B b, const Remembering<MovingStretch<double>, double> s) { b.breaks(s); },
                "dmp: not a BondPotential: `breaks(const Bond& bond)` must be const");
  if constexpr (HasMemory<B>)
    static_assert(
        requires(const B b, const State s, double dt) {
          { b.memory_after(dt)(s) } -> std::same_as<double>;
        },
        "dmp: not a BondPotential: `memory_after(dt)` gives no function `T (const Bond& bond)`, the memory at the end of a step of dt [s]");
  return BondPotential<B>;
}

}  // namespace dmp::bond
