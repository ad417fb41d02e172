#pragma once
#include <cmath>
#include <random>
#include <dmp/core/field.hpp>
#include <dmp/core/math.hpp>
#include <dmp/core/pack.hpp>
#include <dmp/core/pair.hpp>

namespace test {

/// A particle with all the fields that pair laws read.
template <int Dim, class T = double>
using Particle = dmp::View<Dim, T,
                           dmp::Fields<dmp::field::Position, dmp::field::Velocity, dmp::field::Mass, dmp::field::Density,
                                       dmp::field::PressureTerm, dmp::field::DynamicViscosity, dmp::field::SoundSpeed>>;

template <int Dim, class T>
[[nodiscard]] dmp::Pair<Dim, T> pair_of(const Particle<Dim, T>& i, const Particle<Dim, T>& j) {
  using dmp::sqrt;
  dmp::Pair<Dim, T> pair{};
  pair.separation = i.position - j.position;
  pair.relative_velocity = i.velocity - j.velocity;
  pair.distance_squared = dot(pair.separation, pair.separation);
  pair.distance = sqrt(pair.distance_squared);
  pair.approach = dot(pair.separation, pair.relative_velocity);
  return pair;
}

/// Particles with different numbers in every field: density 800 to 1200, p/rho^2 -1 to 1, viscosity 1e-3 to 2e-3, sound speed 10 to 20,
/// mass 1 to 2, velocity -1 to 1, position 0 to 1 (SI units).
class ParticleSource {
 public:
  template <int Dim>
  [[nodiscard]] Particle<Dim> next() {
    Particle<Dim> result{};
    for (int d = 0; d < Dim; ++d) {
      result.position[d] = between(0.0, 1.0);
      result.velocity[d] = between(-1.0, 1.0);
    }
    result.mass = between(1.0, 2.0);
    result.density = between(800.0, 1200.0);
    result.pressure_term = between(-1.0, 1.0);
    result.dynamic_viscosity = between(1e-3, 2e-3);
    result.sound_speed = 15.0 + 5.0 * result.velocity[0];
    return result;
  }
  [[nodiscard]] double between(double a, double b) { return a + (b - a) * static_cast<double>(generator_()) / 4294967296.0; }

 private:
  std::mt19937 generator_{2021};
};

/// The pack whose lanes are the particles.
template <class Real, int Width, int Dim>
[[nodiscard]] Particle<Dim, dmp::Pack<Real, Width>> gather(const Particle<Dim> (&lanes)[Width]) {
  Particle<Dim, dmp::Pack<Real, Width>> result{};
  for (int lane = 0; lane < Width; ++lane) {
    for (int d = 0; d < Dim; ++d) {
      result.position[d].raw[lane] = static_cast<Real>(lanes[lane].position[d]);
      result.velocity[d].raw[lane] = static_cast<Real>(lanes[lane].velocity[d]);
    }
    result.mass.raw[lane] = static_cast<Real>(lanes[lane].mass);
    result.density.raw[lane] = static_cast<Real>(lanes[lane].density);
    result.pressure_term.raw[lane] = static_cast<Real>(lanes[lane].pressure_term);
    result.dynamic_viscosity.raw[lane] = static_cast<Real>(lanes[lane].dynamic_viscosity);
    result.sound_speed.raw[lane] = static_cast<Real>(lanes[lane].sound_speed);
  }
  return result;
}

/// Largest difference between f(pair, i, j) on packs and on double, as a fraction of the largest |f|.
template <class Real, int Width, int Dim, class Function>
[[nodiscard]] double pair_lane_error(const Function& f) {
  ParticleSource source;
  double difference = 0.0, largest = 0.0;
  for (int block = 0; block < 32; ++block) {
    Particle<Dim> i[Width], j[Width];
    for (int lane = 0; lane < Width; ++lane) {
      i[lane] = source.next<Dim>();
      j[lane] = source.next<Dim>();
    }
    const auto packed_i = gather<Real>(i), packed_j = gather<Real>(j);
    const dmp::Pack<Real, Width> result = f(pair_of<Dim>(packed_i, packed_j), packed_i, packed_j);
    for (int lane = 0; lane < Width; ++lane) {
      const double expected = f(pair_of<Dim>(i[lane], j[lane]), i[lane], j[lane]);
      largest = std::fmax(largest, std::fabs(expected));
      const double error = std::fabs(static_cast<double>(result[lane]) - expected);
      difference = std::isnan(error) ? INFINITY : std::fmax(difference, error);
    }
  }
  return difference == 0.0 ? 0.0 : difference / largest;
}

/// A rotation by 40 degrees about the axis (1, 2, 2)/3, in the plane by 40 degrees, on the line a reflection.
template <int Dim>
[[nodiscard]] dmp::Components<Dim, double> rotate(const dmp::Components<Dim, double>& x) {
  const double angle = 0.6981317007977318, c = std::cos(angle), s = std::sin(angle);
  if constexpr (Dim == 1) {
    return {-x[0]};
  } else if constexpr (Dim == 2) {
    return {c * x[0] - s * x[1], s * x[0] + c * x[1]};
  } else {
    const double a[3] = {1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0};
    const double along = (1.0 - c) * (a[0] * x[0] + a[1] * x[1] + a[2] * x[2]);
    return {c * x[0] + s * (a[1] * x[2] - a[2] * x[1]) + along * a[0], c * x[1] + s * (a[2] * x[0] - a[0] * x[2]) + along * a[1],
            c * x[2] + s * (a[0] * x[1] - a[1] * x[0]) + along * a[2]};
  }
}

template <int Dim>
[[nodiscard]] double length(const dmp::Components<Dim, double>& x) {
  return std::sqrt(dot(x, x));
}

/// |a x b|: the torque of a force b at a. 0 on the line.
template <int Dim>
[[nodiscard]] double cross_length(const dmp::Components<Dim, double>& a, const dmp::Components<Dim, double>& b) {
  if constexpr (Dim == 1) return 0.0;
  else if constexpr (Dim == 2) return std::fabs(a[0] * b[1] - a[1] * b[0]);
  else return std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}

}  // namespace test
