// The sliders of a scene: their keys, units and ranges, and that --set accepts them.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
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

TEST(WhatIf, SlidersStandAtTheScenesValuesInUnitsAsPeopleReadThem) {
  const json sliders = sliders_of(test::shipped("paper_sliding"));
  const auto is = [&](const char* key, double value, const char* unit, double low, double high) {
    const json s = slider(sliders, key);
    EXPECT_EQ(s.at("unit"), unit) << key;
    EXPECT_DOUBLE_EQ(s.at("value"), value) << key;
    EXPECT_DOUBLE_EQ(s.at("low"), low) << key;
    EXPECT_DOUBLE_EQ(s.at("high"), high) << key;
  };
  is("contact.friction", 0.3, "", 0.0, 0.6);
  is("contact.clearance", 0.5, "mm", 0.125, 1.0);
  is("contact.restitution", 0.5, "", 0.0, 1.0);
  is("rotor.speed", 3000.0, "rpm", 750.0, 6000.0);
  is("rotor.disc[0].eccentricity", 20.0, "um", 0.0, 40.0);
  is("controller.preload", 10.0, "N", 0.0, 20.0);
  is("controller.gap_time", 8.0, "ms", 2.0, 16.0);
  EXPECT_FALSE(slider(sliders, "controller.switching_gain").empty()) << "at its default";
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
      EXPECT_LT(s.at("low"), s.at("high"));
      EXPECT_LE(s.at("low"), s.at("value"));
      EXPECT_LE(s.at("value"), s.at("high"));
      const std::string unit = s.at("unit");
      std::vector<std::string> changes = {s.at("key").get<std::string>() + "=" +
                                          s.at("value").dump() + (unit.empty() ? "" : " " + unit)};
      EXPECT_NO_THROW(scene::parse_scene(scene.text, scene.name + ".toml", changes))
          << entry.path() << ": " << changes.front();
      ++tried;
    }
  }
  EXPECT_GT(tried, 100);
}

}  // namespace
}  // namespace rotorub
