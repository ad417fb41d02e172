#pragma once
#include <string_view>
#include <dmp/core/field.hpp>
#include <dmp/core/require.hpp>
#include <dmp/kernel/concept.hpp>

namespace dmp::sph {

/// Density averaged over the particles around, a summed law that is meant for every 20th to 50th step:
///   rho_i = sum_j m_j W(r_ij) / sum_j (m_j/rho_j) W(r_ij)   [kg/m^3], the sums with j = i
/// Smooths what the continuity equation has roughened, also at a free surface; does not undo a drift of the mean (DensitySum does).
/// D. Shepard, Proc. 23rd ACM National Conf. (1968) 517-524, doi:10.1145/800186.810616.
template <class K>
struct ShepardDensity {
  static_assert(kernel::explain_kernel<K>());
  struct CoveredVolume {
    static constexpr std::string_view name = "covered_volume", unit = "-";
    static constexpr bool is_vector = false;
    template <int Dim, class T>
    struct Slot {
      T covered_volume;
    };
    static constexpr auto& of(auto& slots) { return slots.covered_volume; }
  };
  using reads = Fields<field::Density>;
  using sums = Fields<field::Density, CoveredVolume>;
  using sets = Fields<field::Density>;
  static constexpr bool uses_velocity = false;
  K kernel;

  [[nodiscard]] double cutoff() const noexcept { return kernel.support_radius; }
  void add(const auto& pair, const auto&, const auto& j, auto& total) const noexcept {
    const auto m_W = j.mass * kernel.value(pair.distance);
    total.density += m_W;
    total.covered_volume += m_W / j.density;
  }
  void set(auto& particle, const auto& total) const noexcept {
    const double own = particle.mass * kernel.value(0.0);
    particle.density = (own + total.density) / (own / particle.density + total.covered_volume);
  }
};
template <class K>
void validate(const ShepardDensity<K>& law) {
  check_parameters(law.kernel);
}

}  // namespace dmp::sph
