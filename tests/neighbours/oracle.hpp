#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>
#include "support/threads.hpp"
#include <dmp/core/vector.hpp>
#include <dmp/geometry/box.hpp>

/// Points, and who is near whom by looking at every pair: what cell grids, ghosts and lists are compared with.
namespace test {

template <int Dim>
using Cloud = std::vector<dmp::Vector<Dim>>;

/// Numbers in [0, 1).
class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double operator()() { return static_cast<double>(generator_()) / 4294967296.0; }

 private:
  std::mt19937 generator_;
};

template <int Dim>
[[nodiscard]] dmp::geometry::Box<Dim> cube(double length, std::array<bool, Dim> periodic = {}) {
  return {.lower = dmp::Vector<Dim>::Constant(-0.5 * length), .upper = dmp::Vector<Dim>::Constant(0.5 * length), .periodic = periodic};
}

/// `count` points in a cube around the origin.
template <int Dim>
[[nodiscard]] Cloud<Dim> scattered(std::size_t count, double length, unsigned seed) {
  Random random(seed);
  Cloud<Dim> points(count);
  for (auto& x : points)
    for (int d = 0; d < Dim; ++d) x[d] = length * (random() - 0.5);
  return points;
}

/// Nine of ten points in two small clusters, one of them at the lower corner; most of the cube stays empty.
template <int Dim>
[[nodiscard]] Cloud<Dim> clustered(std::size_t count, double length, unsigned seed) {
  Cloud<Dim> points = scattered<Dim>(count, length, seed);
  for (std::size_t k = 0; k < count; ++k)
    if (k % 10 != 0) points[k] = 0.03 * points[k] + dmp::Vector<Dim>::Constant(length * (k % 2 == 0 ? -0.485 : 0.3));
  return points;
}

/// All lattice points of the cube: on the lower faces, and on every boundary between cells whose width divides the spacing.
template <int Dim>
[[nodiscard]] Cloud<Dim> lattice(int per_side, double length) {
  Cloud<Dim> points;
  const auto count = static_cast<std::size_t>(std::lround(std::pow(per_side, Dim)));
  for (std::size_t k = 0; k < count; ++k) {
    dmp::Vector<Dim> x;
    std::size_t rest = k;
    for (int d = 0; d < Dim; ++d, rest /= static_cast<std::size_t>(per_side))
      x[d] = -0.5 * length + length / per_side * static_cast<double>(rest % static_cast<std::size_t>(per_side));
    points.push_back(x);
  }
  return points;
}

/// A particle, or one of its images: row of the original, and how many boxes away.
template <int Dim>
using Image = std::pair<std::uint32_t, std::array<int, Dim>>;

/// Calls f(image) for the 3^Dim (where periodic) positions of particle `row` in the box and around it.
template <int Dim, class Function>
void for_each_image(std::uint32_t row, const dmp::geometry::Box<Dim>& box, const Function& f) {
  std::array<int, Dim> shift;
  for (int d = 0; d < Dim; ++d) shift[static_cast<std::size_t>(d)] = box.periodic[static_cast<std::size_t>(d)] ? -1 : 0;
  for (;;) {
    f(Image<Dim>{row, shift});
    std::size_t d = 0;
    for (; d < Dim; ++d) {
      if (box.periodic[d] && ++shift[d] <= 1) break;
      shift[d] = box.periodic[d] ? -1 : 0;
    }
    if (d == Dim) return;
  }
}

template <int Dim>
[[nodiscard]] dmp::Vector<Dim> position_of(const Image<Dim>& image, std::span<const dmp::Vector<Dim>> points,
                                           const dmp::geometry::Box<Dim>& box) {
  dmp::Vector<Dim> x = points[image.first];
  for (int d = 0; d < Dim; ++d)
    if (const int boxes = image.second[static_cast<std::size_t>(d)]; boxes != 0) x[d] += boxes * (box.upper[d] - box.lower[d]);
  return x;
}

/// Everything closer than `radius` to `x`, in order; `self` (a row, or -1) does not count, its images do.
template <int Dim>
[[nodiscard]] std::vector<Image<Dim>> all_near(const dmp::Vector<Dim>& x, double radius, std::int64_t self,
                                               std::span<const dmp::Vector<Dim>> points, const dmp::geometry::Box<Dim>& box) {
  std::vector<Image<Dim>> near;
  for (std::uint32_t row = 0; row < points.size(); ++row)
    for_each_image<Dim>(row, box, [&](const Image<Dim>& image) {
      if (image == Image<Dim>{static_cast<std::uint32_t>(self), {}} && self >= 0) return;
      if ((position_of<Dim>(image, points, box) - x).squaredNorm() < radius * radius) near.push_back(image);
    });
  std::sort(near.begin(), near.end());
  return near;
}

}  // namespace test
