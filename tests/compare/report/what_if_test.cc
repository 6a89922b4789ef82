// The sliders of a scene: their keys, values and ranges, and that --set accepts them.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "compare/report/what_if.h"
#include "native_model/scene/reader.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

using nlohmann::json;

json slider(const json& sliders, const std::string& key) {
  for (const json& s : sliders)
    if (s.at("key") == key) return s;
  ADD_FAILURE() << "no slider " << key << " in " << sliders.dump(1);
  return {};
}

// page/what_if.js chooses the units and the ends of the sliders (tests/page/unit/what_if.test.js).
TEST(WhatIf, SlidersStandAtTheScenesValues) {
  const json sliders = sliders_of(test::shipped("paper_sliding"));
  const auto is = [&](const char* key, double value, const char* unit) {
    const json s = slider(sliders, key);
    EXPECT_EQ(s.at("unit"), unit) << key;
    EXPECT_NEAR(s.at("value").get<double>(), value, 1e-6 * value) << key;
  };
  is("contact.friction", 0.3, "1");
  is("contact.clearance", 0.5e-3, "m");
  is("contact.restitution", 0.5, "1");
  is("rotor.speed", 3000.0 / 30.0 * std::numbers::pi, "rad/s");
  is("controller.gap_time", 8e-3, "s");
  EXPECT_FALSE(slider(sliders, "controller.switching_gain").empty()) << "at its default";
  const json restitution = slider(sliders, "contact.restitution"),
             clearance = slider(sliders, "contact.clearance");
  EXPECT_EQ(restitution.at("low"), 0.0);
  EXPECT_EQ(restitution.at("high"), 1.0);
  EXPECT_EQ(clearance.at("low_open"), true) << "a clearance of 0 is refused";
  EXPECT_TRUE(clearance.at("high").is_null());
}

TEST(WhatIf, TheSpeedTakesWithItWhatKeepsStep) {
  const json also = {"drive.speed", "force[0].frequency"};
  EXPECT_EQ(slider(sliders_of(test::shipped("paper_passive")), "rotor.speed").at("also"), also);
  const json apart = {"force[0].frequency"};
  const auto scene = test::shipped("paper_passive", {"drive.speed=49 Hz"});
  EXPECT_EQ(slider(sliders_of(scene), "rotor.speed").at("also"), apart);
}

TEST(WhatIf, EachOfSeveralContactsHasItsOwn) {
  const json sliders = sliders_of(test::shipped("two_catchers"));
  EXPECT_FALSE(slider(sliders, "contact[0].clearance").empty());
  EXPECT_FALSE(slider(sliders, "contact[1].clearance").empty());
}

TEST(WhatIf, ALibraryOfTheUsersIsNotRunInAPage) {
  scene::Scene scene = test::shipped("paper_sliding");
  scene.auxiliary.front().controller->kind = scene::ControllerKind::kLibrary;
  scene.auxiliary.front().controller->library = "own.so";
  EXPECT_TRUE(sliders_of(scene).empty());
  scene = test::shipped("paper_sliding");
  scene.text.clear();
  EXPECT_TRUE(sliders_of(scene).empty());
}

TEST(WhatIf, OfEveryShippedSceneEverySliderIsTakenAtItsValue) {
  int tried = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ROTORUB_MJCF_DIR)) {
    if (entry.path().extension() != ".toml") continue;
    const scene::Scene scene = scene::read_scene(entry.path());
    for (const json& s : sliders_of(scene)) {
      if (!s.at("low").is_null()) {
        EXPECT_LE(s.at("low"), s.at("value")) << s;
      }
      if (!s.at("high").is_null()) {
        EXPECT_LE(s.at("value"), s.at("high")) << s;
      }
      const std::string unit = s.at("unit");
      std::vector<std::string> changes = {s.at("key").get<std::string>() + "=" +
                                          s.at("value").dump() + (unit == "1" ? "" : " " + unit)};
      EXPECT_NO_THROW(scene::parse_scene(scene.text, scene.name + ".toml", changes))
          << entry.path() << ": " << changes.front();
      ++tried;
    }
  }
  EXPECT_GT(tried, 100);
}

}  // namespace
}  // namespace rotorub
