#include "compare/base/plot_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rotorub {
namespace {

std::vector<double> wave(std::size_t n) {
  std::vector<double> y(n);
  for (std::size_t i = 0; i < n; ++i) y[i] = std::sin(0.01 * static_cast<double>(i));
  return y;
}

TEST(Thin, IsShortAscendingAndHasBothEnds) {
  const auto y = wave(50000);
  const auto kept = thin(y, 0, y.size(), 200);
  EXPECT_LE(kept.size(), 402U);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  EXPECT_EQ(std::adjacent_find(kept.begin(), kept.end()), kept.end());
  EXPECT_EQ(kept.front(), 0U);
  EXPECT_EQ(kept.back(), y.size() - 1);
}

// The envelope is exact: every bucket's extremes are the series' own.
TEST(Thin, KeepsTheEnvelope) {
  const auto y = wave(10000);
  const auto kept = thin(y, 0, y.size(), 100);
  for (std::size_t k = 0; k < 100; ++k) {
    const auto begin = y.begin() + static_cast<std::ptrdiff_t>(100 * k);
    double high = -2.0, low = 2.0;
    for (const std::size_t i : kept) {
      if (i < 100 * k || i >= 100 * (k + 1)) continue;
      high = std::max(high, y[i]);
      low = std::min(low, y[i]);
    }
    EXPECT_EQ(high, *std::max_element(begin, begin + 100));
    EXPECT_EQ(low, *std::min_element(begin, begin + 100));
  }
}

TEST(Thin, LeavesShortSeriesAlone) {
  const auto y = wave(10);
  EXPECT_EQ(thin(y, 0, 10, 200).size(), 10U);
  EXPECT_EQ(thin(y, 3, 3, 200).size(), 0U);
  EXPECT_EQ(thin(y, 3, 5, 200), (std::vector<std::size_t>{3, 4}));
}

TEST(Thin, StaysInItsRange) {
  const auto y = wave(10000);
  const auto kept = thin(y, 2000, 7000, 50);
  EXPECT_EQ(kept.front(), 2000U);
  EXPECT_EQ(kept.back(), 6999U);
}

// RFC 4648, section 10.
TEST(Base64, TestVectors) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\xff\xfe\x00", 3)), "//4A");
}

}  // namespace
}  // namespace rotorub
