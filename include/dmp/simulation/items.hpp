#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>
#include <dmp/bond/concept.hpp>
#include <dmp/bond/harmonic.hpp>
#include <dmp/bond/kelvin_voigt.hpp>
#include <dmp/core/field.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/values.hpp>
#include <dmp/forcing/concept.hpp>
#include <dmp/forcing/contact_plane.hpp>
#include <dmp/geometry/fill.hpp>
#include <dmp/neighbours/bond_list.hpp>
#include <dmp/particles/mobility.hpp>
#include <dmp/sweep/pair_law.hpp>
#include <dmp/sweep/particle_law.hpp>
#include <dmp/sweep/summed_law.hpp>

/// What a scene is made of. Groups are named by types of the user's: `struct Water {};`. Everything that two groups do to each other is
/// declared by an item; what is not declared does not exist in the program.
namespace dmp::simulation {

/// Particles of one kind.
template <class Tag_, class Mobility_, int Dim_>
struct GroupItem {
  using Tag = Tag_;
  using Mobility = Mobility_;
  static constexpr int Dim = Dim_;
  std::string name;
  Mobility mobility;
  geometry::Points<Dim> points;
  double mass;  ///< of one particle [kg]
};
/// group<Water>("water", Mobile{}, fill(...), mass): `mass` [kg] of one particle (kg per metre of depth in 2D).
template <class Tag, class Mobility, int Dim>
[[nodiscard]] GroupItem<Tag, Mobility, Dim> group(std::string name, Mobility mobility, geometry::Points<Dim> points, double mass) {
  require_positive(("group " + name + ": mass of a particle").c_str(), mass, "kg");
  if constexpr (requires { mobility.motion; }) check_parameters(mobility.motion);
  if constexpr (particles::is_roller<Mobility>) {
    const auto& along = mobility.motion.direction.value;
    const double squared = dot(along, along);
    require(std::fabs(squared - 1.0) <= 1e-12, ("group " + name + ": direction of a Roller must have length 1, its square").c_str(),
            squared);
  }
  if (points.positions.empty()) throw ParameterError("group " + name + ": at least one particle is needed, got none");
  return {std::move(name), std::move(mobility), std::move(points), mass};
}

/// Pair laws between two groups, or within one. Each acts on both (action = reaction), unless one of them is frozen.
template <class A_, class B_, class... Law>
struct Interaction {
  using A = A_;
  using B = B_;
  using reads = unite<typename Law::reads...>;
  using writes = unite<typename Law::writes...>;
  static constexpr bool uses_velocity = (Law::uses_velocity || ...), collides = (sweep::is_potential<Law> || ...);
  Values<Law...> laws;
  int excluded_reach = 0;

