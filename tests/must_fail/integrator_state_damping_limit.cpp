// expect: dmp: not an Integrator: no `oscillation_limit`, `damping_limit`, `state_damping_limit`, `keeps_rates` and `name`
#include <string_view>
#include <dmp/integrator/concept.hpp>

namespace {
struct Euler {
  static constexpr std::string_view name = "Euler";
  static constexpr double oscillation_limit = 0.0, damping_limit = 2.0;
  static void begin(double& x, double& v, double a, double dt) { x += dt * v, v += dt * a; }
  static void end(double&, double, double) {}
  static double seen(double v, double, double) { return v; }
  static void begin_state(double& s, double rate, double dt) { s += dt * rate; }
  static void end_state(double&, double, double) {}
  static double seen_state(double s, double, double, double) { return s; }
};
}  // namespace

static_assert(dmp::integrator::explain_integrator<Euler>());
