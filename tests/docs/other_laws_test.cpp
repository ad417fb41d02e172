// docs/write-a-law.md, second part: one short law of every other family, through the suite of the family and together in one scene.
#include <cmath>
#include <numbers>
#include <doctest/doctest.h>
#include <dmp/dmp.hpp>

#include "bond/laws.hpp"
#include "eos/laws.hpp"
#include "forcing/laws.hpp"
#include "kernel/laws.hpp"
#include "potential/laws.hpp"
#include "rheology/laws.hpp"
#include "thermal/laws.hpp"
#include "viscosity/laws.hpp"

namespace own {

// doc: own-using
using namespace dmp;
// end

// doc: own-kernel
/// Wendland C6 in 2D.  W = (78/(7 pi h^2)) (1 - q)^8 (1 + 8q + 25q^2 + 32q^3),  q = r/h.
/// W. Dehnen, H. Aly, Mon. Not. R. Astron. Soc. 425 (2012) 1068-1082, doi:10.1111/j.1365-2966.2012.21439.x, table 1.
struct WendlandC6 {
  static constexpr int dimension = 2;
  double support_radius;  // h [m]

  template <class T>
  T value(const T& r) const {
    const double h = support_radius, scale = 78.0 / (7.0 * std::numbers::pi * h * h);
    const T q = r * (1.0 / h), rest = max(h - r, 0.0) * (1.0 / h);
    return scale * (1.0 + q * (8.0 + q * (25.0 + 32.0 * q))) * square(square(square(rest)));
  }
  template <class T>
  T radial_factor(const T& r) const {
    const double h = support_radius, scale = 78.0 / (7.0 * std::numbers::pi * h * h);
    const T q = r * (1.0 / h), rest = max(h - r, 0.0) * (1.0 / h);
    return (-22.0 * scale / (h * h)) * (1.0 + q * (7.0 + 16.0 * q)) * rest * square(cube(rest));
  }
};
// end
void validate(const WendlandC6&) {}

// doc: own-eos
/// Isothermal fluid of constant sound speed, p = c^2 rho: the equation of state of Morris et al. 1997.
struct Isothermal {
  double rest_density, c;  // [kg/m^3], [m/s]
  template <class T>
  T pressure(const T& rho) const {
    return c * c * rho;
  }
  template <class T>
  T sound_speed(const T&) const {
    return T(c);
  }
  template <class T>
  T density(const T& p) const {
    return p * (1.0 / (c * c));
  }
};
// end
void validate(const Isothermal&) {}

// doc: own-viscosity
/// Laminar viscosity as Morris', for one kinematic viscosity nu: mu_i + mu_j = nu (rho_i + rho_j).
struct OneViscosity {
  using reads = Fields<field::Density>;
  double nu;  // [m^2/s]
  auto along_velocity(const auto&, const auto& i, const auto& j) const { return nu * (i.density + j.density) / (i.density * j.density); }
  double damping_rate(double, double, double radial_factor_integral, int) const { return 2.0 * nu * radial_factor_integral; }
};
// end
void validate(const OneViscosity&) {}

// doc: own-potential
/// Soft repulsion, finite at r = 0.  U = eps (1 - (r/r_c)^2)^2 [J],  f = (4 eps/r_c^2)(1 - (r/r_c)^2) [N/m],  r < r_c.
struct SoftRepulsion {
  double energy_scale, cutoff;  // eps [J], r_c [m]
  template <class T>
  T force_factor(const T& distance_squared) const {
    return (4.0 * energy_scale / (cutoff * cutoff)) * rest(distance_squared);
  }
  template <class T>
  T energy(const T& distance_squared) const {
    return energy_scale * square(rest(distance_squared));
  }
  double largest_stiffness() const { return 8.0 * energy_scale / (cutoff * cutoff); }  // U'' at r_c

