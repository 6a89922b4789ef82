// One arithmetic for one run and for many: what is written for a scalar T works on double, or on
// Lane<W>, W independent runs in the vector registers of one core. The same operations in the same
// order: a lane's bits are those of the run alone. Everything here is inlined into its caller,
// whose translation unit chooses the instruction set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#define ROTORUB_INLINE inline __attribute__((always_inline))
// Rare, and done run by run: a function of its own, for any processor.
#define ROTORUB_SLOW __attribute__((noinline, cold))

// Before a loop whose arrays overlap element by element or not at all.
#define ROTORUB_APART _Pragma("GCC ivdep")

namespace rotorub::lanes {

// GCC's vectors of W doubles. Their own alignment is lost as a template argument: the structs below
// fix it.
template <int W>
struct Raw;
#define ROTORUB_RAW(W)                                                             \
  template <>                                                                      \
  struct Raw<W> {                                                                  \
    typedef double Value __attribute__((vector_size(8 * W), aligned(8 * W)));      \
    typedef std::int64_t Mask __attribute__((vector_size(8 * W), aligned(8 * W))); \
  }
ROTORUB_RAW(2);
ROTORUB_RAW(4);
ROTORUB_RAW(8);
#undef ROTORUB_RAW

template <int W>
struct alignas(8 * W) LaneMask {  // all bits or none in each lane
  typename Raw<W>::Mask raw;
  friend ROTORUB_INLINE LaneMask operator&(const LaneMask& a, const LaneMask& b) {
    return {a.raw & b.raw};
  }
  friend ROTORUB_INLINE LaneMask operator|(const LaneMask& a, const LaneMask& b) {
    return {a.raw | b.raw};
  }
  friend ROTORUB_INLINE LaneMask operator!(const LaneMask& a) { return {~a.raw}; }
};

template <int W>
struct alignas(8 * W) Lane {
  typename Raw<W>::Value raw;
  double operator[](int lane) const { return raw[lane]; }
  ROTORUB_INLINE Lane& operator+=(const Lane& b) { return raw += b.raw, *this; }
  ROTORUB_INLINE Lane& operator-=(const Lane& b) { return raw -= b.raw, *this; }
  ROTORUB_INLINE Lane& operator*=(const Lane& b) { return raw *= b.raw, *this; }
#define ROTORUB_OPERATOR(op) \
  friend ROTORUB_INLINE Lane operator op(const Lane& a, const Lane& b) { return {a.raw op b.raw}; }
  ROTORUB_OPERATOR(+)
  ROTORUB_OPERATOR(-)
  ROTORUB_OPERATOR(*)
  ROTORUB_OPERATOR(/)
#undef ROTORUB_OPERATOR
#define ROTORUB_COMPARISON(op)                                                  \
  friend ROTORUB_INLINE LaneMask<W> operator op(const Lane& a, const Lane& b) { \
    return {a.raw op b.raw};                                                    \
  }
  ROTORUB_COMPARISON(>)
  ROTORUB_COMPARISON(<)
  ROTORUB_COMPARISON(>=)
  ROTORUB_COMPARISON(<=)
  ROTORUB_COMPARISON(==)
  ROTORUB_COMPARISON(!=)
#undef ROTORUB_COMPARISON
  friend ROTORUB_INLINE Lane operator-(const Lane& a) { return {-a.raw}; }
};

// Vectors of T at the alignment of T: the standard allocator loses a vector type's.
template <class T>
struct Allocator {
  using value_type = T;
  Allocator() = default;
  template <class U>
  Allocator(const Allocator<U>&) {}  // NOLINT: allocators convert
  T* allocate(std::size_t n) {
    return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{64}));
  }
  void deallocate(T* p, std::size_t) { ::operator delete (p, std::align_val_t{64}); }
  bool operator==(const Allocator&) const { return true; }
};
template <class T>
using Array = std::vector<T, Allocator<T>>;

template <class T>
struct Traits;
template <>
struct Traits<double> {
  using Mask = bool;
  static constexpr int kWidth = 1;
};
template <int W>
struct Traits<Lane<W>> {
  using Mask = LaneMask<W>;
  static constexpr int kWidth = W;
};
template <class T>
using Mask = typename Traits<T>::Mask;
template <class T>
inline constexpr int kWidth = Traits<T>::kWidth;

ROTORUB_INLINE double get(const double& x, int) { return x; }
ROTORUB_INLINE bool get(const bool& x, int) { return x; }
ROTORUB_INLINE void set(double& x, int, double value) { x = value; }
template <int W>
ROTORUB_INLINE double get(const Lane<W>& x, int lane) {
  return x.raw[lane];
}
template <int W>
ROTORUB_INLINE bool get(const LaneMask<W>& x, int lane) {
  return x.raw[lane] != 0;
}
template <int W>
ROTORUB_INLINE void set(Lane<W>& x, int lane, double value) {
  x.raw[lane] = value;
}

ROTORUB_INLINE double select(bool mask, double a, double b) { return mask ? a : b; }
template <int W>
ROTORUB_INLINE Lane<W> select(const LaneMask<W>& mask, const Lane<W>& a, const Lane<W>& b) {
  return {mask.raw ? a.raw : b.raw};
}

ROTORUB_INLINE bool any(bool mask) { return mask; }
template <int W>
ROTORUB_INLINE bool any(const LaneMask<W>& mask) {
  std::int64_t all = 0;
  if constexpr (W == 8) {
    // Halving keeps it in vector registers.
    Raw<4>::Mask half[2];
    __builtin_memcpy(half, &mask.raw, sizeof half);
    return any(LaneMask<4>{half[0] | half[1]});
  } else if constexpr (W == 4) {
    Raw<2>::Mask half[2];
    __builtin_memcpy(half, &mask.raw, sizeof half);
    return any(LaneMask<2>{half[0] | half[1]});
  } else {
    for (int i = 0; i < W; ++i) all |= mask.raw[i];
  }
  return all != 0;
}

ROTORUB_INLINE double square_root(double x) { return __builtin_sqrt(x); }
template <int W>
ROTORUB_INLINE Lane<W> square_root(const Lane<W>& x) {
  Lane<W> y;
  for (int i = 0; i < W; ++i) y.raw[i] = __builtin_sqrt(x.raw[i]);
  return y;
}

template <class T>
ROTORUB_INLINE T larger(const T& a, const T& b) {
  return select(a > b, a, b);
}
template <class T>
ROTORUB_INLINE T magnitude(const T& a) {
  return select(a < T{}, -a, a);
}
// term(0) + ... + term(n - 1) in four sums, none of which waits for another.
template <class T, class Term>
ROTORUB_INLINE T sum(int n, Term term) {
  T sums[4] = {};
  int i = 0;
  for (; i + 4 <= n; i += 4) {
    for (int k = 0; k < 4; ++k) sums[k] += term(i + k);
  }
  for (; i < n; ++i) sums[0] += term(i);
  if (n < 4) return sums[0];
  return (sums[0] + sums[2]) + (sums[1] + sums[3]);
}
// The same number in every lane.
template <class T>
ROTORUB_INLINE T all(double x) {
  T y{};
  for (int i = 0; i < kWidth<T>; ++i) set(y, i, x);
  return y;
}

}  // namespace rotorub::lanes
