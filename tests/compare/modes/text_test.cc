#include "compare/modes/result.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/oracles/shafts.h"

namespace rotorub {
namespace {

scene::Scene friswell() {
  scene::Scene s;
  s.name = "friswell";
  s.rotor.speed = 100.0;
  s.rotor.geometry = oracle::friswell_rotor();
  return s;
}

TEST(ModesJson, HasTheContractsShape) {
  const nlohmann::json result =
      result::json_of(modes_result("", analyse_rotor(friswell(), {0.0, 418.8790204786391})));
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
  const nlohmann::json result = result::json_of(modes_result("", analyse_rotor(friswell(), {})));
  ASSERT_EQ(result["speeds"].size(), 1u);
  EXPECT_EQ(result["speeds"][0]["speed"], 100.0);
}

TEST(ModesJson, GivesTheThreshold) {
  scene::Scene s = friswell();
  s.rotor.geometry->internal_damping_ratio = 0.01;
  const nlohmann::json result = result::json_of(modes_result("", analyse_rotor(s, {})));
  EXPECT_NEAR(result["stability_threshold"].get<double>(),
              result["critical_speeds"][0].get<double>(), 1e-6);
}

// The terminal lists the critical speeds near the speed of the rotor, the JSON all of them.
TEST(ModesTable, CountsTheCriticalSpeedsFarAbove) {
  const result::Section slow = modes_result("", analyse_rotor(friswell(), {1.0}));
  EXPECT_EQ(result::json_of(slow).at("critical").size(), 3u);
  EXPECT_NE(result::text_of(slow).find("and 2 higher critical speeds"), std::string::npos);
  const std::string fast = result::text_of(modes_result("", analyse_rotor(friswell(), {1e3})));
  EXPECT_EQ(fast.find("higher critical speed"), std::string::npos) << fast;
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
  EXPECT_NE(
      result::text_of(modes_result(s.name, analyse_rotor(s, {}))).find("stable up to 6324.6 rad/s"),
      std::string::npos);
  const nlohmann::json result = result::json_of(modes_result("", analyse_rotor(s, {})));
  EXPECT_TRUE(result["stability_threshold"].is_null());
  EXPECT_NEAR(result["stability_bound"].get<double>(), 20.0 * std::sqrt(1e5), 1e-6);
}

TEST(ModesTable, SaysWhatTheJsonSays) {
  scene::Scene s = friswell();
  const std::string stable = result::text_of(modes_result(s.name, analyse_rotor(s, {0.0})));
  EXPECT_NE(stable.find("friswell"), std::string::npos);
  EXPECT_NE(stable.find("backward          86.71405      13.80097"), std::string::npos) << stable;
  EXPECT_NE(stable.find("86.96099 rad/s (830.4163 rpm)"), std::string::npos) << stable;
  EXPECT_NE(stable.find("stable at all speeds"), std::string::npos);
  EXPECT_EQ(stable.back(), '\n');

  s.rotor.geometry->internal_damping_ratio = 0.01;
  EXPECT_NE(
      result::text_of(modes_result(s.name, analyse_rotor(s, {}))).find("unstable above 86.96"),
      std::string::npos);
}

// Further keys, which leave the contract's alone.
TEST(ModesJson, GivesModeShapes) {
  scene::Scene s = friswell();
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
  scene::Scene s = friswell();
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
