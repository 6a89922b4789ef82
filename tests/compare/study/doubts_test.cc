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

}  // namespace
}  // namespace rotorub
