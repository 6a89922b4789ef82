// [[check]] is read, refused if it contradicts itself, and does not belong to the scene.
#include "native_model/scene/rules.h"

#include <gtest/gtest.h>

#include "native_model/scene/reader.h"
#include "tests/native_model/scene/scene_samples.h"
#include "tests/support/refusal.h"
#include "tests/support/said.h"

namespace rotorub::scene {
namespace {

std::string with(const std::string& rule) {
  return std::string(kModalSample) + "\n[[check]]\n" + rule;
}

TEST(Rules, AreReadFromTheTextOfTheScene) {
  const Scene scene = parse_scene(with("metric = \"error.rotor_x\"\nengine = \"native-verlet\"\n"
                                       "min = 1\nmax = 2.5\nwhy = \"first\"\n"
                                       "[[check]]\nexpect = \"refused\"\nwhy = \"second\"\n"),
                                  "s.toml");
  const std::vector<Rule> rules = read_rules(scene);
  ASSERT_EQ(rules.size(), 2u);
  EXPECT_EQ(rules[0].metric, "error.rotor_x");
  EXPECT_EQ(rules[0].engine, RuleEngine::kNativeVerlet);
  EXPECT_EQ(rules[0].min, 1.0);
  EXPECT_EQ(rules[0].max, 2.5);
  EXPECT_EQ(rules[0].expect, Expect::kPass);
  EXPECT_EQ(rules[0].why, "first");
  EXPECT_EQ(rules[1].engine, RuleEngine::kNative);
  EXPECT_EQ(rules[1].expect, Expect::kRefused);
  EXPECT_FALSE(rules[1].min || rules[1].max);
}

TEST(Rules, FollowOverrides) {
  const std::vector<std::string> overrides{"check[0].max=3"};
  const Scene scene =
      parse_scene(with("metric = \"steps\"\nmax = 1\nwhy = \"w\"\n"), "s.toml", overrides);
  EXPECT_EQ(read_rules(scene).at(0).max, 3.0);
}

TEST(Rules, NoneOfASceneWithoutThem) {
  EXPECT_TRUE(read_rules(parse_scene(kModalSample, "s.toml")).empty());
  EXPECT_TRUE(read_rules(Scene{}).empty());
}

TEST(Rules, ContradictionsAreRefusedWithTheirPlace) {
  struct Wrong {
    const char* rule;
    const char* key;
    const char* reason;
  };
  for (const Wrong& wrong : std::initializer_list<Wrong>{
           {"metric = \"steps\"\nmax = 1\n", "check[0].why", "missing"},
           {"metric = \"steps\"\nwhy = \"w\"\n", "check[0].metric", "no limit"},
           {"max = 1\nwhy = \"w\"\n", "check[0].max", "has nothing to limit"},
           {"why = \"w\"\n", "check[0]", "is empty"},
           {"metric = \"steps\"\nmin = 2\nmax = 1\nwhy = \"w\"\n", "check[0].max", "below `min`"},
           {"metric = \"steps\"\nmax = 1\nexpect = \"refused\"\nwhy = \"w\"\n", "check[0].metric",
            "there is none"},
           {"metric = \"steps\"\nmax = 1\nengine = \"native-verlets\"\nwhy = \"w\"\n",
            "check[0].engine", "did you mean \"native-verlet\""},
           {"metric = 3\nmax = 1\nwhy = \"w\"\n", "check[0].metric", "a text in quotes"},
           {"metric = \"steps\"\nmax = \"1 mm\"\nwhy = \"w\"\n", "check[0].max", "pure number"},
           {"metrik = \"steps\"\nexpect = \"pass\"\nwhy = \"w\"\n", "check[0].metrik",
            "did you mean `metric`"}}) {
    const auto all = test::refusals([&] { parse_scene(with(wrong.rule), "s.toml"); });
    ASSERT_FALSE(all.empty()) << wrong.rule << " was accepted";
    EXPECT_EQ(all[0].key, wrong.key) << wrong.rule;
    EXPECT_GT(all[0].line, 0);
    EXPECT_TRUE(test::contains(all[0].reason, wrong.reason));
  }
}

}  // namespace
}  // namespace rotorub::scene
