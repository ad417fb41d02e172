#pragma once
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <dmp/core/require.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/bond/concept.hpp>
#include <dmp/forcing/concept.hpp>
#include <dmp/forcing/contact_plane.hpp>
#include <dmp/simulation/composition.hpp>
#include <dmp/simulation/contacts.hpp>

namespace dmp::simulation {

/// What a forcing does to a group as a whole.
template <int Dim>
struct Load {
  Vector<Dim> force = Vector<Dim>::Zero();   ///< sum over the particles [N]
  Vector<Dim> centre = Vector<Dim>::Zero();  ///< their mean position [m], each as much as its force is large
  std::size_t particles = 0;                 ///< that feel it
  double radius = 0.0;                       ///< largest distance [m] of one of them from the line through the centre along the force
};

/// What a forcing does now to the particles of a group, e.g. how hard a plane presses and how wide the contact is:
///   load_on<Beads>(scene, plane).force
/// The law need not be part of the scene. At `time` [s], if it is not the scene's. The same bits for any number of threads.
/// A forcing::ContactPlane must be one of the scene's (ParameterError), and the force is that of its last evaluation, whatever `time`: in a
/// run the one that keeps the particles in front for the next step, and what the step just made has needed besides. A particle that two
/// opposite planes touch at once bears the difference of their forces, on the one that presses harder.
template <class Tag, class Scene, class Law>
[[nodiscard]] Load<Scene::dimension> load_on(const Scene& scene, const Law& law, double time) {
  constexpr int dim = Scene::dimension;
  constexpr bool is_contact = std::is_same_v<Law, forcing::ContactPlane<dim>>;
  check_parameters(law);
  const auto& g = scene.template group<Tag>();
  if constexpr (is_contact) {
    static_assert(meets_planes<decltype(g)>, "dmp: load_on: no confined_by of the scene concerns the group");
    bool known = false;
    for_each_plane(scene.engine(), g, [&](const auto& plane, const Vector<dim>& normal) {
      known = known || (plane.position == law.position && plane.motion == law.motion && normal == to_vector<dim>(law.normal));
    });
    require(known, "load_on: a contact plane must be one of the scene's, with its normal, motion and position [m]", law.position);
  } else {
    static_assert(forcing::explain_forcing<Law, dim>());
  }
  const auto force = [&](std::size_t i) -> Vector<dim> {
    if constexpr (is_contact) {  // the forces of other planes have no part along this normal, or one against it
      const Vector<dim> normal = to_vector<dim>(law.normal), all = g.template get<ContactForce>()[i];
      const double part = normal.dot(all);
      return (part > 1e-9 * all.norm() ? part : 0.0) * normal;  // a choice of vectors GCC 12 makes wrong code of with AVX-512
    } else {
      return g.mass * to_vector<dim>(law.acceleration(scene.engine().subject(g, i, time, 0.0)));
    }
  };
  struct Sums {
    Vector<dim> force = Vector<dim>::Zero(), moment = Vector<dim>::Zero();
    double size = 0.0;
    std::size_t particles = 0;
    void operator+=(const Sums& other) {
      force += other.force;
      moment += other.moment;
      size += other.size;
      particles += other.particles;
    }
  };
  const Sums sums = sum_over_rows(g.blocks, Sums{}, [&](std::size_t i) -> Sums {
    const Vector<dim> one = force(i);
    const double size = one.norm();
    return {one, size * g.positions()[i], size, size > 0.0 ? std::size_t{1} : std::size_t{0}};
  });
  Load<dim> load{.force = sums.force, .centre = Vector<dim>::Zero(), .particles = sums.particles, .radius = 0.0};
  if (!(sums.size > 0.0)) return load;
  load.centre = sums.moment / sums.size;
  const double total = sums.force.norm();
  const Vector<dim> along = (total > 0.0 ? 1.0 / total : 0.0) * sums.force;
  for (std::size_t i = 0; i < g.size(); ++i)
    if (force(i).squaredNorm() > 0.0) {
      const Vector<dim> from = g.positions()[i] - load.centre;
      load.radius = std::fmax(load.radius, (from - from.dot(along) * along).norm());
    }
  return load;
}
template <class Tag, class Scene, class Law>
[[nodiscard]] Load<Scene::dimension> load_on(const Scene& scene, const Law& law) {
  return load_on<Tag>(scene, law, scene.time());
}

/// Force [N] with which bonds to other groups pull at a group as a whole: what its clamp must hold. Of the tension as it is now, that of
/// dashpots and memories among it.
template <class Tag, class Scene>
[[nodiscard]] Vector<Scene::dimension> bond_load(const Scene& scene) {
  constexpr int dim = Scene::dimension;
  Vector<dim> load = Vector<dim>::Zero();
  scene.engine().for_each_item([&](const auto& active) {
    using I = std::remove_cvref_t<decltype(active.item)>;
    if constexpr (is_bonds<I>)
      if constexpr (std::is_same_v<typename I::A, Tag> != std::is_same_v<typename I::B, Tag>) {
        const auto& a = scene.template group<typename I::A>();
        const auto& b = scene.template group<typename I::B>();
        for (const auto& one : active.item.bonds) {
          if (scene.engine().is_broken(active, one) || (active.of_a.empty() && active.of_b.empty())) continue;
          const Vector<dim> apart = neighbours::minimum_image<dim>(a.positions()[one.i] - b.positions()[one.j], scene.engine().box());
          const double length = apart.norm();
          if (!(length > 0.0)) continue;
          bond::FullState<double> seen{};
          seen.length = length;
          seen.rest_length = one.rest_length;
          seen.length_rate =
              apart.dot(scene.engine().seen_velocity(a, one.i, 0.0) - scene.engine().seen_velocity(b, one.j, 0.0)) / length;
          if constexpr (bond::HasMemory<decltype(I::law)>)
            seen.memory =
                scene.engine().look_up(active, one, [](const auto& list, std::size_t i, std::size_t k) { return list.memories_of(i)[k]; });
          if constexpr (bond::IsDispersive<decltype(I::law)>)
            seen.strain_of_ends = a.template get<field::BondStrain>()[one.i] + b.template get<field::BondStrain>()[one.j];
          double tension = active.item.law.tension(seen);
          if constexpr (requires { active.item.law.dashpot; }) tension += active.item.law.dashpot.tension(seen);
          load += (std::is_same_v<typename I::A, Tag> ? -1.0 : 1.0) * one.weight * tension / length * apart;
        }
      }
  });
  return load;
}

}  // namespace dmp::simulation
