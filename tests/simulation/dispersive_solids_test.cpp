// Springs with dispersion in scenes: E and nu, speeds of waves, energy over long runs, bounds of the step, and the pressed cube. Cases B3
// and B10.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>
#include <Eigen/Eigenvalues>
#include <doctest/doctest.h>

#include "support/dispersion.hpp"
#include "support/random.hpp"

using namespace dmp;
using namespace dmp::simulation;
using namespace dmp::lattice_spring;
using bond::Dispersive;
using geometry::Box;
using integrator::Leapfrog;
using particles::Clamp, particles::Driven, particles::Frozen, particles::Mobile, particles::Roller;

namespace {

struct Beads {};
struct First {};
struct Last {};

/// The law that gives a body E = 1 and this Poisson ratio.
Dispersive law_for(const Body<3>& body, double poisson_ratio) {
  const Springs springs = springs_for(body, ElasticConstants<3>::from_young(1.0, poisson_ratio));
  return {.stiffness = springs.stiffness, .dispersive_share = springs.dispersive_share};
}
Body<3> block(int length, int width) {
  auto body = lattice_block(CubicLattice{.spacing = 1.0}, {length, width, width}, SurfaceBonds::shared);
  measure_rest_lengths<3>(body.bonds, body.points.positions);
  return body;
}
/// A body along x whose ends are held by `mobility`, at rest; what holds the last beads has moved them by `elongation`.
template <class Mobility>
auto stretched(const Body<3>& body, const Dispersive& law, const Mobility& first, const Mobility& last, double time, double tolerance,
               std::vector<Vector<3>>& positions, double& load) {
  double longest = 0.0;
  for (const auto& x : body.points.positions) longest = std::fmax(longest, x[0]);
  const test::Divided<3, 3> parts(body, [&](const Vector<3>& x) -> std::size_t { return x[0] < 0.5 ? 1 : x[0] > longest - 0.5 ? 2 : 0; });
  const auto& list = parts.bonds;
  auto scene = simulation::scene<Leapfrog>(
      Box<3>::unbounded(), group<Beads>("beads", Mobile{}, parts.points[0], 1.0), group<First>("first", first, parts.points[1], 1.0),
      group<Last>("last", last, parts.points[2], 1.0), bonds<Beads, Beads>(law, list[0][0]), bonds<Beads, First>(law, list[0][1]),
      bonds<Beads, Last>(law, list[0][2]), bonds<First, First>(law, list[1][1]), bonds<Last, Last>(law, list[2][2]));
  const double moved = last.motion.motion.displacement(time);  // start as uniform strain along x has it
  for (auto& x : scene.template group<Beads>().positions()) x[0] *= 1.0 + moved / longest;
  const auto report = relax(scene, {.force_tolerance = tolerance, .time = time});
  load = bond_load<First>(scene)[0];
  positions.resize(body.points.positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
    positions[i] = parts.part[i] == 0   ? scene.template group<Beads>().positions()[parts.row[i]]
                   : parts.part[i] == 1 ? scene.template group<First>().positions()[parts.row[i]]
                                        : scene.template group<Last>().positions()[parts.row[i]];
  return report;
}
Clamp<3> along_x(double speed) { return {.direction = {{1.0, 0.0, 0.0}}, .motion = {.speed = speed}}; }

}  // namespace

TEST_CASE(
    "B3: a bar of lattice between rollers, stretched in a scene, has E and nu up to its strain, and the small-strain solution up to strain "
    "squared") {
  constexpr int length = 10, width = 3;
  const auto body = block(length, width);
  const auto& x = body.points.positions;
  for (const double nu : {-0.5, 0.0, 0.1, 0.25, 0.4, 0.49}) {
    CAPTURE(nu);
    const auto law = law_for(body, nu);
    Supports<3> rollers(x.size());
    std::vector<Vector<3>> unit(x.size(), Vector<3>::Zero());
    for (std::size_t i = 0; i < x.size(); ++i) {
      unit[i][0] = x[i][0];
      if (x[i][0] < 0.5 || x[i][0] > length - 0.5) rollers.hold(i, 0);
    }
    const auto linear = equilibrium<3>(SmallStrain<3>(body, {.stiffness = law.stiffness, .dispersive_share = law.dispersive_share}),
                                       rollers, unit, {}, {.tolerance = 1e-12})
                            .displacements;
    std::array<double, 2> modulus{}, ratio{}, error{};
    for (const int half : {0, 1}) {
      const double strain = half == 0 ? 2e-3 : 1e-3;
      std::vector<Vector<3>> positions;
      double load = 0.0;
      stretched(body, law, Roller{along_x(0.0)}, Roller{along_x(strain * length)}, 1.0, 1e-10, positions, load);
      const auto n = static_cast<std::size_t>(half);
      double across = 0.0, count = 0.0;
      Vector<3> shift = Vector<3>::Zero();  // nothing holds the body across
      for (std::size_t i = 0; i < x.size(); ++i) shift += (positions[i] - x[i] - strain * linear[i]) / static_cast<double>(x.size());
      shift[0] = 0.0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        error[n] = std::fmax(error[n], (positions[i] - x[i] - strain * linear[i] - shift).norm() / strain);
        if (x[i][1] < 0.5 || x[i][1] > width - 0.5) {
          across += (x[i][1] < 0.5 ? -1.0 : 1.0) * (positions[i][1] - x[i][1]);
          count += 0.5;
        }
      }
      modulus[n] = load / (width * width * strain);
      ratio[n] = -across / (count * width * strain);
    }
    for (std::size_t n = 0; n < 2; ++n) {
      const double strain = n == 0 ? 2e-3 : 1e-3;
      CHECK(std::fabs(modulus[n] - 1.0) < 2.0 * strain);
      CHECK(std::fabs(ratio[n] - nu) < 2.0 * strain);
      CHECK(error[n] < strain);  // divided by the strain already
    }
    CHECK(std::fabs(2.0 * modulus[1] - modulus[0] - 1.0) < 2e-6);  // without what is linear in the strain
    CHECK(std::fabs(2.0 * ratio[1] - ratio[0] - nu) < 2e-6);
    CHECK(error[1] == doctest::Approx(0.5 * error[0]).epsilon(0.05));
  }
}

