#include <cstdint>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/core/field.hpp>
#include <dmp/particles/records.hpp>

namespace field = dmp::field;
using dmp::Fields;
using dmp::particles::Records;

namespace {

/// Different numbers in every slot of every record.
template <class View>
View filled(std::size_t index) {
  View view{};
  int slot = 0;
  dmp::particles::detail::for_each_number(view, [&](int, double& number) { number = 100.0 * static_cast<double>(index) + ++slot; });
  return view;
}

template <class View>
std::vector<double> numbers(View view) {
  std::vector<double> result;
  dmp::particles::detail::for_each_number(view, [&](int, double& number) { result.push_back(number); });
  return result;
}
template <class View>
std::vector<double> numbers_of_lane(View view, int lane) {
  std::vector<double> result;
  dmp::particles::detail::for_each_number(view, [&](int, auto& number) { result.push_back(number[lane]); });
  return result;
}

template <int Dim, class List>
void check_round_trip() {
  using R = Records<Dim, List>;
  using View = typename R::template view<double>;
  CAPTURE(Dim);
  CAPTURE(R::numbers);
  static_assert(R::stride >= R::numbers && R::stride < R::numbers + R::width && R::stride % R::width == 0);  // whole registers, no more
  static_assert(R::bytes_per_particle() == sizeof(double) * R::stride);

  constexpr std::size_t count = 61;
  R records;
  CHECK(records.size() == 0);
  records.resize(count);
  CHECK(records.size() == count);
  for (std::size_t k = 0; k < count; ++k) {
    View view = filled<View>(k);
    records.store(k, view);
  }
  for (std::size_t k = 0; k < count; ++k) CHECK(numbers(records.load(k)) == numbers(filled<View>(k)));

  using Lanes = dmp::Pack<double, R::width>;
  for (std::uint32_t start = 0; start < count; start += 5) {
    std::uint32_t index[R::width];
    for (std::uint32_t lane = 0; lane < R::width; ++lane)
      index[lane] = static_cast<std::uint32_t>((start + 17 * lane * lane) % count);                           // any order, repetitions
    index[R::width - 1] = count - 1;                                                                          // the very last record
    const auto gathered = records.gather(index);
    const auto spread = records.template spread<Lanes>(index[0]);
    for (int lane = 0; lane < R::width; ++lane) {
      CHECK(numbers_of_lane(gathered, lane) == numbers(filled<View>(index[lane])));
      CHECK(numbers_of_lane(spread, lane) == numbers(filled<View>(index[0])));
    }
  }
}

}  // namespace

TEST_CASE("what is stored in a record is loaded, spread and gathered again: 1 to 10 numbers in 1D, 2D and 3D") {
  check_round_trip<1, Fields<field::Position>>();
  check_round_trip<1, Fields<field::Position, field::Velocity, field::Density>>();
  check_round_trip<2, Fields<field::Position>>();
  check_round_trip<2, Fields<field::Position, field::Velocity>>();
  check_round_trip<2, Fields<field::Density, field::Position, field::PressureTerm>>();
  check_round_trip<3, Fields<field::Position>>();
  check_round_trip<3, Fields<field::Position, field::Density>>();
  check_round_trip<3, Fields<field::Position, field::Velocity, field::Density, field::PressureTerm>>();
  check_round_trip<3, Fields<field::Position, field::Velocity, field::Density, field::PressureTerm, field::DynamicViscosity>>();
  check_round_trip<
      3, Fields<field::Position, field::Velocity, field::Density, field::PressureTerm, field::DynamicViscosity, field::SpecificEnergy>>();
}

TEST_CASE("the record of a weakly compressible fluid in space is one cache line") {
  using Fluid = Records<3, Fields<field::Position, field::Velocity, field::Density, field::PressureTerm>>;
  CHECK(Fluid::bytes_per_particle() == 64);
}

TEST_CASE("a law sees in a gathered record the fields by their names") {
  using R = Records<2, Fields<field::Position, field::Velocity, field::Density>>;
  R records;
  records.resize(3);
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = static_cast<double>(k);
    R::view<double> view{};
    view.position = {x, 10.0 + x};
    view.velocity = {20.0 + x, 30.0 + x};
    view.density = 40.0 + x;
    records.store(k, view);
  }
  std::uint32_t index[R::width];
  for (int lane = 0; lane < R::width; ++lane) index[lane] = static_cast<std::uint32_t>(2 - lane % 3);
  const auto seen = records.gather(index);
  for (int lane = 0; lane < R::width; ++lane) {
    const double x = index[lane];
    CHECK(seen.position[0][lane] == x);
    CHECK(seen.position[1][lane] == 10.0 + x);
    CHECK(seen.velocity[0][lane] == 20.0 + x);
    CHECK(seen.velocity[1][lane] == 30.0 + x);
    CHECK(seen.density[lane] == 40.0 + x);
  }
}
