#include <algorithm>
#include <numeric>
#include <random>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/core/field.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/particles/columns.hpp>

namespace field = dmp::field;
using dmp::Fields;
using dmp::Vector;
using dmp::particles::Columns;

static_assert(Columns<2, Fields<>>::bytes_per_particle == 0);
static_assert(Columns<2, Fields<field::Position, field::Density>>::bytes_per_particle == 24);  // two components and a number, no z
static_assert(Columns<3, Fields<field::Position, field::Velocity, field::Density>>::bytes_per_particle == 56);

TEST_CASE_TEMPLATE("new rows are zero, and growing keeps the old ones", Dimension, std::integral_constant<int, 1>,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int dim = Dimension::value;
  Columns<dim, Fields<field::Position, field::Density>> columns;
  columns.resize(2);
  columns.template get<field::Position>()[1] = Vector<dim>::Constant(3.0);
  columns.template get<field::Density>()[1] = 5.0;
  columns.resize(400);
  for (std::size_t k = 0; k < 400; ++k) {
    CHECK(columns.template get<field::Position>()[k] == Vector<dim>::Constant(k == 1 ? 3.0 : 0.0));
    CHECK(columns.template get<field::Density>()[k] == (k == 1 ? 5.0 : 0.0));
  }
}

TEST_CASE("sorting moves whole particles: every column by the same order, there and back") {
  constexpr std::size_t count = 1000;
  Columns<3, Fields<field::Position, field::Density, field::Velocity, field::SpecificEnergy>> columns;
  columns.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double x = static_cast<double>(k);
    columns.get<field::Position>()[k] = {x, -x, 0.5 * x};
    columns.get<field::Velocity>()[k] = {2.0 * x, 3.0 * x, 4.0 * x};
    columns.get<field::Density>()[k] = 1000.0 + x;
    columns.get<field::SpecificEnergy>()[k] = 1.0 / (1.0 + x);
  }
  std::vector<std::uint32_t> order(count), back(count);
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937(7));
  for (std::uint32_t k = 0; k < count; ++k) back[order[k]] = k;

  const auto holds = [&columns](std::size_t row, double x) {
    return columns.get<field::Position>()[row] == Vector<3>(x, -x, 0.5 * x) &&
           columns.get<field::Velocity>()[row] == Vector<3>(2.0 * x, 3.0 * x, 4.0 * x) &&
           columns.get<field::Density>()[row] == 1000.0 + x && columns.get<field::SpecificEnergy>()[row] == 1.0 / (1.0 + x);
  };
  std::vector<double> scratch(3 * count);
  columns.permute(order, dmp::Ranges(count, 100), scratch.data());
  std::size_t right = 0;
  for (std::size_t k = 0; k < count; ++k) right += holds(k, order[k]);
  CHECK(right == count);
  columns.permute(back, dmp::Ranges(count), scratch.data());
  right = 0;
  for (std::size_t k = 0; k < count; ++k) right += holds(k, static_cast<double>(k));
  CHECK(right == count);
}

TEST_CASE("sorting nobody, or one particle, changes nothing") {
  Columns<1, Fields<field::Position>> columns;
  double scratch = 0.0;
  columns.permute({}, dmp::Ranges(0), &scratch);
  CHECK(columns.get<field::Position>().empty());
  columns.resize(1);
  columns.get<field::Position>()[0][0] = 2.0;
  const std::uint32_t order[] = {0};
  columns.permute(order, dmp::Ranges(1), &scratch);
  CHECK(columns.get<field::Position>()[0][0] == 2.0);
}
