// The smallest bound of the time step, and whose it is; what is no bound is refused by the name of its law.
#include <limits>
#include <string>
#include <doctest/doctest.h>
#include <dmp/sweep/step_limit.hpp>

using dmp::ParameterError, dmp::sweep::StepLimit;

TEST_CASE("of all bounds the smallest one counts, that of stability among those of stability") {
  StepLimit limit;
  CHECK(limit.bound_by == "nothing");
  limit.require_below(3.0, "sound");
  limit.resolve(2.0, "acceleration");
  limit.damp(0.5, 1.0, "viscosity");      // 2 s, no smaller
  limit.oscillate(0.25, 2.0, "springs");  // 4 s
  limit.oscillate(0.0, 2.0, "springs of nothing");
  limit.damp(0.0, 1.0, "still air");
  CHECK(limit.time_step == 2.0);
  CHECK(limit.bound_by == "acceleration");
  CHECK(limit.stable_time_step == 2.0);
  CHECK(limit.stability_bound_by == "viscosity");
  StepLimit later;
  later.require_below(2.5, "sound");
  later.resolve(1.0, "acceleration of later");
  limit.include(later);
  CHECK(limit.time_step == 1.0);
  CHECK(limit.bound_by == "acceleration of later");
  CHECK(limit.stable_time_step == 2.0);
  CHECK(limit.stability_bound_by == "viscosity");
}

TEST_CASE("a bound that is not a number, or negative, is refused and its law named; so are the rates that bounds are made of") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  StepLimit limit;
  CHECK_THROWS_WITH_AS(limit.resolve(nan, "acceleration"), "bound of the time step by acceleration must be >= 0 s, got nan",
                       ParameterError);
  CHECK_THROWS_WITH_AS(limit.require_below(nan, "sound"), "bound of the time step by sound must be >= 0 s, got nan", ParameterError);
  CHECK_THROWS_WITH_AS(limit.require_below(-0.5, "sound"), "bound of the time step by sound must be >= 0 s, got -0.5", ParameterError);
  CHECK_THROWS_WITH_AS(limit.damp(nan, 1.0, "viscosity"), "rate by which viscosity bounds the time step must be >= 0 1/s, got nan",
                       ParameterError);
  CHECK_THROWS_WITH_AS(limit.oscillate(-1.0, 2.0, "pair potential"),
                       "rate by which pair potential bounds the time step must be >= 0 1/s^2, got -1", ParameterError);
  CHECK_NOTHROW(limit.require_below(infinite, "nothing at all"));
  CHECK(limit.time_step == infinite);
  CHECK(limit.bound_by == "nothing");
}