 private:
  template <class T>
  T rest(const T& distance_squared) const {
    return select(distance_squared < cutoff * cutoff, 1.0 - distance_squared * (1.0 / (cutoff * cutoff)), 0.0);
  }
};
// end
void validate(const SoftRepulsion&) {}

// doc: own-forcing
/// Centrifugal acceleration of a frame that turns about the origin.  a = w^2 r  [m/s^2]
struct Centrifugal {
  double w;  // [rad/s]
  auto acceleration(const auto& subject) const { return (w * w) * subject.position; }
};
// end
void validate(const Centrifugal&) {}

// doc: own-thermal
/// Solid whose specific heat rises with the temperature.  c = a + b T,  e = a T + b T^2/2  [J/kg]
struct WarmingSolid {
  double a, b;  // [J/(kg K)], [J/(kg K^2)]
  auto temperature(const auto& e) const { return 2.0 * e / (a + sqrt(a * a + 2.0 * b * e)); }
  auto specific_energy(const auto& temperature) const { return temperature * (a + 0.5 * b * temperature); }
  double specific_heat() const { return a; }  // the least
  bool admits(double e) const { return e > 0.0; }
  std::string demand() const { return "WarmingSolid: temperature must be > 0 K, that is specific_energy > 0 J/kg"; }
};
// end
void validate(const WarmingSolid&) {}

// doc: own-shear
/// Paste with a yield stress.  mu = mu_p + tau_y/sqrt(rate^2 + rate_0^2)  [Pa s]: below rate_0 it creeps.
/// M. Bercovier, M. Engelman, J. Comput. Phys. 36 (1980) 313-326, doi:10.1016/0021-9991(80)90163-1.
struct Bingham {
  static constexpr std::string_view name = "bingham";
  double mu_p, tau_y, rate_0;  // [Pa s], [Pa], [1/s]
  auto apparent_viscosity(const auto& shear_rate) const { return mu_p + tau_y / sqrt(square(shear_rate) + rate_0 * rate_0); }
};
// end
void validate(const Bingham&) {}

// doc: own-field
/// Volume fraction of suspended solids, a state of every particle that a law of this program reads.
struct Concentration {
  static constexpr std::string_view name = "concentration", unit = "-";
  static constexpr bool is_vector = false;
  template <int Dim, class T>
  struct Slot {
    T concentration;
  };
  static constexpr auto& of(auto& slots) { return slots.concentration; }
};
// end

// doc: own-material
/// Viscosity of a suspension.  mu = mu0 (1 - c/c_max)^(-2.5 c_max)  [Pa s]
/// I. M. Krieger, T. J. Dougherty, Trans. Soc. Rheol. 3 (1959) 137-152, doi:10.1122/1.548848.
struct KriegerDougherty {
  using reads = Fields<Concentration>;
  using writes = Fields<field::DynamicViscosity>;
  double mu0, c_max;  // viscosity of the liquid [Pa s], densest packing [-]
  void apply(auto& particle) const { particle.dynamic_viscosity = mu0 * pow(1.0 - particle.concentration / c_max, -2.5 * c_max); }
};
// end

// doc: own-rate
struct ConcentrationRate {
  using integrates = Concentration;
  static constexpr std::string_view name = "concentration_rate", unit = "1/s";
  static constexpr bool is_vector = false;
  template <int Dim, class T>
  struct Slot {
    T concentration_rate;
  };
  static constexpr auto& of(auto& slots) { return slots.concentration_rate; }
};
// end

// doc: own-pair
/// Fickian diffusion.  dc_i/dt = sum_j 2 D (m_j/rho_j) F (c_i - c_j)  [1/s],  F = (1/r) dW/dr <= 0: the richer particle loses.
/// P. W. Cleary, J. J. Monaghan, J. Comput. Phys. 148 (1999) 227-264, doi:10.1006/jcph.1998.6118.
template <class K>
struct Diffusion {
  using reads = Fields<field::Density, Concentration>;
  using writes = Fields<ConcentrationRate>;
  static constexpr bool uses_velocity = false;
  K kernel;
  double diffusivity;  // D [m^2/s]

