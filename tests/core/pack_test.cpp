#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>
#include <doctest/doctest.h>
#include <dmp/core/math.hpp>
#include <dmp/core/pack.hpp>

namespace {

/// Calls f<Real, Width>() for every width up to the target's, in single and in double precision.
template <class Function>
void for_every_pack(const Function& f) {
  f.template operator()<double, 1>();
  f.template operator()<double, 2>();
  f.template operator()<double, 4>();
  f.template operator()<double, dmp::native_width<double>>();
  f.template operator()<float, 1>();
  f.template operator()<float, 4>();
  f.template operator()<float, 8>();
  f.template operator()<float, dmp::native_width<float>>();
}

/// Two packs of different numbers, every lane its own.
template <class Real, int Width>
struct Two {
  Real a[Width], b[Width];
  dmp::Pack<Real, Width> x, y;
  Two() {
    for (int lane = 0; lane < Width; ++lane) {
      a[lane] = static_cast<Real>(0.5 + 1.25 * lane);
      b[lane] = static_cast<Real>(4.0 - 1.5 * lane);
    }
    x = dmp::Pack<Real, Width>::load(a);
    y = dmp::Pack<Real, Width>::load(b);
  }
};

}  // namespace

TEST_CASE("a pack calculates in each lane what a number calculates") {
  for_every_pack([]<class Real, int Width>() {
    CAPTURE(sizeof(Real));
    CAPTURE(Width);
    static_assert(sizeof(dmp::Pack<Real, Width>) == sizeof(Real) * Width);
    static_assert(std::is_trivially_copyable_v<dmp::Pack<Real, Width>>);
    const Two<Real, Width> two;
    const auto &x = two.x, &y = two.y;
    auto plus = x, minus = x, times = x;
    plus += y;
    minus -= y;
    times *= y;
    for (int lane = 0; lane < Width; ++lane) {
      CAPTURE(lane);
      const Real a = two.a[lane], b = two.b[lane], two_r = Real(2);
      CHECK((x + y)[lane] == a + b);
      CHECK((x - y)[lane] == a - b);
      CHECK((x * y)[lane] == a * b);
      CHECK((x / y)[lane] == a / b);
      CHECK((-x)[lane] == -a);
      CHECK((2.0 + x)[lane] == two_r + a);
      CHECK((2.0 - x)[lane] == two_r - a);
      CHECK((2.0 * x)[lane] == two_r * a);
      CHECK((2.0 / x)[lane] == two_r / a);
      CHECK((x + 2.0)[lane] == a + two_r);
      CHECK((x - 2.0)[lane] == a - two_r);
      CHECK((x * 2.0)[lane] == a * two_r);
      CHECK((x / 2.0)[lane] == a / two_r);
      CHECK(plus[lane] == a + b);
      CHECK(minus[lane] == a - b);
      CHECK(times[lane] == a * b);
      CHECK(min(x, y)[lane] == (b < a ? b : a));
      CHECK(max(x, y)[lane] == (a < b ? b : a));
      CHECK(max(y, 0.0)[lane] == (b < Real(0) ? Real(0) : b));
      CHECK(min(0.0, y)[lane] == (b < Real(0) ? b : Real(0)));
      CHECK(abs(y)[lane] == (b < Real(0) ? -b : b));
      CHECK(dmp::square(y)[lane] == b * b);
    }
  });
}

TEST_CASE("a pack selects lane by lane") {
  for_every_pack([]<class Real, int Width>() {
    CAPTURE(sizeof(Real));
    CAPTURE(Width);
    const Two<Real, Width> two;
    const auto &x = two.x, &y = two.y;
    for (int lane = 0; lane < Width; ++lane) {
      CAPTURE(lane);
      const Real a = two.a[lane], b = two.b[lane];
      CHECK(select(x < y, x, y)[lane] == (a < b ? a : b));
      CHECK(select(x > 1.0, x, 0.0)[lane] == (a > Real(1) ? a : Real(0)));
      CHECK(select(x <= 0.5, 7.0, y)[lane] == (a <= Real(0.5) ? Real(7) : b));
      CHECK((x >= 0.5)[lane]);
      CHECK((x < y && x > 1.0)[lane] == (a < b && a > Real(1)));
      CHECK((x < y || x > 1.0)[lane] == (a < b || a > Real(1)));
      CHECK((!(x < y))[lane] == !(a < b));
    }
  });
}

TEST_CASE("the functions of a pack are those of a number, to rounding") {
  for_every_pack([]<class Real, int Width>() {
    CAPTURE(sizeof(Real));
    CAPTURE(Width);
    const Two<Real, Width> two;
    for (int lane = 0; lane < Width; ++lane) {
      CAPTURE(lane);
      const double a = static_cast<double>(two.a[lane]), tolerance = 4.0 * static_cast<double>(std::numeric_limits<Real>::epsilon());
      const auto close = [&](Real result, double expected) {
        return std::fabs(static_cast<double>(result) - expected) <= tolerance * (1.0 + std::fabs(expected));
      };
      CHECK(close(sqrt(two.x)[lane], std::sqrt(a)));
      CHECK(close(exp(two.x)[lane], std::exp(a)));
      CHECK(close(log(two.x)[lane], std::log(a)));
      CHECK(close(pow(two.x, 1.7)[lane], std::pow(a, 1.7)));
      CHECK(close(dmp::power(two.x, 5.0)[lane], std::pow(a, 5.0)));
    }
    CHECK(static_cast<double>(sqrt(dmp::Pack<Real, Width>(0.0))[0]) == 0.0);
  });
}

