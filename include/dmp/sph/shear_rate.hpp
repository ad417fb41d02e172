#pragma once
#include <cmath>
#include <string_view>
#include <Eigen/LU>
#include <dmp/core/field.hpp>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/kernel/concept.hpp>

namespace dmp::sph {

/// Shear rate from the velocities around, a summed law:  sqrt(2 D:D) [1/s],  D = (L + L^T)/2,  L = G M^-1
///   G = sum_j V_j (v_j - v_i) (x) grad_i W,   M = sum_j V_j (r_j - r_i) (x) grad_i W,   V_j = m_j/rho_j, grad_i W = F r_ij
/// M is the unit matrix in the continuum, about 1/8 of it at a corner in space; dividing by it makes L exact for a linear velocity field,
/// also beside walls and free surfaces. Where neighbours do not span space (a row, a sheet, a droplet of few particles: det M <= 0.01
/// (tr M/d)^d) L = G.
/// J. Bonet, T.-S. L. Lok, Comput. Methods Appl. Mech. Engrg. 180 (1999) 97-115, doi:10.1016/S0045-7825(99)00051-1.
template <class K>
struct ShearRate {
  static_assert(kernel::explain_kernel<K>());
  static constexpr int dimension = K::dimension;
  struct VelocityGradient {  // G
    static constexpr std::string_view name = "velocity_gradient", unit = "1/s";
    static constexpr bool is_vector = false, is_tensor = true;
    template <int Dim, class T>
    struct Slot {
      Components<Dim * Dim, T> velocity_gradient;
    };
    static constexpr auto& of(auto& slots) { return slots.velocity_gradient; }
  };
  struct Moment {  // M
    static constexpr std::string_view name = "moment", unit = "-";
    static constexpr bool is_vector = false, is_tensor = true;
    template <int Dim, class T>
    struct Slot {
      Components<Dim * Dim, T> moment;
    };
    static constexpr auto& of(auto& slots) { return slots.moment; }
  };
  using reads = Fields<field::Density>;
  using sums = Fields<VelocityGradient, Moment>;
  using sets = Fields<field::ShearRate>;
  static constexpr bool uses_velocity = true;
  K kernel;

  [[nodiscard]] double cutoff() const noexcept { return kernel.support_radius; }
  void add(const auto& pair, const auto&, const auto& j, auto& total) const noexcept {
    const auto V_F = j.mass / j.density * kernel.radial_factor(pair.distance);
    unrolled<dimension>([&](auto a) {
      unrolled<dimension>([&](auto b) {
        constexpr int ab = a * dimension + b;
        total.velocity_gradient[ab] -= V_F * pair.relative_velocity[a] * pair.separation[b];
        total.moment[ab] -= V_F * pair.separation[a] * pair.separation[b];
      });
    });
  }
  void set(auto& particle, const auto& total) const noexcept {
    using Matrix = Eigen::Matrix<double, dimension, dimension, dimension == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
    const Matrix moment = Eigen::Map<const Matrix>(total.moment.component);
    Matrix gradient = Eigen::Map<const Matrix>(total.velocity_gradient.component);
    double scale = 0.01;
    unrolled<dimension>([&](auto) { scale *= moment.trace() / dimension; });
    if (moment.determinant() > scale) gradient = (gradient * moment.inverse()).eval();
    particle.shear_rate = std::sqrt(0.5) * (gradient + gradient.transpose()).norm();  // 2 D:D = |L + L^T|^2/2
  }
};
template <class K>
void validate(const ShearRate<K>& law) {
  check_parameters(law.kernel);
}

}  // namespace dmp::sph
