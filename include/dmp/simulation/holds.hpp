#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <dmp/bond/concept.hpp>
#include <dmp/core/aligned.hpp>
#include <dmp/core/math.hpp>
#include <dmp/core/pack.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/neighbours/bond_list.hpp>
#include <dmp/sweep/bonds.hpp>
#include <dmp/sweep/gather.hpp>

namespace dmp::simulation::detail {

/// Of a symmetric matrix, to about 1e-8 of its largest magnitude. In closed form, since every scene would have to read Eigen's solvers:
/// with H = q 1 + p B, q = tr H/d, tr B^2 = d (d - 1), it is q + p in the plane, q + 2 p cos(arccos(det B/2)/3), 3 det B = tr B^3, in space.
/// O. K. Smith, Commun. ACM 4 (1961) 168, doi:10.1145/355578.366316.
template <int Dim>
[[nodiscard]] double largest_eigenvalue(const Eigen::Matrix<double, Dim, Dim>& h) noexcept {
  using Matrix = Eigen::Matrix<double, Dim, Dim>;
  if constexpr (Dim == 1) return h(0, 0);
  const double q = h.trace() / Dim;
  const Matrix deviator = h - q * Matrix::Identity();
  const double p = std::sqrt(deviator.squaredNorm() / (Dim * (Dim - 1)));
  if (Dim == 2 || !(p > 0.0)) return q + p;
  const Matrix b = deviator / p;
  return q + 2.0 * p * std::cos(std::acos(std::clamp((b * b * b).trace() / 6.0, -1.0, 1.0)) / 3.0);
}

/// How bonds hold each particle of a group, per mass: a symmetric matrix for each row, springs [1/s^2] or dashpots [1/s].
template <int Dim>
class Holds {
 public:
  using Matrix = Eigen::Matrix<double, Dim, Dim>;
  static constexpr int numbers = Dim * (Dim + 1) / 2;  ///< of the upper triangle, row by row
  static constexpr int stride = (numbers + sweep::Lanes::width - 1) / sweep::Lanes::width * sweep::Lanes::width;
  /// Row and column of each number.
  static constexpr auto places = [] {
    std::array<std::pair<int, int>, numbers> result{};
    for (int a = 0, n = 0; a < Dim; ++a)
      for (int b = a; b < Dim; ++b) result[static_cast<std::size_t>(n++)] = {a, b};
    return result;
  }();

  /// Zeros in `rows` rows, unless there are some already.
  void make(std::size_t rows) {
    if (data_.empty()) data_.assign(rows * stride, 0.0);
  }
  [[nodiscard]] bool empty() const noexcept { return data_.empty(); }
  [[nodiscard]] double* data() noexcept { return data_.data(); }
  [[nodiscard]] Matrix of(std::size_t row) const noexcept {
    Matrix matrix;
    for (std::size_t n = 0; n < numbers; ++n)
      matrix(places[n].first, places[n].second) = matrix(places[n].second, places[n].first) = data_[row * stride + n];
    return matrix;
  }
  /// Largest eigenvalue; and what it does not exceed, much faster: the largest sum of magnitudes in a line (Gershgorin).
  [[nodiscard]] double largest(std::size_t row) const noexcept { return empty() ? 0.0 : largest_eigenvalue<Dim>(of(row)); }
  [[nodiscard]] double at_most(std::size_t row) const noexcept {
    if (empty()) return 0.0;
    return of(row).cwiseAbs().colwise().sum().maxCoeff();
  }

