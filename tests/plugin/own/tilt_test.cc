// A rotor that tilts in its ring. The contact is that of its centre's circle: exact for a thin disc
// to first order in the tilt. What is left out, by looking at the rotor's edge point by point.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/plugin/own/two_rings.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

constexpr double kTiltRadius = 0.05, kTiltClearance = 5e-4;

class Tilt : public HookedTest {
 protected:
  // Gap of a rotor's two edges, `half` to either side of its centre, in an endless cylinder: the
  // least distance of any of their points.
  static double gap_of_edges(const mjModel* m, const mjData* d, double half) {
    const int disc = mj_name2id(m, mjOBJ_GEOM, "disc");
    const mjtNum *centre = d->geom_xpos + 3 * disc, *axes = d->geom_xmat + 9 * disc;
    constexpr int kPoints = 100000;
    double farthest = 0.0;
    for (const double z : {-half, half}) {
      for (int i = 0; i < kPoints; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kPoints;
        const double p[] = {kTiltRadius * std::cos(angle), kTiltRadius * std::sin(angle), z};
        double at[2];
        for (int k = 0; k < 2; ++k) {
          at[k] = centre[k] + axes[3 * k] * p[0] + axes[3 * k + 1] * p[1] + axes[3 * k + 2] * p[2];
        }
        farthest = std::max(farthest, std::hypot(at[0], at[1]));
      }
    }
    return kTiltRadius + kTiltClearance - farthest;
  }
};

// Thin: our gap is the smaller, by no more than r theta^2 / 2 (25 nm at 1 mrad, 2.5 um at 10 mrad).
// Long: the edges come nearer by half the length times theta. Two contacts, one at each end, know
// that.
TEST_F(Tilt, LeavesOutTheSquareOfTheTilt) {
  TwoRings x;
  x.rings = 1;
  const ModelPointer m = load(document(x));
  double most = 0.0;
  for (const double theta : {1e-4, 1e-3, 3e-3, 1e-2}) {
    for (const double direction : {0.0, 0.7, 1.5707963}) {
      const DataPointer d = start(m.get());
      d->qpos[0] = 4e-4;
      d->qpos[2] = theta * std::cos(direction);
      d->qpos[3] = theta * std::sin(direction);
      mj_forward(m.get(), d.get());
      const double ours = kTiltClearance - 4e-4;
      const double missing = gap_of_edges(m.get(), d.get(), 0.0) - ours;
      EXPECT_GT(missing, -1e-12);
      EXPECT_LT(missing, 0.5 * kTiltRadius * theta * theta + 1e-12) << theta;
      most = std::max(most, missing / (0.5 * kTiltRadius * theta * theta));
      const double long_one = ours - gap_of_edges(m.get(), d.get(), 0.01);
      EXPECT_LT(long_one, 0.01 * theta + 1e-12);
      if (direction > 1.5) {
        EXPECT_GT(long_one, 0.8 * 0.01 * theta - 0.5 * kTiltRadius * theta * theta);
      }
    }
  }
  EXPECT_GT(most, 0.3);  // the bound is no more than three times what there is
}

}  // namespace
}  // namespace rotorub::test
