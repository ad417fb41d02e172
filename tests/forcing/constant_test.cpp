#include "forcing/laws.hpp"
#include <dmp/forcing/constant.hpp>

namespace forcing = dmp::forcing;

TEST_CASE("gravity obeys the laws of forcings in 1D, 2D and 3D") {
  check_forcing_laws<1>(forcing::Constant<1>{.uniform_acceleration = {{-9.81}}});
  check_forcing_laws<2>(forcing::Constant<2>{.uniform_acceleration = {{0.0, -9.81}}});
  check_forcing_laws<3>(forcing::Constant<3>{.uniform_acceleration = {{0.0, 0.0, -9.81}}});
}

TEST_CASE("everything falls alike, heavy or light, fast or slow, now or later") {
  const forcing::Constant<3> gravity{.uniform_acceleration = {{0.0, 0.0, -9.81}}};
  for (const double mass : {1e-9, 1e9}) {
    const auto a = gravity.acceleration(forcing::Subject<3>{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}, mass, 7.0});
    CHECK(a[0] == 0.0);
    CHECK(a[1] == 0.0);
    CHECK(a[2] == -9.81);
  }
}

TEST_CASE("gravity refuses to be no number") {
  CHECK(test::complaint_about(forcing::Constant<2>{.uniform_acceleration = {{0.0, NAN}}}) ==
        "forcing::Constant: uniform_acceleration must be finite [m/s^2], got nan");
}
