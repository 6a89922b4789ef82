// The impact's closed form against Routh's: the impulse grows bit by bit, Coulomb's law holds at
// every bit.
#include "tests/support/oracles/planar_impact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace rotorub::oracle {
namespace {

struct After {
  double normal, slip;
};

// Compression until the bodies no longer close, then restitution times that impulse more (Poisson).
After by_increments(const PlanarImpact& p, double normal, double slip, int parts) {
  const double whole = -normal / p.g_nn * (1.0 + p.restitution), bit = whole / parts;
  for (int k = 0; k < parts; ++k) {
    normal += p.g_nn * bit;
    // Friction takes what it may, and no more than stops the slip.
    const double most = p.friction * p.g_tt * bit;
    slip -= std::clamp(slip, -most, most);
  }
  return {normal, slip};
}

TEST(PlanarImpact, WithoutTangentialRestitutionIsRouths) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int stuck = 0, slid = 0;
  for (int k = 0; k < 500; ++k) {
    const PlanarImpact p{0.2 + unit(random), 0.2 + unit(random), unit(random), unit(random), 0.0};
    const double normal = -0.1 - unit(random), slip = 2.0 * unit(random) - 1.0;
    const After exact = by_increments(p, normal, slip, 2000);
    ASSERT_NEAR(p.normal_after(normal), exact.normal, 1e-11) << k;
    ASSERT_NEAR(p.slip_after(normal, slip), exact.slip, 1e-11) << k;
    ++(p.sticks(normal, slip) ? stuck : slid);
  }
  EXPECT_GT(stuck, 100);
  EXPECT_GT(slid, 100);
}

double energy(const PlanarImpact& p, double normal, double slip) {
  return 0.5 * (normal * normal / p.g_nn + slip * slip / p.g_tt);
}

TEST(PlanarImpact, NeverGainsEnergyAndLosesNoneWhereBothRestitutionsAreOne) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 2000; ++k) {
    PlanarImpact p{0.2 + unit(random), 0.2 + unit(random), 2.0 * unit(random), unit(random),
                   unit(random)};
    const double normal = -0.1 - unit(random);
    // Slips that stick, so that the tangential restitution acts.
    const double slip =
        0.999 * p.friction * p.g_tt * p.compression(normal) * (2.0 * unit(random) - 1.0);
    ASSERT_TRUE(p.sticks(normal, slip));
    const double before = energy(p, normal, slip);
    ASSERT_LE(energy(p, p.normal_after(normal), p.slip_after(normal, slip)), before);
    p.restitution = p.tangential_restitution = 1.0;
    ASSERT_NEAR(energy(p, p.normal_after(normal), p.slip_after(normal, slip)), before,
                1e-14 * before);
    ASSERT_DOUBLE_EQ(p.slip_after(normal, slip), -slip) << "springs back whole";
  }
}

TEST(PlanarImpact, StickingEndsWhereFrictionIsUsedUp) {
  const PlanarImpact p{0.5, 2.0, 0.25, 0.5, 0.0};
  // Compression 1 / 0.5 = 2 N s; friction stops up to 0.25 * 2 * 2 = 1 m/s of slip in it.
  EXPECT_EQ(p.compression(-1.0), 2.0);
  EXPECT_TRUE(p.sticks(-1.0, 1.0));
  EXPECT_FALSE(p.sticks(-1.0, std::nextafter(1.0, 2.0)));
  EXPECT_TRUE(p.sticks(-1.0, -1.0));
  EXPECT_NEAR(p.slip_after(-1.0, 1.4), 0.0, 1e-15) << "stopped in the expansion";
  EXPECT_NEAR(p.slip_after(-1.0, -3.0), -1.5, 1e-15);
  EXPECT_EQ(p.normal_after(-1.0), 0.5);
}

}  // namespace
}  // namespace rotorub::oracle
