#pragma once
#include <cmath>
#include <cstdint>
#include <utility>
#include <dmp/core/unrolled.hpp>

/// SIMD packs from the compilers' vector extension: the operators of double, element by element. The width follows the target that
/// the user compiles for (AVX-512, AVX, SSE2, NEON); where there is none it is one and the same code runs.
namespace dmp {

namespace detail {
#if defined(__AVX512F__)
inline constexpr int vector_bytes = 64;
#elif defined(__AVX__)
inline constexpr int vector_bytes = 32;
#elif defined(__SSE2__) || defined(__ARM_NEON)
inline constexpr int vector_bytes = 16;
#else
inline constexpr int vector_bytes = 0;
#endif
template <int Bytes>
struct Integer;
template <>
struct Integer<8> {
  using type = std::int64_t;
};
template <>
struct Integer<4> {
  using type = std::int32_t;
};
}  // namespace detail

/// Lanes of the target's widest vector register: 8, 4, 2 or 1 doubles; twice as many floats.
template <class Real>
inline constexpr int native_width = detail::vector_bytes == 0 ? 1 : detail::vector_bytes / static_cast<int>(sizeof(Real));

/// One truth value per lane: what comparing two packs gives, and `select` takes.
template <class Real, int Width>
struct Mask {
  using Raw __attribute__((vector_size(sizeof(Real) * Width))) = typename detail::Integer<sizeof(Real)>::type;
  Raw raw;
  friend Mask operator&&(Mask a, Mask b) noexcept { return {a.raw & b.raw}; }
  friend Mask operator||(Mask a, Mask b) noexcept { return {a.raw | b.raw}; }
  friend Mask operator!(Mask a) noexcept { return {~a.raw}; }
  [[nodiscard]] bool operator[](int lane) const noexcept { return raw[lane] != 0; }
};

/// `Width` numbers that go through a law together. Mixes with double, which is spread to all lanes.
template <class Real, int Width>
struct Pack {
  using Raw __attribute__((vector_size(sizeof(Real) * Width))) = Real;
  static constexpr int width = Width;
  Raw raw;

  Pack() noexcept = default;
  Pack(double x) noexcept : raw(Raw{} + static_cast<Real>(x)) {}
  explicit Pack(Raw given) noexcept : raw(given) {}
  [[nodiscard]] static Pack load(const Real* from) noexcept {
    Pack result;
    __builtin_memcpy(&result.raw, from, sizeof(Raw));
    return result;
  }
  [[nodiscard]] Real operator[](int lane) const noexcept { return raw[lane]; }

  [[gnu::always_inline]] friend Pack operator+(Pack a, Pack b) noexcept { return Pack(a.raw + b.raw); }
  [[gnu::always_inline]] friend Pack operator-(Pack a, Pack b) noexcept { return Pack(a.raw - b.raw); }
  [[gnu::always_inline]] friend Pack operator*(Pack a, Pack b) noexcept { return Pack(a.raw * b.raw); }
  [[gnu::always_inline]] friend Pack operator/(Pack a, Pack b) noexcept { return Pack(a.raw / b.raw); }
  [[gnu::always_inline]] friend Pack operator+(Pack a, double b) noexcept { return a + Pack(b); }
  [[gnu::always_inline]] friend Pack operator-(Pack a, double b) noexcept { return a - Pack(b); }
  [[gnu::always_inline]] friend Pack operator*(Pack a, double b) noexcept { return a * Pack(b); }
  [[gnu::always_inline]] friend Pack operator/(Pack a, double b) noexcept { return a / Pack(b); }
  [[gnu::always_inline]] friend Pack operator+(double a, Pack b) noexcept { return Pack(a) + b; }
  [[gnu::always_inline]] friend Pack operator-(double a, Pack b) noexcept { return Pack(a) - b; }
  [[gnu::always_inline]] friend Pack operator*(double a, Pack b) noexcept { return Pack(a) * b; }
  [[gnu::always_inline]] friend Pack operator/(double a, Pack b) noexcept { return Pack(a) / b; }
  [[gnu::always_inline]] friend Pack operator-(Pack a) noexcept { return Pack(-a.raw); }
  Pack& operator+=(Pack b) noexcept { return *this = *this + b; }
  Pack& operator-=(Pack b) noexcept { return *this = *this - b; }
  Pack& operator*=(Pack b) noexcept { return *this = *this * b; }

  friend Mask<Real, Width> operator<(Pack a, Pack b) noexcept { return {a.raw < b.raw}; }
  friend Mask<Real, Width> operator>(Pack a, Pack b) noexcept { return {a.raw > b.raw}; }
  friend Mask<Real, Width> operator<=(Pack a, Pack b) noexcept { return {a.raw <= b.raw}; }
  friend Mask<Real, Width> operator>=(Pack a, Pack b) noexcept { return {a.raw >= b.raw}; }
  friend Mask<Real, Width> operator<(Pack a, double b) noexcept { return a < Pack(b); }
  friend Mask<Real, Width> operator>(Pack a, double b) noexcept { return a > Pack(b); }
  friend Mask<Real, Width> operator<=(Pack a, double b) noexcept { return a <= Pack(b); }
  friend Mask<Real, Width> operator>=(Pack a, double b) noexcept { return a >= Pack(b); }

