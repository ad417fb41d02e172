#pragma once
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>
#include <dmp/bond/harmonic.hpp>
#include <dmp/bond/kelvin_voigt.hpp>
#include <dmp/bond/standard_linear_solid.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/lattice_spring/body.hpp>
#include <dmp/lattice_spring/detail/checks.hpp>

namespace dmp::lattice_spring {

/// Slow loading of a viscoelastic body, without inertia and without a bound of the step. Over a step of dt every bond is a spring,
///   tension at the end of the step = k' (L - L')
/// with one stiffness k' for all bonds and a rest length L' of each that knows its past, so a step in time is a state of rest of a body
/// of such springs (simulation::relax). The branch force q beside the spring k (L - L0) steps as q <- d q + g (L - L_before):
///   Kelvin-Voigt           d = 0, g = c/dt: backward Euler, of first order; the midpoint rule, of second, if made with dt/2 and advanced
///                          to 2 x - (x before) from each state of rest x
///   standard linear solid  d = e^(-h), g = k_m (1 - e^(-h))/h, h = dt k_m/c_m: as bond::Maxwell, exact for a constant rate of length
/// and k' = k + g, L' = (k L0 + g L_before - d q)/k'.
///   InertiaFreeStep<3> step(law, dt, body.bonds, x);   for each step: relax a scene with bonds<G, G>(step.law(), step.bonds()), then
///   step.advance(positions of the scene)
template <int Dim>
class InertiaFreeStep {
 public:
  /// From rest at `positions`; the rest lengths of the bonds must be known (measure_rest_lengths).
  InertiaFreeStep(const bond::KelvinVoigt& law, double dt, std::vector<neighbours::Bond> bonds, std::span<const Vector<Dim>> positions)
      : InertiaFreeStep((validate(law), law.stiffness), dt, law.damping / dt, 0.0, std::move(bonds), positions) {}
  InertiaFreeStep(const bond::StandardLinearSolid& law, double dt, std::vector<neighbours::Bond> bonds,
                  std::span<const Vector<Dim>> positions)
      : InertiaFreeStep((validate(law), law.stiffness), dt, gain_of(law, dt), std::exp(-steps_of(law, dt)), std::move(bonds), positions) {}

  /// The springs of the next step.
  [[nodiscard]] bond::Harmonic law() const noexcept { return {.stiffness = stiffness_ + gain_}; }
  [[nodiscard]] std::vector<neighbours::Bond> bonds() const {
    std::vector<neighbours::Bond> springs = bonds_;
    const double stiffness = law().stiffness;
    if (!(stiffness > 0.0)) return springs;
    for (std::size_t b = 0; b < springs.size(); ++b) {
      springs[b].rest_length = (stiffness_ * bonds_[b].rest_length + gain_ * before_[b] - decay_ * branch_[b]) / stiffness;
      require_not_negative("lattice_spring::InertiaFreeStep: rest length of a bond, strained too much for these steps,",
                           springs[b].rest_length, "m");
    }
    return springs;
  }
  /// The step is done, and has led to `positions`.
  void advance(std::span<const Vector<Dim>> positions) {
    const auto now = lengths(positions);
    for (std::size_t b = 0; b < now.size(); ++b) branch_[b] = decay_ * branch_[b] + gain_ * (now[b] - before_[b]);
    before_ = now;
  }

 private:
  InertiaFreeStep(double stiffness, double dt, double gain, double decay, std::vector<neighbours::Bond> bonds,
                  std::span<const Vector<Dim>> positions)
      : stiffness_(stiffness), gain_(gain), decay_(decay), bonds_(std::move(bonds)), branch_(bonds_.size(), 0.0) {
    require_positive("lattice_spring::InertiaFreeStep: dt", dt, "s");
    detail::require_ends("lattice_spring::InertiaFreeStep", bonds_, positions.size());
    for (const neighbours::Bond& bond : bonds_)
      require_not_negative("lattice_spring::InertiaFreeStep: rest_length (measure_rest_lengths first)", bond.rest_length, "m");
    before_ = lengths(positions);
  }
  static double steps_of(const bond::StandardLinearSolid& law, double dt) {
    require_positive("lattice_spring::InertiaFreeStep: branch_damping", law.branch_damping, "N s/m");
    return dt * law.branch_stiffness / law.branch_damping;
  }
  static double gain_of(const bond::StandardLinearSolid& law, double dt) {
    const double h = steps_of(law, dt);
    return law.branch_stiffness * (h > 0.0 ? -std::expm1(-h) / h : 1.0);
  }
  [[nodiscard]] std::vector<double> lengths(std::span<const Vector<Dim>> positions) const {
    detail::require_ends("lattice_spring::InertiaFreeStep", bonds_, positions.size());
    std::vector<double> result;
    result.reserve(bonds_.size());
    for (const neighbours::Bond& bond : bonds_) result.push_back((positions[bond.j] - positions[bond.i]).norm());
    return result;
  }

  double stiffness_, gain_, decay_;
  std::vector<neighbours::Bond> bonds_;
  std::vector<double> branch_, before_{};  // q [N] and length [m] at the beginning of the step
};

}  // namespace dmp::lattice_spring
