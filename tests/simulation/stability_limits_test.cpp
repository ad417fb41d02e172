// The bound of the time step of every law: stable at 0.95 of it for a long run; and where it ends the run blows up, and is stopped by an
// error that says when, who and what. The scenes, and where exactly each blows up: tests/support/stability.hpp, docs/stability.md.
#include <string>
#include <vector>
#include <doctest/doctest.h>

#include "support/stability.hpp"
#include "support/threads.hpp"

using namespace test::stability;
using integrator::ExtrapolatedVerlet, integrator::Leapfrog, integrator::SymplecticEuler;

namespace {

constexpr std::uint64_t long_run = 5000;  // steps

void check(const Case& c, const std::string& whose) {
  CAPTURE(c.law);
  CAPTURE(c.scene);
  CHECK(c.stated > 0.0);
  CHECK(c.bound_by == whose);
  const Outcome within = c.run(0.95 * c.stated, long_run);
  CHECK(within.growth < 30.0);  // of a disturbance of all motions; at 0.95 of its bound an oscillator reaches 3.2 times its amplitude
  CHECK(within.error == "");
  const Outcome past = c.run(c.stopped * c.stated, 2000);
  CHECK(past.error.starts_with("dmp: "));
  CHECK(past.where.step > 0);
  if (past.error.find("conjugate gradients did not converge") != std::string::npos) return;  // no one particle's
  CHECK(past.where.group != "");
  CHECK(past.where.particle >= 0);
  CHECK(past.where.field != "");
  for (const std::string& part :
       {" at t = " + to_text(past.where.time) + " s", ", step " + std::to_string(past.where.step), ", group " + past.where.group,
        ", particle " + std::to_string(past.where.particle), ", " + past.where.field + " = " + to_text(past.where.value)})
    CHECK(past.error.find(part) != std::string::npos);
}
void check(const std::vector<Case>& cases, const std::vector<std::string>& whose) {
  const test::Threads one(1);
  REQUIRE(whose.size() == cases.size());
  for (std::size_t k = 0; k < cases.size(); ++k) check(cases[k], whose[k]);
}
const std::string springs_of_beads = "bond stiffness of beads - beads", dashpots_of_beads = "bond dashpot of beads - beads";

}  // namespace

TEST_CASE("fluids and heat: stable at 0.95 of the bound, and where it ends the blow-up is caught") {
  check(fluids<ExtrapolatedVerlet>(),
        {"sound", "sound", "sound", "viscosity", "viscosity", "viscosity", "viscosity", "density diffusion", "heat conduction"});
}
TEST_CASE("beads, bonds and forcings: stable at 0.95 of the bound, and where it ends the blow-up is caught") {
  const std::string &k = springs_of_beads, &c = dashpots_of_beads;
  check(beads<Leapfrog>(),
        {k, k, k, k, k, c, c, k, k, k, k, k, k, k, "pair potential", "drag on beads", "stiffness of a forcing on beads"});
}
TEST_CASE("several laws that bound the step alike: together too they are stable at 0.95 of the bound") {
  check(together<ExtrapolatedVerlet>(), {"drag on fluid", "viscosity of fluid", "sound", "viscosity of fluid"});
}
TEST_CASE("springs in a liquid, whose sound extrapolates the density: stable at 0.95 of the bound, without viscosity too") {
  const std::vector<std::string> springs(4, "bond stiffness of fluid - fluid");
  check(liquid_with_springs<ExtrapolatedVerlet>(), springs);
  check(liquid_with_springs<Leapfrog>(), springs);
  check(liquid_with_springs<SymplecticEuler>(), springs);
}
TEST_CASE("the bound of sound with the other integrators") { check({sound<Leapfrog>(), sound<SymplecticEuler>()}, {"sound", "sound"}); }
