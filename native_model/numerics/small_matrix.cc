#include "native_model/numerics/small_matrix.h"

#include <cassert>
#include <type_traits>

#include "native_model/numerics/loops.h"

namespace rotorub::small_matrix {
namespace {

// Vectors of W doubles (GCC extension).
template <int W>
struct Raw;
#define ROTORUB_RAW(W)                                                        \
  template <>                                                                 \
  struct Raw<W> {                                                             \
    typedef double Value __attribute__((vector_size(8 * W), aligned(8 * W))); \
  }
ROTORUB_RAW(2);
ROTORUB_RAW(4);
ROTORUB_RAW(8);
#undef ROTORUB_RAW

// Processes rows from `from` in blocks of kVectors registers of W numbers; returns the first
// remaining row.
template <int W, int kVectors, class Store>
ROTORUB_INLINE int blocks_of_rows(int from, const double* columns, int rows, int count,
                                  const double* in, Store store) {
  using Vector = typename Raw<W>::Value;
  constexpr int kBlock = W * kVectors;
  for (; from + kBlock <= rows; from += kBlock) {
    Vector sums[kVectors] = {};
    for (int j = 0; j < count; ++j) {
      const double* column = columns + j * rows + from;
#pragma GCC unroll 4
      for (int k = 0; k < kVectors; ++k) {
        Vector part;
        __builtin_memcpy(&part, column + k * W, sizeof part);
        sums[k] += part * in[j];
      }
    }
#pragma GCC unroll 4
    for (int k = 0; k < kVectors; ++k) store(from + k * W, sums[k]);
  }
  return from;
}
template <int W, class Store>
ROTORUB_INLINE void each_block(const double* columns, int rows, int count, const double* in,
                               Store store) {
  int i = blocks_of_rows<W, 8 / W>(0, columns, rows, count, in, store);
  i = blocks_of_rows<2, 1>(i, columns, rows, count, in, store);
  if (i == rows) return;
  double sum = 0.0;
  for (int j = 0; j < count; ++j) sum += columns[j * rows + i] * in[j];
  store(i, sum);
}

template <int W>
ROTORUB_INLINE void combine_blocks(const double* columns, int rows, const WeightedColumn* sum,
                                   int count, double factor, const double* start, double* out) {
  using Vector = typename Raw<W>::Value;
  constexpr int kVectors = 8 / W;
  for (int i = 0; i < rows; i += 8) {
    Vector sums[kVectors] = {};
    for (int j = 0; j < count; ++j) {
      const double* column = columns + sum[j].column * rows + i;
#pragma GCC unroll 4
      for (int k = 0; k < kVectors; ++k) {
        Vector part;
        __builtin_memcpy(&part, column + k * W, sizeof part);
        sums[k] += part * sum[j].weight;
      }
    }
#pragma GCC unroll 4
    for (int k = 0; k < kVectors; ++k) {
      sums[k] *= factor;
      if (start) {
        Vector from;
        __builtin_memcpy(&from, start + i + k * W, sizeof from);
        sums[k] += from;
      }
      __builtin_memcpy(out + i + k * W, &sums[k], sizeof sums[k]);
    }
  }
}

// Compiles a function for each processor type; the loader selects one (GCC's function
// multiversioning).
#ifdef ROTORUB_EACH_TARGET
#define ROTORUB_EACH_WIDTH(X)                                                  \
  __attribute__((target("avx512f"))) X(8) __attribute__((target("avx2"))) X(4) \
      __attribute__((target("default"))) X(2)
#else
#define ROTORUB_EACH_WIDTH(X) X(2)
#endif

#define ROTORUB_MULTIPLY(W)                                                                 \
  void product(const double* columns, int rows, int count, const double* in, double* out) { \
    each_block<W>(columns, rows, count, in, [&](int i, const auto& sums) {                  \
      __builtin_memcpy(out + i, &sums, sizeof sums);                                        \
    });                                                                                     \
  }
ROTORUB_EACH_WIDTH(ROTORUB_MULTIPLY)
#define ROTORUB_ADD_MULTIPLE(W)                                                                   \
  void added_product(double factor, const double* columns, int rows, int count, const double* in, \
                     double* out) {                                                               \
    each_block<W>(columns, rows, count, in, [&](int i, const auto& sums) {                        \
      std::remove_cvref_t<decltype(sums)> new_rows;                                               \
      __builtin_memcpy(&new_rows, out + i, sizeof new_rows);                                      \
      new_rows += sums * factor;                                                                  \
      __builtin_memcpy(out + i, &new_rows, sizeof new_rows);                                      \
    });                                                                                           \
  }
ROTORUB_EACH_WIDTH(ROTORUB_ADD_MULTIPLE)
#define ROTORUB_COMBINE(W)                                                             \
  void combined(const double* columns, int rows, const WeightedColumn* sum, int count, \
                double factor, const double* start, double* out) {                     \
    combine_blocks<W>(columns, rows, sum, count, factor, start, out);                  \
  }
ROTORUB_EACH_WIDTH(ROTORUB_COMBINE)

}  // namespace

void multiply(const double* columns, int rows, int count, const double* in, double* out) {
  product(columns, rows, count, in, out);
}
void add_multiple(double factor, const double* columns, int rows, int count, const double* in,
                  double* out) {
  added_product(factor, columns, rows, count, in, out);
}

void combine(const double* columns, int rows, std::span<const WeightedColumn> sum, double factor,
             const double* start, double* out) {
  assert(rows % 8 == 0);
  combined(columns, rows, sum.data(), static_cast<int>(sum.size()), factor, start, out);
}

}  // namespace rotorub::small_matrix
