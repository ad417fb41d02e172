#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <dmp/core/components.hpp>
#include <dmp/core/pack.hpp>
#include <dmp/core/vector.hpp>

/// In which numbers pair laws are evaluated. State, integration and sums over more than one particle's list are always double.
namespace dmp::precision {

/// Records in double; positions in metres.
struct Double {
  using Real = double;
  static constexpr std::string_view name = "double";
  static constexpr bool pairs_once = true;  ///< pairs of a block are evaluated once for both particles

  template <int Dim>
  struct Frame {
    Frame() = default;
    Frame(const Vector<Dim>&, double) noexcept {}
    [[nodiscard]] double write(double x, int) const noexcept { return x; }
    [[nodiscard]] double read(double x, int) const noexcept { return x; }
    template <class T>
    [[nodiscard, gnu::always_inline]] Components<Dim, T> separation(const Components<Dim, T>& i,
                                                                    const Components<Dim, T>& j) const noexcept {
      return -(j - i);  // processors subtract what lies in memory, and that is i: one load less than i - j
    }
  };
};

/// Records in single precision, half the memory and twice the lanes. Positions are whole numbers of 2^-30 of a frame somewhat more than
/// twice as long as the scene, so that the separation of neighbours does not depend on where they are: its error is 2^-24 of itself, and
/// 2^-30 of the frame. A particle far outside of all others makes the frame long and the rest coarse. Laws get about seven digits; what
/// that means for a flow, examples/taylor_green tells.
struct Single {
  using Real = float;
  static constexpr std::string_view name = "single";
  static constexpr bool pairs_once = false;  ///< adding to the other particle in double takes longer than to evaluate a pair twice

  template <int Dim>
  struct Frame {
    Vector<Dim> centre = Vector<Dim>::Zero();
    double per_metre = 1.0, metres = 1.0;

    Frame() = default;
    /// `extent` [m]: no two particles are farther apart along an axis.
    Frame(const Vector<Dim>& centre_, double extent) noexcept : centre(centre_), per_metre(0x1p30 / extent), metres(extent / 0x1p30) {}
    [[nodiscard]] float write(double x, int d) const noexcept {
      const double steps = std::fmin((x - centre[d]) * per_metre, 0x1.8p30);  // what is far away lies beyond all particles
      return std::bit_cast<float>(static_cast<std::int32_t>(std::lrint(steps)));
    }
    [[nodiscard]] double read(float x, int d) const noexcept {
      return centre[d] + metres * static_cast<double>(std::bit_cast<std::int32_t>(x));
    }
    template <class T>
    [[nodiscard, gnu::always_inline]] Components<Dim, T> separation(const Components<Dim, T>& i,
                                                                    const Components<Dim, T>& j) const noexcept {
      Components<Dim, T> result;
      unrolled<Dim>([&](auto d) __attribute__((always_inline)) { result[d] = T::of_difference(i[d], j[d]) * T(metres); });
      return result;
    }
  };
};

}  // namespace dmp::precision
