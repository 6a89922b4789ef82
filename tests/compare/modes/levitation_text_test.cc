// What `rotorub modes` says of the closed loop of magnetic bearings.
#include "compare/modes/levitation_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "compare/modes/result.h"
#include "compare/modes/rotor_analysis.h"
#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

// S = (m s^2 - k_s) / (m s^2 + k_i D s + k_i P - k_s), as figures and as a file.
constexpr const char* kHung = R"(
[run]
end = 0.01
[rotor.modal]
mass = [2.0]
stiffness = [0.0]
[magnetic_bearing]
negative_stiffness = 1e5
[magnetic_bearing.control]
force_per_current = 80.0
proportional = 4000.0
derivative = 10.0
)";

TEST(LevitationText, PolesLoopsAndZones) {
  const RotorAnalysis analysis = analyse_rotor(scene::parse_scene(kHung, "hung.toml", {}), {});
  const nlohmann::json all = result::json_of(modes_result("", analysis))["speeds"][0]["levitation"];
  EXPECT_EQ(all["sample_time"], 0.0);
  EXPECT_TRUE(all["poles_refused"].is_null());
  ASSERT_EQ(all["poles"].size(), 4u);
  EXPECT_NEAR(all["poles"][0]["real"].get<double>(), -200.0, 1e-9);
  EXPECT_NEAR(std::abs(all["poles"][0]["imaginary"].get<double>()), std::sqrt(1.1e5 - 4e4), 1e-9);
  ASSERT_EQ(all["loops"].size(), 2u);
  EXPECT_EQ(all["loops"][1]["bearing"], 1);
  EXPECT_EQ(all["loops"][1]["axis"], "y");
  const double w = all["loops"][1]["frequency"];
  const double plant = -2.0 * w * w - 1e5;
  const double size = -plant / std::hypot(plant + 3.2e5, 800.0 * w);
  EXPECT_NEAR(all["loops"][1]["sensitivity"].get<double>(), size, 1e-9 * size);
  EXPECT_EQ(all["loops"][1]["zone"], "A");
  // zeta = 200 / sqrt(1.1e5).
  const nlohmann::json& step = all["loops"][0]["step"];
  const double overshoot = std::exp(-M_PI * 200.0 / std::sqrt(1.1e5 - 4e4));
  EXPECT_NEAR(step["overshoot"].get<double>(), overshoot, 1e-9);
  EXPECT_NEAR(step["steady"].get<double>(), 1.0 / 2.2e5, 1e-9 / 2.2e5);
  EXPECT_NEAR(step["static_stiffness"].get<double>(), 2.2e5, 1e-3);
  EXPECT_NEAR(step["largest_at"].get<double>(), M_PI / std::sqrt(1.1e5 - 4e4), 1e-9);
  EXPECT_EQ(all["loops"][0]["unbalance"], 0.0);
  const std::string text = result::text_of(modes_result("hung", analysis));
  EXPECT_NE(text.find("step of force on the rotor at each bearing"), std::string::npos);
  EXPECT_NE(text.find(fmt::format("{:.4g}", 100.0 * overshoot)), std::string::npos) << text;
  EXPECT_EQ(text.find("unbalance response"), std::string::npos) << "there is none";
  EXPECT_NE(text.find("closed loop of the magnetic bearings at 0 rad/s"), std::string::npos)
      << text;
  EXPECT_NE(text.find("zone of ISO 14839-3"), std::string::npos);
  EXPECT_EQ(text.find("no sensitivity"), std::string::npos);
  EXPECT_NE(text.find("Whirl without integrators, filters, amplifiers and sampling: stable at all"),
            std::string::npos)
      << text;
}

// An undamped bearing has poles on the axis up to round-off, which do not grow.
TEST(LevitationText, AnUndampedLoopDoesNotGrow) {
  Levitation undamped;
  undamped.poles = {{1e-13, 300.0}, {1e-13, -300.0}};
  EXPECT_EQ(instability_text(100.0, undamped),
            "The closed loop of the magnetic bearings is unstable at 954.93 rpm: a motion at 300 "
            "rad/s does not decay.");
  undamped.poles = {{2.5, 1e-9}, {-1e4, 0.0}};
  EXPECT_EQ(instability_text(-100.0, undamped),
            "The closed loop of the magnetic bearings is unstable at 954.93 rpm: a motion without "
            "oscillation grows at 2.5 1/s.");
  undamped.poles = {{-2.5, 0.0}};
  EXPECT_EQ(instability_text(100.0, undamped), "");
  undamped.poles_refused = "a library commands the magnetic bearings";
  EXPECT_EQ(instability_text(100.0, undamped),
            "Stability is unknown, because a library commands the magnetic bearings.");
}

TEST(LevitationText, SaysSoWhereTheLoopIsUnstableOrThereIsNone) {
  const RotorAnalysis grows = analyse_rotor(
      scene::parse_scene(kHung, "grows.toml",
                         std::vector<std::string>{"magnetic_bearing.amplifier={bandwidth=40.0}"}),
      {});
  const std::string text = result::text_of(modes_result("grows", grows));
  EXPECT_NE(text.find("The closed loop of the magnetic bearings is unstable at 0 rpm: a motion at"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("so it has no sensitivity and no zone of ISO 14839-3."), std::string::npos);
  for (const char* absent : {"step of force", "largest |S|", "stable at all speeds"})
    EXPECT_EQ(text.find(absent), std::string::npos) << absent;
  const nlohmann::json all = result::json_of(modes_result("", grows))["speeds"][0]["levitation"];
  ASSERT_EQ(all["loops"].size(), 2u);
  for (const char* key : {"sensitivity", "frequency", "zone", "step", "unbalance"})
    EXPECT_TRUE(all["loops"][0].at(key).is_null()) << key;
  EXPECT_EQ(all["loops"][1]["axis"], "y");
  const RotorAnalysis none = analyse_rotor(
      scene::parse_scene(
          kHung, "none.toml",
          std::vector<std::string>{"magnetic_bearing.control=none", "rotor.modal.stiffness=[2e5]"}),
      {});
  EXPECT_TRUE(result::json_of(modes_result("", none))["speeds"][0]["levitation"].is_null());
  EXPECT_EQ(result::text_of(modes_result("none", none)).find("closed loop"), std::string::npos);
}

}  // namespace
}  // namespace rotorub
