#include <cstdlib>
#include <limits>
#include <string>
#include <type_traits>
#include <doctest/doctest.h>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

template <class Function>
std::string complaint(const Function& f) {
  try {
    f();
  } catch (const std::invalid_argument& error) {  // ParameterError is one: callers may catch either
    return error.what();
  }
  return {};
}
}  // namespace

TEST_CASE("an error says which rule was broken, and by which value") {
  CHECK(complaint([] { dmp::require(false, "bond::Harmonic: stiffness must be >= 0 N/m", -16.0); }) ==
        "bond::Harmonic: stiffness must be >= 0 N/m, got -16");
  CHECK(complaint([] { dmp::require(true, "anything", -16.0); }).empty());
  CHECK_THROWS_AS(dmp::require(false, "rule", 0.0), dmp::ParameterError);
}

TEST_CASE("numbers are written as short as they read back") {
  CHECK(dmp::to_text(0.1) == "0.1");
  CHECK(dmp::to_text(-16.0) == "-16");
  CHECK(dmp::to_text(1e-300) == "1e-300");
  CHECK(dmp::to_text(nan) == "nan");
  CHECK(dmp::to_text(-infinity) == "-inf");
  for (const double x : {1.0 / 3.0, 2.0 / 3.0e-7, 1.7976931348623157e308, 4.9406564584124654e-324})
    CHECK(std::strtod(dmp::to_text(x).c_str(), nullptr) == x);
}

TEST_CASE("what must be positive is neither 0, nor negative, nor infinite, nor NaN") {
  for (const double good : {4.9406564584124654e-324, 1.0, std::numeric_limits<double>::max()})
    CHECK(complaint([good] { dmp::require_positive("a: b", good, "m"); }).empty());
  CHECK(complaint([] { dmp::require_positive("a: b", 0.0, "m"); }) == "a: b must be finite and > 0 m, got 0");
  CHECK(complaint([] { dmp::require_positive("a: b", -0.5, "m"); }) == "a: b must be finite and > 0 m, got -0.5");
  CHECK(complaint([] { dmp::require_positive("a: b", infinity, "m"); }) == "a: b must be finite and > 0 m, got inf");
  CHECK(complaint([] { dmp::require_positive("a: b", nan, "m"); }) == "a: b must be finite and > 0 m, got nan");
}

TEST_CASE("what must not be negative may be 0") {
  for (const double good : {0.0, -0.0, 1.0}) CHECK(complaint([good] { dmp::require_not_negative("a: b", good, "m"); }).empty());
  CHECK(complaint([] { dmp::require_not_negative("a: b", -1e-9, "m"); }) == "a: b must be finite and >= 0 m, got -1e-09");
  CHECK(complaint([] { dmp::require_not_negative("a: b", infinity, "m"); }) == "a: b must be finite and >= 0 m, got inf");
  CHECK(complaint([] { dmp::require_not_negative("a: b", nan, "m"); }) == "a: b must be finite and >= 0 m, got nan");
}

TEST_CASE("what must be finite may have any sign") {
  for (const double good : {0.0, -1e308, 1e308}) CHECK(complaint([good] { dmp::require_finite("a: b", good, "Pa"); }).empty());
  CHECK(complaint([] { dmp::require_finite("a: b", -infinity, "Pa"); }) == "a: b must be finite [Pa], got -inf");
  CHECK(complaint([] { dmp::require_finite("a: b", nan, "Pa"); }) == "a: b must be finite [Pa], got nan");
}

TEST_CASE("a required parameter has no default, costs nothing and reads as its number") {
  static_assert(!std::is_default_constructible_v<dmp::Required<double>>);
  static_assert(sizeof(dmp::Required<double>) == sizeof(double) && std::is_trivially_copyable_v<dmp::Required<double>>);
  constexpr dmp::Required<double> radius = 2.0;
  CHECK(3.0 * radius == 6.0);
}
