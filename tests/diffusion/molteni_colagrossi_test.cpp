#include "diffusion/laws.hpp"
#include "support/lattice.hpp"
#include <dmp/diffusion/molteni_colagrossi.hpp>
#include <dmp/kernel/lucy.hpp>

namespace diffusion = dmp::diffusion;

namespace {

/// drho/dt of a particle of density 1 at the origin of a square or cubic lattice of unit spacing with density(position).
template <int Dim, class Density>
double density_rate(const diffusion::MolteniColagrossi& law, double support_radius, const Density& density) {
  const dmp::kernel::Lucy<Dim> kernel{.support_radius = support_radius};
  test::Particle<Dim> i{};
  i.density = density(i.position);
  double result = 0.0;
  test::for_each_site<Dim>(support_radius, [&](const auto& site, double volume) {
    test::Particle<Dim> j{};
    j.position = site;
    j.density = density(site);
    j.mass = j.density * volume;
    const auto pair = test::pair_of<Dim>(i, j);
    result += j.mass * kernel.radial_factor(pair.distance) * law.flux(pair, i, j, support_radius);
  });
  return result;
}

const diffusion::MolteniColagrossi law{.sound_speed = 16.0};

}  // namespace

TEST_CASE("delta-SPH diffusion obeys the laws of density diffusion in 1D, 2D and 3D") {
  static_assert(sizeof(diffusion::MolteniColagrossi) == 2 * sizeof(double));
  check_diffusion_laws<1>(law);
  check_diffusion_laws<2>(law);
  check_diffusion_laws<3>(law);
  check_diffusion_laws<3>(diffusion::MolteniColagrossi{.sound_speed = 1e9, .delta = 10.0});
}

TEST_CASE("delta-SPH diffusion of a parabolic density is delta h_s c times its Laplacian, h_s = half the support") {
  constexpr double support = 2.6, moment = 1.0061, curvature = 1e-3;  // second moment of the square lattice: sheet 06, section 2.1
  const double rate = density_rate<2>(law, support, [](const auto& x) { return 1.0 + 0.5 * curvature * x[1] * x[1]; });
  CHECK(std::fabs(rate / (0.1 * (support / 2.0) * 16.0 * curvature) - moment) <= 0.6e-4);
}

TEST_CASE("delta-SPH diffusion leaves a uniform slope of density alone") {
  CHECK(std::fabs(density_rate<3>(law, 2.6, [](const auto& x) { return 1.0 + 1e-3 * x[0]; })) <= 1e-15);
}

TEST_CASE("delta-SPH diffusion wears down one dense particle at its stated rate") {
  constexpr double support = 8.0, excess = 1e-3;
  const double rate = density_rate<3>(law, support, [](const auto& x) { return dot(x, x) == 0.0 ? 1.0 + excess : 1.0; });
  const double stated = law.damping_rate(support, 10.5 / (support * support));  // Lucy's 10.5/h^2, sheet 06, section 2.1
  CHECK(-rate / excess == doctest::Approx(stated).epsilon(0.01));
}

TEST_CASE("delta-SPH diffusion refuses parameters that would sharpen the density") {
  using MC = diffusion::MolteniColagrossi;
  CHECK(test::complaint_about(MC{.sound_speed = -1.0}) == "diffusion::MolteniColagrossi: sound_speed must be finite and > 0 m/s, got -1");
  CHECK(test::complaint_about(MC{.sound_speed = 1.0, .delta = -0.1}) ==
        "diffusion::MolteniColagrossi: delta must be finite and >= 0 [-], got -0.1");
  CHECK(test::complaint_about(MC{.sound_speed = NAN}) == "diffusion::MolteniColagrossi: sound_speed must be finite and > 0 m/s, got nan");
}
