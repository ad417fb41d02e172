#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <dmp/core/unrolled.hpp>

/// SIMD packs from the compilers' vector extension: the operators of double, element by element. The width follows the target that
/// the user compiles for (AVX, SSE2, NEON); where there is none it is one and the same code runs. AVX-512 brings twice the registers and
/// its instructions to packs of 32 bytes; packs of 64 make sweeps slower (docs/performance.md).
namespace dmp {

namespace detail {
#if defined(__AVX__)
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

/// Lanes of a pack that fills a register: 4, 2 or 1 doubles; twice as many floats.
template <class Real>
inline constexpr int native_width = detail::vector_bytes == 0 ? 1 : detail::vector_bytes / static_cast<int>(sizeof(Real));

/// Floats of a pack for loops that select and compress rather than compute: AVX-512 has instructions for 16 lanes of that.
#if defined(__AVX512F__) && defined(__AVX512DQ__)
inline constexpr int selecting_width = 16;
#else
inline constexpr int selecting_width = native_width<float>;
#endif

/// One truth value per lane: what comparing two packs gives, and `select` takes.
template <class Real, int Width>
struct Mask {
  using Raw __attribute__((vector_size(sizeof(Real) * Width))) = typename detail::Integer<sizeof(Real)>::type;
  using Unsigned __attribute__((vector_size(sizeof(Real) * Width))) = std::make_unsigned_t<typename detail::Integer<sizeof(Real)>::type>;
  Raw raw;
  friend Mask operator&&(Mask a, Mask b) noexcept { return {a.raw & b.raw}; }
  friend Mask operator||(Mask a, Mask b) noexcept { return {a.raw | b.raw}; }
  friend Mask operator!(Mask a) noexcept { return {~a.raw}; }
  [[nodiscard]] bool operator[](int lane) const noexcept { return raw[lane] != 0; }
  /// Bit l is lane l.
  [[nodiscard]] unsigned bits() const noexcept {
#if defined(__AVX__)
    if constexpr (sizeof(Raw) == 32 && sizeof(Real) == 8) {
      double signs __attribute__((vector_size(32)));
      __builtin_memcpy(&signs, &raw, 32);
      return static_cast<unsigned>(__builtin_ia32_movmskpd256(signs));
    }
    if constexpr (sizeof(Raw) == 32 && sizeof(Real) == 4) {
      float signs __attribute__((vector_size(32)));
      __builtin_memcpy(&signs, &raw, 32);
      return static_cast<unsigned>(__builtin_ia32_movmskps256(signs));
    }
#endif
#if defined(__AVX512DQ__)
    if constexpr (sizeof(Raw) == 64 && sizeof(Real) == 4) {
      int lanes __attribute__((vector_size(64)));
      __builtin_memcpy(&lanes, &raw, 64);
      return static_cast<unsigned>(__builtin_ia32_cvtd2mask512(lanes));
    }
#endif
    unsigned result = 0;
    for (int lane = 0; lane < Width; ++lane) result |= static_cast<unsigned>(raw[lane] != 0) << lane;
    return result;
  }
};

/// `Width` numbers that go through a law together. Mixes with double, which is spread to all lanes.
template <class Real, int Width>
struct Pack {
  using Raw __attribute__((vector_size(sizeof(Real) * Width))) = Real;
  using Rows __attribute__((vector_size(sizeof(std::uint32_t) * Width))) = std::uint32_t;  ///< row numbers, one per lane
  static constexpr int width = Width;
  Raw raw;

