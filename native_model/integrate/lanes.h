// One arithmetic for one run and for many: a kernel written for T works on double, or on Lane, a
// vector of independent runs. The same operations in the same order: a lane's bits are those of
// the run alone. Everything here is inlined into its caller, which chooses the instruction set.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#define ROTORUB_INLINE inline __attribute__((always_inline))

namespace rotorub::lanes {

inline constexpr int kWidth = 8;
inline constexpr std::size_t kBytes = 8 * kWidth;

// A vector type's own alignment follows the instruction set and is lost as a template argument: the
// structs below fix it.
typedef double RawLane __attribute__((vector_size(kBytes), aligned(kBytes)));        // NOLINT
typedef std::int64_t RawMask __attribute__((vector_size(kBytes), aligned(kBytes)));  // NOLINT

struct alignas(kBytes) LaneMask {  // all bits or none in each lane
  RawMask raw;
};
ROTORUB_INLINE LaneMask operator&(const LaneMask& a, const LaneMask& b) { return {a.raw & b.raw}; }

struct alignas(kBytes) Lane {
  RawLane raw;
  double operator[](int lane) const { return raw[lane]; }
  ROTORUB_INLINE Lane& operator+=(const Lane& b) { return raw += b.raw, *this; }
  ROTORUB_INLINE Lane& operator-=(const Lane& b) { return raw -= b.raw, *this; }
  ROTORUB_INLINE Lane& operator*=(const Lane& b) { return raw *= b.raw, *this; }
};
ROTORUB_INLINE Lane operator+(const Lane& a, const Lane& b) { return {a.raw + b.raw}; }
ROTORUB_INLINE Lane operator-(const Lane& a, const Lane& b) { return {a.raw - b.raw}; }
ROTORUB_INLINE Lane operator*(const Lane& a, const Lane& b) { return {a.raw * b.raw}; }
ROTORUB_INLINE Lane operator/(const Lane& a, const Lane& b) { return {a.raw / b.raw}; }
ROTORUB_INLINE Lane operator-(const Lane& a) { return {-a.raw}; }
ROTORUB_INLINE LaneMask operator>(const Lane& a, const Lane& b) { return {a.raw > b.raw}; }
ROTORUB_INLINE LaneMask operator<(const Lane& a, const Lane& b) { return {a.raw < b.raw}; }
ROTORUB_INLINE LaneMask operator>=(const Lane& a, const Lane& b) { return {a.raw >= b.raw}; }
ROTORUB_INLINE LaneMask operator<=(const Lane& a, const Lane& b) { return {a.raw <= b.raw}; }
ROTORUB_INLINE LaneMask operator==(const Lane& a, const Lane& b) { return {a.raw == b.raw}; }
ROTORUB_INLINE LaneMask operator!=(const Lane& a, const Lane& b) { return {a.raw != b.raw}; }

// Vectors of T at the alignment of T: the standard allocator loses a vector type's.
template <class T>
struct Allocator {
  using value_type = T;
  Allocator() = default;
  template <class U>
  Allocator(const Allocator<U>&) {}  // NOLINT: allocators convert
  T* allocate(std::size_t n) {
    return static_cast<T*>(::operator new(n * sizeof(T), std::align_val_t{8 * kWidth}));
  }
  void deallocate(T* p, std::size_t) { ::operator delete(p, std::align_val_t{8 * kWidth}); }
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
template <>
struct Traits<Lane> {
  using Mask = LaneMask;
  static constexpr int kWidth = lanes::kWidth;
};

ROTORUB_INLINE double get(const double& x, int) { return x; }
ROTORUB_INLINE double get(const Lane& x, int lane) { return x.raw[lane]; }
ROTORUB_INLINE bool get(const bool& x, int) { return x; }
ROTORUB_INLINE bool get(const LaneMask& x, int lane) { return x.raw[lane] != 0; }
ROTORUB_INLINE void set(double& x, int, double value) { x = value; }
ROTORUB_INLINE void set(Lane& x, int lane, double value) { x.raw[lane] = value; }

ROTORUB_INLINE double select(bool mask, double a, double b) { return mask ? a : b; }
ROTORUB_INLINE Lane select(const LaneMask& mask, const Lane& a, const Lane& b) {
  return {mask.raw ? a.raw : b.raw};
}

ROTORUB_INLINE bool any(bool mask) { return mask; }
ROTORUB_INLINE bool any(const LaneMask& mask) {
  // Halving keeps it in vector registers.
  typedef std::int64_t Half __attribute__((vector_size(kBytes / 2)));     // NOLINT
  typedef std::int64_t Quarter __attribute__((vector_size(kBytes / 4)));  // NOLINT
  Half half[2];
  __builtin_memcpy(half, &mask.raw, sizeof half);
  const Half both = half[0] | half[1];
  Quarter quarter[2];
  __builtin_memcpy(quarter, &both, sizeof quarter);
  const Quarter all = quarter[0] | quarter[1];
  return (all[0] | all[1]) != 0;
}

ROTORUB_INLINE double square_root(double x) { return __builtin_sqrt(x); }
ROTORUB_INLINE Lane square_root(const Lane& x) {
  Lane y;
  for (int i = 0; i < kWidth; ++i) y.raw[i] = __builtin_sqrt(x.raw[i]);
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
// The same number in every lane.
template <class T>
ROTORUB_INLINE T all(double x) {
  T y{};
  for (int i = 0; i < Traits<T>::kWidth; ++i) set(y, i, x);
  return y;
}

}  // namespace rotorub::lanes
