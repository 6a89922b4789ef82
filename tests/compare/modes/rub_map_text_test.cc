// What `rotorub modes` says of lasting rubs: JSON, table and the map's picture and page.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "compare/modes/rub_analysis.h"
#include "compare/modes/rub_map_text.h"
#include "compare/modes/rub_result.h"
#include "native_model/scene/reader.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

using test::shipped;

using nlohmann::json;

TEST(RubJson, OfTheWhip) {
  const scene::Scene scene = shipped("bench_whip");
  const RubAnalyses rubs = analyse_rubs(scene, {scene.rotor.speed}).front();
  ASSERT_EQ(rubs.at.size(), 1U);
  const json whip = result::json_of(rub_result(rubs.at[0]));
  ASSERT_EQ(whip.at("rubs").size(), 4U);
  const json& stable = whip["rubs"][1];
  EXPECT_EQ(stable.at("kind"), "whip");
  EXPECT_EQ(stable.at("stable"), true);
  EXPECT_NEAR(stable.at("whirl").get<double>(), -501.9257, 5e-5);
  EXPECT_NEAR(stable.at("normal_force").get<double>(), 244.8444, 5e-5);
  EXPECT_EQ(whip.at("attractors"), json({"no contact", "backward whip", "rolling"}));
  EXPECT_TRUE(whip.at("rolling_ranges")[1][1].is_null()) << "to infinity";
  EXPECT_EQ(whip.at("ring").size(), 2U);
  EXPECT_EQ(whip.at("joined").size(), 2U);
  const std::string table = result::text_of(rub_result(rubs.at[0]));
  EXPECT_NE(table.find("-501.9 "), std::string::npos) << table;
  EXPECT_NE(table.find("whirl speeds of 380.9469 to 501.9257"), std::string::npos) << table;
}

// A point about which nothing can move has no growth rate, not minus infinity.
TEST(RubJson, HasNumbersOrNull) {
  const scene::Scene scene = shipped("bench_annular_rigid");
  const RubAnalyses rubs = analyse_rubs(scene, {scene.rotor.speed}).front();
  const json point = result::json_of(rub_result(rubs.at.at(0)));
  EXPECT_EQ(point.at("rubs").back().at("kind"), "rolling");
  EXPECT_TRUE(point.at("rubs").back().at("growth_rate").is_null());
  EXPECT_EQ(result::text_of(rub_result(rubs.at[0])).find("inf"), std::string::npos);
}

// Torsion and the motor: each rub once more, and the rolling that the motor keeps; none of it where
// both are held.
TEST(RubJson, WhereTorsionAndTheSpeedGiveWay) {
  const scene::Scene scene = shipped("paper_rolling");
  const RubAnalyses rubs = analyse_rubs(scene, {scene.rotor.speed}).front();
  const json point = result::json_of(rub_result(rubs.at.at(0)));
  ASSERT_EQ(point.at("driven").size(), point.at("rubs").size());
  const json& rolling = point.at("driven_rolling").back();
  EXPECT_EQ(rolling.at("stable"), true);
  EXPECT_NEAR(rolling.at("speed").get<double>(), 196.09, 0.01);
  EXPECT_NEAR(rolling.at("torque").get<double>(),
              0.5 * (scene.drive->speed - rolling.at("speed").get<double>()), 1e-6);
  const std::string table = result::text_of(rub_result(rubs.at[0]));
  EXPECT_NE(table.find("at a speed that the motor sustains"), std::string::npos) << table;

  EXPECT_FALSE(
      result::json_of(rub_result(analyse_rubs(shipped("bench_whip"), {314.0}).front().at.at(0)))
          .contains("driven"));
  const scene::Scene follows = shipped("run_up");  // its torque depends on time too
  EXPECT_FALSE(
      result::json_of(rub_result(analyse_rubs(follows, {follows.rotor.speed}).front().at.at(0)))
          .contains("driven"));
}

