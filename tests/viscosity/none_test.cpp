#include <type_traits>
#include <doctest/doctest.h>
#include <dmp/viscosity/concept.hpp>
#include <dmp/viscosity/none.hpp>

namespace viscosity = dmp::viscosity;

TEST_CASE("no viscosity costs no byte, no field and no time step") {
  static_assert(viscosity::explain_viscosity<viscosity::None>());
  static_assert(std::is_empty_v<viscosity::None> && viscosity::None::reads::count == 0);
  static_assert(!viscosity::ActsAlongSeparation<viscosity::None> && !viscosity::ActsAlongVelocity<viscosity::None>);
  validate(viscosity::None{});
  CHECK(viscosity::None{}.damping_rate(1.0, 1.0, 1.0, 2) == 0.0);
}
