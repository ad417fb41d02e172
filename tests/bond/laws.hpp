#pragma once
#include <cmath>
#include <type_traits>
#include "support/compare.hpp"
#include "support/dual.hpp"
#include "support/particles.hpp"
#include <doctest/doctest.h>
#include <dmp/bond/concept.hpp>
#include <dmp/core/pack.hpp>

namespace test {

/// The state of a bond as law B wants to see it.
template <class B, class T>
[[nodiscard]] auto stretch_of(const T& length, const T& rest_length, [[maybe_unused]] const T& length_rate) {
  if constexpr (dmp::bond::UsesVelocity<B>) return dmp::bond::MovingStretch<T>{{length, rest_length}, length_rate};
  else if constexpr (dmp::bond::IsDispersive<B>)  // a bond alone
    return dmp::bond::Dispersing<dmp::bond::Stretch<T>, T>{{length, rest_length}, 2.0 * (length - rest_length) / rest_length};
  else return dmp::bond::Stretch<T>{length, rest_length};
}

/// The same; a law with memory sees a bond that has suddenly been stretched from its rest length.
template <class B, class T>
[[nodiscard]] auto bond_of(const B& law, const T& length, const T& rest_length, const T& length_rate) {
  const auto stretch = stretch_of<B>(length, rest_length, length_rate);
  if constexpr (dmp::bond::HasMemory<B>) {
    dmp::bond::Remembering<std::remove_const_t<decltype(stretch)>, T> bond{stretch, length - rest_length, T(0.0)};
    bond.memory = law.memory_after(0.0)(bond);
    return bond;
  } else {
    return stretch;
  }
}

/// Force on i of the bond between i and j: -tension n_ij.
template <int Dim, class B>
[[nodiscard]] dmp::Components<Dim, double> bond_force(const B& law, const Particle<Dim>& i, const Particle<Dim>& j, double rest_length) {
  const auto pair = pair_of<Dim>(i, j);
  const double tension = law.tension(bond_of(law, pair.distance, rest_length, pair.approach / pair.distance));
  return (-tension / pair.distance) * pair.separation;
}

}  // namespace test

