#include "renders/machine.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <utility>

#include "renders/instant.h"
#include "renders/machine_view.h"
#include "renders/stage.h"
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
  const Trajectory run =
      with_second_mode(resting_run({.rotor_x = 3e-4, .rotor_y = 1e-4}), -1e-4, 2e-4);
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
  const Trajectory run = with_second_mode(resting_run({}), 0.0, 0.0);
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
  EXPECT_TRUE(machine.magnetic_bearings.empty()) << "the scene has a force there, not a bearing";
  ASSERT_EQ(machine.loads.size(), 1u);
  EXPECT_NEAR(machine.loads[0].z, 0.42 / 0.6, 1e-12);
  // Everything is above the base plate.
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
  // It is never so small that the clearance disappears.
  EXPECT_GE(section_magnification(scene, 1.0) * kClearance, 0.1 * 0.05);
}

Machine machine_of(const scene::Scene& scene, std::optional<double> magnification = {}) {
  const Trajectory run = resting_run({});
  const Playback playback(run);
  return make_machine(scene, one(playback), 0.0, 0.1, magnification);
}

// A second ring with a fifth of the clearance could be magnified five times as much.
TEST(Machine, SeveralContactsShareAScaleInAnyOrder) {
  scene::Scene scene = ring_scene();
  const double section = section_magnification(scene, 0.0),
               machine = machine_of(scene).magnification;
  scene.auxiliary.push_back(scene.first());
  scene.auxiliary[1].contact->clearance = 0.2 * kClearance;
  for (const char* order : {"wide ring first", "narrow ring first"}) {
    SCOPED_TRACE(order);
    EXPECT_EQ(section_magnification(scene, 0.0), section);
    EXPECT_EQ(machine_of(scene).magnification, machine);
    std::swap(scene.auxiliary[0], scene.auxiliary[1]);
  }
}

const char* const kIdeal = "[actuator]\nforce_limit = 600.0\n";
const char* const kMagnets =
    "[actuator]\nkind = \"electromagnet\"\nforce_constant = 6e-6\nbias_current = 2.0\n"
    "air_gap = \"1 mm\"\nstiffness = 0.0\n";

// Bodies of one colour whose axis lies across the shaft at 45 degrees, as that of a strut.
int struts(const scene::Scene& scene, const Color& color) {
  const MujocoErrors errors;
  std::vector<Mesh> meshes;
  const MachineView view(machine_of(scene, 40.0), meshes);
  Stage stage({64, 64, 0, {1.0F, 1.0F, 1.0F}}, meshes);
  const Trajectory run = resting_run({});
  const Playback playback(run);
  view.draw(stage.canvas(), instant_at(playback, 0.05, {}, {}), nullptr);
  int count = 0;
  for (int k = 0; k < stage.scene().ngeom; ++k) {
    const mjvGeom& geom = stage.scene().geoms[k];
    const double y = std::abs(static_cast<double>(geom.mat[5]));  // the third column: the axis
    const double z = std::abs(static_cast<double>(geom.mat[8]));
    const bool colored = geom.rgba[0] == color.red && geom.rgba[1] == color.green;
    if (geom.type == mjGEOM_CYLINDER && colored && std::abs(y - z) < 0.2 && y > 0.5) ++count;
  }
  return count;
}

TEST(Support, AFixedRingHasAHousingAndNoStruts) {
  const scene::Scene fixed = modal_scene("");
  EXPECT_TRUE(machine_of(fixed).support.fixed);
  EXPECT_EQ(struts(fixed, palette::kHousing), 0);
  EXPECT_EQ(struts(fixed, palette::kShaft), 0);
}

TEST(Support, ActuatorsAreThoseOfTheScene) {
  const DrawnSupport springs = machine_of(modal_scene(kElasticRing)).support;
  EXPECT_TRUE(springs.spring_x && springs.spring_y);
  EXPECT_FALSE(springs.fixed || springs.actuators || springs.magnets);
  EXPECT_GT(struts(modal_scene(kElasticRing), palette::kHousing), 4) << "the turns of two springs";

  const scene::Scene ideal = modal_scene(kElasticRing + kIdeal);
  EXPECT_TRUE(machine_of(ideal).support.actuators);
  EXPECT_FALSE(machine_of(ideal).support.magnets);
  EXPECT_EQ(struts(ideal, palette::kHousing), 2);
  EXPECT_EQ(struts(ideal, palette::kCopper), 0);

  const scene::Scene magnets = modal_scene(kElasticRing + kMagnets);
  EXPECT_TRUE(machine_of(magnets).support.magnets);
  EXPECT_EQ(struts(magnets, palette::kCopper), 2);
}

TEST(Support, ASpringOfOnePlaneIsDrawnThere) {
  const DrawnSupport support =
      machine_of(modal_scene("[stator]\nmass = 1.0\ndamping = 200.0\nstiffness = [1e5, 0.0]\n"))
          .support;
  EXPECT_TRUE(support.spring_x);
  EXPECT_FALSE(support.spring_y);
}

TEST(Support, ForcesAreThoseOfTheScene) {
  EXPECT_TRUE(machine_of(modal_scene("")).loads.empty());
  const Machine loaded = machine_of(modal_scene(
      "[[force]]\nkind = \"rotating\"\namplitude = 150.0\nfrequency = 0.0\non = 0.02\n"));
  ASSERT_EQ(loaded.loads.size(), 1U);
  EXPECT_EQ(loaded.largest_load, 150.0);
  EXPECT_EQ(loaded.loads[0].force.at(0.01, 0.0).norm(), 0.0);
  EXPECT_NEAR(loaded.loads[0].force.at(0.03, 0.0)[0], 150.0, 1e-9);
  EXPECT_TRUE(loaded.magnetic_bearings.empty());
}

}  // namespace
}  // namespace rotorub::renders
