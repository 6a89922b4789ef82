// Scale bars beside the ring: in which corner each of them is.
#include "renders/corners.h"

#include <gtest/gtest.h>

namespace rotorub::renders {
namespace {

constexpr Area kArea{0, 0, 240, 240};

TEST(Corners, ABoxCoversNeitherTheDiscNorAnother) {
  Corners corners(kArea, 70.0, 5.0, 5.0);
  EXPECT_EQ(corners.next(100.0, 20.0), Sheet::Point(0.0, 5.0));
  EXPECT_EQ(corners.next(100.0, 20.0), Sheet::Point(0.0, 25.0));
  // Below that, the next one would cover the disc.
  EXPECT_EQ(corners.next(100.0, 20.0), Sheet::Point(140.0, 5.0));
  // A wide box has no room beside the one at the upper left.
  EXPECT_EQ(corners.next(150.0, 20.0), Sheet::Point(0.0, 215.0));
}

TEST(Corners, LeavesTheLowerLeftToAnActuator) {
  Corners corners(kArea, 100.0, 5.0, -1.0);
  EXPECT_EQ(corners.next(60.0, 30.0), Sheet::Point(0.0, 5.0));
  EXPECT_EQ(corners.next(60.0, 30.0), Sheet::Point(180.0, 5.0));
  // Without a free corner it stands below the first.
  EXPECT_EQ(corners.next(60.0, 30.0), Sheet::Point(0.0, 35.0));
}

}  // namespace
}  // namespace rotorub::renders
