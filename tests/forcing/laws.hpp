#pragma once
#include <cmath>
#include "support/compare.hpp"
#include "support/particles.hpp"
#include <doctest/doctest.h>
#include <dmp/forcing/concept.hpp>

/// What every forcing must obey in Dim dimensions. One that states no damping rate does not see velocities; one that does, takes energy.
template <int Dim, class F>
void check_forcing_laws(const F& law) {
  static_assert(dmp::forcing::explain_forcing<F, Dim>());
  static_assert(test::is_plain<F>);
  constexpr bool damps = requires {
    { law.damping_rate(1.0) } -> std::convertible_to<double>;
  };
  validate(law);
  test::ParticleSource source;
  for (int n = 0; n < 100; ++n) {
    const auto particle = source.next<Dim>();
    dmp::forcing::Subject<Dim> subject{particle.position, particle.velocity, particle.mass, source.between(0.0, 10.0)};
    const auto moving = law.acceleration(subject);
    subject.velocity = {};
    const auto drag = moving - law.acceleration(subject);
    if constexpr (damps) {
      CHECK(dot(drag, particle.velocity) < 0.0);
      CHECK(test::length(drag) <= law.damping_rate(particle.mass) * test::length(particle.velocity) * (1.0 + 1e-14));
    } else {
      CHECK(test::length(drag) <= 1e-14 * test::length(moving));
    }
  }
  for (const double time : {0.0, 1e-300, 1e9, 1e300}) {
    const dmp::forcing::Subject<Dim> subject{{}, {}, 1e-30, time};
    CHECK(std::isfinite(test::length(law.acceleration(subject))));
  }
}
