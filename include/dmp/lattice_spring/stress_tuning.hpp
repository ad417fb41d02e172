#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>
#include <dmp/core/math.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/lattice_spring/body.hpp>
#include <dmp/lattice_spring/hardy_stress.hpp>
#include <dmp/lattice_spring/interior.hpp>
#include <dmp/lattice_spring/tuning.hpp>
#include <dmp/neighbours/cell_grid.hpp>

namespace dmp::lattice_spring {

/// How the stress of a network is made even.
struct StressTuning {
  double probe_radius = 0.0;            ///< [m] of the ball about each bead in which its stress is measured; 0: 0.8 reach
  double step = 1.0;                    ///< t, > 0 and < 2: part of the error of the stress that a step takes away
  std::size_t most_alternations = 300;  ///< of a step for the stress and one for the balance
  double least_gain = 0.01;             ///< it ends when the scatter of the stress falls by less than this in 20 of them, relative
  Tuning balance{};                     ///< limit of change and solver, and how long weights are balanced before and after
};
inline void validate(const StressTuning& tuning) {
  require_not_negative("lattice_spring::StressTuning: probe_radius", tuning.probe_radius, "m");
  require(tuning.step > 0.0 && tuning.step < 2.0, "lattice_spring::StressTuning: step must be > 0 and < 2", tuning.step);
  require(tuning.most_alternations >= 1, "lattice_spring::StressTuning: most_alternations must be >= 1",
          static_cast<double>(tuning.most_alternations));
  require_not_negative("lattice_spring::StressTuning: least_gain", tuning.least_gain, "");
  validate(tuning.balance);
}

/// What became of it; `steps` of the report are alternations.
struct StressTuningReport : TuningReport {
  double stress_scatter_before = 0.0, stress_scatter = 0.0;  ///< of the normal stresses of the probed beads, relative to the mean pressure
};

/// ikL-tune: weights for which, under a uniform expansion, no force is left on inner beads and the stress sigma_i in a ball about each bead
/// (Hardy's) is the same everywhere, N K e 1. Alternates tune_balance's step with
///   change of w_b = -t w_b sum over the beads i around of B n . (sigma_i/(N K e) - 1) n / sum of B,
/// B the share of the bond's ball in the probe of i. Both within the limit of change. Only beads that lie deeper than probe and reach
/// together are probed: nearer to the surface bonds are missing. K is that of the interior, as it was. The points do not move.
/// M. Kot, ChemEngineering 5 (2021) 3, doi:10.3390/chemengineering5010003, section 4, where each spring is changed by the sum over beads of
/// -t V/(B e L^2) n . (sigma_i - N K e 1) n with t of about 1/(number of springs): by the mean over beads here, so that t has a known range
/// and nothing is divided by a small B.
template <SolidShape S>
[[nodiscard]] StressTuningReport tune_stress(Body<3>& body, const S& shape, double reach, const StressTuning& tuning = {}) {
  validate(tuning);
  validate(shape);
  require_positive("lattice_spring::tune_stress: reach", reach, "m");
  detail::require_ends("lattice_spring::tune_stress", body.bonds, body.points.positions.size());
  detail::Balance<3> balance(body, shape, reach, tuning.balance);
  StressTuningReport report;
  if (balance.inner_beads() == 0) return report;
  report.imbalance_before = balance.imbalance();
  report.end = TuningEnd::most_steps;

  // The bonds in the probe of each bead that has one.
  const auto& x = body.points.positions;
  const double radius = tuning.probe_radius > 0.0 ? tuning.probe_radius : 0.8 * reach;
  const double volume = 4.0 / 3.0 * std::numbers::pi * cube(radius);
  struct Share {
    std::uint32_t bond;
    double overlap;  // B
  };
  std::vector<Share> shares;
  std::vector<std::size_t> first{0};
  {
    std::vector<Vector<3>> midpoints;
    for (const neighbours::Bond& bond : body.bonds) midpoints.push_back(0.5 * (x[bond.i] + x[bond.j]));
    neighbours::CellGrid<3> grid;
    grid.build(midpoints, radius);
    std::vector<std::uint32_t> found;
    for (const Vector<3>& centre : x) {
      if (!(depth_in(shape, centre) >= radius + reach)) continue;
      found.clear();
      grid.find(centre, radius + 0.5 * reach, neighbours::CellGrid<3>::nobody, found);
      std::sort(found.begin(), found.end());
      for (const std::uint32_t b : found) {
        const double half = 0.5 * std::sqrt(balance.squared_length(b));
        if (!(half > 0.0)) continue;
        const double overlap = ball_overlap(radius, half, (midpoints[b] - centre).norm()) / (4.0 / 3.0 * std::numbers::pi * cube(half));
        if (overlap > 1e-6) shares.push_back({b, overlap});
      }
      first.push_back(shares.size());
    }
  }
  const std::size_t probes = first.size() - 1;
  const double level = balance.level_before() / (3.0 * volume_deeper(shape, reach));  // N K e for e = 1
  std::vector<Tensor<3>> excess(probes);                                              // sigma/(N K e) - 1
  const auto measure = [&] {
    double sum = 0.0;
    for (std::size_t p = 0; p < probes; ++p) {
      Tensor<3> stress = Tensor<3>::Zero();
      for (std::size_t s = first[p]; s < first[p + 1]; ++s) {
        const Vector<3>& apart = balance.apart()[shares[s].bond];
        stress += (shares[s].overlap * body.bonds[shares[s].bond].weight) * apart * apart.transpose();
      }
      excess[p] = stress / (volume * level) - Tensor<3>::Identity();
      sum += excess[p].diagonal().squaredNorm() / 3.0;
    }
    return probes > 0 ? std::sqrt(sum / static_cast<double>(probes)) : 0.0;
  };

  for (std::size_t k = 0; k < tuning.balance.most_steps; ++k)
    if (balance.step(tuning.balance.solver_tolerance, k == 0 ? 1.0 : 1.8) < tuning.balance.least_step ||
        balance.imbalance() <= tuning.balance.imbalance)
      break;
  report.stress_scatter_before = measure();
  double before = report.stress_scatter_before;
  std::vector<double> sum(body.bonds.size()), weight(body.bonds.size());
  for (; probes > 0 && report.steps < tuning.most_alternations; ++report.steps) {
    const double now = measure();
    if (report.steps % 20 == 0 && report.steps > 0) {
      if (!(now < (1.0 - tuning.least_gain) * before)) {
        report.end = TuningEnd::stagnated;
        break;
      }
      before = now;
    }
    std::fill(sum.begin(), sum.end(), 0.0);
    std::fill(weight.begin(), weight.end(), 0.0);
    for (std::size_t p = 0; p < probes; ++p)
      for (std::size_t s = first[p]; s < first[p + 1]; ++s) {
        const Vector<3>& apart = balance.apart()[shares[s].bond];
        sum[shares[s].bond] += shares[s].overlap * apart.dot(excess[p] * apart);
        weight[shares[s].bond] += shares[s].overlap;
      }
    for (std::size_t b = 0; b < sum.size(); ++b)
      if (weight[b] > 0.0) balance.change(b, body.bonds[b].weight * (1.0 - tuning.step * sum[b] / (weight[b] * balance.squared_length(b))));
    balance.step(1e-2, 1.0);  // the next one goes on from there
  }
  if (probes == 0) report.end = TuningEnd::stagnated;
  balance.finish(report);
  report.stress_scatter = measure();
  return report;
}

}  // namespace dmp::lattice_spring
