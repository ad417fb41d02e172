#pragma once
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <dmp/core/vector.hpp>
#include <dmp/integrator/concept.hpp>

namespace test {

/// A particle of unit mass under a(x, v, t), moved as a scene moves it: begin, acceleration from what the integrator shows, end.
template <class I, class Acceleration>
class Trajectory {
 public:
  Trajectory(double x, double v, Acceleration acceleration) : x_(x), v_(v), acceleration_(acceleration), a_(acceleration(x, v, 0.0)) {}

  void step(double dt) {
    time_ += dt;
    I::begin(x_, v_, a_, dt);
    a_ = acceleration_(x_, I::seen(v_, a_, dt), time_);
    I::end(v_, a_, dt);
  }
  Trajectory& run(int steps, double dt) {
    for (int n = 0; n < steps; ++n) step(dt);
    return *this;
  }
  void turn_back() { v_ = -v_; }
  [[nodiscard]] double x() const { return x_; }
  [[nodiscard]] double v() const { return v_; }

 private:
  double x_, v_, time_ = 0.0;
  Acceleration acceleration_;
  double a_;
};
template <class I, class Acceleration>
[[nodiscard]] Trajectory<I, Acceleration> particle(double x, double v, Acceleration acceleration) {
  return {x, v, acceleration};
}

/// Order of convergence of f(steps), an error that shrinks as the steps become more.
template <class Error>
[[nodiscard]] double observed_order(const Error& error, int steps) {
  return std::log2(std::fabs(error(steps)) / std::fabs(error(2 * steps)));
}

/// Largest |x| in `steps` steps of the oscillator a = -x - 2 damping v from x = 1 at rest.
template <class I>
[[nodiscard]] double farthest(double oscillation, double damping, int steps) {  // omega dt, lambda dt
  auto p = particle<I>(1.0, 0.0, [=](double x, double v, double) { return -oscillation * oscillation * x - damping * v; });
  double largest = 1.0;
  for (int n = 0; n < steps && largest < 1e30; ++n) {
    p.step(1.0);
    largest = std::max({largest, std::fabs(p.x()), std::fabs(p.v())});
  }
  return largest;
}
/// A state s with a rate that laws compute from the s that they see, beside a velocity: as density and flow in a scene.
template <class I>
class State {
 public:
  explicit State(double s) : s_(s) {}
  /// One step of length 1 of ds/dt = v - damping s, dv/dt = -stiffness s.
  void step(double damping, double stiffness) {
    if (!started_) {
      previous_ = rate_ = -damping * s_;
      a_ = -stiffness * s_;
      started_ = true;
    }
    double x = 0.0;
    I::begin(x, v_, a_, 1.0);
    I::begin_state(s_, rate_, 1.0);
    const double seen = I::seen_state(s_, rate_, previous_, 1.0), velocity = I::seen(v_, a_, 1.0);
    previous_ = rate_;
    rate_ = velocity - damping * seen;
    a_ = -stiffness * seen;
    I::end(v_, a_, 1.0);
    I::end_state(s_, rate_, 1.0);
  }
  [[nodiscard]] double value() const { return s_; }

 private:
  double s_, v_ = 0.0, rate_ = 0.0, previous_ = 0.0, a_ = 0.0;
  bool started_ = false;
};
/// |s| after `steps` steps of ds/dt = -lambda s from s = 1.
template <class I>
[[nodiscard]] double state_left(double damping, int steps) {  // lambda dt
  State<I> state(1.0);
  for (int n = 0; n < steps; ++n) state.step(damping, 0.0);
  return std::fabs(state.value());
}
/// Amplitude of sound after `steps` steps, from 1: the largest |s| of the last period.
template <class I>
[[nodiscard]] double loudness(double oscillation, int steps) {  // omega dt
  State<I> state(1.0);
  const int period = static_cast<int>(7.0 / oscillation) + 1;
  double largest = 0.0;
  for (int n = 0; n < steps && largest < 1e30; ++n) {
    state.step(0.0, oscillation * oscillation);
    const double s = std::fabs(state.value());
    if (n >= steps - period || s > 1e30) largest = std::max(largest, s);
  }
  return largest;
}

/// Largest |x| in the last steps of an oscillator from x = 1 that also drives a state, which acts back weakly: as a spring in a liquid.
template <class I>
[[nodiscard]] double swing(double oscillation, int steps) {  // omega dt
  double x = 1.0, v = 0.0, s = 0.0, rate = 0.0, previous = 0.0, a = -oscillation * oscillation, largest = 0.0;
  for (int n = 0; n < steps && largest < 1e30; ++n) {
    I::begin(x, v, a, 1.0);
    I::begin_state(s, rate, 1.0);
    const double seen = I::seen_state(s, rate, previous, 1.0), velocity = I::seen(v, a, 1.0);
    previous = rate;
    rate = velocity;
    a = -oscillation * oscillation * x - 0.01 * seen;
    I::end(v, a, 1.0);
    I::end_state(s, rate, 1.0);
    if (n >= steps - 10 || std::fabs(x) > 1e30) largest = std::max(largest, std::fabs(x));
  }
  return largest;
}

/// |v| after `steps` steps of dv/dt = -lambda v from v = 1.
template <class I>
[[nodiscard]] double speed_left(double damping, int steps) {  // lambda dt
  return std::fabs(particle<I>(0.0, 1.0, [=](double, double v, double) { return -damping * v; }).run(steps, 1.0).v());
}

}  // namespace test