namespace {

/// A periodic piece of the cubic lattice, `cells` in each direction, of spacing and mass 1: every bond of it is inside.
Body<3> periodic_lattice(const std::array<int, 3>& cells) {
  Body<3> body;
  const auto row = [&](int i, int j, int m) {
    const auto wrap = [](int a, int n) { return static_cast<std::uint32_t>((a % n + n) % n); };
    return wrap(i, cells[0]) +
           static_cast<std::uint32_t>(cells[0]) * (wrap(j, cells[1]) + static_cast<std::uint32_t>(cells[1]) * wrap(m, cells[2]));
  };
  for (int m = 0; m < cells[2]; ++m)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i) {
        body.points.positions.emplace_back(i + 0.5, j + 0.5, m + 0.5);
        for (const auto& bond : CubicLattice::bonds())
          body.bonds.push_back(
              {row(i, j, m), row(i + bond.to[0], j + bond.to[1], m + bond.to[2]),
               std::sqrt(static_cast<double>(bond.to[0] * bond.to[0] + bond.to[1] * bond.to[1] + bond.to[2] * bond.to[2]))});
      }
  return body;
}

/// Speed of a standing wave over that of the continuum, less 1: along x, or along x and y together, in a lattice of n cells to a wave.
double error_of_speed(int n, double nu, bool oblique, const Vector<3>& polarisation) {
  const auto constants = ElasticConstants<3>::from_young(1.0, nu);
  const std::array<int, 3> cells{n, oblique ? n : 4, 4};
  const auto body = periodic_lattice(cells);
  const Dispersive law{.stiffness = constants.spring_modulus,
                       .dispersive_share = constants.dispersive_share};  // lambda = mu = k/l if D = 0
  const Vector<3> wave = 2.0 * std::numbers::pi / n * Vector<3>(1.0, oblique ? 1.0 : 0.0, 0.0);
  const Vector<3> direction = polarisation.normalized();
  const bool longitudinal = std::fabs(direction.dot(wave)) > 1e-9;
  const double speed =
      std::sqrt(longitudinal ? constants.first_lame_parameter + 2.0 * constants.shear_modulus : constants.shear_modulus);  // density 1
  const double frequency = speed * wave.norm(), period = 2.0 * std::numbers::pi / frequency;
  auto scene = simulation::scene<Leapfrog>(
      Box<3>{.lower = Vector<3>::Zero(), .upper = Vector<3>(cells[0], cells[1], cells[2]), .periodic = {true, true, true}},
      group<Beads>("beads", Mobile{}, body.points, 1.0), bonds<Beads, Beads>(law, body.bonds));
  constexpr double fastest = 1e-7;
  scene.group<Beads>().set<field::Velocity>([&](const Vector<3>& x) -> Vector<3> { return fastest * std::sin(wave.dot(x)) * direction; });
  const double dt = period / std::ceil(period / (0.2 * scene.step_limit().time_step));
  scene.run({.until = period, .time_step = dt});
  double displaced = 0.0, all = 0.0;
  for (std::size_t i = 0; i < body.points.positions.size(); ++i) {
    const auto& x = body.points.positions[i];
    Vector<3> u = scene.group<Beads>().positions()[i] - x;
    u = neighbours::minimum_image<3>(u, scene.engine().box());
    displaced += std::sin(wave.dot(x)) * u.dot(direction);
    all += square(std::sin(wave.dot(x)));
  }
  return std::asin(displaced / all * frequency / fastest) / (2.0 * std::numbers::pi);  // displaced = V/omega sin(omega period)
}

}  // namespace

