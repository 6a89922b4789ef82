// The impact's closed form against Routh's: the impulse grows bit by bit, Coulomb's law holds at
// every bit.
#include "tests/support/oracles/planar_impact.h"

#include <gtest/gtest.h>

#include <algorithm>
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

}  // namespace
}  // namespace rotorub::oracle
