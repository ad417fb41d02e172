#pragma once
#include <cstddef>
#include <optional>
#include <type_traits>
#include <vector>
#include <dmp/core/field.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/neighbours/bond_list.hpp>
#include <dmp/particles/columns.hpp>
#include <dmp/simulation/composition.hpp>

namespace dmp::simulation {

/// A field at a fixed point, from the particles of one group around it: sum_j V_j f_j W(r_j) / sum_j V_j W(r_j), V = m/rho where the group
/// has a density, else 1 (D. Shepard, Proc. 23rd ACM Nat. Conf. (1968) 517-524, doi:10.1145/800186.810616). Exact for a constant field.
/// Nothing where no particle is within the support: the probe is dry.
///   const auto speed = probe<Water, field::Velocity>(scene, kernel, {1.0, 0.2});
template <class Tag, class Field, class Scene, class Kernel>
[[nodiscard]] std::optional<particles::Value<Scene::dimension, Field>> probe(const Scene& scene, const Kernel& kernel,
                                                                             const Vector<Scene::dimension>& point) {
  const auto& group = scene.template group<Tag>();
  using Layout = typename std::remove_cvref_t<decltype(group)>::Layout;
  particles::Value<Scene::dimension, Field> sum{};
  if constexpr (Field::is_vector) sum.setZero();
  double weights = 0.0;
  for (std::size_t i = 0; i < group.size(); ++i) {
    const double distance = neighbours::minimum_image<Scene::dimension>(group.positions()[i] - point, scene.engine().box()).norm();
    double weight = kernel.value(distance);
    if constexpr (contains<field::Density, typename Layout::columns>) weight /= group.template get<field::Density>()[i];
    sum += weight * group.template get<Field>()[i];
    weights += weight;
  }
  if (!(weights > 0.0)) return std::nullopt;
  return sum / weights;
}

/// Bonds whose two ends lie in one place: they have no direction, and exert no force until something else parts the two.
template <class Scene>
[[nodiscard]] std::size_t count_zero_length_bonds(const Scene& scene) {
  std::size_t count = 0;
  scene.engine().for_each_item([&](const auto& active) {
    using I = std::remove_cvref_t<decltype(active.item)>;
    if constexpr (is_bonds<I>) {
      const auto& first = scene.template group<typename I::A>().positions();
      const auto& second = scene.template group<typename I::B>().positions();
      for (const auto& bond : active.item.bonds)
        if (!scene.engine().is_broken(active, bond) &&
            neighbours::minimum_image<Scene::dimension>(first[bond.i] - second[bond.j], scene.engine().box()).isZero(0.0))
          ++count;
    }
  });
  return count;
}

/// Bonds between two groups, or within one, that have broken: as they were given, with their rest lengths.
template <class A, class B, class Scene>
[[nodiscard]] std::vector<neighbours::Bond> broken_bonds(const Scene& scene) {
  std::vector<neighbours::Bond> result;
  scene.engine().for_each_item([&](const auto& active) {
    using I = std::remove_cvref_t<decltype(active.item)>;
    if constexpr (is_bonds<I>)
      if constexpr (std::is_same_v<typename I::A, A> && std::is_same_v<typename I::B, B>)
        for (const auto& bond : active.item.bonds)
          if (scene.engine().is_broken(active, bond)) result.push_back(bond);
  });
  return result;
}

}  // namespace dmp::simulation