TEST_CASE(
    "waves in a periodic lattice travel at sqrt((lambda + 2 mu)/rho) and sqrt(mu/rho), in any direction, to second order in the wave "
    "number") {
  const Vector<3> x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0), xy(1.0, 1.0, 0.0), yx(1.0, -1.0, 0.0);
  for (const double nu : {-0.5, 0.0, 0.25, 0.4, 0.49}) {
    CAPTURE(nu);
    for (const auto& [is_oblique, direction] : {std::pair{false, x}, {false, y}, {true, xy}, {true, yx}, {true, z}}) {
      const bool oblique = is_oblique;
      const Vector<3> polarisation = direction;  // a structured binding must not be captured
      CAPTURE(oblique);
      CAPTURE(polarisation.transpose());
      const double coarse = error_of_speed(12, nu, oblique, polarisation), fine = error_of_speed(24, nu, oblique, polarisation);
      const double angle = 2.0 * std::numbers::pi / 12,
                   squared = square(angle) * (oblique ? 2.0 : 1.0);  // wave number times spacing, and square
      CHECK(std::fabs(coarse) < 0.25 * squared);
      CHECK(std::fabs(4.0 * fine - coarse) / 3.0 < 0.02 * square(squared));  // without what is of second order
      if (oblique || polarisation[0] == 0.0) continue;
      // Along x the lattice has rho omega^2 l^2 = 3 mu 2 (1 - cos q) + (lambda - mu) sin^2 q, q = wave number times l: the strains of its
      // beads are central differences.
      const auto constants = ElasticConstants<3>::from_young(1.0, nu);
      const double mu = constants.shear_modulus, lambda = constants.first_lame_parameter;
      const double exact = 6.0 * mu * (1.0 - std::cos(angle)) + (lambda - mu) * square(std::sin(angle));
      CHECK(1.0 + coarse == doctest::Approx(std::sqrt(exact / (lambda + 2.0 * mu)) / angle).epsilon(1e-3));
    }
  }
}

namespace {

double energy_error(double nu, double share_of_bound, double until, double& first, double& last) {
  const auto body = block(5, 5);
  const auto law = law_for(body, nu);
  auto scene = simulation::scene<Leapfrog>(Box<3>::unbounded(), group<Beads>("beads", Mobile{}, body.points, 1.0),
                                           bonds<Beads, Beads>(law, body.bonds));
  test::RandomVectors random;
  Vector<3> mean = Vector<3>::Zero();
  auto& velocity = scene.group<Beads>().get<field::Velocity>();
  for (auto& v : velocity) v = random.vector(2e-3);
  for (const auto& v : velocity) mean += v / static_cast<double>(velocity.size());
  for (auto& v : velocity) v -= mean;
  const auto energy = [&] {
    double kinetic = 0.0;
    for (const auto& v : scene.group<Beads>().get<field::Velocity>()) kinetic += 0.5 * v.squaredNorm();
    const auto& x = scene.group<Beads>().positions();
    return kinetic + static_cast<double>(test::dispersive_energy<3>(law.stiffness, law.dispersive_share, body.bonds, {x.data(), x.size()}));
  };
  const double dt = share_of_bound * scene.step_limit().time_step, start = energy();
  double worst = 0.0;
  int looks = 0;
  first = last = 0.0;
  const double end = until * scene.step_limit().time_step;
  scene.every(end / 200.0, [&](auto&) {
    const double error = energy() / start - 1.0;
    worst = std::fmax(worst, std::fabs(error));
    (looks < 100 ? first : last) += error / 100.0;
    ++looks;
  });
  scene.run({.until = end, .time_step = dt});
  return worst;
}

}  // namespace

