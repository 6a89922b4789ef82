// Where straight paths meet the circle, and which normal a contact has that they close.
#include "native_model/contact/circle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rotorub {
namespace {

constexpr double kRing = 0.5e-3;  // m

TEST(CircleExit, FromInsideIsWhereThePathCrosses) {
  EXPECT_DOUBLE_EQ(circle_exit({0.0, 0.0}, {2.0 * kRing, 0.0}, kRing), 0.5);
  EXPECT_DOUBLE_EQ(circle_exit({0.5 * kRing, 0.0}, {-3.0 * kRing, 0.0}, kRing), 0.5);
  EXPECT_GT(circle_exit({0.0, 0.0}, {0.5 * kRing, 0.0}, kRing), 1.0);
}

TEST(CircleExit, FromOutsideIsAtOnceOrWhereItComesOutAgain) {
  EXPECT_EQ(circle_exit({1.01 * kRing, 0.0}, {1e-4, 0.0}, kRing), 0.0);
  // Through the middle: in at 0.01, out at 2.01 radii of 4.
  EXPECT_NEAR(circle_exit({1.01 * kRing, 0.0}, {-4.0 * kRing, 0.0}, kRing), 2.01 / 4.0, 1e-12);
  // A chord from the circle itself: 2 cos 45 deg of its radius.
  const double chord = std::sqrt(2.0) * kRing;
  EXPECT_NEAR(circle_exit({kRing, 0.0}, {-2.0 * kRing, 2.0 * kRing}, kRing),
              chord / (std::sqrt(8.0) * kRing), 1e-12);
  EXPECT_GT(circle_exit({1.5 * kRing, 0.0}, {-1e-6, 1e-3}, kRing), 1.0) << "passes by";
}

TEST(ReachCircle, IsTheFirstPointFromOutside) {
  EXPECT_DOUBLE_EQ(reach_circle({2.0 * kRing, 0.0}, {-kRing, 0.0}, kRing), 1.0);
  EXPECT_LT(reach_circle({2.0 * kRing, 0.0}, {kRing, 0.0}, kRing), 0.0) << "leads away";
  EXPECT_LT(reach_circle({2.0 * kRing, 0.0}, {-kRing, 2.0 * kRing}, kRing), 0.0) << "passes by";
}

TEST(NormalOfPath, IsThatOfItsBeginUnlessItLeavesElsewhere) {
  const Eigen::Vector2d d{0.3e-3, 0.4e-3}, outward = d.normalized();
  EXPECT_LT((normal_of_path(d, 2.0 * d, kRing) - outward).norm(), 1e-15);
  // Through the middle and out on the other side.
  EXPECT_LT((normal_of_path(0.5 * d, -3.0 * d, kRing) + outward).norm(), 1e-15);
  // From the centre there is no other.
  EXPECT_LT((normal_of_path({0.0, 0.0}, 3.0 * d, kRing) - outward).norm(), 1e-15);
  // Outside already.
  EXPECT_LT((normal_of_path(1.5 * d, -0.1 * d, kRing) - outward).norm(), 1e-15);
}

}  // namespace
}  // namespace rotorub
