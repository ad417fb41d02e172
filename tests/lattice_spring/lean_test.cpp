// A body of bonds between plates holds what sheet 01, section 7 names, and nothing else: asserted while this file is compiled.
#include <type_traits>
#include <utility>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/bond.hpp>
#include <dmp/forcing.hpp>
#include <dmp/integrator.hpp>
#include <dmp/lattice_spring.hpp>
#include <dmp/simulation.hpp>

// No kernel and no SPH: had one of these headers been included, these would clash with the templates of the same name.
namespace dmp::kernel {
struct Lucy;
struct WendlandC2;
}  // namespace dmp::kernel
namespace dmp::sph {
struct WeaklyCompressible;
}

namespace {

using namespace dmp;
using namespace dmp::simulation;

struct Beads {};

template <class Item>
auto pressed(const geometry::Points<3>& points, const Item& bonded) {
  const forcing::Plane<3> below{.normal = {{0.0, 0.0, 1.0}}, .position = 0.0, .strength = 1.0};
  return scene<integrator::Leapfrog>(geometry::Box<3>::unbounded(), group<Beads>("beads", particles::Mobile{}, points, 1.0), bonded,
                                     forced_by<Beads>(below));
}
template <class Item>
using Pressed = decltype(pressed(std::declval<geometry::Points<3>>(), std::declval<Item>()));
template <class Law>
using With = Pressed<decltype(bonds<Beads, Beads>(std::declval<Law>(), {}))>;
using Implicit = Pressed<decltype(implicit_bonds<Beads, Beads>(std::declval<bond::KelvinVoigt>(), {}))>;

template <class Scene>
using GroupOf = std::remove_cvref_t<decltype(std::declval<Scene&>().template group<Beads>())>;
template <class Scene>
using EngineOf = std::remove_cvref_t<decltype(std::declval<Scene&>().engine())>;

template <class G>
concept HasGhosts = requires(G group) { group.ghosts; };

/// `Record`: what bonds load of each bead.
template <class Scene, class Record>
consteval bool is_lean() {
  using G = GroupOf<Scene>;
  using L = typename G::Layout;
  static_assert(std::is_same_v<typename L::columns, Fields<field::Position, field::Velocity, field::Acceleration>>);
  static_assert(G::Columns::bytes_per_particle == 9 * sizeof(double));
  static_assert(std::is_same_v<typename L::record, Record>);
  static_assert(std::is_same_v<typename L::writes, Fields<field::Force>>);
  static_assert(std::is_same_v<typename L::constants, Fields<field::Mass>> && std::is_same_v<typename L::derived, Fields<>>);
  static_assert(!L::has_pairs && !EngineOf<Scene>::has_pairs && !HasGhosts<G>);
  return true;
}
template <class Law>
inline constexpr bool remembers = !std::is_empty_v<sweep::Recall<Law>>;

}  // namespace

TEST_CASE("a body of bonds between plates: no density, no lists, no kernels; velocities for dashpots and memories for branches alone") {
  using field::Position, field::Velocity;
  static_assert(is_lean<With<bond::Harmonic>, Fields<Position>>());
  static_assert(is_lean<With<bond::KelvinVoigt>, Fields<Position, Velocity>>());
  static_assert(is_lean<Implicit, Fields<Position, Velocity>>());
  static_assert(is_lean<With<bond::Maxwell>, Fields<Position>>());
  static_assert(is_lean<With<bond::StandardLinearSolid>, Fields<Position>>());
  static_assert(!remembers<bond::Harmonic> && !remembers<bond::KelvinVoigt> && remembers<bond::Maxwell> &&
                remembers<bond::StandardLinearSolid>);
  static_assert(sizeof(bond::Harmonic) == sizeof(double) && sizeof(bond::KelvinVoigt) == 2 * sizeof(double));

  const auto block = lattice_spring::lattice_block(lattice_spring::CubicLattice{.spacing = 1.0}, {2, 2, 2});
  auto scene = pressed(block.points, bonds<Beads, Beads>(bond::Harmonic{.stiffness = 1.0}, block.bonds));
  CHECK(describe(scene).find("no neighbour lists, no ghosts") != std::string::npos);
  CHECK(GroupOf<decltype(scene)>::Columns::bytes_per_particle == 72);
}