TEST_CASE("the sum over the lanes is the same every time: halves first") {
  const double values[4] = {1e16, 1.0, -1e16, 1.0};
  CHECK(sum(dmp::Pack<double, 4>::load(values)) == 2.0);  // (1e16 - 1e16) + (1 + 1); from left to right it would be 1
  CHECK(sum(dmp::Pack<float, 8>(0.5)) == 4.0);
  CHECK(sum(dmp::Pack<double, 1>(3.0)) == 3.0);
  CHECK(dmp::sum(3.0) == 3.0);
}

TEST_CASE("a transposing load brings every field of every record to its lane") {
  for_every_pack([]<class Real, int Width>() {
    CAPTURE(sizeof(Real));
    CAPTURE(Width);
    constexpr int stride = 2 * Width, records = 37, count = stride - 1;  // the last field of the record is padding
    std::vector<Real> table(static_cast<std::size_t>(stride * records));
    for (std::size_t n = 0; n < table.size(); ++n) table[n] = static_cast<Real>(n);
    std::uint32_t index[Width];
    for (int lane = 0; lane < Width; ++lane) index[lane] = static_cast<std::uint32_t>((5 + 11 * lane) % records);
    dmp::Pack<Real, Width> fields[stride];
    fields[count] = -1.0;
    dmp::load_transposed<count>(table.data(), stride, index, fields);
    for (int field = 0; field < count; ++field)
      for (int lane = 0; lane < Width; ++lane)
        CHECK(fields[field][lane] == static_cast<Real>(index[lane] * stride + static_cast<unsigned>(field)));
    CHECK(fields[count][0] == static_cast<Real>(-1));  // no field beyond the count is touched
  });
}

TEST_CASE("a transposing sum adds every field of every lane to its record, one after the other where two lanes name the same") {
  for_every_pack([]<class Real, int Width>() {
    CAPTURE(sizeof(Real));
    CAPTURE(Width);
    constexpr int stride = 2 * Width, records = 11, count = stride - 1;
    std::vector<Real> table(static_cast<std::size_t>(stride * records)), expected;
    for (std::size_t n = 0; n < table.size(); ++n) table[n] = static_cast<Real>(n);
    expected = table;
    std::uint32_t index[Width];
    for (int lane = 0; lane < Width; ++lane) index[lane] = static_cast<std::uint32_t>(lane / 2 * 3 % records);  // twice each
    dmp::Pack<Real, Width> fields[stride];
    for (int field = 0; field < count; ++field) {
      fields[field] = 0.0;
      for (int lane = 0; lane < Width; ++lane) {
        fields[field].raw[lane] = static_cast<Real>(1000 * field + lane + 1);
        expected[index[lane] * static_cast<unsigned>(stride) + static_cast<unsigned>(field)] += fields[field][lane];
      }
    }
    dmp::add_transposed<count>(table.data(), stride, index, fields);
    CHECK(table == expected);  // what no lane names, and what fills up the records, is as before
  });
}

TEST_CASE("sums across the lanes: lane l of the pack of rows, number f of the fields") {
  for_every_pack([]<class Real, int Width>() {
    CAPTURE(sizeof(Real));
    CAPTURE(Width);
    dmp::Pack<Real, Width> rows[Width];
    for (int row = 0; row < Width; ++row) {
      rows[row] = 0.0;
      for (int lane = 0; lane < Width; ++lane) rows[row].raw[lane] = static_cast<Real>(100 * row + lane * lane);
    }
    const auto across = dmp::sum_across(rows);
    for (int row = 0; row < Width; ++row) CHECK(static_cast<double>(across[row]) == sum(rows[row]));

    constexpr int count = 2 * Width + 1;
    dmp::Pack<Real, Width> fields[3 * Width];
    double totals[count + 1];
    totals[count] = -1.0;
    for (int field = 0; field < count; ++field) {
      fields[field] = 0.0;
      for (int lane = 0; lane < Width; ++lane) fields[field].raw[lane] = static_cast<Real>(7 * field + lane);
    }
    dmp::sum_transposed<count>(fields, totals);
    for (int field = 0; field < count; ++field) CHECK(totals[field] == sum(fields[field]));
    CHECK(totals[count] == -1.0);
  });
}

TEST_CASE("one lane spread to all") {
  for_every_pack([]<class Real, int Width>() {
    const Two<Real, Width> two;
    const auto first = dmp::spread_lane<0>(two.x), last = dmp::spread_lane<Width - 1>(two.x);
    for (int lane = 0; lane < Width; ++lane) {
      CHECK(first[lane] == two.a[0]);
      CHECK(last[lane] == two.a[Width - 1]);
    }
  });
}