  Pack() noexcept = default;
  Pack(double x) noexcept : raw(static_cast<Real>(x) - Raw{}) {}
  explicit Pack(Raw given) noexcept : raw(given) {}
  [[nodiscard]] static Pack load(const Real* from) noexcept {
    Pack result;
    __builtin_memcpy(&result.raw, from, sizeof(Raw));
    return result;
  }
  /// 0, 1, 2, ...
  [[nodiscard]] static Rows lane_numbers() noexcept {
    return []<std::uint32_t... L>(std::integer_sequence<std::uint32_t, L...>) { return Rows{L...}; }
    (std::make_integer_sequence<std::uint32_t, Width>{});
  }
  [[nodiscard]] static Pack all(Real x) noexcept {  // bit by bit
    return Pack(x - Raw{});
  }
  /// a - b of packs that hold whole numbers instead: differences wrap around and are exact.
  [[nodiscard]] static Pack of_difference(Pack a, Pack b) noexcept {
    using Whole = typename Mask<Real, Width>::Raw;
    typename Mask<Real, Width>::Unsigned i, j;
    __builtin_memcpy(&i, &a.raw, sizeof(Raw));
    __builtin_memcpy(&j, &b.raw, sizeof(Raw));
    i -= j;
    Whole difference;
    __builtin_memcpy(&difference, &i, sizeof(Raw));
    return Pack(__builtin_convertvector(difference, Raw));
  }
  void store(Real* to) const noexcept { __builtin_memcpy(to, &raw, sizeof(Raw)); }
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
  friend Pack min(Pack a, Pack b) noexcept {  // one instruction where the compiler would use two
#if defined(__AVX__)
    if constexpr (sizeof(Raw) == 32 && sizeof(Real) == 8) return Pack(__builtin_ia32_minpd256(b.raw, a.raw));
    if constexpr (sizeof(Raw) == 32 && sizeof(Real) == 4) return Pack(__builtin_ia32_minps256(b.raw, a.raw));
#endif
    return Pack(b.raw < a.raw ? b.raw : a.raw);
  }
  friend Pack max(Pack a, Pack b) noexcept {
#if defined(__AVX__)
    if constexpr (sizeof(Raw) == 32 && sizeof(Real) == 8) return Pack(__builtin_ia32_maxpd256(b.raw, a.raw));
    if constexpr (sizeof(Raw) == 32 && sizeof(Real) == 4) return Pack(__builtin_ia32_maxps256(b.raw, a.raw));
#endif
    return Pack(a.raw < b.raw ? b.raw : a.raw);
  }
  friend Pack min(Pack a, double b) noexcept { return min(a, Pack(b)); }
  friend Pack max(Pack a, double b) noexcept { return max(a, Pack(b)); }
  friend Pack min(double a, Pack b) noexcept { return min(Pack(a), b); }
  friend Pack max(double a, Pack b) noexcept { return max(Pack(a), b); }

