#include "native_model/numerics/small_matrix.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace rotorub {
namespace {

// Sizes around those of the blocks of rows (8, 4, 2, 1), square and rectangular.
struct Case {
  int rows, count;
  std::vector<double> columns, in, out;
};
std::vector<Case> cases() {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  const auto values = [&](int n) {
    std::vector<double> x(static_cast<std::size_t>(n));
    for (double& one : x) one = value(random);
    return x;
  };
  std::vector<Case> out;
  for (int rows = 1; rows <= 35; ++rows) {
    for (const int count : {1, 3, rows}) {
      out.push_back({rows, count, values(rows * count), values(count), values(rows)});
    }
  }
  return out;
}
// The sum of a row from its first column to its last, in the order of the header.
double row(const Case& of, int i) {
  double sum = 0.0;
  for (int j = 0; j < of.count; ++j) {
    sum +=
        of.columns[static_cast<std::size_t>(j * of.rows + i)] * of.in[static_cast<std::size_t>(j)];
  }
  return sum;
}

// Any instruction set gives the bits of the plain sum.
TEST(SmallMatrix, SumsInTheOrderOfColumns) {
  for (Case of : cases()) {
    SCOPED_TRACE(of.rows);
    const std::vector<double> before = of.out;
    small_matrix::add_multiple(0.3, of.columns.data(), of.rows, of.count, of.in.data(),
                               of.out.data());
    for (int i = 0; i < of.rows; ++i) {
      const auto at = static_cast<std::size_t>(i);
      EXPECT_EQ(of.out[at], before[at] + 0.3 * row(of, i)) << i;
    }
    small_matrix::multiply(of.columns.data(), of.rows, of.count, of.in.data(), of.out.data());
    for (int i = 0; i < of.rows; ++i) {
      EXPECT_EQ(of.out[static_cast<std::size_t>(i)], row(of, i)) << i;
    }
  }
}

}  // namespace
}  // namespace rotorub
