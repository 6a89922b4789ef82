// The wanted gap: ends, smoothness, and that it never asks for a closed gap before its time.
#include "native_model/control/gap_reference.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rotorub {
namespace {

constexpr double kGap = 0.5e-3, kTime = 0.008;
const SwitchOn kAtRest{0.1, kGap, 0.0};

TEST(GapReference, FallsFromTheGapAtSwitchOnToZero) {
  EXPECT_EQ(gap_reference(kAtRest, 0.0, kTime).gap, kGap);
  EXPECT_EQ(gap_reference(kAtRest, 0.1, kTime).gap, kGap);
  EXPECT_NEAR(gap_reference(kAtRest, 0.104, kTime).gap, 0.5 * kGap, 1e-15);
  EXPECT_NEAR(gap_reference(kAtRest, 0.108, kTime).gap, 0.0, 1e-18);
  EXPECT_NEAR(gap_reference(kAtRest, 5.0, kTime).gap, 0.0, 1e-18);
  EXPECT_EQ(gap_reference(kAtRest, 5.0, kTime).share, 1.0);
  double last = kGap;
  for (double t = 0.1; t < 0.109; t += 1e-5) {
    const GapReference r = gap_reference(kAtRest, t, kTime);
    ASSERT_LE(r.gap, last);
    ASSERT_LE(r.rate, 0.0);
    last = r.gap;
  }
}

void expect_smooth(const SwitchOn& on, double from) {
  const double h = 1e-7, speed = kGap / kTime, acceleration = speed / kTime;
  for (double t = from; t < 0.109; t += 1.3e-5) {
    const auto before = gap_reference(on, t - h, kTime), now = gap_reference(on, t, kTime),
               after = gap_reference(on, t + h, kTime);
    ASSERT_NEAR(now.rate, (after.gap - before.gap) / (2 * h), 1e-6 * speed) << t;
    ASSERT_NEAR(now.acceleration, (after.rate - before.rate) / (2 * h), 2e-3 * acceleration) << t;
    // No jump anywhere: the third derivative is bounded by 60 g0 / T^3 and 36 rate / T^2.
    ASSERT_LT(std::abs(after.acceleration - before.acceleration), 330.0 * h / kTime * acceleration)
        << t;
  }
}

TEST(GapReference, IsTwiceContinuouslyDifferentiable) { expect_smooth(kAtRest, 0.0995); }

TEST(GapReference, LeavesTheGapAtTheRateItHad) {
  for (const double rate : {-0.1, -0.02, 0.05}) {
    const SwitchOn on{0.1, kGap, rate};
    const GapReference start = gap_reference(on, 0.1, kTime);
    EXPECT_EQ(start.gap, kGap);
    EXPECT_DOUBLE_EQ(start.rate, rate) << "so the error starts without a jump in its rate";
    EXPECT_EQ(start.acceleration, 0.0);
    expect_smooth(on, 0.1 + 1e-6);
    const GapReference end = gap_reference(on, 0.108, kTime);
    EXPECT_NEAR(end.gap, 0.0, 1e-18);
    EXPECT_NEAR(end.rate, 0.0, 1e-15);
  }
}

TEST(GapReference, NeverAsksForAClosedGapBeforeItsTime) {
  for (const double rate : {-0.1, -1.0, -100.0}) {
    for (double t = 0.1; t < 0.108; t += 1e-5) {
      ASSERT_GE(gap_reference({0.1, kGap, rate}, t, kTime).gap, 0.0) << rate << " " << t;
    }
  }
  EXPECT_EQ(gap_reference({0.1, -1e-6, -1.0}, 0.101, kTime).gap, 0.0) << "closed already";
}

// Beyond the clearance the ring would have to be on the other side of the rotor.
TEST(GapReference, NeverAsksForLessThanHalfTheDistanceAtSwitchOn) {
  for (const double distance : {0.0, 0.01, 0.1, 0.3, 0.5, 0.9}) {
    const double clearance = kGap, gap = (1.0 - distance) * clearance;
    for (const double rate : {0.01, 0.1, 100.0}) {
      for (double t = 0.1; t < 0.108; t += 1e-5) {
        ASSERT_GE(clearance - gap_reference({0.1, gap, rate}, t, kTime, clearance).gap,
                  0.5 * distance * clearance)
            << distance << " " << rate << " " << t;
      }
    }
  }
}

}  // namespace
}  // namespace rotorub