// Each while the others are open: what the scene with that contact alone has, its modes scaled
// there.
TEST(RubAnalyses, OfSeveralContactsAreThoseOfEachAlone) {
  const scene::Scene one = shipped("bench_whip");
  scene::Scene two = one;
  two.auxiliary.push_back(one.first());
  two.auxiliary[1].contact->shape = {-0.5};
  two.auxiliary[1].name = "other end";
  const std::vector<RubAnalyses> rubs = analyse_rubs(two, {one.rotor.speed});
  ASSERT_EQ(rubs.size(), 2u);
  EXPECT_EQ(rubs[1].contact, "other end");
  // A mode of -0.5 at the contact is one of four times the mass, stiffness and damping that is 1
  // there.
  scene::Scene scaled = one;
  scaled.rotor.modal->mass = scaled.rotor.modal->mass_y = {4.0 * one.rotor.modal->mass[0]};
  scaled.rotor.modal->stiffness =
      scaled.rotor.modal->stiffness_y = {4.0 * one.rotor.modal->stiffness[0]};
  scaled.rotor.modal->damping = scaled.rotor.modal->damping_y = {4.0 * one.rotor.modal->damping[0]};
  for (const auto& [found, of] : {std::pair(&rubs[0], &one),
                                  std::pair(&rubs[1], static_cast<const scene::Scene*>(&scaled))}) {
    const RubAnalyses exact = analyse_rubs(*of, {one.rotor.speed}).front();
    ASSERT_EQ(found->at.size(), 1u) << found->refused;
    ASSERT_EQ(found->at[0].point.rubs.size(), exact.at[0].point.rubs.size());
    ASSERT_FALSE(exact.at[0].point.rubs.empty());
    for (std::size_t k = 0; k < exact.at[0].point.rubs.size(); ++k) {
      const rub::SteadyRub &a = found->at[0].point.rubs[k].rub, &b = exact.at[0].point.rubs[k].rub;
      EXPECT_NEAR(a.whirl, b.whirl, 1e-9 * std::abs(b.whirl));
      EXPECT_NEAR(a.normal_force, b.normal_force, 1e-9 * b.normal_force);
    }
  }
}

TEST(RubAnalyses, SaysWhyThereAreNone) {
  const scene::Scene sliding = shipped("paper_sliding");
  const RubAnalyses rubs = analyse_rubs(sliding, {sliding.rotor.speed}).front();
  EXPECT_TRUE(rubs.at.empty());
  EXPECT_NE(rubs.refused.find("controller.kind"), std::string::npos) << rubs.refused;
  scene::Scene sampled = shipped("bench_whip");
  sampled.magnetic_bearings.resize(1);
  scene::BearingControl& control = sampled.magnetic_bearings[0].control.emplace();
  control.force_per_current = 100.0;
  control.proportional = 1000.0;
  EXPECT_EQ(analyse_rubs(sampled, {100.0}).front().refused, "");
  control.sample_time = 1e-4;
  EXPECT_NE(analyse_rubs(sampled, {100.0}).front().refused.find("control.sample_time"),
            std::string::npos);
  scene::Scene open = shipped("bench_whip");
  open.first().contact.reset();
  EXPECT_EQ(analyse_rubs(open, {100.0}).front().refused, "");
}

class RubMapOfTheWhip : public testing::Test {
 protected:
  RubMapOfTheWhip()
      : scene(shipped("bench_whip")),
        map(rub::rub_map(rub::rub_system(scene), even_values(200.0, 400.0, 3), {0.1, 0.2, 0.25})) {}
  static std::vector<double> even_values(double from, double to, int count) {
    std::vector<double> all;
    for (int k = 0; k < count; ++k) all.push_back(from + (to - from) * k / (count - 1));
    return all;
  }
  scene::Scene scene;
  rub::RubMap map;
};

TEST_F(RubMapOfTheWhip, AsAPicture) {
  const std::string picture = result::text_of(rub_map_picture("whip", map));
  EXPECT_NE(picture.find("     0.25 |OOO\n      0.2 |VVV\n      0.1 |OOO\n"), std::string::npos)
      << picture;
  EXPECT_NE(picture.find("V  no contact + backward whip + rolling"), std::string::npos) << picture;
  EXPECT_EQ(picture.find("synchronous"), std::string::npos) << "only what occurs is explained";
}

