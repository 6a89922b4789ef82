// What holds the ring, and what acts on the shaft, is drawn as the scene has it.
#include <gtest/gtest.h>

#include <array>

#include "renders/machine_view.h"
#include "renders/palette.h"
#include "renders/stage.h"
#include "tests/renders/samples.h"

namespace rotorub::renders {
namespace {

const char* const kIdeal = "[actuator]\nforce_limit = 600.0\n";
const char* const kMagnets =
    "[actuator]\nkind = \"electromagnet\"\nforce_constant = 6e-6\nbias_current = 2.0\n"
    "air_gap = \"1 mm\"\nstiffness = 0.0\n";

Machine machine_of(const scene::Scene& scene) {
  const Trajectory run = resting_run({});
  const Playback playback(run);
  const std::array<const Playback*, 1> runs = {&playback};
  return make_machine(scene, runs, 0.0, 0.1, 40.0);
}

// Bodies of one colour whose axis lies across the shaft at 45 degrees, as that of a strut.
int struts(const scene::Scene& scene, const Color& color) {
  const MujocoErrors errors;
  std::vector<Mesh> meshes;
  const MachineView view(machine_of(scene), meshes);
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
  EXPECT_FALSE(loaded.magnetic_bearing);
}

}  // namespace
}  // namespace rotorub::renders
