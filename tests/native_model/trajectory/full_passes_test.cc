#include "native_model/trajectory/full_passes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace rotorub {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

FullPasses followed(double end, double step, const std::function<double(double)>& angle) {
  FullPasses passes;
  for (double t = 0.0; t <= end; t += step) {
    passes.follow(1e-4 * Eigen::Vector2d(std::cos(angle(t)), std::sin(angle(t))), t);
  }
  return passes;
}

TEST(FullPasses, OfAWhirl) {
  // 10.6 turns, in the one sense and the other, at 3 to 400 states a turn.
  for (const double each : {3.1, 7.3, 400.0}) {
    for (const double sense : {1.0, -1.0}) {
      const FullPasses p =
          followed(1.06, 0.1 / each, [&](double t) { return 0.3 + sense * kTurn * 10.0 * t; });
      EXPECT_EQ(sense > 0.0 ? p.forward() : p.backward(), 10) << each;
      EXPECT_EQ(sense > 0.0 ? p.backward() : p.forward(), 0) << each;
      EXPECT_NEAR(p.time(), 1.0, 0.1 / each + 0.03) << each;
    }
  }
}

// Rocks for 1 s, then goes backward three times in 0.3 s, comes back to rock.
TEST(FullPasses, BetweenRocking) {
  const FullPasses p = followed(2.5, 1e-3, [](double t) {
    if (t < 1.0) return -1.5 + 0.8 * std::sin(kTurn * 4.0 * t);
    if (t < 1.3) return -1.5 - kTurn * 10.0 * (t - 1.0);
    return -1.5 - 3.0 * kTurn + 0.8 * std::sin(kTurn * 4.0 * (t - 1.3));
  });
  EXPECT_EQ(p.backward(), 3);
  EXPECT_EQ(p.forward(), 0);
  EXPECT_NEAR(p.time(), 0.3, 0.25);
}

}  // namespace
}  // namespace rotorub
