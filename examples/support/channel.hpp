#pragma once
#include <algorithm>
#include <cmath>
#include <vector>
#include <dmp/core/field.hpp>
#include <dmp/core/math.hpp>
#include <dmp/geometry.hpp>

namespace example {

/// A plane channel, periodic along x, between two plates of three rows of particles each whose first row lies on the plane of the wall.
struct Channel {
  double gap;                        ///< H [m], between the planes y = 0 and y = H
  int rows;                          ///< spacings across
  double support_in_spacings = 2.6;  ///< at most 4: the plates are no thicker

  static constexpr double columns = 10.0;
  [[nodiscard]] double spacing() const { return gap / rows; }
  [[nodiscard]] double support_radius() const { return support_in_spacings * spacing(); }
  [[nodiscard]] dmp::geometry::Box<2> box() const {
    return {.lower = {0.0, -3.0 * spacing()}, .upper = {columns * spacing(), gap + 3.0 * spacing()}, .periodic = {true, false}};
  }
  [[nodiscard]] dmp::geometry::Points<2> fluid() const { return layer(spacing(), gap - spacing()); }
  [[nodiscard]] dmp::geometry::Points<2> lower_plate() const { return layer(-2.0 * spacing(), 0.0); }
  [[nodiscard]] dmp::geometry::Points<2> upper_plate() const { return layer(gap, gap + 2.0 * spacing()); }

 private:
  [[nodiscard]] dmp::geometry::Points<2> layer(double first, double last) const {  // rows from y = first to y = last
    return dmp::geometry::fill(
        dmp::geometry::Cubic<2>{.spacing = spacing(), .origin = {0.0, 0.5 * spacing()}},
        dmp::geometry::Cuboid<2>{.lower = {0.0, first - 0.25 * spacing()}, .upper = {columns * spacing(), last + 0.25 * spacing()}});
  }
};

/// How far the velocity along x is from an exact profile u(y).
struct ProfileError {
  double l2;     ///< root mean square difference over that of the exact profile
  double shape;  ///< the same after scaling the exact profile to fit best
  double scale;  ///< that scale: measured/exact
};

template <class Group, class Exact>
[[nodiscard]] ProfileError profile_error(const Group& fluid, const Exact& exact) {
  double difference = 0.0, exact_squared = 0.0, measured_squared = 0.0, product = 0.0;
  for (std::size_t i = 0; i < fluid.size(); ++i) {
    const double u = fluid.template get<dmp::field::Velocity>()[i][0], right = exact(fluid.positions()[i][1]);
    difference += dmp::square(u - right);
    exact_squared += dmp::square(right);
    measured_squared += dmp::square(u);
    product += u * right;
  }
  return {std::sqrt(difference / exact_squared), std::sqrt(std::max(0.0, 1.0 - dmp::square(product) / (measured_squared * exact_squared))),
          product / exact_squared};
}

}  // namespace example
