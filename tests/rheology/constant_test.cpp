#include "rheology/laws.hpp"
#include <dmp/rheology/constant.hpp>

namespace rheology = dmp::rheology;

TEST_CASE("a constant viscosity obeys the laws of rheology") {
  static_assert(sizeof(rheology::Constant) == sizeof(double) && rheology::Constant::reads::count == 0);
  check_rheology_laws(rheology::Constant{.dynamic_viscosity = 0.003});
  check_rheology_laws(rheology::Constant{.dynamic_viscosity = 0.0});
}

TEST_CASE("blood of 3 mPa s has 3 mPa s everywhere") {
  dmp::View<3, double, dmp::Fields<dmp::field::DynamicViscosity>> particle{};
  rheology::Constant{.dynamic_viscosity = 0.003}.apply(particle);
  CHECK(particle.dynamic_viscosity == 0.003);
}

TEST_CASE("a constant viscosity refuses to be negative") {
  CHECK(test::complaint_about(rheology::Constant{.dynamic_viscosity = -1.0}) ==
        "rheology::Constant: dynamic_viscosity must be finite and >= 0 Pa s, got -1");
  CHECK(test::complaint_about(rheology::Constant{.dynamic_viscosity = NAN}) ==
        "rheology::Constant: dynamic_viscosity must be finite and >= 0 Pa s, got nan");
}
