#include "renders/instant.h"

#include <gtest/gtest.h>

#include "tests/renders/samples.h"

namespace rotorub::renders {
namespace {

// In contact for a fraction of the time, with one force.
Trajectory pressed_run(double force, double share) {
  return made_run(1001, [=](double t) {
    return Row{.rotor_x = kClearance, .normal_force = t <= 0.1 * share ? force : 0.0};
  });
}

Scales scales_of(const std::vector<const Trajectory*>& runs) {
  std::vector<Playback> playbacks;
  for (const Trajectory* run : runs) playbacks.emplace_back(*run);
  std::vector<const Playback*> pointers;
  for (const Playback& playback : playbacks) pointers.push_back(&playback);
  return make_scales(pointers, 0.0, 0.1, kClearance);
}

// In an earlier film the cone, in contact for 0.6 % of the time, had the scale "1 N" for 14,050 N.
TEST(Scales, AForceThatIsSeldomThereSetsTheScaleAllTheSame) {
  const Trajectory cone = pressed_run(14050.0, 0.006);
  const Scales scales = scales_of({&cone});
  EXPECT_GT(scales.force.high, 14050.0);
  EXPECT_FALSE(scales.force.logarithmic);
  EXPECT_FALSE(scales.force.clips(14050.0));
}

TEST(Scales, RunsShownTogetherShareOne) {
  const Trajectory native = pressed_run(60.0, 1.0);
  const Trajectory near = pressed_run(90.0, 0.5);
  EXPECT_DOUBLE_EQ(scales_of({&native, &near}).force.high, scales_of({&near}).force.high);
  EXPECT_GT(scales_of({&native, &near}).force.high, scales_of({&native}).force.high);
}

TEST(Scales, RunsFarApartAreBothSeen) {
  const Trajectory native = pressed_run(60.0, 1.0);
  const Trajectory cone = pressed_run(14050.0, 0.006);
  const Scales scales = scales_of({&cone, &native});
  EXPECT_TRUE(scales.force.logarithmic);
  EXPECT_GT(scales.force.share(60.0), 0.2);
  EXPECT_LT(scales.force.share(60.0), scales.force.share(14050.0));
  EXPECT_FALSE(scales.force.clips(14050.0));
  EXPECT_EQ(scales.force.share(0.0), 0.0);
}

TEST(Scales, AForceOfNothingDoesNotSpreadTheScale) {
  const Trajectory native = pressed_run(60.0, 1.0);
  const Trajectory graze = pressed_run(1e-12, 1.0);
  const Scales scales = scales_of({&native, &graze});
  EXPECT_GT(scales.force.share(60.0), 0.9);
  EXPECT_GT(scales.force.low, 1e-6);
}

TEST(Scales, ValuesBeyondTheScaleAreClippedAndMarked) {
  Trajectory run = made_run(1001, [](double t) {
    return Row{.rotor_x = kClearance, .normal_force = t < 0.0005 ? 5000.0 : 100.0};
  });
  const Scales scales = scales_of({&run});
  EXPECT_LT(scales.force.high, 200.0);
  EXPECT_EQ(scales.force.share(5000.0), 1.0);
  const Playback playback(run);
  EXPECT_TRUE(instant_at(playback, 0.0, scales, {}).normal.clipped);
  EXPECT_FALSE(instant_at(playback, 0.05, scales, {}).normal.clipped);
}

TEST(Scales, PenetrationIsShownToItsDepth) {
  const Trajectory deep = made_run(101, [](double t) {
    return Row{.rotor_x = t < 0.05 ? 0.9 * kClearance : 2.8 * kClearance, .normal_force = 1e5};
  });
  const Scales scales = scales_of({&deep});
  EXPECT_NEAR(scales.gap.low, -1.8e6 * kClearance, 1e-6);
  EXPECT_EQ(scales.gap.share(-1.8e6 * kClearance), 0.0);
  EXPECT_GT(scales.gap.share(0.0), 0.5);
}

TEST(Scales, ImpulsesWhereContactNeverLasts) {
  Trajectory bounces = resting_run({});
  bounces.impacts = {{.t = 0.05, .normal_impulse = 0.4, .gap_rate_before = -0.1}};
  EXPECT_TRUE(scales_of({&bounces}).impulses);
  EXPECT_GT(scales_of({&bounces}).impulse.high, 0.4);
  const Trajectory lasting = pressed_run(10.0, 1.0);
  EXPECT_FALSE(scales_of({&lasting}).impulses);
  EXPECT_EQ(scales_of({&lasting}).control.high, 0.0);
}

TEST(Scales, ControlForceFromItsColumns) {
  Trajectory run = pressed_run(10.0, 1.0);
  run.series.push_back({"control_x", "N", std::vector<double>(run.rows(), 30.0)});
  run.series.push_back({"control_y", "N", std::vector<double>(run.rows(), -40.0)});
  EXPECT_DOUBLE_EQ(scales_of({&run}).control.high, 50.0);
  EXPECT_EQ(Playback(run).at(0.02).control, Eigen::Vector2d(30.0, -40.0));
  EXPECT_EQ(scales_of({&run}).current.high, 0.0) << "an ideal force has no coil";
  run.series.push_back({"current_1", "A", std::vector<double>(run.rows(), 0.6)});
  run.series.push_back({"current_2", "A", std::vector<double>(run.rows(), -0.8)});
  EXPECT_DOUBLE_EQ(scales_of({&run}).current.high, 1.0);
  // With their signs, relative to the film's largest.
  const Instant instant = instant_at(Playback(run), 0.02, scales_of({&run}), {});
  EXPECT_DOUBLE_EQ(instant.current[0], 0.6);
  EXPECT_DOUBLE_EQ(instant.current[1], -0.8);
}

TEST(Scales, ValuesInWords) {
  EXPECT_EQ(value_text(14050.4, "N"), "14,050 N");
  EXPECT_EQ(value_text(-1234567.0, "N"), "-1,234,567 N");
  EXPECT_EQ(value_text(57.31, "N"), "57.3 N");
  EXPECT_EQ(length_text(0.5e-3), "0.5 mm");
  EXPECT_EQ(length_text(3e-6), "3 µm");
}

}  // namespace
}  // namespace rotorub::renders
