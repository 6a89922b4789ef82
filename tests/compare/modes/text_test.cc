#include "compare/modes/result.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "compare/modes/answers.h"
#include "compare/modes/speed_margin.h"
#include "compare/starter/starter.h"
#include "native_model/scene/reader.h"
#include "tests/support/oracles/shafts.h"
#include "tests/support/said.h"

namespace rotorub {
namespace {

TEST(ModesJson, HasTheContractsShape) {
  const nlohmann::json result = result::json_of(
      modes_result("", analyse_rotor(oracle::friswell_scene(), {0.0, 418.8790204786391})));
  ASSERT_EQ(result.at("speeds").size(), 2u);
  EXPECT_EQ(result["speeds"][0].at("speed"), 0.0);
  const nlohmann::json& modes = result["speeds"][1].at("modes");
  ASSERT_EQ(modes.size(), oracle::kFriswellAt4000Rpm.size());
  double last = 0.0;
  for (std::size_t j = 0; j < modes.size(); ++j) {
    const double frequency = modes[j].at("frequency");
    EXPECT_NEAR(frequency, oracle::kFriswellAt4000Rpm[j], 5e-3);
    EXPECT_GE(std::abs(frequency), last) << "by rising absolute frequency";
    last = std::abs(frequency);
    EXPECT_TRUE(modes[j].at("damping_ratio").is_number());
  }
  EXPECT_EQ(result.at("critical_speeds").size(), 3u);
  EXPECT_TRUE(result.at("stability_threshold").is_null());
  EXPECT_TRUE(result.at("stability_bound").is_null()) << "undamped: nothing can grow";
}

TEST(ModesJson, WithoutSpeedsTakesTheScenes) {
  const nlohmann::json result =
      result::json_of(modes_result("", analyse_rotor(oracle::friswell_scene(), {})));
  ASSERT_EQ(result["speeds"].size(), 1u);
  EXPECT_EQ(result["speeds"][0]["speed"], 100.0);
}

TEST(ModesJson, GivesTheThreshold) {
  scene::Scene s = oracle::friswell_scene();
  s.rotor.geometry->internal_damping_ratio = 0.01;
  const nlohmann::json result = result::json_of(modes_result("", analyse_rotor(s, {})));
  EXPECT_NEAR(result["stability_threshold"].get<double>(),
              result["critical_speeds"][0].get<double>(), 1e-6);
}

// The terminal lists the first five critical speeds and those near the speed of the rotor, the JSON
// all of them.
TEST(ModesTable, CountsTheCriticalSpeedsFarAbove) {
  scene::Scene s = oracle::friswell_scene();
  const std::string few = result::text_of(modes_result("", analyse_rotor(s, {1.0})));
  EXPECT_EQ(few.find("higher critical speed"), std::string::npos) << "three in all";

  RotorAnalysis analysis = analyse_rotor(s, {1.0});
  analysis.critical_speeds = {1e3, 2e3, 3e3, 4e3, 5e3, 6e3, 7e3, 8e3};
  analysis.critical_senses.assign(analysis.critical_speeds.size(), WhirlSense::kForward);
  const result::Section slow = modes_result("", analysis);
  EXPECT_EQ(result::json_of(slow).at("critical").size(), 8u);
  EXPECT_TRUE(test::contains(result::text_of(slow), {"47,750 rpm (5000 rad/s), forward\n",
                                                     "and 3 higher critical speeds"}));
  analysis.spectra.front().speed = 2.5e3;
  const std::string fast = result::text_of(modes_result("", analysis));
  EXPECT_TRUE(test::contains(fast, {"66,850 rpm (7000 rad/s)", "and 1 higher critical speed,"}));
}

// The answers stand before the tables: critical speed, free orbit, stable rubs.
TEST(ModesTable, BeginsWithTheAnswers) {
  const scene::Scene s = scene::parse_scene(starter_scene({}), "pump.toml", {});
  RotorAnalysis analysis = analyse_rotor(s, {});
  const auto first_lines = [&] {
    // Without the line breaks.
    std::istringstream words(result::text_of(modes_result("pump", analysis)));
    std::string text;
    for (std::string word; words >> word && word != "damping";) text += word + " ";
    return text;
  };
  EXPECT_TRUE(test::contains(first_lines(),
                             {"The critical speed nearest to 3000 rpm is ",
                              "The free orbit at the contact, after the loss, reaches ",
                              "so contact is unavoidable.", "Stable rub", "synchronous rub at "}));
  EXPECT_EQ(first_lines().find("API 617 requires"), std::string::npos) << "not asked for";
  analysis.margin = speed_margin(s, analysis.critical_speeds);
  ASSERT_TRUE(analysis.margin && analysis.margin->required);
  // A damping ratio of 0.01 is an amplification factor of 50.
  EXPECT_NEAR(analysis.margin->amplification, 50.0, 0.5);
  EXPECT_TRUE(test::contains(first_lines(), "API 617 requires"));
  EXPECT_TRUE(test::contains(first_lines(), "% (AF "));
}

TEST(ModesTable, SaysThatCriticalSpeedsOnOilFilmsAreUndamped) {
  scene::Scene s = scene::parse_scene(starter_scene({}), "pump.toml", {});
  const auto answer = [&] { return result::text_of(modes_result("pump", analyse_rotor(s, {}))); };
  EXPECT_EQ(answer().find("(forward, undamped)"), std::string::npos);
  for (scene::ShaftBearing& bearing : s.rotor.geometry->bearings)
    bearing.cross_damping = {5.0, 5.0};
  EXPECT_TRUE(test::contains(answer(), "undamped)"));
}

TEST(ModesTable, WritesLongNumbersInGroups) {
  EXPECT_EQ(grouped(169987.0), "170,000");
  EXPECT_EQ(grouped(-41846.01), "-41,850");
  EXPECT_EQ(grouped(1234567.0), "1,235,000");
  EXPECT_EQ(grouped(4115.958), "4116");
  EXPECT_EQ(grouped(0.0), "0");
}

// A mode with nearly a node at the contact is scaled to its peak: no other value exceeds 1.
TEST(ModesTable, ScalesAModeWithANodeAtTheContactToItsPeak) {
  const std::vector<std::string> at_the_node{"contact.station=0.299"};
  const scene::Scene s = scene::parse_scene(starter_scene({}), "pump.toml", at_the_node);
  const RotorAnalysis analysis = analyse_rotor(s, {});
  ASSERT_TRUE(analysis.shapes);
  double largest = 0.0;
  for (Eigen::Index j = 0; j < 6; ++j)
    largest = std::max(largest, analysis.shapes->x.at_stations.col(j).cwiseAbs().maxCoeff());
  ASSERT_GT(largest, 10.0) << "in the coordinates of a run";
  const std::string text = result::text_of(modes_result("pump", analysis));
  const std::size_t from = text.find("mode shapes at rest"), to = text.find("higher modes", from);
  std::istringstream rows(text.substr(from, to - from));
  double shown = 0.0;
  for (std::string line; std::getline(rows, line);) {
    if (line.size() < 80 || line.find("Hz") != std::string::npos) continue;
    std::istringstream values(line.substr(line.size() - 6 * 13));
    for (double value = 0.0; values >> value;) shown = std::max(shown, std::abs(value));
  }
  EXPECT_GT(shown, 0.5);
  EXPECT_LT(shown, 10.0) << text.substr(from, to - from);
}

TEST(ModesTable, FreeBodyAndBoundedSearch) {
  scene::Scene s;
  s.name = "one";
  s.rotor.modal.emplace().mass = {2.0};
  s.rotor.modal->stiffness = {0.0};
  EXPECT_NE(result::text_of(modes_result("one", analyse_rotor(s, {}))).find("rigid"),
            std::string::npos);

  // Threshold at 41 omega, beyond the search.
  s.rotor.modal->stiffness = {2e5};
  s.rotor.modal->damping = {40.0};
  s.rotor.modal->internal_damping = {1.0};
  EXPECT_NE(result::text_of(modes_result(s.name, analyse_rotor(s, {})))
                .find("stable up to 60,400 rpm (6325 rad/s)"),
            std::string::npos);
  const nlohmann::json result = result::json_of(modes_result("", analyse_rotor(s, {})));
  EXPECT_TRUE(result["stability_threshold"].is_null());
  EXPECT_NEAR(result["stability_bound"].get<double>(), 20.0 * std::sqrt(1e5), 1e-6);
}

TEST(ModesTable, SaysWhatTheJsonSays) {
  scene::Scene s = oracle::friswell_scene();
  const std::string stable = result::text_of(modes_result(s.name, analyse_rotor(s, {0.0})));
  EXPECT_NE(stable.find("friswell"), std::string::npos);
  EXPECT_NE(stable.find("backward          86.71405      13.80097"), std::string::npos) << stable;
  EXPECT_NE(stable.find("830.4 rpm (86.96 rad/s)"), std::string::npos) << stable;
  EXPECT_NE(stable.find("stable at all speeds"), std::string::npos);
  EXPECT_EQ(stable.back(), '\n');

  s.rotor.geometry->internal_damping_ratio = 0.01;
  EXPECT_NE(result::text_of(modes_result(s.name, analyse_rotor(s, {})))
                .find("unstable above 830.4 rpm (86.96 rad/s)"),
            std::string::npos);
}

// Further keys, which leave the contract's alone.
TEST(ModesJson, GivesModeShapes) {
  scene::Scene s = oracle::friswell_scene();
  const RotorAnalysis analysis = analyse_rotor(s, {});
  const nlohmann::json shapes = result::json_of(modes_result("", analysis)).at("mode_shapes");
  EXPECT_EQ(shapes.at("same_planes"), true);
  const std::size_t points = shapes.at("z").size();
  ASSERT_EQ(shapes.at("stations").size(), 4u) << "two bearings, two discs";
  EXPECT_EQ(shapes["stations"][0], (nlohmann::json{{"kind", "bearing"},
                                                   {"name", "bearing 1"},
                                                   {"z", s.rotor.geometry->bearings[0].z}}));
  for (const char* plane : {"x", "y"}) {
    ASSERT_EQ(shapes.at(plane).size(), 3u);
    for (std::size_t j = 0; j < 3; ++j) {
      const nlohmann::json& mode = shapes[plane][j];
      EXPECT_NEAR(mode.at("frequency").get<double>(), oracle::kFriswellAtRest[j], 5e-3);
      ASSERT_EQ(mode.at("shape").size(), points);
      ASSERT_EQ(mode.at("at_stations").size(), 4u);
      EXPECT_EQ(mode["shape"][3].get<double>(),
                analysis.shapes->x.shape(3, static_cast<Eigen::Index>(j)));
    }
  }
  EXPECT_TRUE(result::json_of(modes_result("", analysis)).at("torsion").empty());
}

TEST(ModesJson, ModalFormHasNoShapes) {
  scene::Scene s;
  s.rotor.modal.emplace().mass = {2.0};
  s.rotor.modal->stiffness = {2e5};
  s.rotor.modal->damping = {40.0};
  s.rotor.torsion.emplace().inertia = {4e-4};
  s.rotor.torsion->stiffness = {36.0};
  s.rotor.torsion->damping = {0.012};
  const RotorAnalysis analysis = analyse_rotor(s, {});
  const nlohmann::json result = result::json_of(modes_result("", analysis));
  EXPECT_TRUE(result.at("mode_shapes").is_null());
  ASSERT_EQ(result.at("torsion").size(), 1u);
  EXPECT_NEAR(result["torsion"][0]["frequency"].get<double>(), 300.0, 1e-9);
  EXPECT_NEAR(result["torsion"][0]["damping_ratio"].get<double>(), 0.05, 1e-12);
  const std::string text = result::text_of(modes_result("one", analysis));
  EXPECT_NE(text.find("mode shapes: unknown"), std::string::npos) << text;
  EXPECT_NE(text.find("torsion, elastic modes"), std::string::npos) << text;
}

TEST(ModesTable, ShapesOfBothPlanesWhereTheyDiffer) {
  scene::Scene s = oracle::friswell_scene();
  EXPECT_NE(result::text_of(modes_result("a", analyse_rotor(s, {}))).find("planes x and y alike"),
            std::string::npos);
  s.rotor.geometry->bearings[0].stiffness.y() *= 0.5;
  const std::string text = result::text_of(modes_result("a", analyse_rotor(s, {})));
  EXPECT_NE(text.find("plane x\n"), std::string::npos) << text;
  EXPECT_NE(text.find("plane y\n"), std::string::npos) << text;
  EXPECT_NE(text.find("disc 2"), std::string::npos) << text;
}

}  // namespace
}  // namespace rotorub
