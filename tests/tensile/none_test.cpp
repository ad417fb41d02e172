#include <type_traits>
#include <doctest/doctest.h>
#include <dmp/tensile/concept.hpp>
#include <dmp/tensile/none.hpp>

namespace tensile = dmp::tensile;

TEST_CASE("no tensile correction costs no byte and no field") {
  static_assert(tensile::explain_tensile_correction<tensile::None>());
  static_assert(std::is_empty_v<tensile::None> && tensile::None::reads::count == 0);
  static_assert(!tensile::Corrects<tensile::None>);
  CHECK_NOTHROW(validate(tensile::None{}));
}