  /// Leaves out pairs that are joined by up to `reach` bonds (LAMMPS' default special_bonds is 3).
  [[nodiscard]] Interaction excluding_bonded(int reach) && {
    require(reach >= 1, "interaction: excluding_bonded must be >= 1 bond", reach);
    excluded_reach = reach;
    return std::move(*this);
  }
  [[nodiscard]] double cutoff() const {
    return laws.apply([](const auto&... law) { return std::max({law.cutoff()...}); });
  }
};
template <class A, class B, class... Law>
[[nodiscard]] auto interaction(const Law&... law) {
  static_assert(sizeof...(Law) > 0, "dmp: interaction<A, B>(...) needs at least one pair law");
  (check_parameters(law), ...);
  (require_positive("interaction: cut-off of a law", sweep::as_pair_law(law).cutoff(), "m"), ...);
  return Interaction<A, B, decltype(sweep::as_pair_law(law))...>{{{sweep::as_pair_law(law)}...}};
}

/// Kelvin-Voigt bonds as forces see them: springs. What their dashpots do, which may be too stiff for forces, is in dashpots.hpp.
struct ImplicitKelvinVoigt : bond::Harmonic {
  bond::KelvinVoigt dashpot;
  double tolerance;
};

/// Bonds within one group, or between two.
template <class A_, class B_, class Law, bool Substepped>
struct Bonds {
  using A = A_;
  using B = B_;
  using reads = std::conditional_t<bond::IsDispersive<Law>, Fields<field::BondStrain>, Fields<>>;
  using writes = Fields<field::Force>;
  static constexpr bool uses_velocity = bond::UsesVelocity<Law> || std::is_same_v<Law, ImplicitKelvinVoigt>;
  static constexpr bool substepped = Substepped;
  Law law;
  std::vector<neighbours::Bond> bonds;
  int substeps = 0;
};
template <class A, class B, class Law>
[[nodiscard]] auto bonds(const Law& law, std::vector<neighbours::Bond> list) {
  static_assert(bond::explain_bond_potential<Law>());
  check_parameters(law);
  return Bonds<A, B, Law, false>{law, std::move(list)};
}
/// Bonds too stiff for the step of the scene: they are integrated in sub-steps, all other forces being kicks at the ends of the step
/// (r-RESPA; M. Tuckerman, B. J. Berne, G. J. Martyna, J. Chem. Phys. 97 (1992) 1990, doi:10.1063/1.463137). Their bound then no longer
/// limits the step of the scene. `substeps` 0: as many as their own bound asks for. Where the step comes just below a multiple of half a
/// period of a fast bond, slow forces of omega_slow feed it, by up to (omega_slow dt)^2/(2 omega_fast dt) per step, unless it is damped.
template <class A, class B, class Law>
[[nodiscard]] auto substepped_bonds(const Law& law, std::vector<neighbours::Bond> list, int substeps = 0) {
  static_assert(bond::explain_bond_potential<Law>());
  static_assert(!bond::IsDispersive<Law>,
                "dmp: substepped_bonds: bonds with a dispersive share need the strains of all bonds of their ends anew in each sub-step, "
                "which is not done; make them bonds<...>");
  check_parameters(law);
  require(substeps >= 0, "substepped_bonds: substeps must be >= 0 (0: as many as stability asks for)", substeps);
  return Bonds<A, B, Law, true>{law, std::move(list), substeps};
}

/// Kelvin-Voigt bonds whose dashpots, however stiff, do not limit the step: only the springs do. They are solved for, to a residual that
/// is `tolerance` of the first one (dashpots.hpp). Needs integrator::Leapfrog.
template <class A, class B>
[[nodiscard]] auto implicit_bonds(const bond::KelvinVoigt& law, std::vector<neighbours::Bond> list, double tolerance = 1e-12) {
  check_parameters(law);
  require(tolerance > 0.0 && tolerance < 1.0, "implicit_bonds: tolerance must be > 0 and < 1", tolerance);
  return Bonds<A, B, ImplicitKelvinVoigt, false>{{{law.stiffness}, {.stiffness = 0.0, .damping = law.damping}, tolerance}, std::move(list)};
}

template <class A, class B, bond::CanBreak Law>
auto implicit_bonds(const Law&, std::vector<neighbours::Bond>, double = 0.0) = delete;  // what is solved for does not break

template <class Tags, class... Law>
struct Material;
/// Properties of the particles of some groups: equation of state, viscosity, ...
template <class... Tag, class... Law>
struct Material<std::tuple<Tag...>, Law...> {
  template <class G>
  static constexpr bool concerns = (std::is_same_v<G, Tag> || ...);
  Values<Law...> laws;
};
template <class... Tag, class... Law>
[[nodiscard]] auto material(const Law&... law) {
  static_assert(sizeof...(Tag) > 0, "dmp: material<Groups...>(laws...) names no group");
  (check_parameters(sweep::as_particle_law(law)), ...);
  return Material<std::tuple<Tag...>, decltype(sweep::as_particle_law(law))...>{{{sweep::as_particle_law(law)}...}};
}

template <class Tags, class Law>
struct Summed;
/// A property of the particles of some groups that is found from their neighbours before forces are.
template <class... Tag, class Law>
struct Summed<std::tuple<Tag...>, Law> {
  template <class G>
  static constexpr bool concerns = (std::is_same_v<G, Tag> || ...);
  Law law;
  std::uint64_t every;
};
/// summed<Water>(sph::ShearRate<K>{...}): a summed law over all partners that interactions of laws with a density join to the group; frozen
/// partners are seen, and not changed. Steps divisible by `every` do it, the start among them; its support must not exceed the cut-off of
/// those interactions. Pairs that an interaction leaves out (excluding_bonded) are left out here too.
template <class... Tag, class Law>
[[nodiscard]] auto summed(const Law& law, std::uint64_t every = 1) {
  static_assert(sizeof...(Tag) > 0, "dmp: summed<Groups...>(law) names no group");
  static_assert(sweep::explain_summed_law<Law>());
  check_parameters(law);
  require(every > 0, "summed: every must be >= 1 step", static_cast<double>(every));
  return Summed<std::tuple<Tag...>, Law>{law, every};
}

template <class Tags, class... Law>
struct Forced;
/// Accelerations of place, velocity and time on some groups.
template <class... Tag, class... Law>
struct Forced<std::tuple<Tag...>, Law...> {
  template <class G>
  static constexpr bool concerns = (std::is_same_v<G, Tag> || ...);
  Values<Law...> laws;
};
template <class... Tag, class... Law>
[[nodiscard]] auto forced_by(const Law&... law) {
  static_assert(sizeof...(Tag) > 0, "dmp: forced_by<Groups...>(laws...) names no group");
  (check_parameters(law), ...);
  return Forced<std::tuple<Tag...>, Law...>{{{law}...}};
}

template <class Tags, int Dim, std::size_t Count>
struct Confined;
/// Planes that the particles of some groups do not get behind.
template <class... Tag, int Dim, std::size_t Count>
struct Confined<std::tuple<Tag...>, Dim, Count> {
  template <class G>
  static constexpr bool concerns = (std::is_same_v<G, Tag> || ...);
  std::array<forcing::ContactPlane<Dim>, Count> planes;
};
/// confined_by<Beads>(forcing::ContactPlane<3>{...}, ...): true contact of mobile groups with rigid planes. Two planes must be opposite or
/// at right angles. The force that keeps a particle from being behind a plane at the end of the next step,
///   (m/dt^2) max(0, p(t + dt) - n . r(t + dt))  [N],   r(t + dt) as it would be without the plane,
/// is one of the forces at t, and load_on measures it. After a change of the step, and in the first one, what is left of r behind the
/// plane is taken out, and its speed with it. Costs no bound of the step. Contact is inelastic: the speed along n becomes that of the
/// plane, a loss of (m/2)(difference)^2 per particle that meets it, which for a body vanishes as its beads become smaller.
/// N. J. Carpenter, R. L. Taylor, M. G. Katona, Int. J. Numer. Methods Eng. 32 (1991) 103-128, doi:10.1002/nme.1620320107.
template <class... Tag, int Dim, class... More>
[[nodiscard]] auto confined_by(const forcing::ContactPlane<Dim>& first, const More&... more) {
  static_assert(sizeof...(Tag) > 0, "dmp: confined_by<Groups...>(planes...) names no group");
  static_assert((std::is_same_v<More, forcing::ContactPlane<Dim>> && ...),
                "dmp: confined_by: all planes must be forcing::ContactPlane<Dim>");
  const Confined<std::tuple<Tag...>, Dim, 1 + sizeof...(More)> result{{first, more...}};
  for (std::size_t a = 0; a < result.planes.size(); ++a) {
    check_parameters(result.planes[a]);
    for (std::size_t b = 0; b < a; ++b) {
      const double cosine = dot(result.planes[a].normal.value, result.planes[b].normal.value);
      require(std::fabs(cosine) <= 1e-12 || std::fabs(cosine + 1.0) <= 1e-12,
              "confined_by: planes must be opposite or at right angles, the product of two normals -1 or 0", cosine);
    }
  }
  return result;
}

}  // namespace dmp::simulation
