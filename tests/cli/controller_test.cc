// The user's own controller on the command line, and what a control engineer asks of a scene.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

const std::string kLibraries = ROTORUB_LIBRARIES;

std::vector<std::string> run_with(const std::string& library, const std::vector<std::string>& more) {
  std::vector<std::string> all{"run", shipped("paper_sliding"), "--controller", kLibraries + "/" + library,
                               "--set", "controller.sample_time=\"50 us\"", "--set", "rotor.modes=2",
                               "--end", "5 ms", "-o", "out", "--json"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST(CliController, ALibraryTakesThePlaceOfTheScenes) {
  const Folder folder;
  const Outcome native =
      folder.run(run_with("own_controller.so", {"--set", "controller.config.stiffness=1e5", "--set",
                                                "controller.on=0"}));
  ASSERT_EQ(native.code, 0) << native.err;
  EXPECT_TRUE(contains(folder.text("out/series.csv"), "control_x")) << "as any controller";
  const Outcome mujoco = folder.run(run_with(
      "own_controller.so", {"--engine", "mujoco", "--set", "controller.config.stiffness=1e5"}));
  ASSERT_EQ(mujoco.code, 0) << mujoco.err << ": a scene that was given may load what it names";
  const Outcome film = folder.run({"render", "out", "--json", "--png", "--size", "320x180"});
  EXPECT_EQ(film.code, 0) << film.err << ": its results are complete where they lie";
}

TEST(CliController, AFailureIsExit3WithNameAndTime) {
  const Folder folder;
  for (const char* engine : {"native", "mujoco"}) {
    const Outcome done = folder.run(run_with(
        "faulty_controller.so", {"--engine", engine, "--set", "controller.config.fault=\"nan\"", "--set",
                                 "controller.config.at=0.002", "--set", "controller.on=0"}));
    EXPECT_EQ(done.code, 3) << done.err;
    EXPECT_TRUE(contains(done.err, "controller_failed")) << done.err;
    EXPECT_TRUE(contains(done.err, "faulty at t = 0.002")) << done.err;
    EXPECT_EQ(nlohmann::json::parse(done.out).at("status"), "controller_failed");
  }
}

TEST(CliController, WhatCannotBeLoadedIsExit2) {
  const Folder folder;
  const Outcome none = folder.run({"run", shipped("paper_sliding"), "--controller", "nowhere.so"});
  EXPECT_EQ(none.code, 2);
  EXPECT_TRUE(contains(none.err, "nowhere.so")) << none.err;
  const Outcome other = folder.run(run_with("other_abi_controller.so", {}));
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(contains(other.err, "controller.library")) << other.err;
}

TEST(CliModes, GivesThePlantOfAController) {
  const Folder folder;
  const Outcome done =
      folder.run({"modes", shipped("paper_sliding"), "--state-space", "--set", "rotor.modes=2"});
  ASSERT_EQ(done.code, 0) << done.err;
  const auto plant = nlohmann::json::parse(done.out);
  EXPECT_EQ(plant.at("A").size(), 12u);
  EXPECT_EQ(plant.at("A")[0].size(), 12u);
  EXPECT_EQ(plant.at("B").size(), 12u);
  EXPECT_EQ(plant.at("C").size(), 4u);
  EXPECT_EQ(plant.at("states")[4], "stator_x");
  EXPECT_EQ(plant.at("A")[10][4], -2e5 / 1.5) << "the ring's spring";
  EXPECT_EQ(plant.at("B")[10][0], 1.0 / 1.5);
}

TEST(CliModes, MapsTheFeedbackThatCalmsARub) {
  const Folder folder;
  const std::string scene = shipped("paper_cross_coupled");
  const std::vector<std::string> asked{"modes", scene, "--feedback-map", "--set", "rotor.modes=2",
                                       "--speeds", "40Hz:60Hz:3", "--feedbacks", "0:4000:9"};
  const Outcome table = folder.run(asked);
  ASSERT_EQ(table.code, 0) << table.err;
  EXPECT_TRUE(contains(table.out, "N s/m")) << table.out;
  EXPECT_TRUE(contains(table.out, "feedback_speed = [\"40 Hz\"")) << table.out;
  auto in_json = asked;
  in_json.push_back("--json");
  const auto map = nlohmann::json::parse(folder.run(in_json).out).at("feedback_map");
  EXPECT_EQ(map.at("growth").size(), 3u);
  EXPECT_EQ(map.at("growth")[0].size(), 9u);
  EXPECT_EQ(map.at("rule").size(), 3u);
  const Outcome sliding = folder.run({"modes", shipped("paper_sliding"), "--feedback-map"});
  EXPECT_EQ(sliding.code, 2);
  EXPECT_TRUE(contains(sliding.err, "controller.kind")) << sliding.err;
}

}  // namespace
}  // namespace rotorub::test
