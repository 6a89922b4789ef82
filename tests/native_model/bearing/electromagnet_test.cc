#include "native_model/bearing/electromagnet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace rotorub {
namespace {

const Electromagnet::Parameters kMagnet{4e-4, 3.0, 5e-3, 2e4};
constexpr double kLimit = 2.5;  // A

TEST(Electromagnet, ForceByHand) {
  const Electromagnet law(kMagnet);
  EXPECT_EQ(law.force(0.0, 0.0), 0.0);
  // i = 1 A in the middle: k_m (16 - 4) / s_0^2.
  EXPECT_NEAR(law.force(0.0, 1.0), 192.0, 1e-12);
  // s = 1 mm without control current: 9 k_m (1/16 - 1/36) 1e6 - c s = 125 - 20 N.
  EXPECT_NEAR(law.force(1e-3, 0.0), 105.0, 1e-12);
  EXPECT_NEAR(law.force(-1e-3, 0.0), -105.0, 1e-12);
  // Both: k_m (16/16 - 4/36) 1e6 - 20 N.
  EXPECT_NEAR(law.force(1e-3, 1.0), 4e-4 * 1e6 * (1.0 - 1.0 / 9.0) - 20.0, 1e-12);
}

TEST(Electromagnet, SlopesInTheMiddle) {
  const Electromagnet law(kMagnet);
  const double per_ampere = 4.0 * 4e-4 * 3.0 / 25e-6;
  const double per_metre = 4.0 * 4e-4 * 9.0 / 125e-9 - 2e4;
  EXPECT_NEAR(law.gain(0.0, 0.0), per_ampere, 1e-12 * per_ampere);
  const double s = 1e-8;
  EXPECT_NEAR((law.force(s, 0.0) - law.force(-s, 0.0)) / (2.0 * s), per_metre, 1e-8 * per_metre);
}

TEST(Electromagnet, GainAndBiasMakeTheForce) {
  const Electromagnet law(kMagnet);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 2000; ++k) {
    const double s = 4.9e-3 * unit(random), i = 3.0 * unit(random);
    const double force = law.force(s, i);
    EXPECT_NEAR(law.gain(s, i) * i + law.force(s, 0.0), force, 1e-12 * (1e3 + std::abs(force)));
  }
}

TEST(Electromagnet, CurrentIsTheInverse) {
  const Electromagnet law(kMagnet);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 2000; ++k) {
    const double s = 4.9e-3 * unit(random), i = kLimit * unit(random);
    EXPECT_NEAR(law.current(s, law.force(s, i), kLimit), i, 1e-12) << s;
  }
}

// Also where the quadratic has no root at all, near a core and far beyond what the magnets give.
TEST(Electromagnet, OutOfReachIsTheLimit) {
  const Electromagnet law(kMagnet);
  for (const double s : {-4.9e-3, -1e-3, 0.0, 1e-3, 4.9e-3}) {
    const double most = law.force(s, kLimit), least = law.force(s, -kLimit);
    for (const double beyond : {1.0, 1e3, 1e9}) {
      EXPECT_EQ(law.current(s, most + beyond, kLimit), kLimit) << s;
      EXPECT_EQ(law.current(s, least - beyond, kLimit), -kLimit) << s;
    }
  }
}

// Hard: the formula has a pole at s = s_0, and a ring that escapes runs through it.
TEST(Electromagnet, FiniteAtAndBeyondTheCores) {
  const Electromagnet law(kMagnet);
  for (const double s : {5e-3, -5e-3, 0.1, -1e6}) {
    EXPECT_TRUE(std::isfinite(law.force(s, 1.0))) << s;
    EXPECT_TRUE(std::isfinite(law.gain(s, 1.0))) << s;
    EXPECT_LE(std::abs(law.current(s, 10.0, kLimit)), kLimit) << s;
  }
}

}  // namespace
}  // namespace rotorub