  friend Pack select(Mask<Real, Width> mask, Pack yes, Pack no) noexcept { return Pack(mask.raw ? yes.raw : no.raw); }
  friend Pack select(Mask<Real, Width> mask, Pack yes, double no) noexcept { return select(mask, yes, Pack(no)); }
  friend Pack select(Mask<Real, Width> mask, double yes, Pack no) noexcept { return select(mask, Pack(yes), no); }
  friend Pack min(Pack a, Pack b) noexcept { return Pack(b.raw < a.raw ? b.raw : a.raw); }
  friend Pack max(Pack a, Pack b) noexcept { return Pack(a.raw < b.raw ? b.raw : a.raw); }
  friend Pack min(Pack a, double b) noexcept { return min(a, Pack(b)); }
  friend Pack max(Pack a, double b) noexcept { return max(a, Pack(b)); }
  friend Pack min(double a, Pack b) noexcept { return min(Pack(a), b); }
  friend Pack max(double a, Pack b) noexcept { return max(Pack(a), b); }

  friend Pack abs(Pack a) noexcept { return max(a, -a); }
  friend Pack exp(Pack a) noexcept {
    return a.each([](Real x) { return std::exp(x); });
  }
  friend Pack log(Pack a) noexcept {
    return a.each([](Real x) { return std::log(x); });
  }
  friend Pack pow(Pack a, double n) noexcept {
    return a.each([n](Real x) { return std::pow(x, static_cast<Real>(n)); });
  }
  friend Pack sqrt(Pack a) noexcept {
#if defined(__AVX__)
    if constexpr (sizeof(Raw) == 32 && sizeof(Real) == 8) return Pack(__builtin_ia32_sqrtpd256(a.raw));
    if constexpr (sizeof(Raw) == 32 && sizeof(Real) == 4) return Pack(__builtin_ia32_sqrtps256(a.raw));
#endif
#if defined(__SSE2__)
    if constexpr (sizeof(Raw) == 16 && sizeof(Real) == 8) return Pack(__builtin_ia32_sqrtpd(a.raw));
    if constexpr (sizeof(Raw) == 16 && sizeof(Real) == 4) return Pack(__builtin_ia32_sqrtps(a.raw));
#endif
    return a.each([](Real x) { return std::sqrt(x); });
  }
  /// Sum over the lanes, halves first: the same order on every machine of one width.
  friend double sum(Pack a) noexcept {
    double part[Width];
    for (int lane = 0; lane < Width; ++lane) part[lane] = static_cast<double>(a.raw[lane]);
    for (int half = Width / 2; half > 0; half /= 2)
      for (int lane = 0; lane < half; ++lane) part[lane] += part[lane + half];
    return part[0];
  }

 private:
  template <class Function>
  Pack each(Function function) const noexcept {
    Pack result;
    for (int lane = 0; lane < Width; ++lane) result.raw[lane] = function(raw[lane]);
    return result;
  }
};

[[nodiscard]] inline double sum(double x) noexcept { return x; }

namespace detail {
template <int Step, class Raw, std::size_t... Lane>
[[gnu::always_inline]] inline void exchange(Raw& a, Raw& b, std::index_sequence<Lane...>) noexcept {
  constexpr int width = sizeof...(Lane);
  constexpr auto low = [](int lane) { return (lane & Step) == 0 ? lane : width + lane - Step; };
  constexpr auto high = [](int lane) { return (lane & Step) == 0 ? lane + Step : width + lane; };
  const Raw first = __builtin_shufflevector(a, b, low(static_cast<int>(Lane))...);
  const Raw second = __builtin_shufflevector(a, b, high(static_cast<int>(Lane))...);
  a = first;
  b = second;
}
template <int Step, class Raw, int Width>
[[gnu::always_inline]] inline void transpose_steps(Raw (&row)[Width]) noexcept {
  if constexpr (Step < Width) {
    unrolled<Width>([&](auto first) __attribute__((always_inline)) {
      if constexpr ((first & Step) == 0) exchange<Step>(row[first], row[first + Step], std::make_index_sequence<Width>{});
    });
    transpose_steps<2 * Step>(row);
  }
}
}  // namespace detail

/// Loads field by field what lies record by record: out[f] lane l = base[stride * index[l] + f], f < Count. `stride` is a multiple
/// of the width: whole registers are loaded and transposed, which on AVX is 3 to 4 times as fast as gathering numbers one by one.
template <int Count, class Real, int Width>
[[gnu::always_inline]] inline void load_transposed(const Real* base, int stride, const std::uint32_t* index, Pack<Real, Width>* out) noexcept {
  using Raw = typename Pack<Real, Width>::Raw;
  const Real* record[Width];
  unrolled<Width>([&](auto lane) __attribute__((always_inline)) {
    record[lane] = base + static_cast<std::size_t>(index[lane]) * static_cast<unsigned>(stride);
  });
  unrolled<(Count + Width - 1) / Width>([&](auto block) __attribute__((always_inline)) {
    constexpr int first = block * Width;
    Raw row[Width];
    unrolled<Width>([&](auto lane) __attribute__((always_inline)) { __builtin_memcpy(&row[lane], record[lane] + first, sizeof(Raw)); });
    detail::transpose_steps<1>(row);
    unrolled<(Count - first < Width ? Count - first : Width)>(
        [&](auto field) __attribute__((always_inline)) { out[first + field] = Pack<Real, Width>(row[field]); });
  });
}

}  // namespace dmp
