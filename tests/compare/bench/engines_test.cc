#include "compare/bench/engines.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "native_model/scene/reader.h"
#include "tests/support/said.h"

namespace rotorub::bench {
namespace {

using test::message_of;

TEST(Ladder, ReadsTimesInAnyUnit) {
  EXPECT_EQ(parse_steps("1e-6, 100us,10 us, 1e-5"), (std::vector<double>{1e-4, 1e-5, 1e-6}));
  EXPECT_EQ(parse_tolerances("1e-9,1e-6"), (std::vector<double>{1e-6, 1e-9}));
}

TEST(Ladder, SaysWhichEntryIsWrong) {
  for (const char* list : {"", "10us,", "10us,,1us", "0", "-1us", "3 kg", "nan"}) {
    const std::string why = message_of<std::invalid_argument>([&] { parse_steps(list); });
    EXPECT_NE(why.find("--steps"), std::string::npos) << "`" << list << "`: " << why;
  }
  EXPECT_NE(message_of<std::invalid_argument>([] { parse_steps("10us,-1us"); }).find("`-1us`"),
            std::string::npos);
  EXPECT_NE(
      message_of<std::invalid_argument>([] { parse_tolerances("1"); }).find("above 0 and below 1"),
      std::string::npos);
}

TEST(BenchEngines, AreChosenByNameOrFamily) {
  const auto names = [](const std::string& list) {
    std::vector<std::string> all;
    for (const BenchEngine& e : chosen_engines(list)) all.push_back(e.name);
    return all;
  };
  EXPECT_EQ(names("native-verlet"), std::vector<std::string>{"native-verlet"});
  EXPECT_EQ(names("mujoco"), (std::vector<std::string>{"mujoco-rigid", "mujoco-coulomb",
                                                       "mujoco-cone", "mujoco-cone-coulomb"}));
  EXPECT_EQ(names("native, mujoco-cone").size(), 3u);
  const auto all = names("");
  for (const char* name : {"native-event", "native-verlet", "penalty", "penalty-per-axis"}) {
    EXPECT_NE(std::find(all.begin(), all.end(), name), all.end()) << name;
  }
  const std::string why =
      message_of<std::invalid_argument>([] { chosen_engines("native,bullet"); });
  EXPECT_NE(why.find("`bullet`"), std::string::npos) << why;
  EXPECT_NE(why.find("mujoco-rigid"), std::string::npos) << "what is accepted: " << why;
}

TEST(BenchEngines, GiveASettingForEachStepOrTolerance) {
  const std::string file = std::string(ROTORUB_MJCF_DIR) + "/bench_ring.toml";
  const SceneReader reader = [&](const std::vector<std::string>& further) {
    return scene::read_scene(file, further);
  };
  const Ladder ladder{{1e-4, 1e-5}, {1e-6, 1e-9, 1e-12}};
  const auto settings = [&](const char* name) {
    return chosen_engines(name)[0].settings(reader, ladder);
  };
  const auto event = settings("native-event");
  ASSERT_EQ(event.size(), 3u);
  EXPECT_FALSE(event[0].step);
  EXPECT_EQ(event[1].setting, "tolerance 1e-09");
  EXPECT_EQ(settings("native-verlet").size(), 2u);
  EXPECT_EQ(settings("penalty").size(), 12u) << "four stiffnesses explicit, two implicit";
  const auto coulomb = settings("mujoco-coulomb");
  ASSERT_EQ(coulomb.size(), 6u) << "Euler, implicit, and a stiffness of its own";
  for (const Setting& s : coulomb) {
    EXPECT_EQ(s.refusal, "");
    ASSERT_TRUE(s.scene);
  }
  EXPECT_EQ(coulomb[2].scene->mujoco.integrator, scene::MujocoIntegrator::kImplicit);
  EXPECT_EQ(coulomb[4].scene->mujoco.solref_stiffness, kFixedStiffness);
}

}  // namespace
}  // namespace rotorub::bench
