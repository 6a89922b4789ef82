// A case on a made-up run: it passes, is refused or violates a rule; and the output of the program.
#include "compare/check/scene_check.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "compare/check/output.h"
#include "tests/compare/hand_made.h"

namespace rotorub::check {
namespace {

using scene::Rule;
using scene::RuleEngine;

const CheckEngine& engine(RuleEngine word) {
  for (const CheckEngine& e : check_engines()) {
    if (e.word == word) return e;
  }
  throw std::logic_error("no such engine");
}
const CheckEngine& native() { return engine(RuleEngine::kNativeEvent); }
const CheckEngine& mujoco() { return engine(RuleEngine::kMujocoCone); }

Rule at_most(const char* metric, double max, RuleEngine of = RuleEngine::kNative) {
  Rule rule;
  rule.engine = of;
  rule.metric = metric;
  rule.max = max;
  return rule;
}

Rule refused(RuleEngine of = RuleEngine::kNative) {
  Rule rule;
  rule.engine = of;
  rule.expect = scene::Expect::kRefused;
  return rule;
}

Attempt ran() {
  return {test::hand_made(11, 0.1,
                          [](double t) {
                            test::Row row;
                            row.x = 1e-4 * t;
                            row.gap = 0.5e-3 - row.x;
                            return row;
                          }),
          ""};
}

Attempt ended(Status status, const std::string& message) {
  Attempt attempt = ran();
  attempt.trajectory->status = status;
  attempt.trajectory->message = message;
  return attempt;
}

Case judged(const CheckEngine& engine, const std::vector<Rule>& rules, const Attempt& attempt,
            const Trajectory* reference = nullptr) {
  scene::Scene scene;
  scene.name = "made_up";
  scene.first().contact = scene::Contact{.radius = 0.05, .clearance = 0.5e-3};
  return judge(scene, engine, rules, attempt, reference);
}

TEST(CheckCase, PassesWhatItsRulesAllow) {
  const Case c = judged(native(), {at_most("end.rotor_x", 2e-4)}, ran());
  EXPECT_EQ(c.outcome(), Outcome::kPass);
  EXPECT_EQ(c.deciding.rule, "end.rotor_x <= 0.0002");
  EXPECT_DOUBLE_EQ(*c.deciding.value, 1e-4);
  EXPECT_TRUE(holds({c}));
}

TEST(CheckCase, TheWorstViolationDecides) {
  const Case c = judged(native(),
                        {at_most("end.rotor_x", 0.9e-4), at_most("largest.rotor_x", 1e-6),
                         at_most("end.rotor_y", 1.0)},
                        ran());
  EXPECT_EQ(c.outcome(), Outcome::kViolates);
  EXPECT_EQ(c.deciding.rule, "largest.rotor_x <= 1e-06");
  EXPECT_FALSE(holds({c}));
}

TEST(CheckCase, ARefusalIsWhatItsFileSaysOrAViolation) {
  const Attempt refusal{std::nullopt, "cannot work"};
  const Attempt large = ended(Status::kStepTooLarge, "beyond the limit");
  for (const Attempt& attempt : {refusal, large}) {
    EXPECT_EQ(judged(native(), {refused()}, attempt).outcome(), Outcome::kRefused);
    EXPECT_TRUE(holds({judged(native(), {refused()}, attempt)}));
    EXPECT_EQ(judged(native(), {}, attempt).outcome(), Outcome::kViolates);
    EXPECT_EQ(judged(mujoco(), {}, attempt).outcome(), Outcome::kRefused) << "as it is";
  }
  EXPECT_NE(judged(native(), {refused()}, large).deciding.reason.find("step_too_large: beyond"),
            std::string::npos);
  // The refusal was expected and did not come, or came without a reason.
  EXPECT_EQ(judged(native(), {refused()}, ran()).outcome(), Outcome::kViolates);
  EXPECT_EQ(judged(native(), {refused()}, ended(Status::kOutOfRange, "")).outcome(),
            Outcome::kViolates);
}

TEST(CheckCase, DivergenceIsNoRefusal) {
  for (const CheckEngine* e : {&native(), &mujoco()}) {
    const Case c = judged(*e, {refused()}, ended(Status::kDiverged, "infinite"));
    EXPECT_EQ(c.outcome(), Outcome::kViolates);
    EXPECT_NE(c.deciding.reason.find("infinite"), std::string::npos);
  }
}

TEST(CheckCase, AnErrorNeedsItsReference) {
  const std::vector<Rule> rules{at_most("error.rotor_x", 1e-9)};
  const Attempt run = ran();
  EXPECT_EQ(judged(native(), rules, run, &*run.trajectory).outcome(), Outcome::kPass);
  EXPECT_EQ(judged(native(), rules, run).outcome(), Outcome::kViolates)
      << "nothing to measure against";
}

TEST(CheckEngines, RulesAreOfTheirEngine) {
  const std::vector<Rule> all{at_most("steps", 1.0),
                              at_most("steps", 2.0, RuleEngine::kNativeEvent),
                              at_most("steps", 3.0, RuleEngine::kNativeVerlet),
                              at_most("steps", 4.0, RuleEngine::kMujocoRigid)};
  const auto limits = [&](RuleEngine word) {
    std::vector<double> found;
    for (const Rule& rule : rules_for(engine(word), all)) found.push_back(*rule.max);
    return found;
  };
  EXPECT_EQ(limits(RuleEngine::kNativeEvent), (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(limits(RuleEngine::kNativeVerlet), (std::vector<double>{1.0, 3.0}));
  EXPECT_EQ(limits(RuleEngine::kMujocoRigid), (std::vector<double>{4.0}));
  EXPECT_EQ(limits(RuleEngine::kMujocoCone), (std::vector<double>{1.0})) << "none of its own";
}

TEST(CheckOutput, FitsEightyColumnsAndSaysAll) {
  std::vector<Case> cases;
  for (const CheckEngine& e : check_engines()) {
    cases.push_back(judged(e, {at_most("end.rotor_x", e.native ? 1.0 : 1e-9)}, ran()));
  }
  const result::Section result = result_of(cases);
  const std::string text = text_of(result);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
  EXPECT_NE(text.find("made_up, mujoco-cone:"), std::string::npos) << text;

  const nlohmann::json all = json_of(result).at("cases");
  ASSERT_EQ(all.size(), check_engines().size());
  for (const auto& c : all) {
    for (const char* key : {"scene", "engine", "outcome", "rule", "value", "limit", "reason"}) {
      EXPECT_TRUE(c.contains(key)) << key;
    }
  }
  EXPECT_EQ(all[0]["outcome"], "pass");
  EXPECT_EQ(all[5]["outcome"], "violates");
  EXPECT_EQ(all[5]["limit"], 1e-9);
}

}  // namespace
}  // namespace rotorub::check
