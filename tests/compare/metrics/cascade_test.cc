#include "compare/metrics/cascade.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <numbers>

#include "tests/support/orbit_run.h"

namespace rotorub {
namespace {

// From 20 to 80 Hz in 4 s; whirl of 20 um forward at 50 Hz and of 4 um backward at 90 Hz.
Trajectory ringing(int rows) {
  constexpr double kTwoPi = 2.0 * std::numbers::pi;
  const std::complex<double> i(0.0, 1.0);
  return test::orbit_run(4.0, static_cast<std::size_t>(rows) + 1, [&](double t) {
    const auto forward = 20e-6 * std::polar(1.0, kTwoPi * 50.0 * t),
               backward = 4e-6 * std::polar(1.0, -kTwoPi * 90.0 * t + 0.4);
    const double speed = kTwoPi * (20.0 + 15.0 * t);
    return test::OrbitRow{forward + backward + 7e-6,
                          kTwoPi * i * (50.0 * forward - 90.0 * backward), 0.0, speed};
  });
}

TEST(Cascade, HasUprightRidgesWhereNaturalFrequenciesRing) {
  constexpr double kTwoPi = 2.0 * std::numbers::pi;
  constexpr std::size_t kRows = 30, kColumns = 601;
  const Cascade c = cascade(ringing(16000), kRows, kColumns, 300.0);
  ASSERT_GE(c.t.size(), kRows - 3) << "those at the ends have no room for eight turns";
  ASSERT_EQ(c.amplitude.size(), c.t.size() * kColumns);
  EXPECT_EQ(c.frequency.front(), -300.0);
  EXPECT_EQ(c.frequency.back(), 300.0);
  for (std::size_t row = 0; row < c.t.size(); ++row) {
    EXPECT_NEAR(c.speed[row], kTwoPi * (20.0 + 15.0 * c.t[row]), 1e-6);
    const auto begin = c.amplitude.begin() + static_cast<std::ptrdiff_t>(row * kColumns);
    const auto forward = std::max_element(begin + 300, begin + kColumns),
               backward = std::max_element(begin, begin + 300);
    EXPECT_NEAR(c.frequency[static_cast<std::size_t>(forward - begin)], 50.0, 1.01);
    EXPECT_NEAR(c.frequency[static_cast<std::size_t>(backward - begin)], -90.0, 2.01);
    EXPECT_NEAR(*forward, 20e-6, 0.1e-6);
    EXPECT_NEAR(*backward, 4e-6, 0.1e-6);
    EXPECT_NEAR(begin[300], 0.0, 1e-15) << "no whirl at 0 Hz";
  }
}

// 200 rows a second: at a spin of 33 Hz and more a turn has fewer than six rows.
TEST(Cascade, IsOpenWhereRowsAreTooFew) {
  const Cascade c = cascade(ringing(800), 30, 101, 300.0);
  ASSERT_FALSE(c.t.empty());
  EXPECT_LT(c.speed.back(), 2.0 * std::numbers::pi * 34.0);
}

}  // namespace
}  // namespace rotorub
