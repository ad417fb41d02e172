#include <cmath>
#include <cstdint>
#include <doctest/doctest.h>
#include <dmp/core/field.hpp>
#include <dmp/particles/records.hpp>

namespace field = dmp::field;
using dmp::Fields;
using dmp::Vector;
using dmp::particles::Records;

namespace {

/// Largest errors of separations, as a fraction of their length, over pairs a `length` apart anywhere in an extent of 1000 m; and of
/// positions [m] and other numbers [-] read back.
template <class Precision, int Dim>
struct Errors {
  double separation = 0.0, position = 0.0, density = 0.0;

  explicit Errors(double length) {
    using R = Records<Dim, Fields<field::Position, field::Density>, Precision>;
    using Lanes = typename R::Lanes;
    R records;
    records.set_frame(typename R::Frame(Vector<Dim>::Constant(300.0), 1000.0));
    records.resize(2);
    for (int n = 0; n < 200; ++n) {
      typename R::template view<double> view[2];
      Vector<Dim> x[2];
      for (int d = 0; d < Dim; ++d) {
        x[0][d] = 300.0 + 490.0 * std::sin(12.9898 * n + 78.233 * d);
        x[1][d] = x[0][d] + length * std::cos(3.7 * n + 1.3 * d);
      }
      for (std::uint32_t k = 0; k < 2; ++k) {
        view[k].position = dmp::to_components<Dim>(x[k]);
        view[k].density = 1000.0 + 0.1 * n;
        records.store(k, view[k]);
        const auto back = records.load(k);
        for (int d = 0; d < Dim; ++d) position = std::fmax(position, std::fabs(back.position[d] - x[k][d]));
        density = std::fmax(density, std::fabs(back.density / view[k].density - 1.0));
      }
      std::uint32_t index[R::width];
      for (int lane = 0; lane < R::width; ++lane) index[lane] = static_cast<std::uint32_t>(lane % 2);
      const auto i = records.template spread<Lanes>(0);
      const auto apart = records.reader().separation(i.position, records.gather(index).position);
      for (int lane = 0; lane < R::width; ++lane)
        for (int d = 0; d < Dim; ++d) {
          const double exact = lane % 2 == 0 ? 0.0 : x[0][d] - x[1][d];
          separation = std::fmax(separation, std::fabs(static_cast<double>(apart[d][lane]) - exact) / length);
        }
    }
  }
};

}  // namespace

TEST_CASE("double precision: positions and other numbers come back bit for bit") {
  const Errors<dmp::precision::Double, 2> errors(0.1);
  CHECK(errors.position == 0.0);
  CHECK(errors.density == 0.0);
  CHECK(errors.separation == 0.0);
}

TEST_CASE_TEMPLATE("single precision: positions to 2^-31 of the extent wherever they are, other numbers to 2^-24", Dimension,
                   std::integral_constant<int, 1>, std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  for (const double length : {0.01, 1.0, 100.0}) {
    const Errors<dmp::precision::Single, Dimension::value> errors(length);
    CHECK(errors.position <= 1000.0 * 0x1p-31 * 1.001);
    CHECK(errors.density <= 0x1p-24);
    CHECK(errors.separation * length <= 2.0 * 1000.0 * 0x1p-31 + 2.0 * 0x1p-24 * length);
  }
}

TEST_CASE("single precision: what lies far away stays beyond all particles, on the far side") {
  using R = Records<2, Fields<field::Position>, dmp::precision::Single>;
  R records;
  records.set_frame(R::Frame(Vector<2>(5.0, -7.0), 100.0));
  records.resize(2);
  R::view<double> here{}, away{};
  here.position = {54.9, 42.9};
  away.position = {1e30, 1e30};
  records.store(0, here);
  records.store(1, away);
  for (int d = 0; d < 2; ++d) CHECK(records.load(1).position[d] > records.load(0).position[d] + 50.0);
}
