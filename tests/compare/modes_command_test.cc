#include "compare/modes_command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "native_model/oracles/friswell_rotor.h"

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
  const nlohmann::json result = modes_json(friswell(), {0.0, 418.8790204786391});
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
  const nlohmann::json result = modes_json(friswell(), {});
  ASSERT_EQ(result["speeds"].size(), 1u);
  EXPECT_EQ(result["speeds"][0]["speed"], 100.0);
}

TEST(ModesJson, GivesTheThreshold) {
  scene::Scene s = friswell();
  s.rotor.geometry->internal_damping_ratio = 0.01;
  const nlohmann::json result = modes_json(s, {});
  EXPECT_NEAR(result["stability_threshold"].get<double>(),
              result["critical_speeds"][0].get<double>(), 1e-6);
}

TEST(ModesTable, FreeBodyAndBoundedSearch) {
  scene::Scene s;
  s.name = "one";
  s.rotor.modal.emplace().mass = {2.0};
  s.rotor.modal->stiffness = {0.0};
  EXPECT_NE(modes_table(s, {}).find("rigid"), std::string::npos);

  // Threshold at 41 omega, beyond the search.
  s.rotor.modal->stiffness = {2e5};
  s.rotor.modal->damping = {40.0};
  s.rotor.modal->internal_damping = {1.0};
  EXPECT_NE(modes_table(s, {}).find("no whirl grows up to 6324.6 rad/s"), std::string::npos);
  const nlohmann::json result = modes_json(s, {});
  EXPECT_TRUE(result["stability_threshold"].is_null());
  EXPECT_NEAR(result["stability_bound"].get<double>(), 20.0 * std::sqrt(1e5), 1e-6);
}

TEST(ModesTable, SaysWhatTheJsonSays) {
  scene::Scene s = friswell();
  const std::string stable = modes_table(s, {0.0});
  EXPECT_NE(stable.find("friswell"), std::string::npos);
  EXPECT_NE(stable.find("backward          86.71405      13.80097"), std::string::npos) << stable;
  EXPECT_NE(stable.find("86.96099 rad/s (830.4163 rpm)"), std::string::npos) << stable;
  EXPECT_NE(stable.find("no whirl grows at any speed"), std::string::npos);
  EXPECT_EQ(stable.back(), '\n');

  s.rotor.geometry->internal_damping_ratio = 0.01;
  EXPECT_NE(modes_table(s, {}).find("unstable above 86.96"), std::string::npos);
}

}  // namespace
}  // namespace rotorub
