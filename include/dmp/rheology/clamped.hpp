#pragma once
#include <limits>
#include <string>
#include <string_view>

namespace dmp::rheology {

/// A law mu(T) that outside of its range goes on with the viscosity of the nearer end. The run then goes on where the law has no
/// meaning, which is why the scene has to ask for it:
///   rheology::Clamped{rheology::Arrhenius{...}}
/// A temperature that is not finite or not > 0 is still refused.
template <class Law>
struct Clamped {
  static constexpr std::string_view name = Law::name;
  Law law;

  template <class T>
  [[nodiscard]] T viscosity(const T& temperature) const noexcept {
    return law.viscosity(law.temperature_range.nearest(temperature));
  }
  [[nodiscard]] bool admits(double temperature) const noexcept {
    return temperature > 0.0 && temperature <= std::numeric_limits<double>::max();
  }
  [[nodiscard]] std::string demand() const { return "rheology::Clamped: temperature must be finite and > 0 K"; }
};
template <class Law>
Clamped(Law) -> Clamped<Law>;

template <class Law>
void validate(const Clamped<Law>& clamped) {
  validate(clamped.law);
}

}  // namespace dmp::rheology