TEST_CASE(
    "energy of a block with dispersion over thousands of periods of its fastest motion: bounded, without drift, of second order in the "
    "step") {
  for (const double nu : {0.49, 0.45, -0.5}) {
    CAPTURE(nu);
    double first, last;
    const double coarse = energy_error(nu, 0.4, 4000.0, first, last);
    CHECK(coarse < 0.1);
    CHECK(std::fabs(last - first) < 0.05 * coarse);
    const double fine = energy_error(nu, 0.2, 1000.0, first, last);
    CHECK(coarse / fine > 3.0);
    CHECK(coarse / fine < 5.5);
  }
}

namespace {

/// Largest frequency of small motions about the present positions, from the second differences of the energy: omega dt <= 2.
template <class Scene>
double exact_bound(const Scene& scene, const Dispersive& law, const std::vector<neighbours::Bond>& bonds, double mass) {
  const auto& now = scene.template group<Beads>().positions();
  const auto size = static_cast<Eigen::Index>(3 * now.size());
  std::vector<Vector<3>> x(now.begin(), now.end());
  const auto forces = [&] {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(size);
    const auto tension = tensions<3>(law, bonds, x);
    for (std::size_t b = 0; b < bonds.size(); ++b) {
      const Vector<3> pull = tension[b] * (x[bonds[b].j] - x[bonds[b].i]).normalized();
      result.segment<3>(3 * static_cast<Eigen::Index>(bonds[b].i)) += pull;
      result.segment<3>(3 * static_cast<Eigen::Index>(bonds[b].j)) -= pull;
    }
    return result;
  };
  Eigen::MatrixXd hessian(size, size);
  constexpr double step = 0x1p-20;
  for (Eigen::Index c = 0; c < size; ++c) {
    double& coordinate = x[static_cast<std::size_t>(c / 3)][c % 3];
    const double there = coordinate;
    coordinate = there + step;
    const Eigen::VectorXd ahead = forces();
    coordinate = there - step;
    hessian.col(c) = (forces() - ahead) / (2.0 * step);
    coordinate = there;
  }
  const Eigen::MatrixXd symmetric = 0.5 * (hessian + hessian.transpose());
  return 2.0 / std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()[size - 1] / mass);
}

}  // namespace

TEST_CASE(
    "the bound of the step of dispersive bonds is below the exact one, at rest and strained by 10 %, and no shorter than that of full "
    "springs") {
  const auto cubic = block(3, 3);
  auto random_net = network(random_points<3>({.least_distance = 0.9, .most_failures = 2000},
                                             geometry::Cuboid<3>{.lower = {0.0, 0.0, 0.0}, .upper = {4.0, 4.0, 4.0}}),
                            1.73);
  measure_rest_lengths<3>(random_net.bonds, random_net.points.positions);
  test::RandomVectors random;
  for (auto& bond : random_net.bonds) bond.weight = 0.6 + random.vector(0.5)[0];
  for (const auto& body : {cubic, random_net})
    for (const double share : {-0.5, -0.3, -0.1, 0.0, 0.2, 0.7, 0.97})
      for (const double stretch : {0.9, 1.0, 1.1}) {
        CAPTURE(share);
        CAPTURE(stretch);
        const Dispersive law{.stiffness = 2.0, .dispersive_share = share};
        const auto make = [&](const auto& of_bonds) {
          auto scene = simulation::scene<Leapfrog>(Box<3>::unbounded(), group<Beads>("beads", Mobile{}, body.points, 0.5),
                                                   bonds<Beads, Beads>(of_bonds, body.bonds));
          test::RandomVectors disorder;
          for (auto& x : scene.template group<Beads>().positions()) x = stretch * x + disorder.vector(0.05);
          return scene;
        };
        auto scene = make(law);
        auto full = make(bond::Harmonic{.stiffness = 2.0});
        const double stated = scene.step_limit().time_step, exact = exact_bound(scene, law, body.bonds, 0.5);
        CHECK(stated <= exact);
        CHECK(stated > 0.3 * exact);
        if (stretch == 1.0) CHECK(stated >= 0.98 * full.step_limit().time_step);
        if (stretch == 1.0 && share < 0.0) CHECK(stated > full.step_limit().time_step);
      }
}

