// A scene's text with values replaced.
#include "compare/tune/setting.h"

#include <gtest/gtest.h>

#include "native_model/scene/reader.h"

namespace rotorub::tune {
namespace {

using scene::ContactModel;
using scene::MujocoIntegrator;
using scene::MujocoSolver;

constexpr const char* kScene = R"(# why this scene
[run]
end = 0.5
step = "10 us"   # of everything

# the shaft
[rotor]
speed = "50 Hz"
)";

TEST(WithValues, KeepsCommentsAndOrder) {
  EXPECT_EQ(with_values(kScene, {{"run", "step", "5e-05"}, {"mujoco", "contact", "\"rigid\""}}),
            R"(# why this scene
[run]
end = 0.5
step = 5e-05  # of everything

# the shaft
[rotor]
speed = "50 Hz"

[mujoco]
contact = "rigid"
)");
}

TEST(WithValues, AddsBehindTheLastKeyAndTakesAway) {
  EXPECT_EQ(with_values("[mujoco]\nsolref_stiffness = 1e8\ncontact = \"cone\"\n\n[run]\nend = 1\n",
                        {{"run", "step", "1e-05"},
                         {"mujoco", "integrator", "\"implicit\""},
                         {"mujoco", "solref_stiffness", "", true},
                         {"mujoco", "solver", "\"newton\"", true}}),
            "[mujoco]\ncontact = \"cone\"\nintegrator = \"implicit\"\n\n[run]\nend = 1\nstep = "
            "1e-05\n");
}

// The written text reads back as the setting, for every variant and any previous text.
TEST(TunedText, ReadsAsTheSetting) {
  const std::string shipped = scene::file_text(std::string(ROTORUB_MJCF_DIR) + "/bench_ring.toml");
  for (const std::string& before :
       {shipped, shipped + "\n[mujoco]\ncontact = \"cone\"\nsolref_stiffness = 1e7 # by hand\n"}) {
    for (Setting setting : variants({})) {
      setting.step = 2e-5;
      const TunedText tuned = tuned_text(before, "ring.toml", setting);
      const scene::Scene scene = scene::parse_scene(tuned.text, "ring.toml");
      EXPECT_TRUE(tuned.comments_kept);
      EXPECT_NE(tuned.text.find("# A Jeffcott rotor"), std::string::npos);
      EXPECT_EQ(scene.run.step, 2e-5);
      EXPECT_EQ(scene.mujoco.contact, setting.contact) << text(setting);
      EXPECT_EQ(scene.mujoco.integrator, setting.integrator) << text(setting);
      if (setting.contact == ContactModel::kRigid) continue;
      EXPECT_EQ(scene.mujoco.solver, setting.solver) << text(setting);
      EXPECT_EQ(scene.mujoco.solref_stiffness, setting.stiffness) << text(setting);
    }
  }
}

TEST(TunedText, WritesAnewWhatHasNoHeaders) {
  std::string dotted = scene::file_text(std::string(ROTORUB_MJCF_DIR) + "/bench_ring.toml");
  const std::size_t at = dotted.find("[run]\nend = 0.5\nstep = 1e-5\n");
  ASSERT_NE(at, std::string::npos);
  dotted.replace(at, 28, "run = {end = 0.5, step = 1e-5}\n");
  Setting setting;
  setting.step = 2e-5;
  const TunedText tuned = tuned_text(dotted, "ring.toml", setting);
  EXPECT_FALSE(tuned.comments_kept);
  EXPECT_EQ(scene::parse_scene(tuned.text, "ring.toml").run.step, 2e-5);
}

TEST(Variants, HoldTheScenesOwnOnce) {
  scene::Mujoco own;
  EXPECT_EQ(variants(own).size(), 29U);
  own.contact = ContactModel::kCone;
  own.integrator = MujocoIntegrator::kRk4;
  own.solver = MujocoSolver::kPgs;
  EXPECT_EQ(variants(own).size(), 30U);
  EXPECT_EQ(variants(own).back().integrator, MujocoIntegrator::kRk4);
}

}  // namespace
}  // namespace rotorub::tune
