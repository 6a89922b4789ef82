#include "native_model/numerics/root.h"

#include <gtest/gtest.h>

#include <vector>

namespace rotorub {
namespace {

constexpr double kRoundOff = 1e-14;

// sign product (x - r).
Polynomial with_roots(double sign, const std::vector<double>& roots) {
  Polynomial p{0, {sign}};
  for (const double r : roots) {
    ++p.degree;
    for (int i = p.degree; i >= 0; --i) {
      const auto k = static_cast<std::size_t>(i);
      p.a[k] = (i > 0 ? p.a[k - 1] : 0.0) - r * p.a[k];
    }
  }
  return p;
}

TEST(FirstCrossing, IsTheFirstOfSeveralRoots) {
  // Below zero at 0: an odd number of roots to the right with sign 1.
  const auto x = first_crossing(with_roots(1.0, {0.7, 0.31, 0.5}), RootStart::kAnywhere);
  ASSERT_TRUE(x);
  EXPECT_NEAR(*x, 0.31, kRoundOff);
}

TEST(FirstCrossing, LooksNoFurtherThanOne) {
  EXPECT_FALSE(first_crossing(with_roots(1.0, {1.1}), RootStart::kAnywhere));
  EXPECT_FALSE(first_crossing(with_roots(-1.0, {-0.5}), RootStart::kAnywhere)) << "falls from 0 on";
  const auto end = first_crossing(with_roots(1.0, {1.0}), RootStart::kAnywhere);
  EXPECT_FALSE(end) << "a touch at the very end is the next step's";
}

TEST(FirstCrossing, SeesTwoRootsCloseTogether) {
  // -(x - 0.4)(x - 0.4 - d): above zero for d only.
  for (const double d : {1e-2, 1e-4, 1e-6}) {
    const auto x = first_crossing(with_roots(-1.0, {0.4, 0.4 + d}), RootStart::kAnywhere);
    ASSERT_TRUE(x) << d;
    EXPECT_NEAR(*x, 0.4, 1e-13 / d);
  }
}

TEST(FirstCrossing, IgnoresRoundOffOfTheStart) {
  Polynomial p = with_roots(1.0, {0.6});
  p.a[0] = 0.0;
  p.a[1] = -1.0;
  ++p.degree;
  p.a[2] = 2.0;  // -x + 2 x^2
  p.a[0] = 1e-18;
  EXPECT_EQ(first_crossing(p, RootStart::kAnywhere), 0.0);
  const auto x = first_crossing(p, RootStart::kBelowZero);
  ASSERT_TRUE(x);
  EXPECT_NEAR(*x, 0.5, kRoundOff);
}

}  // namespace
}  // namespace rotorub
