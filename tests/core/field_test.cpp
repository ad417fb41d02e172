#include <string>
#include <type_traits>
#include <doctest/doctest.h>
#include <dmp/core/field.hpp>

namespace field = dmp::field;
using dmp::Fields;

namespace test {
/// A field that a user's law brings along.
struct Damage {
  static constexpr std::string_view name = "damage", unit = "-";
  static constexpr bool is_vector = false;
  template <int Dim, class T>
  struct Slot {
    T damage;
  };
  static constexpr auto& of(auto& slots) { return slots.damage; }
};
}  // namespace test
using test::Damage;

TEST_CASE("a union of field sets has each field once, in order of appearance") {
  using A = Fields<field::Density, field::PressureTerm>;
  using B = Fields<field::PressureTerm, field::DynamicViscosity, field::Density>;
  static_assert(std::is_same_v<dmp::unite<A, B>, Fields<field::Density, field::PressureTerm, field::DynamicViscosity>>);
  static_assert(std::is_same_v<dmp::unite<Fields<>, A, Fields<>, A>, A>);
  static_assert(std::is_same_v<dmp::unite<>, Fields<>>);
  static_assert(std::is_same_v<dmp::unite<Fields<field::Mass, field::Mass>>, Fields<field::Mass>>);
  CHECK(dmp::unite<A, B>::count == 3);
}

TEST_CASE("a difference of field sets keeps what the second lacks") {
  using A = Fields<field::Density, field::PressureTerm, field::Velocity>;
  static_assert(std::is_same_v<dmp::subtract<A, Fields<field::PressureTerm, field::Mass>>, Fields<field::Density, field::Velocity>>);
  static_assert(std::is_same_v<dmp::subtract<A, A>, Fields<>>);
  static_assert(std::is_same_v<dmp::subtract<A, Fields<>>, A>);
  static_assert(dmp::contains<field::Velocity, A> && !dmp::contains<field::Mass, A>);
  CHECK(dmp::subtract<A, Fields<field::Velocity>>::count == 2);
}

TEST_CASE("a view holds the numbers of its fields and not a byte more") {
  static_assert(sizeof(dmp::View<3, double, Fields<field::Position, field::Density>>) == 4 * sizeof(double));
  static_assert(sizeof(dmp::View<2, float, Fields<field::Position, field::Velocity, Damage>>) == 5 * sizeof(float));
  static_assert(std::is_empty_v<dmp::View<3, double, Fields<>>>);
  dmp::View<2, double, Fields<field::Velocity, Damage>> view{};
  view.velocity = {3.0, 4.0};
  view.damage = 0.25;
  CHECK(dot(view.velocity, view.velocity) == 25.0);
  CHECK(Damage::of(view) == 0.25);
  field::Velocity::of(view)[0] = 5.0;
  CHECK(view.velocity[0] == 5.0);
}

TEST_CASE("fields are visited in order, each with its name and unit") {
  std::string text;
  dmp::for_each_field(Fields<field::Density, Damage, field::Force>{},
                      [&](auto f) { text += std::string(f.name) + " [" + std::string(f.unit) + "] "; });
  CHECK(text == "density [kg/m^3] damage [-] force [N] ");
}

TEST_CASE("the rate of a field names what it integrates") {
  static_assert(std::is_same_v<field::DensityRate::integrates, field::Density>);
  CHECK(std::string(field::DensityRate::unit) == std::string(field::Density::unit) + "/s");
}

TEST_CASE("components add, subtract, scale and multiply like vectors") {
  const dmp::Components<3, double> a{1.0, 2.0, 3.0}, b{4.0, -5.0, 6.0};
  CHECK(dot(a, b) == 12.0);
  const auto c = 2.0 * a - b, d = a + b;
  CHECK(c[0] == -2.0);
  CHECK(c[1] == 9.0);
  CHECK(c[2] == 0.0);
  CHECK(d[1] == -3.0);
  CHECK(dot(dmp::Components<1, double>{3.0}, dmp::Components<1, double>{-2.0}) == -6.0);
}