  double cutoff() const { return kernel.support_radius; }
  void add(const auto& pair, const auto& i, const auto& j, auto& sums) const {
    sums.concentration_rate += 2.0 * diffusivity * j.mass / j.density * kernel.radial_factor(pair.distance) * (i.concentration - j.concentration);
  }
  void step_limits(const sweep::StepState& state, sweep::StepLimit& limit) const {
    limit.require_below(state.state_damping_limit / (2.0 * diffusivity * kernel::radial_factor_integral(kernel)), "diffusion of solids");
  }
};
// end

// doc: own-summed
struct Filling {
  static constexpr std::string_view name = "filling", unit = "-";
  static constexpr bool is_vector = false;
  template <int Dim, class T>
  struct Slot {
    T filling;
  };
  static constexpr auto& of(auto& slots) { return slots.filling; }
};

/// Share of the support that particles fill, sum_j V_j W: 1 inside, about 1/2 at a free surface.
template <class K>
struct FillingAround {
  using reads = Fields<field::Density>;
  using sums = Fields<Filling>;
  using sets = Fields<Filling>;
  static constexpr bool uses_velocity = false;
  K kernel;

  double cutoff() const { return kernel.support_radius; }
  void add(const auto& pair, const auto&, const auto& j, auto& total) const {
    total.filling += j.mass / j.density * kernel.value(pair.distance);
  }
  void set(auto& particle, const auto& total) const {
    particle.filling = total.filling + particle.mass / particle.density * kernel.value(0.0);
  }
};
// end

}  // namespace own

TEST_CASE("laws of one's own obey the laws of their families") {
  // doc: own-suites
  check_kernel_laws(own::WendlandC6{.support_radius = 0.1});
  check_equation_of_state_laws(own::Isothermal{.rest_density = 1000.0, .c = 10.0}, 1000.0 * 100.0);  // p at rho0 [Pa]
  check_viscosity_laws<2>(own::OneViscosity{.nu = 0.3});                                             // the suite compares with 0.3
  check_pair_potential_laws(own::SoftRepulsion{.energy_scale = 2.0, .cutoff = 0.1}, 0.0);            // from r = 0
  check_forcing_laws<3>(own::Centrifugal{.w = 2.0});
  check_thermal_laws(own::WarmingSolid{.a = 400.0, .b = 0.5}, 0.0, 600.0);                           // from 0 to 600 K
  check_viscosity_of_shear_rate_laws(own::Bingham{.mu_p = 0.1, .tau_y = 5.0, .rate_0 = 0.01}, Becomes::thinner, 0.1, 500.1);
  // end
}

namespace own {

struct Slurry {};

/// A doubly periodic square of slurry under all the laws above; the solids vary as a wave along x.
double amplitude_left(double time) {
  constexpr double spacing = 0.05, wave = 2.0 * std::numbers::pi;
  const geometry::Cuboid<2> square{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}};
  // doc: own-scene
  using Kernel = WendlandC6;
  using Flow = sph::WeaklyCompressible<Kernel, viscosity::Morris<>>;
  const Kernel kernel{.support_radius = 3.0 * spacing};
  auto basin = simulation::scene<integrator::ExtrapolatedVerlet>(
      geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {1.0, 1.0}, .periodic = {true, true}},
      simulation::group<Slurry>("slurry", particles::Mobile{}, geometry::fill(geometry::Cubic<2>{.spacing = spacing}, square), spacing * spacing),
      simulation::interaction<Slurry, Slurry>(Flow{.kernel = kernel}, Diffusion<Kernel>{.kernel = kernel, .diffusivity = 0.01},
                                              SoftRepulsion{.energy_scale = 1e-9, .cutoff = spacing}),
      simulation::material<Slurry>(Isothermal{.rest_density = 1.0, .c = 5.0}, KriegerDougherty{.mu0 = 0.01, .c_max = 0.64}),
      simulation::summed<Slurry>(FillingAround<Kernel>{.kernel = kernel}),
      simulation::forced_by<Slurry>(Centrifugal{.w = 1e-6}));
  auto& slurry = basin.group<Slurry>();
  slurry.set<field::Density>([](const auto&) { return 1.0; });
  slurry.set<Concentration>([](const Vector<2>& x) { return 0.2 + 0.1 * std::sin(wave * x[0]); });
  // end
  const double before = basin.engine().prepared(slurry, 0, 0.0).dynamic_viscosity;  // particle 0 lies half a spacing from the corner
  CHECK(before == doctest::Approx(0.01 * std::pow(1.0 - (0.2 + 0.1 * std::sin(0.5 * wave * spacing)) / 0.64, -1.6)));
  basin.run({.until = time});
  double overlap = 0.0, total = 0.0;
  for (std::size_t k = 0; k < slurry.size(); ++k) {
    overlap += 2.0 * slurry.get<Concentration>()[k] * std::sin(wave * slurry.positions()[k][0]) / static_cast<double>(slurry.size());
    total += slurry.get<Concentration>()[k] / static_cast<double>(slurry.size());
  }
  CHECK(total == doctest::Approx(0.2).epsilon(1e-6));
  for (const double filling : slurry.get<Filling>()) CHECK(filling == doctest::Approx(1.0).epsilon(0.01));  // nowhere a free surface
  return overlap / std::exp(-0.01 * wave * wave * basin.time());
}

}  // namespace own

