#include "native_model/oracles/drop.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rotorub::oracle {
namespace {

// Bounces one after another: speed at the ground from the fall, then e times that.
TEST(Drop, ImpactTimesAreTheSumOfFlights) {
  const Drop drop{0.5e-3, 9.81, 0.5};
  double t = std::sqrt(2.0 * 0.5e-3 / 9.81), speed = std::sqrt(2.0 * 9.81 * 0.5e-3);
  for (int k = 0; k < 30; ++k) {
    EXPECT_NEAR(drop.impact_time(k), t, 1e-16) << k;
    speed *= 0.5;
    t += 2.0 * speed / 9.81;
  }
  EXPECT_NEAR(drop.rest_time(), t, 1e-9 * t);
  EXPECT_LT(drop.impact_time(30), drop.rest_time()) << "never reached by bouncing";
}

TEST(Drop, TheBenchsFirstImpacts) {
  const Drop drop{0.5e-3, 9.81, 0.5};
  EXPECT_NEAR(drop.impact_time(0), 10.0964e-3, 0.5e-7);
  EXPECT_NEAR(drop.impact_time(1), 20.1928e-3, 0.5e-7);
  EXPECT_NEAR(drop.impact_time(2), 25.2409e-3, 0.5e-7);
}

TEST(Drop, HeightObeysItsEquationBetweenImpacts) {
  const Drop drop{0.3, 9.81, 0.8};
  const double h = 1e-5;
  for (int k = 0; k < 12; ++k) {
    const double from = k == 0 ? 0.0 : drop.impact_time(k - 1), to = drop.impact_time(k);
    const double t = from + 0.37 * (to - from);
    const double second =
        (drop.height_at(t - h) - 2.0 * drop.height_at(t) + drop.height_at(t + h)) / (h * h);
    EXPECT_NEAR(second, -9.81, 1e-4) << k;
    EXPECT_NEAR(drop.height_at(to), 0.0, 1e-13) << k;
    // Restitution: the speed after over that before.
    const double before = -drop.height_at(to - h) / h, after = drop.height_at(to + h) / h;
    EXPECT_NEAR(after / -before, 0.8, 1e-3) << k;
    EXPECT_GT(drop.height_at(t), 0.0);
  }
}

TEST(Drop, RestsAfterwards) {
  const Drop drop{0.5e-3, 9.81, 0.5};
  EXPECT_EQ(drop.height_at(drop.rest_time() * 1.0001), 0.0);
  const Drop plastic{0.5e-3, 9.81, 0.0};
  EXPECT_EQ(plastic.rest_time(), plastic.fall_time());
  EXPECT_EQ(plastic.impact_time(5), plastic.fall_time());
}

}  // namespace
}  // namespace rotorub::oracle
