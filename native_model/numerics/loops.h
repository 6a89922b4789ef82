// Helpers for loops over coordinates and modes that the compiler should vectorise.
#pragma once

// For functions that every step calls; their calls would take a tenth of the step of a small rotor.
#define ROTORUB_INLINE inline __attribute__((always_inline))

// Before a loop whose arrays are either identical or do not overlap.
#define ROTORUB_APART _Pragma("GCC ivdep")

namespace rotorub {

// term(0) + ... + term(n - 1), computed as four independent sums.
template <class Term>
inline double sum(int n, Term term) {
  double sums[4] = {};
  int i = 0;
  for (; i + 4 <= n; i += 4) {
    for (int k = 0; k < 4; ++k) sums[k] += term(i + k);
  }
  for (; i < n; ++i) sums[0] += term(i);
  if (n < 4) return sums[0];
  return (sums[0] + sums[2]) + (sums[1] + sums[3]);
}

}  // namespace rotorub