TEST_F(RubMapOfTheWhip, AsJson) {
  const json all = rub_map_json(map);
  EXPECT_EQ(all.at("speeds"), json({200.0, 300.0, 400.0}));
  EXPECT_EQ(all.at("frictions"), json({0.1, 0.2, 0.25}));
  ASSERT_EQ(all.at("points").size(), 9U);
  EXPECT_EQ(all["points"][5].at("speed"), 300.0);
  EXPECT_EQ(all["points"][5].at("friction"), 0.25);
}

// Over other keys each point is a scene of its own; over speed and friction it is the map of old.
TEST_F(RubMapOfTheWhip, OverAnyTwoKeys) {
  const scene::Variants scenes(std::string(ROTORUB_MJCF_DIR) + "/bench_whip.toml");
  const RubKeyMap same =
      rub_key_map(scenes, {kSpeedKey, "rad/s", map.speeds}, {kFrictionKey, "", map.frictions});
  EXPECT_EQ(rub_map_json(same), rub_map_json(map));

  const RubKeyMap other = rub_key_map(scenes, {"contact.clearance", "m", {-1.0, 2e-4, 1e-3}},
                                      {kFrictionKey, "", {0.2, 0.25}});
  EXPECT_FALSE(other.at(0, 0)) << "no clearance is below 0";
  EXPECT_NE(other.refused.find("contact.clearance"), std::string::npos) << other.refused;
  const scene::Scene one = scene::read_scene(
      std::string(ROTORUB_MJCF_DIR) + "/bench_whip.toml",
      std::vector<std::string>{"contact.clearance=1e-3", "contact.friction=0.25"});
  const rub::RubSystem system = rub::rub_system(one);
  EXPECT_EQ(result::json_of(rub_point_result(*other.at(2, 1))),
            result::json_of(rub_point_result(rub::RubStudy(system).at(system.friction))));
  const json all = rub_map_json(other);
  EXPECT_EQ(all.at("across").at("key"), "contact.clearance");
  EXPECT_TRUE(all.at("points")[0].is_null());
  const std::string picture = result::text_of(rub_map_picture("whip", other));
  EXPECT_NE(picture.find("contact.clearance / m"), std::string::npos) << picture;
  EXPECT_NE(picture.find("Blank: refused"), std::string::npos) << picture;
  EXPECT_TRUE(rub_columns(other.points).at("attractors")[0].is_null());
}

TEST_F(RubMapOfTheWhip, AsAPage) {
  const json columns = rub_columns(RubKeyMap(map).points);
  for (const json& column : columns) EXPECT_EQ(column.size(), 9U);
  EXPECT_EQ(columns.at("attractors")[4], "no contact + backward whip + rolling");
  EXPECT_TRUE(columns.at("rub_growth")[4].is_null()) << "no load, no synchronous rub";
  const json parts = page_json(rub_map_picture("whip", map));
  ASSERT_EQ(parts.size(), 1U) << "the legend without the letters of the picture";
  EXPECT_EQ(parts[0].at("rows").back().at("cells"),
            json({"no contact + backward whip + rolling", "33.3 %"}));
}

// What `rotorub modes --feedback-map` says: the rule, its keys in a scene, the page.

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
  const result::Section found = feedback_map_result("x", map);
  const json data = json_of(found).at("feedback_map");
  EXPECT_EQ(data.at("growth")[0][3], -4.0);
  for (const char* key : {"growth", "frequency", "normal_force"})
    EXPECT_TRUE(data.at(key)[1][1].is_null()) << key;
  EXPECT_EQ(data.at("whip")[1], json({false, true, false, false, false}));
  const json rule = page_json(found).at(0);
  ASSERT_EQ(rule.at("rows").size(), 2U);
  EXPECT_EQ(rule.at("columns")[1].at("text"), "k / N s/m");
  EXPECT_EQ(rule.at("rows")[0].at("cells"), json({"15.92", "300", "200", "300", "4", "50", ""}));
  const std::string text = text_of(found);
  EXPECT_NE(text.find("no forced rub is stable"), std::string::npos);
  EXPECT_NE(text.find("feedback = [300"), std::string::npos);
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