/// What an integrator says of itself, beside its limits.
struct Claims {
  double order;         ///< for forces of position
  double damped_order;  ///< for forces of velocity too, in the way it shows velocities to laws
  double state_order;   ///< for a state such as density under a given rate that changes with time
  bool position_exact;  ///< under constant acceleration; the velocity always is
  bool reversible;      ///< for forces of position
  double sound_limit;   ///< sound, in which a state and the velocity drive each other, is stable for omega dt < this; 0: never
};

template <class I>
void check_integrator_laws(const Claims& claims) {
  static_assert(dmp::integrator::explain_integrator<I>());
  constexpr auto spring = [](double x, double, double) { return -x; };
  constexpr auto pendulum = [](double x, double, double) { return -std::sin(x); };

  // Order, from closed forms: x and v at t = 3 of an oscillator, a damped one, and a free particle under a force of time.
  const auto error = [](auto acceleration, double x0, double v0, double x, double v) {
    return [=](int steps) {
      const auto p = test::particle<I>(x0, v0, acceleration).run(steps, 3.0 / steps);
      return std::hypot(p.x() - x, p.v() - v);
    };
  };
  const double c = std::cos(3.0), s = std::sin(3.0), decay = std::exp(-1.5);
  CHECK(test::observed_order(error(spring, 1.0, 0.5, c + 0.5 * s, 0.5 * c - s), 400) == doctest::Approx(claims.order).epsilon(0.02));
  const auto damped = [](double x, double v, double) { return -1.25 * x - v; };  // exp(-t/2) (cos t + sin t)
  CHECK(test::observed_order(error(damped, 1.0, 0.5, decay * (c + s), decay * (0.5 * c - 1.5 * s)), 400) ==
        doctest::Approx(claims.damped_order).epsilon(0.05));
  const auto driven = [](double, double, double t) { return std::cos(t); };  // 1 - cos t
  CHECK(test::observed_order(error(driven, 0.0, 0.0, 1.0 - c, s), 400) == doctest::Approx(claims.order).epsilon(0.02));

  // Constant acceleration: v exact, x = v0 t + a t^2/2 if claimed, else behind or ahead by half a step, a t dt/2.
  const double fall =
      test::particle<I>(2.0, 3.0, [](double, double, double) { return -4.0; }).run(64, 0.125).x();  // to t = 8, without rounding
  const double speed = test::particle<I>(2.0, 3.0, [](double, double, double) { return -4.0; }).run(64, 0.125).v();
  CHECK(speed == 3.0 - 4.0 * 8.0);
  if (claims.position_exact)
    CHECK(fall == 2.0 + 3.0 * 8.0 - 0.5 * 4.0 * 64.0);
  else
    CHECK(std::fabs(fall - (2.0 + 3.0 * 8.0 - 0.5 * 4.0 * 64.0)) == 0.5 * 4.0 * 8.0 * 0.125);
  CHECK(test::particle<I>(2.0, 3.0, [](double, double, double) { return 0.0; }).run(64, 0.125).x() == 26.0);

  // Time reversal: turn round, come back.
  auto swing = test::particle<I>(1.0, 0.5, pendulum).run(1000, 0.05);
  swing.turn_back();
  swing.run(1000, 0.05);
  const double missed = std::hypot(swing.x() - 1.0, swing.v() + 0.5);
  if (claims.reversible)
    CHECK(missed < 1e-11);
  else
    CHECK(missed > 1e-3);

  // Symplectic for forces of position: the energy of a pendulum wavers and does not drift, over 10000 swings.
  auto pendulum_run = test::particle<I>(2.0, 0.0, pendulum);
  const auto energy = [&] { return 0.5 * pendulum_run.v() * pendulum_run.v() - std::cos(pendulum_run.x()); };
  const double start = energy();
  double early = 0.0, late = 0.0;
  for (int n = 0; n < 820000; ++n) {
    pendulum_run.step(0.1);
    if (n < 82000) early = std::max(early, std::fabs(energy() - start));
    if (n >= 738000) late = std::max(late, std::fabs(energy() - start));
  }
  CHECK(early > 1e-5);
  CHECK(late < 1.001 * early);

  // Stability: the stated limits are where it ends, and not earlier. Below, an undamped oscillator never exceeds
  // 1/sqrt(1 - (omega dt/2)^2) of its amplitude, for its shadow energy is conserved.
  const double oscillation = I::oscillation_limit, damping = I::damping_limit;
  CHECK(test::farthest<I>(0.95 * oscillation, 0.0, 100000) < 10.0);
  CHECK(test::farthest<I>(1.05 * oscillation, 0.0, 1000) > 1e20);
  CHECK(test::speed_left<I>(0.95 * damping, 1000) < 1e-20);
  CHECK(test::speed_left<I>(1.05 * damping, 1000) > 1e20);
  // Both at once: (omega dt/limit)^2 + lambda dt/limit < 1.
  for (const double share : {0.1, 0.5, 0.9}) {
    CAPTURE(share);
    CHECK(test::farthest<I>(std::sqrt(0.95 * share) * oscillation, 0.95 * (1.0 - share) * damping, 10000) < 20.0);
    CHECK(test::farthest<I>(std::sqrt(1.05 * share) * oscillation, 1.05 * (1.0 - share) * damping, 10000) > 1e20);
  }

  // A state with a rate: exact for a constant rate, of the stated order for one that changes.
  double density = 1000.0;
  for (int n = 0; n < 64; ++n) {
    I::begin_state(density, 16.0, 0.125);
    I::end_state(density, 16.0, 0.125);
  }
  CHECK(density == 1128.0);
  const auto state_error = [](int steps) {  // rate cos t, known at the ends of steps
    const double dt = 3.0 / steps;
    double state = 0.0, rate = 1.0;
    for (int n = 1; n <= steps; ++n) {
      I::begin_state(state, rate, dt);
      rate = std::cos(n * dt);
      I::end_state(state, rate, dt);
    }
    return state - std::sin(3.0);
  };
  CHECK(test::observed_order(state_error, 400) == doctest::Approx(claims.state_order).epsilon(0.02));

  // Stability of states: damping to the stated limit, sound to the stated limit or not at all.
  const double state_damping = I::state_damping_limit;
  CHECK(test::state_left<I>(0.95 * state_damping, 2000) < 1e-20);
  CHECK(test::state_left<I>(1.05 * state_damping, 2000) > 1e10);
  if (claims.sound_limit > 0.0) {
    CHECK(test::loudness<I>(0.1, 100000) < 2.0);
    CHECK(test::loudness<I>(0.95 * claims.sound_limit, 10000) < 2.0);
    CHECK(test::loudness<I>(1.05 * claims.sound_limit, 10000) > 1e10);
    CHECK(test::swing<I>(0.95 * I::coupled_limit, 40000) < 1.0);
    CHECK(test::swing<I>(1.05 * I::coupled_limit, 40000) > 1e3);
  } else {
    CHECK(test::loudness<I>(0.1, 20000) > 1e10);
  }

  // A vector moves as its components do.
  dmp::Vector<3> x(1.0, 2.0, 3.0), v(-1.0, 0.5, 0.25);
  const dmp::Vector<3> a(0.1, 0.2, 0.3), b(-0.3, 0.7, 0.9);
  dmp::Vector<3> x1 = x, v1 = v;
  I::begin(x, v, a, 0.3);
  const dmp::Vector<3> seen = I::seen(v, a, 0.3);
  I::end(v, b, 0.3);
  for (int d = 0; d < 3; ++d) {
    I::begin(x1[d], v1[d], a[d], 0.3);
    CHECK(seen[d] == doctest::Approx(I::seen(v1[d], a[d], 0.3)).epsilon(1e-15));
    I::end(v1[d], b[d], 0.3);
    CHECK(x[d] == doctest::Approx(x1[d]).epsilon(1e-15));
    CHECK(v[d] == doctest::Approx(v1[d]).epsilon(1e-15));
  }
}