TEST_CASE("a field, a material law and a pair law of one's own: a wave of solids decays as exp(-D k^2 t)") {
  CHECK(own::amplitude_left(0.5) == doctest::Approx(0.1).epsilon(0.03));
}

namespace own {

struct Bar {};

/// A bar of the warming solid, its left half at `hot` and the rest at 300 K, 5000 s later: the same heat, nearer to each other.
void conduct(double hot) {
  constexpr double spacing = 0.01;
  const geometry::Cuboid<2> cuboid{.lower = {0.0, 0.0}, .upper = {0.2, 0.06}};
  const WarmingSolid solid{.a = 400.0, .b = 0.5};
  const sph::HeatConduction<WendlandC6> conduction{.kernel = {.support_radius = 3.0 * spacing}};
  auto scene = simulation::scene<integrator::LammpsVerlet>(
      geometry::Box<2>{.lower = {0.0, 0.0}, .upper = {0.2, 0.06}, .periodic = {false, true}},
      simulation::group<Bar>("bar", particles::Stationary{}, geometry::fill(geometry::Cubic<2>{.spacing = spacing}, cuboid),
                             8000.0 * spacing * spacing),
      // doc: own-thermal-material
      simulation::material<Bar>(solid, eos::ConstantDensity{.density = 8000.0}, thermal::Conductivity{.thermal_conductivity = 40.0}),
      // end
      simulation::interaction<Bar, Bar>(conduction));
  auto& energies = scene.group<Bar>().get<field::SpecificEnergy>();
  scene.group<Bar>().set<field::SpecificEnergy>([&](const Vector<2>& x) { return solid.specific_energy(x[0] < 0.1 ? hot : 300.0); });
  const auto heat = [&] {
    double sum = 0.0;
    for (const double e : energies) sum += e / static_cast<double>(energies.size());
    return sum;
  };
  const double before = heat(), mean = solid.temperature(before);
  scene.run({.until = 5000.0});
  CHECK(heat() == doctest::Approx(before).epsilon(1e-12));
  for (const double e : energies) CHECK(solid.temperature(e) == doctest::Approx(mean).epsilon(1e-3));
}

}  // namespace own

TEST_CASE("a thermal law of one's own: a bar comes to one temperature and keeps its heat; what the law does not admit is refused") {
  own::conduct(500.0);
  const std::string demand = "WarmingSolid: temperature must be > 0 K, that is specific_energy > 0 J/kg, got specific_energy -3975 J/kg";
  CHECK_THROWS_WITH_AS(own::conduct(-10.0), doctest::Contains(demand.c_str()), dmp::ParameterError);
}
