// What `rotorub modes --feedback-map` says: the rule, its keys in a scene, the page.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "compare/modes/control_text.h"
#include "compare/report/linear_maps.h"
#include "native_model/scene/reader.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

using nlohmann::json;
using rub::FeedbackPoint;
using test::shipped;

FeedbackPoint point(double speed, double feedback, double growth) {
  FeedbackPoint p{speed, feedback, rub::Stability{}, 50.0, false};
  p.forced->growth = growth;
  p.forced->stable = growth < 0.0;
  return p;
}

// Stable at k = 0, and from 200 to 300 with the best at 300, at the first speed; nowhere at the
// second, where with k = 100 none lasts.
rub::FeedbackMap made_by_hand() {
  rub::FeedbackMap map{{100.0, 200.0}, {0.0, 100.0, 200.0, 300.0, 400.0}, {}};
  const double growths[] = {-1.0, 2.0, -3.0, -4.0, 1.0};
  for (int j = 0; j < 5; ++j) map.points.push_back(point(100.0, 100.0 * j, growths[j]));
  for (int j = 0; j < 5; ++j) map.points.push_back(point(200.0, 100.0 * j, 1.0 + j));
  map.points[6].forced.reset();
  map.points[6].normal_force.reset();
  map.points[6].whip = true;
  return map;
}

TEST(FeedbackMap, TheRuleIsTheFastestDecayAndItsStableStretch) {
  const rub::FeedbackMap map = made_by_hand();
  const auto rule = map.rule();
  ASSERT_EQ(rule.size(), 2U);
  ASSERT_TRUE(rule[0].has_value());
  EXPECT_EQ(rule[0]->point->feedback, 300.0);
  EXPECT_EQ(rule[0]->from, 200.0)
      << "the stretch about it, without the k = 0 beyond an unstable one";
  EXPECT_EQ(rule[0]->to, 300.0);
  EXPECT_FALSE(rule[1].has_value());
}

TEST(FeedbackMap, ItsPageHasNoNumberWhereNoRubLasts) {
  const rub::FeedbackMap map = made_by_hand();
  const json plots = feedback_map_plots(map);
  ASSERT_EQ(plots.at("figures").size(), plots.at("columns").size());
  for (const json& column : plots["columns"]) ASSERT_EQ(column.size(), 10U);
  EXPECT_EQ(plots["columns"][0][3], -4.0);
  EXPECT_TRUE(plots["columns"][0][6].is_null());
  EXPECT_TRUE(plots["columns"][2][6].is_null());
  EXPECT_EQ(plots["columns"][3][6], "whip or rolling");
  const std::string page = feedback_map_page(shipped("paper_cross_coupled"), map);
  EXPECT_TRUE(page.starts_with("<!doctype html>"));
  EXPECT_NE(page.find("at 1 of 2 speeds"), std::string::npos);
  EXPECT_NE(page.find("no forced rub is stable"), std::string::npos);
  EXPECT_NE(page.find("feedback = [300"), std::string::npos);
}

TEST(FeedbackMap, ItsKeysAreAScenes) {
  std::istringstream keys(feedback_keys(made_by_hand()));
  std::vector<std::string> overrides;
  for (std::string line; std::getline(keys, line);) overrides.push_back("controller." + line);
  ASSERT_EQ(overrides.size(), 2U);
  const scene::Scene read =
      scene::read_scene(std::string(ROTORUB_MJCF_DIR) + "/paper_cross_coupled.toml", overrides);
  EXPECT_EQ(read.first().controller->feedback, std::vector<double>{300.0});
  ASSERT_EQ(read.first().controller->feedback_speed.size(), 1U);
  EXPECT_NEAR(read.first().controller->feedback_speed[0], 100.0, 0.05);
}

// At each of its speeds the shipped k makes the rub decay nearly as fast as the best of a grid.
TEST(FeedbackMap, TheShippedScenesFollowTheRule) {
  const scene::Scene scene = shipped("paper_cross_coupled");
  EXPECT_EQ(scene.first().controller->feedback,
            shipped("paper_two_phase").first().controller->feedback);
  const rub::RubSystem system = rub::rub_system(scene);
  for (std::size_t i = 0; i < scene.first().controller->feedback.size(); ++i) {
    const std::vector<double> speed{scene.first().controller->feedback_speed[i]};
    const auto best = [&](const std::vector<double>& feedbacks) {
      const rub::FeedbackMap map = rub::feedback_map(system, speed, feedbacks);
      const auto choice = map.rule()[0];
      return choice ? choice->point->forced->growth : 0.0;
    };
    std::vector<double> grid;
    for (int k = 0; k <= 25; ++k) grid.push_back(100.0 * k);
    const double growth = best(grid);
    ASSERT_LT(growth, 0.0) << i;
    EXPECT_LE(best({scene.first().controller->feedback[i]}), 0.9 * growth) << i;
  }
}

}  // namespace
}  // namespace rotorub
