// Sine and cosine together, of one number or of lanes: the same bits in each, which a library's own
// functions are not for vectors. Within 1.5 units in the last place of the larger of the two.
#pragma once

#include "native_model/numerics/lanes.h"

namespace rotorub {

namespace sine_cosine_parts {

// Up to here the reduction is exact to 1e-16 rad.
inline constexpr double kFarthest = 1e6;  // rad

// pi/2 in three parts; the first two have 33 bits, so that their products with k are exact.
inline constexpr double kFirst = 0x1.921fb544p+0;
inline constexpr double kSecond = 0x1.0b4611a6p-34;
inline constexpr double kThird = 0x1.3198a2e037073p-69;

// Taylor's series in r^2 to the terms that are below round-off at |r| = pi/4.
inline constexpr double kSine[] = {-1.0 / 6.0,          1.0 / 120.0,         -1.0 / 5040.0,
                                   1.0 / 362880.0,      -1.0 / 39916800.0,   1.0 / 6227020800.0,
                                   -1.0 / 1307674368e3, 1.0 / 355687428096e3};
inline constexpr double kCosine[] = {1.0 / 24.0,         -1.0 / 720.0,      1.0 / 40320.0,
                                     -1.0 / 3628800.0,   1.0 / 479001600.0, -1.0 / 87178291200.0,
                                     1.0 / 20922789888e3};
// Even and odd powers in two sums, neither of which waits for the other.
template <class T, int kTerms>
ROTORUB_INLINE T series(const double (&c)[kTerms], const T& x) {
  const T square = x * x;
  T sums[2] = {lanes::all<T>(c[kTerms - 1]), lanes::all<T>(c[kTerms - 2])};
#pragma GCC unroll 8
  for (int i = kTerms - 3; i >= 0; --i) {
    T& sum = sums[(kTerms - 1 - i) % 2];
    sum = sum * square + lanes::all<T>(c[i]);
  }
  constexpr int kEven = (kTerms - 1) % 2;
  return sums[kEven] + x * sums[1 - kEven];
}
template <class T>
ROTORUB_INLINE T nearest_integer(const T& x) {
  const T shift = lanes::all<T>(0x1.8p52);  // of |x| < 2^51
  return (x + shift) - shift;
}
// In the lanes that are beyond kFarthest.
template <class T>
ROTORUB_SLOW void of_far_angles(const T& angle, T& sine, T& cosine);

}  // namespace sine_cosine_parts

// angle: rad, any size. `sine`, `cosine` apart from it.
template <class T>
ROTORUB_INLINE void sine_cosine(const T& angle, T& sine, T& cosine) {
  using namespace sine_cosine_parts;
  const auto all = [](double x) { return lanes::all<T>(x); };
  const T one = all(1.0), half = all(0.5);
  const T k = nearest_integer(angle * all(0x1.45f306dc9c883p-1));
  const T r = ((angle - k * all(kFirst)) - k * all(kSecond)) - k * all(kThird);
  const T x = r * r;
  const T s = r + r * (x * series(kSine, x));
  const T c = (one - half * x) + (x * x) * series(kCosine, x);
  // k mod 4 over 4: 0, 1/4, +-1/2, -1/4.
  const T quarters = k * all(0.25), turn = quarters - nearest_integer(quarters);
  const T size = lanes::magnitude(turn);
  const auto swaps = size == all(0.25);
  const T sine_size = lanes::select(swaps, c, s), cosine_size = lanes::select(swaps, s, c);
  sine = lanes::select((size == half) | (turn == all(-0.25)), -sine_size, sine_size);
  cosine = lanes::select((size == half) | (turn == all(0.25)), -cosine_size, cosine_size);
  const auto far = lanes::magnitude(angle) > all(kFarthest);
  if (lanes::any(far)) of_far_angles(angle, sine, cosine);
}

}  // namespace rotorub
