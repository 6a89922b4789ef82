#include "native_model/bearing/drive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rotorub {
namespace {

// d T / d Omega by central differences.
double numerical_slope(const Drive& drive, double speed, double h) {
  return (drive.torque(speed + h) - drive.torque(speed - h)) / (2.0 * h);
}

scene::Drive kloss() {
  scene::Drive d;
  d.kind = scene::DriveKind::kKloss;
  d.breakdown_torque = 8.0;
  d.breakdown_slip = 0.2;
  d.synchronous_speed = 314.0;
  return d;
}

// The curve rises, is constant and falls, with uneven spacing.
scene::Drive table() {
  scene::Drive d;
  d.kind = scene::DriveKind::kTable;
  d.table_speed = {-10.0, 0.0, 5.0, 40.0, 50.0, 52.0, 90.0};
  d.table_torque = {6.0, 7.0, 7.0, 9.5, 3.0, 2.9, 0.0};
  return d;
}

TEST(DriveKloss, IsSmoothThroughSynchronousSpeed) {
  const Drive drive(kloss());
  EXPECT_EQ(drive.torque(314.0), 0.0) << "slip 0: 0/0 in the textbook form";
  // T = 2 T_b s / s_b there.
  EXPECT_DOUBLE_EQ(drive.slope(314.0), -2.0 * 8.0 / 0.2 / 314.0);
  EXPECT_GT(drive.torque(313.0), 0.0);
  EXPECT_LT(drive.torque(315.0), 0.0);
  EXPECT_NEAR(drive.torque(313.0), -drive.torque(315.0), 1e-13);
}

TEST(DriveKloss, IsTheTextbookCurve) {
  const Drive drive(kloss());
  for (const double speed : {-50.0, 0.0, 100.0, 250.0, 300.0, 330.0}) {
    const double slip = 1.0 - speed / 314.0;
    EXPECT_NEAR(drive.torque(speed), 2.0 * 8.0 / (slip / 0.2 + 0.2 / slip), 1e-13) << speed;
  }
}

TEST(DriveTable, IsMonotoneBetweenNeighbours) {
  const scene::Drive d = table();
  const Drive drive(d);
  const auto& y = d.table_torque;
  for (std::size_t i = 0; i + 1 < y.size(); ++i) {
    const double from = d.table_speed[i], h = d.table_speed[i + 1] - from;
    EXPECT_NEAR(drive.torque(from), y[i], 1e-14);
    const double way = y[i + 1] > y[i] ? 1.0 : y[i + 1] < y[i] ? -1.0 : 0.0;
    double last = y[i];
    for (int k = 1; k <= 200; ++k) {
      const double torque = drive.torque(from + h * k / 200.0);
      if (way == 0.0) {
        ASSERT_NEAR(torque, y[i], 1e-14) << "equal neighbours: flat";
      } else {
        ASSERT_GE(way * (torque - last), -1e-14) << "interval " << i << ", " << k;
      }
      last = torque;
    }
  }
}

TEST(DriveTable, IsHeldBeyondItsEnds) {
  const Drive drive(table());
  EXPECT_EQ(drive.torque(-1000.0), 6.0);
  EXPECT_EQ(drive.torque(1000.0), 0.0);
  EXPECT_EQ(drive.slope(-1000.0), 0.0);
  EXPECT_EQ(drive.slope(1000.0), 0.0);
}

TEST(DriveTable, ReproducesAStraightLine) {
  scene::Drive d;
  d.kind = scene::DriveKind::kTable;
  d.table_speed = {0.0, 10.0, 35.0, 100.0};
  d.table_torque = {20.0, 18.0, 13.0, 0.0};
  const Drive drive(d);
  for (double speed = 1.0; speed < 100.0; speed += 7.3) {
    EXPECT_NEAR(drive.torque(speed), 20.0 - 0.2 * speed, 1e-13);
    EXPECT_NEAR(drive.slope(speed), -0.2, 1e-13);
  }
  d.table_speed = {0.0, 10.0};  // the shortest that is accepted
  d.table_torque = {20.0, 18.0};
  EXPECT_NEAR(Drive(d).torque(2.5), 19.5, 1e-13);
}

TEST(DriveSlope, IsTheDerivativeAndContinuous) {
  const double h = 1e-4;
  for (const scene::Drive& d : {kloss(), table()}) {
    const Drive drive(d);
    for (double speed = -9.7; speed < 89.9; speed += 0.31) {
      // Central differences: h^2/6 T''' beside round-off / h, and T'' jumps at a table's points.
      ASSERT_NEAR(drive.slope(speed), numerical_slope(drive, speed, h), 2e-4) << speed;
    }
  }
  const Drive drive(table());
  for (const double point : {0.0, 5.0, 40.0, 50.0, 52.0}) {
    EXPECT_NEAR(drive.slope(point - 1e-9), drive.slope(point + 1e-9), 1e-7) << point;
  }
}

// ---------------------------------------------------------------- speed_controlled
scene::Drive controlled() {
  scene::Drive d;
  d.kind = scene::DriveKind::kSpeedControlled;
  d.gain = 0.5;
  d.integral_gain = 20.0;
  d.speed = 300.0;
  d.acceleration = 1000.0;
  d.torque_limit = 4.0;
  return d;
}

// If speed and angle equal the reference, the drive has no torque.
TEST(DriveSpeedControlled, RestsOnItsReference) {
  for (const double start : {100.0, 500.0, 300.0}) {
    const Drive drive(controlled(), start);
    const double way = 300.0 - start, end = std::abs(way) / 1000.0;
    EXPECT_DOUBLE_EQ(drive.ramp_end(), end);
    for (const double t : {0.0, 0.3 * end, end, end + 0.7}) {
      const double risen = std::min(t, end);
      const double reference = end > 0.0 ? start + way * risen / end : 300.0;
      const double angle = 0.5 * (start + reference) * risen + 300.0 * (t - risen);
      EXPECT_NEAR(drive.torque(t, angle, reference), 0.0, 1e-11) << start << ' ' << t;
      EXPECT_NEAR(drive.torque(t, angle, reference - 2.0), 1.0, 1e-11);
      EXPECT_NEAR(drive.torque(t, angle - 0.1, reference), 2.0, 1e-11);
      EXPECT_EQ(drive.torque(t, angle, reference - 20.0), 4.0) << "at its limit";
      EXPECT_EQ(drive.torque(t, angle + 9.0, reference), -4.0);
      // However far the drive lags, its speed is at most limit / gain above its reference.
      EXPECT_NEAR(drive.torque(t, angle - 900.0, reference + 8.0), 0.0, 1e-11);
    }
  }
}

TEST(DriveSpeedControlled, WithoutAnAccelerationItIsTheStepOfTheReference) {
  scene::Drive d = controlled();
  d.acceleration = std::numeric_limits<double>::infinity();
  d.torque_limit = d.acceleration;
  const Drive drive(d, 100.0);
  EXPECT_EQ(drive.torque(0.0, 0.0, 100.0), 0.5 * 200.0);
  EXPECT_DOUBLE_EQ(drive.torque(0.1, 20.0, 290.0), 0.5 * 10.0 + 20.0 * (30.0 - 20.0));
}

}  // namespace
}  // namespace rotorub