TEST_CASE("dispersive bonds near the limits of the Poisson ratio are stable at 0.95 of the bound of the step") {
  for (const double nu : {-0.99, -0.5, 0.4, 0.49, 0.4999}) {
    CAPTURE(nu);
    const auto body = block(5, 5);
    auto scene = simulation::scene<Leapfrog>(Box<3>::unbounded(), group<Beads>("beads", Mobile{}, body.points, 1.0),
                                             bonds<Beads, Beads>(law_for(body, nu), body.bonds));
    test::RandomVectors random;
    for (auto& v : scene.group<Beads>().get<field::Velocity>()) v = random.vector(1e-6);
    const double dt = 0.95 * scene.step_limit().time_step;
    scene.run({.until = 4999.75 * dt, .time_step = dt});
    double fastest = 0.0;
    for (const auto& v : scene.group<Beads>().get<field::Velocity>()) fastest = std::fmax(fastest, v.norm());
    CHECK(fastest < 30e-6);  // at 0.95 of its bound an oscillator reaches 3.2 times its amplitude
    CHECK(fastest > 1e-7);
  }
}

TEST_CASE(
    "B10: a cube between plates that stick to it, pressed by 10 %: it bulges at nu = 0.49 and narrows at -0.99, where the parts of the "
    "force cancel") {
  constexpr int cells = 8;
  const auto body = block(cells, cells);
  const auto& x = body.points.positions;
  std::vector<double> widenings;
  for (const double nu : {0.49, 0.25, 0.0, -0.99}) {
    CAPTURE(nu);
    const auto law = law_for(body, nu);
    std::vector<Vector<3>> positions;
    double load = 0.0;
    stretched(body, law, Driven{along_x(0.0)}, Driven{along_x(-0.1 * cells)}, 1.0, 1e-7, positions, load);
    const auto together = tensions<3>(law, body.bonds, positions);
    const auto direct =
        tensions<3>(bond::Harmonic{.stiffness = law.stiffness * (1.0 - std::fabs(law.dispersive_share))}, body.bonds, positions);
    double direct_squared = 0.0, dispersive_squared = 0.0, together_squared = 0.0, widening = 0.0, count = 0.0;
    for (std::size_t b = 0; b < direct.size(); ++b) {
      CHECK(std::isfinite(together[b]));
      const Vector<3> from_centre = 0.5 * (x[body.bonds[b].i] + x[body.bonds[b].j]) - Vector<3>::Constant(0.5 * cells);
      if (from_centre.cwiseAbs().maxCoeff() > 0.25 * cells) continue;  // near the plates, shear does not cancel
      direct_squared += square(direct[b]);
      dispersive_squared += square(together[b] - direct[b]);
      together_squared += square(together[b]);
    }
    for (std::size_t i = 0; i < x.size(); ++i)
      if (std::fabs(x[i][0] - 0.5 * cells) < 0.5 && (x[i][1] < 0.5 || x[i][1] > cells - 0.5)) {
        widening += (x[i][1] < 0.5 ? -2.0 : 2.0) * (positions[i][1] - x[i][1]) / cells;
        count += 1.0;
      }
    widenings.push_back(widening / count);
    CHECK(load < 0.0);  // the plates push
    CHECK(test::dispersive_energy<3>(law.stiffness, law.dispersive_share, body.bonds, positions) > 0.0L);
    CHECK(folded_beads<3>(body.bonds, x, positions).empty());
    if (nu == -0.99) {
      CHECK(std::sqrt(together_squared / direct_squared) < 0.2);
      CHECK(std::sqrt(dispersive_squared / direct_squared) == doctest::Approx(1.0).epsilon(0.2));
    }
    if (nu == 0.25) CHECK(dispersive_squared <= 1e-24 * direct_squared);
  }
  CHECK(widenings[0] > widenings[1]);
  CHECK(widenings[1] > 0.005);
  CHECK(std::fabs(widenings[2]) < 0.2 * widenings[1]);
  CHECK(widenings[3] < -0.03);
}
