#include <cstdint>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/core/field.hpp>
#include <dmp/particles/sums.hpp>

namespace field = dmp::field;
using dmp::Fields;
using dmp::particles::Sums;

namespace {

template <class View>
std::vector<double> numbers(View view) {
  std::vector<double> result;
  dmp::particles::detail::for_each_number(view, [&](int, double& number) { result.push_back(number); });
  return result;
}

/// Adds packs of whole numbers to the records, and takes the sums.
template <int Dim, class List, class Real>
void check_sums() {
  using S = Sums<Dim, List>;
  constexpr int all_lanes = dmp::native_width<Real>;
  using Lanes = dmp::Pack<Real, all_lanes>;
  using LanesView = typename S::template view<Lanes>;
  CAPTURE(Dim);
  CAPTURE(S::numbers);
  static_assert(S::stride >= S::numbers && S::stride < S::numbers + S::width && S::stride % S::width == 0);
  constexpr std::uint32_t count = 37, width = all_lanes;
  S sums;
  sums.resize(count);
  CHECK(sums.size() == count);
  sums.set_zero(0, count);
  std::vector<std::vector<double>> expected(count, std::vector<double>(S::numbers, 0.0));
  const auto add = sums.adder();
  for (std::uint32_t n = 0; n < 50; ++n) {
    std::uint32_t index[width];
    LanesView lanes{};
    for (std::uint32_t lane = 0; lane < width; ++lane) {
      index[lane] = n * lane % count;  // some twice
      if (n == 7) index[lane] = lane % 2 == 0 ? 0 : count - 1;
    }
    dmp::particles::detail::for_each_number(lanes, [&](int slot, Lanes& number) {
      number = 0.0;
      for (std::uint32_t lane = 0; lane < width; ++lane) {
        number.raw[static_cast<int>(lane)] = static_cast<Real>(1.0 + 100.0 * slot + 10.0 * lane + n);
        expected[index[lane]][static_cast<std::size_t>(slot)] += static_cast<double>(number[static_cast<int>(lane)]);
      }
    });
    add(index, lanes);
  }
  LanesView lanes{};
  std::vector<double> of_lanes;
  dmp::particles::detail::for_each_number(lanes, [&](int slot, Lanes& number) {
    number = 1.0 + slot;
    of_lanes.push_back((1.0 + slot) * width);
  });
  CHECK(numbers(S::totals(lanes)) == of_lanes);
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t n = 0; n < of_lanes.size(); ++n) expected[k][n] += of_lanes[n];
    CHECK(numbers(sums.take(k, lanes)) == expected[k]);
    CHECK(numbers(sums.take(k, lanes)) == of_lanes);  // zero since it has been taken
  }
  add(std::vector<std::uint32_t>(width, 5).data(), lanes);
  sums.set_zero(5, 6);
  CHECK(numbers(sums.take(5, lanes)) == of_lanes);
}

template <class Real>
void check_all() {
  check_sums<1, Fields<field::Force>, Real>();
  check_sums<2, Fields<field::Force>, Real>();
  check_sums<3, Fields<field::Force>, Real>();
  check_sums<1, Fields<field::Acceleration, field::DensityRate>, Real>();
  check_sums<2, Fields<field::Acceleration, field::DensityRate>, Real>();
  check_sums<3, Fields<field::Acceleration, field::DensityRate>, Real>();
  check_sums<2, Fields<field::Force, field::Acceleration, field::DensityRate>, Real>();
  check_sums<3, Fields<field::Force, field::Acceleration, field::DensityRate>, Real>();
}

}  // namespace

TEST_CASE(
    "sums: lanes are added to the records they name if these lie in the range, otherwise aside; a record is taken once; packs of double") {
  check_all<double>();
}
TEST_CASE(
    "sums: lanes are added to the records they name if these lie in the range, otherwise aside; a record is taken once; packs of float") {
  check_all<float>();
}
