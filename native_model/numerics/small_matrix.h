// Products with small dense matrices that stand column by column, as the fixed steps have them:
// sums over a row wait for each addition, sums of columns go on side by side. Of one run compiled
// for each instruction set, of runs side by side inlined; each sum from the first column to the
// last, so the same bits from all of them.
#pragma once

#include <span>

#include "native_model/numerics/lanes.h"

namespace rotorub::small_matrix {

// out = A in; `in` and `out` apart.
void multiply(const double* columns, int rows, int count, const double* in, double* out);
// out += factor (A in).
void add_multiple(double factor, const double* columns, int rows, int count, const double* in,
                  double* out);

// out = factor times a sum of columns, each with its weight; plus `start`, unless null. rows: a
// multiple of 8.
struct WeightedColumn {
  int column;
  double weight;
};
void combine(const double* columns, int rows, std::span<const WeightedColumn> sum, double factor,
             const double* start, double* out);

// Rows [i, i + kRows) of A in.
template <int kRows, class T>
ROTORUB_INLINE void rows_of_product(const T* columns, int rows, int count, const T* in, T* sums) {
  for (int k = 0; k < kRows; ++k) sums[k] = T{};
  for (int j = 0; j < count; ++j) {
    const T* column = columns + j * rows;
    for (int k = 0; k < kRows; ++k) sums[k] += column[k] * in[j];
  }
}
// store(i, sum) for each row.
template <class T, class Store>
ROTORUB_INLINE void each_row(const T* columns, int rows, int count, const T* in, Store store) {
  constexpr int kBlock = 8;
  T sums[kBlock];
  int i = 0;
  for (; i + kBlock <= rows; i += kBlock) {
    rows_of_product<kBlock>(columns + i, rows, count, in, sums);
    for (int k = 0; k < kBlock; ++k) store(i + k, sums[k]);
  }
  for (; i + 2 <= rows; i += 2) {
    rows_of_product<2>(columns + i, rows, count, in, sums);
    for (int k = 0; k < 2; ++k) store(i + k, sums[k]);
  }
  for (; i < rows; ++i) {
    rows_of_product<1>(columns + i, rows, count, in, sums);
    store(i, sums[0]);
  }
}

template <int W>
ROTORUB_INLINE void multiply(const lanes::Lane<W>* columns, int rows, int count,
                             const lanes::Lane<W>* in, lanes::Lane<W>* out) {
  each_row(columns, rows, count, in, [&](int i, const lanes::Lane<W>& sum) { out[i] = sum; });
}
template <int W>
ROTORUB_INLINE void add_multiple(const lanes::Lane<W>& factor, const lanes::Lane<W>* columns,
                                 int rows, int count, const lanes::Lane<W>* in,
                                 lanes::Lane<W>* out) {
  each_row(columns, rows, count, in,
           [&](int i, const lanes::Lane<W>& sum) { out[i] += factor * sum; });
}

}  // namespace rotorub::small_matrix