 private:
  AlignedVector<double> data_;
};

template <class Law>
[[nodiscard]] double largest_damping(const Law& law) {
  if constexpr (bond::UsesVelocity<Law>) return law.largest_damping();
  else return 0.0;
}

/// Adds what the bonds of one item do to the particles of a group as they stand now, with `per_mass` = f/m: f k/m n n^T to the springs,
/// f c/m n n^T to the dashpots, and across a bond under tension f T/(m r) (1 - n n^T) to the springs. A bond of length zero, or of one
/// whose square overflows, may act in any direction.
template <class Law, class G, class Partners>
void add_holds(const Law& law, double per_mass, const neighbours::BondList& list, const G& g, const Partners& partners,
               const sweep::Periods<G::Dim>& periods, Holds<G::Dim>& springs, Holds<G::Dim>& dashpots) {
  using sweep::Lanes;
  constexpr int Dim = G::Dim, width = Lanes::width, numbers = Holds<Dim>::numbers, stride = Holds<Dim>::stride;
  constexpr bool with_dashpots = bond::UsesVelocity<Law>;
  const double stiffness = per_mass * law.largest_stiffness(), damping = per_mass * largest_damping(law);
  springs.make(g.first_ghost());
  if constexpr (with_dashpots) dashpots.make(g.first_ghost());
  const auto& there = partners.positions();
  const auto add_one = [&](std::size_t i) {
    const auto bonds = list.of(i);
    const Vector<Dim>& here = g.positions()[i];
    Lanes own[numbers], own_dashpots[numbers];
    for (int n = 0; n < numbers; ++n) own[n] = own_dashpots[n] = 0.0;
    for (std::size_t k = 0; k < bonds.size; k += width) {
      const auto apart = sweep::separations_of<Partners::Records::stride>(here, there.data(), bonds.partner + k, periods);
      const Lanes squared = dot(apart, apart);
      bond::FullState<Lanes> seen{};
      seen.length = sqrt(squared);
      seen.rest_length = Lanes::load(bonds.rest_length + k);
      if constexpr (bond::HasMemory<Law>) seen.memory = Lanes::load(list.memories_of(i) + k);
      if constexpr (bond::IsDispersive<Law>) {
        double strain[width];
        for (std::size_t lane = 0; lane < width; ++lane)
          strain[lane] = partners.template get<field::BondStrain>()[bonds.partner[k + lane] / Partners::Records::stride];
        seen.strain_of_ends = g.template get<field::BondStrain>()[i] + Lanes::load(strain);
      }
      const auto is_bond = seen.rest_length >= 0.0, has_length = squared > 0.0 && squared <= std::numeric_limits<double>::max();
      const Lanes weight = select(is_bond, Lanes::load(bonds.weight + k * bonds.weight_step), 0.0);
      const Lanes inverse = select(has_length, 1.0 / squared, 0.0), tension = law.tension(seen);
      const Lanes across = select(is_bond && has_length, per_mass * weight * max(tension, 0.0) * (seen.length * inverse), 0.0);
      const auto add = [&](double along_all, Lanes across_all, Holds<Dim>& holds, Lanes* sums) __attribute__((always_inline)) {
        const Lanes along = along_all * weight, in_any = select(has_length, across_all, along), per_square = (along - across_all) * inverse;
        Lanes terms[numbers];
        unrolled<numbers>([&](auto n) __attribute__((always_inline)) {
          constexpr auto place = Holds<Dim>::places[n];
          terms[n] = per_square * apart[place.first] * apart[place.second];
          if constexpr (place.first == place.second) terms[n] += in_any;
          sums[n] += terms[n];
        });
        if constexpr (std::is_same_v<G, Partners>) {
          std::uint32_t row[width];
          unrolled<width>([&](auto lane) __attribute__((always_inline)) { row[lane] = bonds.reaction[k + lane] / G::Sums::stride; });
          add_transposed<numbers>(holds.data(), stride, row, terms);
        }
      };
      add(stiffness, across, springs, own);
      if constexpr (with_dashpots) add(damping, 0.0, dashpots, own_dashpots);
    }
    const auto add_own = [&](const Lanes* sums, Holds<Dim>& holds) {
      double total[numbers];
      sum_transposed<numbers>(sums, total);
      for (std::size_t n = 0; n < numbers; ++n) holds.data()[i * stride + n] += total[n];
    };
    add_own(own, springs);
    if constexpr (with_dashpots) add_own(own_dashpots, dashpots);
  };
  for_each_block(g.blocks, [&](std::size_t, std::size_t block) {
    for (std::size_t i = g.blocks.begin(block); i < g.blocks.end(block); ++i) add_one(i);
  });
}

}  // namespace dmp::simulation::detail
