#pragma once
#include <dmp/core/components.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::forcing {

/// The same acceleration everywhere and always: gravity, or the drive that stands for a pressure gradient (G = -grad p/rho).
template <int Dim>
struct Constant {
  Required<Components<Dim, double>> uniform_acceleration;  ///< [m/s^2]

  [[nodiscard]] Components<Dim, double> acceleration(const auto&) const noexcept { return uniform_acceleration; }
};

template <int Dim>
void validate(const Constant<Dim>& law) {
  for (const double a : law.uniform_acceleration.value.component) require_finite("forcing::Constant: uniform_acceleration", a, "m/s^2");
}

}  // namespace dmp::forcing
