// A thousand random scenes of eight kinds, parameters over many decades, some of them senseless: each keeps its particles, finite values
// and, where nothing acts from outside, its momentum; or it stops with an error that says who, what and how much.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <type_traits>
#include <vector>
#include <doctest/doctest.h>

#include "io/temporary_folder.hpp"
#include "scenes.hpp"

using namespace test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(), epsilon = std::numeric_limits<double>::epsilon();

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : generator_(seed) {}
  [[nodiscard]] double between(double low, double high) { return low + (high - low) * static_cast<double>(generator_() >> 11) * 0x1p-53; }
  [[nodiscard]] bool one_in(std::uint64_t n) { return generator_() % n == 0; }
  template <class T>
  [[nodiscard]] T one_of(const std::vector<T>& values) {
    return values[generator_() % values.size()];
  }
  /// A parameter of about this size, over `decades` either way; one in sixty is what no sane user gives.
  [[nodiscard]] double about(double size, double decades) {
    if (one_in(60)) return one_of<double>({0.0, -1.0, infinity, -infinity, std::nan(""), 1e-300, 1e300});
    return size * std::pow(10.0, between(-decades, decades));
  }
  template <int Dim>
  [[nodiscard]] Vector<Dim> vector(double size) {
    Vector<Dim> result;
    for (int d = 0; d < Dim; ++d) result[d] = between(-size, size);
    return result;
  }

 private:
  std::mt19937_64 generator_;
};

/// A cube at the origin, and how its places are drawn.
template <int Dim>
struct Cube {
  Dice& dice;
  double side = dice.one_of<double>({1e-6, 1.0, 1e6}) * dice.between(0.5, 2.0);
  geometry::Box<Dim> box = random_box();

  geometry::Box<Dim> random_box() {
    geometry::Box<Dim> result = geometry::Box<Dim>::unbounded();
    for (int d = 0; d < Dim; ++d) {
      if (dice.one_in(3)) continue;
      result.lower[d] = 0.0;
      result.upper[d] = dice.about(side, 0.0);
      result.periodic[static_cast<std::size_t>(d)] = !dice.one_in(4);
    }
    return result;
  }
  /// No, one, two or up to a hundred particles on a lattice from `low` to `high` (shares of the side), shaken, or anywhere.
  geometry::Points<Dim> points(double low = 0.0, double high = 1.0) {
    const auto count = dice.one_in(40) ? 0.0 : dice.one_of<double>({1.0, 2.0, 7.0, 30.0, 50.0, 100.0});
    const int per_side = std::max(1, static_cast<int>(std::floor(std::pow(count, 1.0 / Dim) + 1e-9)));
    const double spacing = (high - low) * side / per_side, shake = dice.one_of<double>({0.001, 0.01, 0.1, 1.0, 10.0});
    geometry::Points<Dim> result{.positions = {}, .spacing = shake > 0.2 || per_side < 4 ? 0.0 : spacing, .volume = std::pow(spacing, Dim)};
    for (int k = 0; k < std::min(static_cast<int>(count), static_cast<int>(std::pow(per_side, Dim) + 0.5)); ++k) {
      Vector<Dim> x;
      for (int d = 0, rest = k; d < Dim; ++d, rest /= per_side) x[d] = low * side + (rest % per_side + 0.5) * spacing;
      x += dice.vector<Dim>(shake * spacing);
      result.positions.push_back(x.cwiseMax(low * side).cwiseMin(high * side * (1.0 - 1e-9)));
    }
    return result;
  }
  [[nodiscard]] double support_radius(const geometry::Points<Dim>& points) {
    const double radius = std::pow(points.volume, 1.0 / Dim) * dice.between(1.2, 3.0);
    return dice.about(dice.one_in(10) ? radius : std::min(radius, 0.4 * side), 0.0);
  }
  /// Bonds to a few of the next rows, each with a chance; now and then one that cannot be.
  std::vector<neighbours::Bond> bonds(const geometry::Points<Dim>& points) {
    std::vector<neighbours::Bond> result;
    const auto count = static_cast<std::uint32_t>(points.positions.size());
    for (std::uint32_t i = 0; i < count; ++i)
      for (std::uint32_t j = i + 1; j < std::min(count, i + 4); ++j)
        if (dice.one_in(2)) result.push_back({.i = i, .j = j, .rest_length = dice.one_in(2) ? -1.0 : dice.between(0.0, 0.4) * side});
    if (box.periodic != std::array<bool, Dim>{} && !dice.one_in(10))  // as long as periodic bonds may be
      std::erase_if(result, [&](const auto& bond) {
        return (points.positions[bond.i] - points.positions[bond.j]).cwiseAbs().maxCoeff() > 0.4 * side;
      });
    if (dice.one_in(40)) result.push_back({.i = 0, .j = count});
    return result;
  }
};

