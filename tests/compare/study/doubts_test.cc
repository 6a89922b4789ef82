#include "compare/run_files/doubts.h"

#include <gtest/gtest.h>

#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

scene::Scene scene_with(const std::string& speed, const std::string& contact) {
  return scene::parse_scene(
      "[run]\nend = 0.1\n[rotor]\nspeed = " + speed +
          "\n[rotor.modal]\nmass = [2.0]\nstiffness = [2e5]\ndamping = [40.0]\n"
          "[contact]\nradius = 0.05\nrestitution = 0.5\n" +
          contact,
      "made.toml");
}

TEST(Doubts, NameWhatIsHardlyMeantWithItsKey) {
  const auto of = [](const std::string& speed, const std::string& contact) {
    return doubts(scene_with(speed, contact));
  };
  EXPECT_TRUE(of("\"50 Hz\"", "clearance = \"0.5 mm\"\nfriction = 0.15\n").empty());
  // 0.4 where 0.4 mm was meant.
  const auto wide = of("\"50 Hz\"", "clearance = 0.4\nfriction = 0.15\n");
  ASSERT_EQ(wide.size(), 1U);
  EXPECT_TRUE(wide[0].starts_with("contact.clearance = 0.4 m is 8 times")) << wide[0];
  // rpm taken for rad/s.
  const auto fast = of("36000", "clearance = \"0.5 mm\"\nfriction = 0.15\n");
  ASSERT_EQ(fast.size(), 1U);
  EXPECT_NE(fast[0].find("1800 m/s"), std::string::npos) << fast[0];
  EXPECT_EQ(of("0.0", "clearance = 0.4\nfriction = 15.0\n").size(), 2U);
}

TEST(Doubts, NameALawThatNeverActs) {
  const auto of = [](const std::string& law) {
    return doubts(scene_with("\"50 Hz\"",
                             "clearance = \"0.5 mm\"\nfriction = 0.15\n[stator]\nmass = 1.0\n"
                             "stiffness = 1e5\ndamping = 100.0\n[controller]\nkind = \"pd\"\n" +
                                 law));
  };
  EXPECT_TRUE(of("on = 0.05\nsample_time = 1e-4\n").empty());
  const auto late = of("on = 0.1\n");
  ASSERT_EQ(late.size(), 1U);
  EXPECT_TRUE(late[0].starts_with("controller.on = 0.1 s")) << late[0];
  const auto seldom = of("sample_time = 10.0\n");
  ASSERT_EQ(seldom.size(), 1U);
  EXPECT_TRUE(seldom[0].starts_with("controller.sample_time = 10 s")) << seldom[0];
}

}  // namespace
}  // namespace rotorub