/// What every bond law must obey.
template <class B>
void check_bond_laws(const B& law) {
  static_assert(dmp::bond::explain_bond_potential<B>());
  static_assert(test::is_plain<B>);
  constexpr bool damped = dmp::bond::UsesVelocity<B>;
  constexpr double rest = 0.8;
  validate(law);
  const double stiffness = law.largest_stiffness();
  CAPTURE(stiffness);
  const auto tension = [&](const auto& r) {
    return law.tension(test::bond_of(law, r, std::decay_t<decltype(r)>(rest), std::decay_t<decltype(r)>(0.0)));
  };
  const auto energy = [&](const auto& r) {
    return law.energy(test::bond_of(law, r, std::decay_t<decltype(r)>(rest), std::decay_t<decltype(r)>(0.0)));
  };

  CHECK(tension(rest) == 0.0);
  CHECK(energy(rest) == 0.0);
  double steepest = 0.0;
  for (const double r : test::evenly(0.0, 3.0 * rest, 301)) {
    CAPTURE(r);
    CHECK(std::fabs(tension(r) - test::slope(energy, r)) <= 1e-14 * stiffness * rest);  // tension = dU/dr
    CHECK(energy(r) >= 0.0);
    CHECK(std::isfinite(tension(r)));
    CHECK(tension(r) * (r - rest) >= 0.0);  // back to the rest length
    steepest = std::fmax(steepest, test::slope(tension, r));
  }
  CHECK(steepest <= stiffness * (1.0 + 1e-12));  // the bound of the time step holds ...
  CHECK(steepest >= stiffness / 1.5);            // ... and is not needlessly small

  if constexpr (damped) {
    const double damping = law.largest_damping();
    for (const double rate : {-10.0, -1e-3, 0.0, 1e-3, 10.0})
      for (const double r : {0.0, rest, 2.0 * rest}) {
        const double drag = law.tension(test::bond_of(law, r, rest, rate)) - tension(r);
        const double rounding = 1e-14 * (std::fabs(tension(r)) + std::fabs(damping * rate));
        CHECK(drag * rate >= -rounding * std::fabs(rate));
        CHECK(std::fabs(drag) <= damping * std::fabs(rate) + rounding);
      }
  }

  if constexpr (dmp::bond::HasMemory<B>) {
    const auto held = test::bond_of(law, 1.5 * rest, rest, 0.0);
    auto later = held;
    later.length_change = 0.0;
    CHECK(law.memory_after(0.0)(later) == held.memory);  // nothing happens in no time
    double before = law.energy(held);
    for (const double dt : {1e-300, 1e-12, 1e-6, 1e-3, 1.0, 1e3, 1e30}) {  // a bond that is held gives off energy
      later.memory = law.memory_after(dt)(later);
      CHECK(std::isfinite(later.memory));
      CHECK(law.energy(later) <= before);
      before = law.energy(later);
    }
    const auto after = [&](const auto& x) {
      using T = std::decay_t<decltype(x)>;
      auto bond = test::bond_of(law, x, T(rest), x);
      bond.length_change = x * x - 1.0;
      return law.memory_after(0.3)(bond);
    };
    const auto lengths = test::evenly(0.0, 3.0 * rest, 256);
    CHECK(test::lane_error<double, dmp::native_width<double>>(after, lengths) < 1e-14);
    CHECK(test::lane_error<float, dmp::native_width<float>>(after, lengths) < 1e-5);
  }

  // One bond in space: any pair, any frame, any rigid motion.
  test::ParticleSource source;
  for (int n = 0; n < 300; ++n) {
    auto i = source.next<3>(), j = source.next<3>();
    const auto on_i = test::bond_force<3>(law, i, j, rest), on_j = test::bond_force<3>(law, j, i, rest);
    const double scale = test::length(on_i);
    const auto pair = test::pair_of<3>(i, j);
    CHECK(test::length(on_i + on_j) == 0.0);
    CHECK(test::cross_length(pair.separation, on_i) <= 1e-14 * scale);
    const auto still = [&] {
      auto a = i, b = j;
      a.velocity = b.velocity = {};
      return test::bond_force<3>(law, a, b, rest);
    }();
    const double dissipated = dot(on_i - still, pair.relative_velocity);
    CHECK(dissipated <= 1e-13 * (scale + test::length(still)));
    if constexpr (damped) {
      if (law.largest_damping() > 0.0) CHECK(dissipated < 0.0);
    }

    auto turned_i = i, turned_j = j;
    for (auto* particle : {&turned_i, &turned_j}) {
      particle->position = test::rotate(particle->position);
      particle->velocity = test::rotate(particle->velocity);
    }
    const double rounding = 1e-12 * (stiffness + scale);
    CHECK(test::length(test::bond_force<3>(law, turned_i, turned_j, rest) - test::rotate(on_i)) <= rounding);

    const double spin[3] = {source.between(-3.0, 3.0), source.between(-3.0, 3.0), source.between(-3.0, 3.0)};
    for (auto* particle : {&i, &j}) {  // rigid motion: 100 m/s and up to 3 rad/s
      const auto& x = particle->position;
      particle->velocity = {100.0 + spin[1] * x[2] - spin[2] * x[1], spin[2] * x[0] - spin[0] * x[2], spin[0] * x[1] - spin[1] * x[0]};
    }
    double damping = 0.0;
    if constexpr (damped) damping = law.largest_damping();
    CHECK(test::length(test::bond_force<3>(law, i, j, rest) - still) <= 1e-12 * damping + rounding);
  }

  const auto lengths = test::evenly(0.0, 3.0 * rest, 256);
  const auto moving = [&](const auto& r) { return law.tension(test::bond_of(law, r, std::decay_t<decltype(r)>(rest), r)); };
  CHECK(test::lane_error<double, dmp::native_width<double>>(moving, lengths) < 1e-14);
  CHECK(test::lane_error<double, dmp::native_width<double>>(energy, lengths) < 1e-14);
  CHECK(test::lane_error<float, dmp::native_width<float>>(moving, lengths) < 1e-5);
  CHECK(test::lane_error<float, dmp::native_width<float>>(energy, lengths) < 1e-5);
}
