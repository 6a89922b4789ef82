// Products with small dense matrices stored by columns, as the fixed-step integrators need them. A
// sum along a row would wait for each addition, but sums of columns run in parallel. The functions
// are compiled for each instruction set. Each sum runs from the first column to the last, so that
// all of them give the same bits.
#pragma once

#include <span>

namespace rotorub::small_matrix {

// out = A in; `in` and `out` must not overlap.
void multiply(const double* columns, int rows, int count, const double* in, double* out);
// out += factor (A in).
void add_multiple(double factor, const double* columns, int rows, int count, const double* in,
                  double* out);

// out = factor times the weighted sum of columns, plus `start` unless it is null. rows: a multiple
// of 8.
struct WeightedColumn {
  int column;
  double weight;
};
void combine(const double* columns, int rows, std::span<const WeightedColumn> sum, double factor,
             const double* start, double* out);

}  // namespace rotorub::small_matrix