/// Momentum, and what it may change by: every sum of n terms is off by n epsilon of their sizes.
template <int Dim>
struct Momentum {
  Vector<Dim> sum = Vector<Dim>::Zero();
  double size = 0.0, force = 0.0;  // sum of m |v| and of m |a|
  double particles = 0.0;

  template <class Scene>
  explicit Momentum(Scene& scene) {
    scene.engine().for_each_group([this](auto& g) {
      using G = std::remove_cvref_t<decltype(g)>;
      if constexpr (particles::is_mobile<typename G::Mobility>)
        for (std::size_t i = 0; i < g.size(); ++i) {
          sum += g.mass * g.template get<field::Velocity>()[i];
          size += g.mass * g.template get<field::Velocity>()[i].norm();
          force += g.mass * g.template get<field::Acceleration>()[i].norm();
          if constexpr (dmp::contains<FastAcceleration, typename G::Layout::columns>)
            force += g.mass * g.template get<FastAcceleration>()[i].norm();
          particles += 1.0;
        }
    });
  }
};

struct Tally {
  int ran = 0, refused = 0, stopped = 0;
};

struct Enough {};  // steps have been seen

/// Sets velocities, spoils something now and then, runs, and looks at what came of it.
template <class Scene>
void check_run(Scene scene, Dice& dice, bool keeps_momentum, double speed, Tally& tally) {
  constexpr int Dim = Scene::dimension;
  std::vector<std::vector<std::uint32_t>> ids;
  scene.engine().for_each_group([&](auto& g) {
    using G = std::remove_cvref_t<decltype(g)>;
    if constexpr (particles::is_mobile<typename G::Mobility>)
      for (auto& v : g.template get<field::Velocity>()) v = dice.vector<Dim>(speed);
    if (dice.one_in(60)) g.positions()[0] = dice.vector<Dim>(dice.one_of<double>({1e300, infinity, std::nan("")}));
    if (dice.one_in(60)) g.positions()[0] = g.positions()[g.size() - 1];
    ids.push_back(g.id);
  });

  if (dice.one_in(4)) scene.set_skin(dice.one_of<double>({0.0, 1e-3, 0.5}) * scene.engine().longest_cutoff());
  RunOptions options{.until = infinity, .check_every = dice.one_of<std::uint64_t>({1, 3, 100})};
  const double bound = scene.step_limit().stable_time_step;
  const bool given = dice.one_in(2) || (!(bound < infinity) && !dice.one_in(10));
  if (given) options.time_step = bound < infinity ? dice.between(0.1, 1.02) * bound : dice.about(1e-3, 3.0);
  const Momentum<Dim> before(scene);
  double size = before.size, force = before.force, steps = 0.0;
  const auto look = [&] {
    const Momentum<Dim> now(scene);
    size = std::max(size, now.size);
    force = std::max(force, now.force);
  };
  const double start = scene.time();
  if (given) {
    for (; steps < 40.0; steps += 5.0) {
      options.until = scene.time() + 5.0 * options.time_step;
      scene.run(options);
      look();
    }
  } else {
    options.until = std::min(100.0 * bound, 1e300);
    options.check_every = 1;
    scene.every(1e-300, [&](auto&) {
      look();
      if (++steps > 40.0) throw Enough{};
    });
    try {
      scene.run(options);
    } catch (const Enough&) {
    }
  }
  ++tally.ran;

  CHECK(find_fault(scene.engine()).what.empty());
  std::size_t group = 0;
  scene.engine().for_each_group([&](auto& g) {
    auto id = g.id;
    std::sort(id.begin(), id.end());
    CHECK(id == ids[group]);
    CHECK(g.positions().size() == ids[group++].size());
  });
  if (!keeps_momentum) return;
  // Forces are read between the steps: they may have been larger in the middle of one, and their terms larger than their sum.
  constexpr double hidden = 10.0;
  const double allowed = epsilon * before.particles * (4.0 * steps * size + hidden * force * (scene.time() - start));
  CHECK((Momentum<Dim>(scene).sum - before.sum).norm() <= allowed);
}

