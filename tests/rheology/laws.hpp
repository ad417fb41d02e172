#pragma once
#include <cmath>
#include "support/compare.hpp"
#include <doctest/doctest.h>
#include <dmp/core/field.hpp>
#include <dmp/core/pack.hpp>

/// What every law of the dynamic viscosity must obey: it writes that, a number >= 0, on double and on packs alike.
template <class R>
void check_rheology_laws(const R& law) {
  static_assert(test::is_plain<R>);
  static_assert(dmp::contains<dmp::field::DynamicViscosity, typename R::writes>);
  validate(law);
  using List = dmp::unite<typename R::reads, typename R::writes>;
  dmp::View<3, double, List> particle{};
  law.apply(particle);
  CHECK(particle.dynamic_viscosity >= 0.0);
  CHECK(std::isfinite(particle.dynamic_viscosity));
  dmp::View<3, dmp::Pack<double, 2>, List> pack{};
  law.apply(pack);
  CHECK(test::relative_error(pack.dynamic_viscosity[0], particle.dynamic_viscosity) < 1e-14);
  CHECK(test::relative_error(pack.dynamic_viscosity[1], particle.dynamic_viscosity) < 1e-14);
}
