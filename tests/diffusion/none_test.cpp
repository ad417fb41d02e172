#include <type_traits>
#include <doctest/doctest.h>
#include <dmp/diffusion/concept.hpp>
#include <dmp/diffusion/none.hpp>

namespace diffusion = dmp::diffusion;

TEST_CASE("no density diffusion costs no byte and no field") {
  static_assert(diffusion::explain_diffusion<diffusion::None>());
  static_assert(std::is_empty_v<diffusion::None> && diffusion::None::reads::count == 0);
  static_assert(!diffusion::Diffuses<diffusion::None>);
  CHECK_NOTHROW(validate(diffusion::None{}));
}