// ---- The kinds of scenes.

template <int Dim, class Integrator>
void liquid(Dice& dice, Tally& tally) {
  using Law = sph::WeaklyCompressible<kernel::WendlandC2<Dim>, viscosity::Morris<>>;
  Cube<Dim> cube{dice};
  const auto points = cube.points();
  const double density = dice.about(1000.0, 3.0), sound = dice.about(10.0, 3.0);
  check_run(scene<Integrator>(cube.box, group<Water>("water", Mobile{}, points, density * std::max(points.volume, 1e-30)),
                              interaction<Water, Water>(Law{.kernel = {.support_radius = cube.support_radius(points)}}),
                              material<Water>(eos::Tait{.rest_density = density, .sound_speed_0 = sound},
                                              rheology::Constant{.dynamic_viscosity = dice.about(1e-3, 6.0)})),
            dice, true, dice.about(0.03 * sound, 1.5), tally);
}

void liquid_in_walls(Dice& dice, Tally& tally) {
  using Law = sph::WeaklyCompressible<kernel::Lucy<2>, viscosity::Artificial>;
  Cube<2> cube{dice};
  const auto points = cube.points(0.25, 1.0), wall = cube.points(0.0, 0.25);
  const double density = dice.about(1.0, 3.0), sound = dice.about(10.0, 3.0);
  const Law law{.kernel = {.support_radius = cube.support_radius(points)},
                .viscosity = {.alpha = dice.about(0.1, 2.0), .sound_speed = sound}};
  check_run(scene<integrator::ExtrapolatedVerlet>(
                cube.box, group<Water>("water", Mobile{}, points, density * std::max(points.volume, 1e-30)),
                group<Wall>("wall", Frozen<2>{}, wall, density * std::max(wall.volume, 1e-30)), interaction<Water, Water>(law),
                interaction<Water, Wall>(law), material<Water, Wall>(eos::Tait{.rest_density = density, .sound_speed_0 = sound}),
                forced_by<Water>(forcing::Constant<2>{.uniform_acceleration = {{{0.0, -dice.about(9.81, 3.0)}}}})),
            dice, false, dice.about(0.03 * sound, 1.5), tally);
}

template <int Dim, class Integrator, class Law>
void springs(const Law& law, Dice& dice, Tally& tally) {
  Cube<Dim> cube{dice};
  const auto points = cube.points();
  const double speed = dice.about(0.01 * cube.side, 4.0);
  check_run(scene<Integrator>(cube.box, group<Solid>("solid", Mobile{}, points, dice.about(1e-3, 6.0)),
                              bonds<Solid, Solid>(law, cube.bonds(points))),
            dice, true, speed, tally);
}

void body_in_liquid(Dice& dice, Tally& tally) {
  using Law = sph::WeaklyCompressible<kernel::WendlandC2<2>, viscosity::Morris<>>;
  Cube<2> cube{dice};
  const auto points = cube.points(0.0, 0.5), body = cube.points(0.5, 1.0);
  const double density = dice.about(1.0, 3.0), sound = dice.about(10.0, 3.0);
  const Law law{.kernel = {.support_radius = std::max(cube.support_radius(points), cube.support_radius(body))}};
  const double stiffness = dice.about(density * sound * sound, 4.0);  // as stiff as the liquid
  check_run(scene<integrator::ExtrapolatedVerlet>(
                cube.box, group<Water>("water", Mobile{}, points, density * std::max(points.volume, 1e-30)),
                group<Solid>("body", Mobile{}, body, density * std::max(body.volume, 1e-30)), interaction<Water, Water>(law),
                interaction<Water, Solid>(law), substepped_bonds<Solid, Solid>(bond::Harmonic{.stiffness = stiffness}, cube.bonds(body)),
                material<Water, Solid>(eos::Tait{.rest_density = density, .sound_speed_0 = sound},
                                       rheology::Constant{.dynamic_viscosity = dice.about(1e-3, 4.0)})),
            dice, true, dice.about(0.03 * sound, 1.5), tally);
}

