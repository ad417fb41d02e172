#include "bond/laws.hpp"
#include <dmp/bond/kelvin_voigt.hpp>

namespace bond = dmp::bond;

namespace {

/// Extension X(t) [m] of a bond between beads of reduced mass m, at rest before the force pull(t) is applied: m X'' = pull - tension.
/// Classical Runge-Kutta, so that only the law decides.
template <class Pull>
class Creep {
 public:
  Creep(bond::KelvinVoigt law, double reduced_mass, Pull pull) : law_(law), mass_(reduced_mass), pull_(pull) {}
  double at(double time, double step) {
    const int steps = static_cast<int>(std::lround((time - time_) / step));
    for (int n = 0; n < steps; ++n, time_ += step) {
      const double a1 = acceleration(time_, x_, v_);
      const double v2 = v_ + 0.5 * step * a1, a2 = acceleration(time_ + 0.5 * step, x_ + 0.5 * step * v_, v2);
      const double v3 = v_ + 0.5 * step * a2, a3 = acceleration(time_ + 0.5 * step, x_ + 0.5 * step * v2, v3);
      const double v4 = v_ + step * a3, a4 = acceleration(time_ + step, x_ + step * v3, v4);
      x_ += step / 6.0 * (v_ + 2.0 * v2 + 2.0 * v3 + v4);
      v_ += step / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    }
    return x_;
  }

 private:
  double acceleration(double time, double x, double v) const {
    return (pull_(time) - law_.tension(bond::MovingStretch<double>{{rest + x, rest}, v})) / mass_;
  }
  static constexpr double rest = 1.0;
  bond::KelvinVoigt law_;
  double mass_;
  Pull pull_;
  double time_ = 0.0, x_ = 0.0, v_ = 0.0;
};

constexpr auto one_newton = [](double) { return 1.0; };

}  // namespace

TEST_CASE("a Kelvin-Voigt bond obeys the laws of bonds") {
  static_assert(sizeof(bond::KelvinVoigt) == 2 * sizeof(double) && bond::UsesVelocity<bond::KelvinVoigt>);
  check_bond_laws(bond::KelvinVoigt{.stiffness = 10.0, .damping = 0.3});
  check_bond_laws(bond::KelvinVoigt{.stiffness = 1e4, .damping = 0.0});
  check_bond_laws(bond::KelvinVoigt{.stiffness = 0.0, .damping = 2.0});
  check_bond_laws(bond::KelvinVoigt{.stiffness = 1e12, .damping = 1e9});
}

TEST_CASE("a Kelvin-Voigt bond creeps as the closed form says: under, critically and over-damped, one bead held or both free") {
  struct Row {
    double damping, reduced_mass, extension[5];
  };
  constexpr double time[5] = {0.5, 1.0, 2.0, 5.0, 10.0};  // sheet 06, section 4.1
  for (const Row& row : {Row{0.2, 1.0, {0.11845360, 0.43102811, 1.25807026, 0.90144933, 1.33685168}},
                         Row{2.0, 1.0, {0.09020401, 0.26424112, 0.59399415, 0.95957232, 0.99950060}},
                         Row{20.0, 1.0, {0.02229491, 0.04649431, 0.09311127, 0.21972777, 0.39270496}},
                         Row{0.2, 0.5, {0.224669, 0.745583, 1.599512, 0.688128, 0.962343}},
                         Row{2.0, 0.5, {0.136943, 0.334857, 0.626167, 0.935475, 0.996551}},
                         Row{20.0, 0.5, {0.023497, 0.047637, 0.094141, 0.220466, 0.393089}}}) {
    CAPTURE(row.damping);
    CAPTURE(row.reduced_mass);
    Creep creep(bond::KelvinVoigt{.stiffness = 1.0, .damping = row.damping}, row.reduced_mass, one_newton);
    for (int n = 0; n < 5; ++n) CHECK(std::fabs(creep.at(time[n], 1e-3) - row.extension[n]) <= (row.reduced_mass == 1.0 ? 1e-8 : 6e-7));
  }
}

TEST_CASE("the published Kelvin-Voigt creep test: 1 N on two beads of 1e-5 kg, k = 0.2 N/m") {
  constexpr double time[3] = {0.5, 1.0, 2.0};  // sheet 06, section 4.1
  struct Row {
    double damping, extension[3];
  };
  for (const Row& row : {Row{0.1, {3.160603, 4.323391, 4.908449}}, Row{0.5, {0.906333, 1.648392, 2.753353}}}) {
    CAPTURE(row.damping);
    Creep creep(bond::KelvinVoigt{.stiffness = 0.2, .damping = row.damping}, 0.5e-5, one_newton);
    for (int n = 0; n < 3; ++n) CHECK(std::fabs(creep.at(time[n], 1e-5) - row.extension[n]) <= 4e-4);  // printed without inertia
  }
}

TEST_CASE("a Kelvin-Voigt bond under a sinusoidal force lags by the published angles") {
  struct Row {
    double damping, frequency, amplitude, lag;
  };
  for (const Row& row :
       {Row{0.2, 0.5, 1.135466, 0.113792}, Row{2.0, 1.0, 0.485071, 1.325818}, Row{20.0, 0.1, 0.447660, 1.109151}}) {  // 4.1
    CAPTURE(row.damping);
    const double frequency = row.frequency, period = 2.0 * 3.14159265358979323846 / frequency, step = period / 4000.0;
    Creep creep(bond::KelvinVoigt{.stiffness = 1.0, .damping = row.damping}, 0.5,
                [frequency](double t) { return std::sin(frequency * t); });
    const int settled = static_cast<int>(std::ceil(400.0 / period));
    double in_phase = 0.0, late = 0.0, x = creep.at(settled * period, step);
    for (int n = 1; n <= 4000; ++n) {
      const double angle = 2.0 * 3.14159265358979323846 * n / 4000.0;
      x = creep.at(settled * period + n * step, step);
      in_phase += x * std::sin(angle) / 2000.0;
      late -= x * std::cos(angle) / 2000.0;
    }
    CHECK(std::hypot(in_phase, late) == doctest::Approx(row.amplitude).epsilon(2e-6));
    CHECK(std::atan2(late, in_phase) == doctest::Approx(row.lag).epsilon(2e-6));
  }
}

TEST_CASE("a Kelvin-Voigt bond refuses parameters that would feed energy") {
  CHECK(test::complaint_about(bond::KelvinVoigt{.stiffness = -1.0, .damping = 0.0}) ==
        "bond::KelvinVoigt: stiffness must be finite and >= 0 N/m, got -1");
  CHECK(test::complaint_about(bond::KelvinVoigt{.stiffness = 1.0, .damping = -0.5}) ==
        "bond::KelvinVoigt: damping must be finite and >= 0 N s/m, got -0.5");
  CHECK(test::complaint_about(bond::KelvinVoigt{.stiffness = 1.0, .damping = NAN}) ==
        "bond::KelvinVoigt: damping must be finite and >= 0 N s/m, got nan");
}
