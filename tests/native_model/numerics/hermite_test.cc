// Hermite's cubic is exact for a cubic.
#include "native_model/numerics/hermite.h"

#include <gtest/gtest.h>

namespace rotorub {
namespace {

TEST(Hermite, ReproducesACubic) {
  const auto cubic = [](double t) { return 2.0 - t + 3.0 * t * t + 0.5 * t * t * t; };
  const auto rate = [](double t) { return -1.0 + 6.0 * t + 1.5 * t * t; };
  const double begin = 0.3, h = 1.7;
  for (const double s : {0.0, 0.25, 0.6, 1.0}) {
    EXPECT_NEAR(hermite(cubic(begin), rate(begin), cubic(begin + h), rate(begin + h), h, s),
                cubic(begin + s * h), 1e-13)
        << s;
  }
}

}  // namespace
}  // namespace rotorub
