#include "renders/machine.h"

#include <gtest/gtest.h>

#include <array>

#include "renders/instant.h"
#include "tests/renders/samples.h"

namespace rotorub::renders {
namespace {

constexpr double kRoundOff = 1e-12;  // drawing units; the shaft is 1

std::array<const Playback*, 1> one(const Playback& playback) { return {&playback}; }

TEST(Machine, PlainNumbers) {
  EXPECT_EQ(plain_number_below(1.0), 1.0);
  EXPECT_EQ(plain_number_below(1.99), 1.5);
  EXPECT_EQ(plain_number_below(18.0), 15.0);
  EXPECT_EQ(plain_number_below(45.0), 40.0);
  EXPECT_EQ(plain_number_below(99.9), 80.0);
  EXPECT_EQ(plain_number_below(100.0), 100.0);
  EXPECT_DOUBLE_EQ(plain_number_below(0.00047), 0.0004);
}

TEST(Machine, DrawnCirclesTouchExactlyWhenTheGapIsZero) {
  const scene::Scene scene = ring_scene();
  for (const double magnification : {1.0, 7.0, 40.0}) {
    // Touching on the moved ring, in some direction.
    const Trajectory run = resting_run({.rotor_x = 1e-4 + 0.6 * kClearance,
                                        .rotor_y = -2e-4 + 0.8 * kClearance,
                                        .stator_x = 1e-4,
                                        .stator_y = -2e-4});
    const Playback playback(run);
    const Machine machine = make_machine(scene, one(playback), 0.0, 0.1, magnification);
    const DrawnSection section = drawn_section(machine, playback.at(0.05));
    ASSERT_TRUE(machine.contact);
    EXPECT_NEAR((section.rotor - section.ring).norm() + machine.contact->rotor_radius,
                machine.contact->ring_bore(), kRoundOff);
    EXPECT_NEAR((section.touch - section.rotor).norm(), machine.contact->rotor_radius, kRoundOff);
  }
}

TEST(Machine, ShaftPassesThroughTheRotorAtTheContact) {
  // The rig's second mode included: the line at the contact station is the plain sum.
  const scene::Scene rig = rig_of_two_modes();
  Trajectory run = resting_run({.rotor_x = 3e-4, .rotor_y = 1e-4});
  run.series.push_back({"x_2", "m", std::vector<double>(run.rows(), -1e-4)});
  run.series.push_back({"y_2", "m", std::vector<double>(run.rows(), 2e-4)});
  const Playback playback(run);
  const Machine machine = make_machine(rig, one(playback), 0.0, 0.1, 10.0);
  const Eigen::Matrix2Xd line = machine.centre_line(playback.at(0.05));
  const Eigen::Vector3d centre = machine.centre(line, machine.contact->z);
  // Straight pieces between the stations of the drawing stand for a curve.
  constexpr double kChords = 0.01;  // of the displacement
  EXPECT_NEAR(centre[1], machine.displaced(2e-4), kChords * machine.displaced(2e-4));
  EXPECT_NEAR(centre[2], machine.displaced(3e-4), kChords * machine.displaced(3e-4));
}

TEST(Machine, RigHasItsPartsAtTheirStations) {
  const scene::Scene rig = rig_of_two_modes();
  Trajectory run = resting_run({});
  run.series.push_back({"x_2", "m", std::vector<double>(run.rows(), 0.0)});
  run.series.push_back({"y_2", "m", std::vector<double>(run.rows(), 0.0)});
  const Playback playback(run);
  const Machine machine = make_machine(rig, one(playback), 0.0, 0.1, std::nullopt);
  EXPECT_DOUBLE_EQ(machine.unit, 1.0 / 0.6);
  ASSERT_EQ(machine.discs.size(), 1u) << "the sleeve is the rotor in the ring";
  EXPECT_DOUBLE_EQ(machine.discs[0].z, 0.5);
  EXPECT_NEAR(machine.discs[0].radius, 0.06 / 0.6, 1e-12);  // sqrt(2 J_p / m)
  EXPECT_EQ(machine.bearings.size(), 2u);
  EXPECT_NEAR(machine.contact->z, 0.4, 1e-12);
  EXPECT_NEAR(machine.contact->rotor_radius, 0.02 / 0.6, 1e-12);
  EXPECT_FALSE(machine.support.fixed);
  ASSERT_TRUE(machine.motor);
  EXPECT_EQ(*machine.motor, 0.0);
  EXPECT_FALSE(machine.magnetic_bearing) << "the scene has a force there, not a bearing";
  ASSERT_EQ(machine.loads.size(), 1u);
  EXPECT_NEAR(machine.loads[0].z, 0.42 / 0.6, 1e-12);
  // All of it stands above the base plate.
  EXPECT_LT(machine.floor, -machine.contact->ring_outer);
  EXPECT_LT(machine.floor, -machine.discs[0].radius);
}

TEST(Machine, SpringlessRotorStaysStraight) {
  const Trajectory run = resting_run({.rotor_x = 1e-4});
  const Playback playback(run);
  const Machine machine = make_machine(free_scene(), one(playback), 0.0, 0.1, 10.0);
  const Eigen::Matrix2Xd line = machine.centre_line(playback.at(0.05));
  EXPECT_NEAR(line.row(0).minCoeff(), line.row(0).maxCoeff(), kRoundOff);
  EXPECT_NEAR(line(0, 0), machine.displaced(1e-4), kRoundOff);
  EXPECT_TRUE(machine.bearings.empty());
}

TEST(Machine, FarMovingRingIsMagnifiedLess) {
  const scene::Scene scene = ring_scene();
  EXPECT_EQ(section_magnification(scene, 0.0), 40.0);
  EXPECT_LT(section_magnification(scene, 2e-3), 40.0);
  // But never so little that the clearance is lost.
  EXPECT_GE(section_magnification(scene, 1.0) * kClearance, 0.1 * 0.05);
}

}  // namespace
}  // namespace rotorub::renders
