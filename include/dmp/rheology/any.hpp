#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <dmp/core/require.hpp>
#include <dmp/rheology/andrade.hpp>
#include <dmp/rheology/arrhenius.hpp>
#include <dmp/rheology/constant.hpp>
#include <dmp/rheology/power_law_gas.hpp>
#include <dmp/rheology/sutherland.hpp>
#include <dmp/rheology/temperature_range.hpp>

namespace dmp::rheology {

/// One of the laws of the temperature, chosen while the program runs. std::visit it once per pass over the particles, not once per
/// particle. Each alternative is what a material takes; Constant is the one that has no viscosity(temperature).
using Any = std::variant<Constant, Andrade, Arrhenius, Sutherland, PowerLawGas>;

inline void validate(const Any& law) {
  std::visit([](const auto& chosen) { validate(chosen); }, law);
}

namespace detail {
using Coefficients = std::span<const double>;
struct Named {
  std::string_view name, lammps_name;
  std::size_t count;  // of coefficients
  Any (*make)(Coefficients c, const TemperatureRange& range);
};
template <class Law, std::size_t... Index>
Any make(Coefficients c, const TemperatureRange& range) {
  return Law{c[Index]..., range};
}
inline constexpr Named named[] = {
    {"constant", "Constant", 1, [](Coefficients c, const TemperatureRange&) -> Any { return Constant{c[0]}; }},
    {Andrade::name, "FourParameterExp", 4, make<Andrade, 0, 1, 2, 3>},
    {Arrhenius::name, "Arrhenius", 2, make<Arrhenius, 0, 1>},
    {Sutherland::name, "SutherlandViscosityLaw", 2, make<Sutherland, 0, 1>},
    {PowerLawGas::name, "PowerLawGas", 2, make<PowerLawGas, 0, 1>},
};
}  // namespace detail

/// The law of this name, ours or that of the LAMMPS command of A. Albano et al., ChemEngineering 5 (2021) 30,
/// doi:10.3390/chemengineering5020030, with the coefficients in the order of its parameters and of the command. A constant takes no heed
/// of the range. Throws ParameterError for an unknown name, a wrong number of coefficients, and whatever validate() refuses.
[[nodiscard]] inline Any by_name(std::string_view name, std::span<const double> coefficients, const TemperatureRange& range) {
  std::string known;
  for (const auto& each : detail::named) {
    if (name == each.name || name == each.lammps_name) {
      require(coefficients.size() == each.count,
              ("rheology::by_name: the number of coefficients of " + std::string(name) + " must be " + std::to_string(each.count)).c_str(),
              static_cast<double>(coefficients.size()));
      const Any law = each.make(coefficients, range);
      validate(law);
      return law;
    }
    known += (known.empty() ? "" : ", ") + std::string(each.name) + " (" + std::string(each.lammps_name) + ")";
  }
  throw ParameterError("rheology::by_name: no law is called '" + std::string(name) + "'; known names (and those of LAMMPS) are " + known);
}

}  // namespace dmp::rheology
