#include <doctest/doctest.h>
#include <dmp/core/values.hpp>
#include <string>
#include <type_traits>
#include <utility>

using dmp::Values;

namespace {
struct Fixed {  // can neither be copied nor moved
  explicit Fixed(int value) : number(value) {}
  Fixed(const Fixed&) = delete;
  int number;
};
}  // namespace

TEST_CASE("Values are made in place and found by their number") {
  Values<Fixed, std::string> values{{Fixed(3)}, {"four"}};
  CHECK(values.get<0>().number == 3);
  values.get<1>() += "teen";
  CHECK(std::as_const(values).get<1>() == "fourteen");
  CHECK(Values<>::count == 0);
  CHECK(Values<int, int>::count == 2);
}

TEST_CASE("Values are visited in their order, each as what it is, two of one type too") {
  Values<int, double, int> values{{1}, {0.5}, {2}};
  std::string seen;
  values.for_each([&seen]<class T>(T& value) {
    value += 1;
    seen += std::is_same_v<T, int> ? "i" : "d";
  });
  CHECK(seen == "idi");
  CHECK(values.apply([](int a, double b, int c) { return a + b + c; }) == 2 + 1.5 + 3);
}

TEST_CASE("Rows of values follow each other, references remain what they refer to") {
  int a = 1;
  const auto all = Values<>{} + Values<int&>{{a}} + Values<char, bool>{{'b'}, {true}};
  a = 7;
  CHECK(all.apply([](int first, char second, bool third) { return first == 7 && second == 'b' && third; }));
}