TEST_CASE("the bits of a mask are its lanes, and a compression keeps the numbers whose bits are set, side by side") {
  for_every_pack([]<class Real, int Width>() {
    CAPTURE(sizeof(Real));
    CAPTURE(Width);
    for (unsigned bits = 0; bits < (1u << Width); bits += Width > 8 ? 37 : 1) {
      dmp::Pack<Real, Width> signs = 0.0;
      for (int lane = 0; lane < Width; ++lane) signs.raw[lane] = static_cast<Real>((bits >> lane & 1u) != 0 ? -1 : 1);
      CHECK((signs < 0.0).bits() == bits);
      CHECK((!(signs >= 0.0)).bits() == bits);
      typename dmp::Pack<Real, Width>::Rows from = dmp::Pack<Real, Width>::lane_numbers() + 100u;
      std::uint32_t to[Width + 1];
      std::vector<std::uint32_t> expected;
      for (int lane = 0; lane < Width; ++lane)
        if ((bits >> lane & 1u) != 0) expected.push_back(static_cast<std::uint32_t>(100 + lane));
      dmp::compress<Width>(from, bits, to);
      CHECK(std::vector<std::uint32_t>(to, to + expected.size()) == expected);
      std::vector<std::uint16_t> to_shorter(Width + 1);
      dmp::compress<Width>(from + 65400u, bits, to_shorter.data());  // 65 535 is the largest
      for (std::uint32_t& number : expected) number += 65400u;
      to_shorter.resize(expected.size());
      CHECK(std::vector<std::uint32_t>(to_shorter.begin(), to_shorter.end()) == expected);
    }
  });
}

TEST_CASE("the nearest whole number, halves to the even one") {
  for_every_pack([]<class Real, int Width>() {
    for (const double x : {0.0, 0.25, 0.5, 0.75, 1.5, 2.5, 1000.25, 123456.75}) {
      CHECK(static_cast<double>(nearest_whole(dmp::Pack<Real, Width>(x))[0]) == std::nearbyint(x));
      CHECK(static_cast<double>(nearest_whole(dmp::Pack<Real, Width>(-x))[Width - 1]) == std::nearbyint(-x));
    }
  });
}

TEST_CASE("smaller, larger and root of infinities and zeros are those of numbers") {
  for_every_pack([]<class Real, int Width>() {
    using Pack = dmp::Pack<Real, Width>;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    CHECK(static_cast<double>(min(Pack(infinity), 1.0)[0]) == 1.0);
    CHECK(static_cast<double>(max(Pack(-infinity), 1.0)[0]) == 1.0);
    CHECK(static_cast<double>(max(Pack(infinity), 1.0)[Width - 1]) == infinity);
    CHECK(static_cast<double>(sqrt(Pack(infinity))[0]) == infinity);
    CHECK(static_cast<double>(sqrt(Pack(4.0))[Width - 1]) == 2.0);
    // A number beside one that is not: as for doubles, the first of the two.
    CHECK(std::isnan(static_cast<double>(max(Pack(std::nan("")), 1.0)[0])) == std::isnan(dmp::max(std::nan(""), 1.0)));
    CHECK(std::isnan(static_cast<double>(max(Pack(1.0), Pack(std::nan("")))[0])) == std::isnan(dmp::max(1.0, std::nan(""))));
    CHECK(std::isnan(static_cast<double>(min(Pack(std::nan("")), 1.0)[0])) == std::isnan(dmp::min(std::nan(""), 1.0)));
    CHECK(std::isnan(static_cast<double>(min(Pack(1.0), Pack(std::nan("")))[0])) == std::isnan(dmp::min(1.0, std::nan(""))));
  });
}

TEST_CASE("packs of single precision in parts of double precision") {
  const Two<float, 8> two;
  const auto low = dmp::part_of<0, 4>(two.y), high = dmp::part_of<1, 4>(two.y);
  for (int lane = 0; lane < 4; ++lane) {
    CHECK(low[lane] == static_cast<double>(two.b[lane]));
    CHECK(high[lane] == static_cast<double>(two.b[4 + lane]));
  }
  const Two<double, 4> doubles;
  for (int lane = 0; lane < 4; ++lane) CHECK(dmp::part_of<0, 4>(doubles.x)[lane] == doubles.a[lane]);
}

TEST_CASE("differences of whole numbers that lie in packs are exact, also of large ones a little apart") {
  const auto pack_of = [](std::int32_t whole) {
    float bits;
    __builtin_memcpy(&bits, &whole, 4);
    return dmp::Pack<float, 4>::all(bits);
  };
  for (const std::int32_t a : {0, 1, -5, 1073741824, -1073741824, 16777217})
    for (const std::int32_t apart : {0, 1, -1, 4711, -8388607})
      CHECK(dmp::Pack<float, 4>::of_difference(pack_of(a + apart), pack_of(a))[2] == static_cast<float>(apart));
}