void molecules(Dice& dice, Tally& tally) {
  Cube<3> cube{dice};
  auto points = cube.points();
  points.spacing = 0.0;
  const double diameter = dice.about(0.2 * cube.side, 0.5), energy = dice.about(1.0, 8.0);
  const double drag = dice.one_in(2) ? 0.0 : dice.about(1.0, 6.0);
  check_run(scene<integrator::Leapfrog>(cube.box, group<Solid>("molecules", Mobile{}, points, dice.about(1e-3, 6.0)),
                                        interaction<Solid, Solid>(potential::LennardJones{
                                            .energy_scale = energy, .diameter = diameter, .cutoff = dice.between(1.0, 2.5) * diameter}),
                                        forced_by<Solid>(forcing::Drag{.coefficient = drag})),
            dice, drag == 0.0, dice.about(0.01 * cube.side, 4.0), tally);
}

void warm_plate(Dice& dice, Tally& tally) {
  Cube<2> cube{dice};
  const auto points = cube.points();
  auto plate = scene<integrator::LammpsVerlet>(
      cube.box, group<Solid>("plate", Stationary{}, points, dice.about(1.0, 6.0)),
      interaction<Solid, Solid>(sph::HeatConduction<kernel::Lucy<2>>{.kernel = {.support_radius = cube.support_radius(points)}}),
      material<Solid>(eos::ConstantDensity{.density = dice.about(1.0, 4.0)},
                      thermal::Linear{.specific_heat_capacity = dice.about(1.0, 6.0)},
                      thermal::Conductivity{.thermal_conductivity = dice.about(1.0, 6.0)}));
  for (double& energy : plate.template group<Solid>().template get<field::SpecificEnergy>()) energy = dice.between(100.0, 1000.0);
  check_run(std::move(plate), dice, true, 0.0, tally);
}

constexpr int kinds = 8;
void make_and_run(int kind, Dice& dice, Tally& tally) {
  switch (kind) {
    case 0: return liquid<2, integrator::ExtrapolatedVerlet>(dice, tally);
    case 1: return liquid<3, integrator::LammpsVerlet>(dice, tally);
    case 2: return liquid_in_walls(dice, tally);
    case 3: return springs<2, integrator::Leapfrog>(bond::Harmonic{.stiffness = dice.about(1.0, 12.0)}, dice, tally);
    case 4:
      return springs<3, integrator::SymplecticEuler>(
          bond::KelvinVoigt{.stiffness = dice.about(1.0, 12.0), .damping = dice.about(1e-3, 6.0)}, dice, tally);
    case 5: return body_in_liquid(dice, tally);
    case 6: return molecules(dice, tally);
    default: return warm_plate(dice, tally);
  }
}

}  // namespace

TEST_CASE("1000 random scenes keep particles, finite values and momentum, or stop with an error that says who, what and how much") {
  Tally tally;
  for (int number = 0; number < 1000; ++number) {
    CAPTURE(number);
    Dice dice(static_cast<std::uint64_t>(number));
    try {
      make_and_run(number % kinds, dice, tally);
    } catch (const ParameterError& error) {
      ++tally.refused;
      const std::string text = error.what();
      CHECK((test::contains(text, ", got ") || test::contains(text, "; give one as time_step")));
    } catch (const SimulationError& error) {
      ++tally.stopped;
      CHECK((error.where.particle >= 0 || test::contains(error.what(), "time step")));
    }
  }
  CHECK(tally.ran >= 400);                      // the scenes are not all nonsense,
  CHECK(tally.refused + tally.stopped >= 100);  // nor all tame
}