  /// The nearest whole number, for |a| < 2^50 (2^21 in single precision).
  friend Pack nearest_whole(Pack a) noexcept {
    constexpr double shift = sizeof(Real) == 8 ? 6755399441055744.0 : 12582912.0;  // 1.5 times 2^52 or 2^23: no digits after the point
    return (a + shift) - shift;
  }
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
/// Side by side, the pieces from number `first` on of every Size-th record.
template <class Real, int Width, int Size>
[[nodiscard, gnu::always_inline]] inline auto pieces(const Real* const* record, int first) noexcept {
  using Piece = typename Pack<Real, Size>::Raw;
  static_assert(Width == Size || Width == 2 * Size);
  Piece low;
  __builtin_memcpy(&low, record[0] + first, sizeof(Piece));
  if constexpr (Width == Size) {
    return low;
  } else {
    Piece high;
    __builtin_memcpy(&high, record[Size] + first, sizeof(Piece));
#if defined(__AVX__) && !defined(__clang__)  // one instruction, where GCC 12 makes two of the shuffle for AVX-512
    if constexpr (sizeof(Piece) == 16) {
      using Half __attribute__((vector_size(16))) = double;
      const auto both = __builtin_ia32_pd256_pd(__builtin_bit_cast(Half, low));
      using Raw = typename Pack<Real, Width>::Raw;
      return __builtin_bit_cast(Raw, __builtin_ia32_vinsertf128_pd256(both, __builtin_bit_cast(Half, high), 1));
    }
#endif
    return [&]<std::size_t... Lane>(std::index_sequence<Lane...>) __attribute__((always_inline)) {
      return __builtin_shufflevector(low, high, static_cast<int>(Lane)...);
    }
    (std::make_index_sequence<Width>{});
  }
}
/// In pieces of four numbers: a0 b0 a1 b1 and a2 b2 a3 b3.
template <class Raw, std::size_t... Lane>
[[gnu::always_inline]] inline void zip(Raw& a, Raw& b, std::index_sequence<Lane...>) noexcept {
  constexpr auto from = [](int lane, int half) {
    return lane % 2 * static_cast<int>(sizeof...(Lane)) + lane / 4 * 4 + half * 2 + lane % 4 / 2;
  };
  const Raw first = __builtin_shufflevector(a, b, from(static_cast<int>(Lane), 0)...);
  const Raw second = __builtin_shufflevector(a, b, from(static_cast<int>(Lane), 1)...);
  a = first;
  b = second;
}
/// Rows of pieces of `Size` numbers: number f of a piece of row r becomes number r of that piece of row f.
template <class Raw, int Size>
[[gnu::always_inline]] inline void transpose_pieces(Raw (&row)[Size]) noexcept {
  constexpr auto lanes = std::make_index_sequence<sizeof(Raw) / sizeof(std::declval<Raw&>()[0])>{};
  if constexpr (Size == 2) exchange<1>(row[0], row[1], lanes);
  if constexpr (Size == 4) {  // what single instructions do
    zip(row[0], row[1], lanes);
    zip(row[2], row[3], lanes);
    exchange<2>(row[0], row[2], lanes);
    exchange<2>(row[1], row[3], lanes);
    std::swap(row[1], row[2]);
  }
}
template <int Step, class Raw, int Width>
[[gnu::always_inline]] inline void sum_steps(Raw (&row)[Width]) noexcept {
  if constexpr (Step < Width) {
    unrolled<Width / (2 * Step)>([&](auto pair) __attribute__((always_inline)) {
      constexpr int first = 2 * Step * pair;
      exchange<Step>(row[first], row[first + Step], std::make_index_sequence<Width>{});
      row[first] += row[first + Step];
    });
    sum_steps<2 * Step>(row);
  }
}
}  // namespace detail

/// Writes the numbers of `from` whose bit is set side by side to `to`, which has room for all of them.
template <int Width, class Number>
[[gnu::always_inline]] inline void compress(typename Pack<float, Width>::Rows from, unsigned bits, Number* to) noexcept {
#if defined(__AVX512F__)
  if constexpr (Width == 16) {
    std::int32_t all __attribute__((vector_size(64)));
    __builtin_memcpy(&all, &from, 64);
    all = __builtin_ia32_compresssi512_mask(all, all, static_cast<unsigned short>(bits));
    using Numbers __attribute__((vector_size(16 * sizeof(Number)))) = Number;
    const Numbers numbers = __builtin_convertvector(all, Numbers);
    __builtin_memcpy(to, &numbers, sizeof(numbers));
    return;
  }
#endif
#if defined(__AVX2__)
  if constexpr (Width == 8) {
    static constexpr auto lanes_of = [] {
      std::array<std::array<std::int32_t, 8>, 256> result{};
      for (unsigned set = 0; set < 256; ++set)
        for (unsigned lane = 0, next = 0; lane < 8; ++lane)
          if ((set >> lane & 1u) != 0) result[set][next++] = static_cast<std::int32_t>(lane);
      return result;
    }();
    std::int32_t all __attribute__((vector_size(32))), order __attribute__((vector_size(32)));
    __builtin_memcpy(&order, lanes_of[bits].data(), 32);
    __builtin_memcpy(&all, &from, 32);
    all = __builtin_ia32_permvarsi256(all, order);
    using Numbers __attribute__((vector_size(8 * sizeof(Number)))) = Number;
    const Numbers numbers = __builtin_convertvector(all, Numbers);
    __builtin_memcpy(to, &numbers, sizeof(numbers));
    return;
  }
#endif
  for (int lane = 0; lane < Width; ++lane) {  // written in any case, kept if its bit is set
    *to = static_cast<Number>(from[lane]);
    to += bits >> lane & 1u;
  }
}

/// Loads field by field what lies record by record: out[f] lane l = base[stride * index[l] + f], f < Count. `stride` is a multiple
/// of the width: pieces of 16 bytes are put side by side and transposed among themselves, since no instruction that crosses them is cheap.
/// On AVX that is 3 to 4 times as fast as gathering numbers one by one.
template <int Count, class Real, int Width>
[[gnu::always_inline]] inline void load_transposed(const Real* base, int stride, const std::uint32_t* index,
                                                   Pack<Real, Width>* out) noexcept {
  using Raw = typename Pack<Real, Width>::Raw;
  constexpr int piece = std::min(Width, 16 / static_cast<int>(sizeof(Real)));  // numbers
  const Real* record[Width];
  unrolled<Width>([&](auto lane) __attribute__((always_inline)) {
    record[lane] = base + static_cast<std::size_t>(index[lane]) * static_cast<unsigned>(stride);
  });
  unrolled<(Count + piece - 1) / piece>([&](auto block) __attribute__((always_inline)) {
    constexpr int first = block * piece;
    Raw row[piece];
    unrolled<piece>([&](auto r) __attribute__((always_inline)) { row[r] = detail::pieces<Real, Width, piece>(record + r, first); });
    detail::transpose_pieces(row);
    unrolled<(Count - first < piece ? Count - first : piece)>([&](auto field) __attribute__((always_inline)) {
      out[first + field] = Pack<Real, Width>(row[field]);
    });
  });
}

/// The reverse, added: base[stride * index[l] + f] += in[f] lane l, f < Count, one record after the other, so that an index may stand
/// twice. Numbers that fill up the last register of a record get zeros added.
template <int Count, class Real, int Width>
[[gnu::always_inline]] inline void add_transposed(Real* base, int stride, const std::uint32_t* index,
                                                  const Pack<Real, Width>* in) noexcept {
  using Raw = typename Pack<Real, Width>::Raw;
  unrolled<(Count + Width - 1) / Width>([&](auto block) __attribute__((always_inline)) {
    constexpr int first = block * Width;
    Raw row[Width];
    unrolled<Width>([&](auto field) __attribute__((always_inline)) {
      if constexpr (first + field < Count) row[field] = in[first + field].raw;
      else row[field] = Raw{};
    });
    detail::transpose_steps<1>(row);
    unrolled<Width>([&](auto lane) __attribute__((always_inline)) {
      Real* const to = base + static_cast<std::size_t>(index[lane]) * static_cast<unsigned>(stride) + first;
      (Pack<Real, Width>::load(to) + Pack<Real, Width>(row[lane])).store(to);
    });
  });
}

/// Lane l is the sum over the lanes of rows[l]; pairs first.
template <class Real, int Width>
[[nodiscard, gnu::always_inline]] inline Pack<Real, Width> sum_across(const Pack<Real, Width> (&rows)[Width]) noexcept {
  typename Pack<Real, Width>::Raw row[Width];
  unrolled<Width>([&](auto l) __attribute__((always_inline)) { row[l] = rows[l].raw; });
  detail::sum_steps<1>(row);
  return Pack<Real, Width>(row[0]);
}

/// out[f] = sum over the lanes of in[f], f < Count.
template <int Count, class Real, int Width>
[[gnu::always_inline]] inline void sum_transposed(const Pack<Real, Width>* in, double* out) noexcept {
  unrolled<(Count + Width - 1) / Width>([&](auto block) __attribute__((always_inline)) {
    constexpr int first = block * Width;
    Pack<Real, Width> rows[Width];
    unrolled<Width>([&](auto field) __attribute__((always_inline)) {
      if constexpr (first + field < Count) rows[field] = in[first + field];
      else rows[field] = 0.0;
    });
    const auto sums = sum_across(rows);
    unrolled<(Count - first < Width ? Count - first : Width)>([&](auto field) __attribute__((always_inline)) {
      out[first + field] = static_cast<double>(sums[field]);
    });
  });
}

/// Lanes Part * Width .. of `a`, in double.
template <int Part, int Width, class Real, int All>
[[nodiscard, gnu::always_inline]] inline Pack<double, Width> part_of(Pack<Real, All> a) noexcept {
  if constexpr (All == Width && sizeof(Real) == sizeof(double)) {
    return a;
  } else {
    const auto part = [&]<std::size_t... L>(std::index_sequence<L...>) __attribute__((always_inline)) {
      return Pack<Real, Width>(__builtin_shufflevector(a.raw, a.raw, (Part * Width + static_cast<int>(L))...));
    }
    (std::make_index_sequence<Width>{});
#if defined(__AVX__) && !defined(__clang__)
    if constexpr (Width == 4) return Pack<double, 4>(__builtin_ia32_cvtps2pd256(part.raw));  // GCC 12 converts halves
#endif
    return Pack<double, Width>(__builtin_convertvector(part.raw, typename Pack<double, Width>::Raw));
  }
}

/// All lanes are lane `Lane` of `a`.
template <int Lane, class Real, int Width>
[[nodiscard, gnu::always_inline]] inline Pack<Real, Width> spread_lane(Pack<Real, Width> a) noexcept {
  return [&]<std::size_t... L>(std::index_sequence<L...>) __attribute__((always_inline)) {
    return Pack<Real, Width>(__builtin_shufflevector(a.raw, a.raw, (static_cast<void>(L), Lane)...));
  }
  (std::make_index_sequence<Width>{});
}

}  // namespace dmp
