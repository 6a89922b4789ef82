// Products with small dense matrices that stand column by column, as the fixed steps have them:
// sums over a row wait for each addition, sums of columns go on side by side. Compiled for each
// instruction set; each sum goes from the first column to the last, so the bits are the same from
// all of them.
#pragma once

#include <span>

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

}  // namespace rotorub::small_matrix
