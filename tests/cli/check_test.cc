// rotorub check as a user starts it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

const char* const kDrop =
    "[run]\nend = 0.01\nstep = 1e-4\n[rotor]\nspeed = 0.0\n[rotor.modal]\n"
    "mass = [2.0]\nstiffness = [0.0]\n[contact]\nradius = 0.05\n"
    "clearance = \"0.5 mm\"\nfriction = 0.2\nrestitution = 0.5\n[[force]]\nkind = \"constant\"\n"
    "vector = [0.0, -19.62]\n";

void write(const Folder& folder, const std::string& file, const std::string& rules) {
  folder.write(file, kDrop + rules);
}

// `compare --with` reads the output of --json.
TEST(CliCheck, KeepsItsCasesForAReport) {
  const Folder folder;
  write(folder, "drop.toml",
        "[[check]]\nmetric = \"mean_force\"\nmax = 1e9\nwhy = \"it is light\"\n");
  const Outcome done = folder.done({"check", "drop.toml", "--json", "-o", "kept"});
  EXPECT_EQ(folder.json_in("kept/check.json"), json::parse(done.out));
  folder.refuses({"compare", "drop.toml", "--with", "nowhere", "-o", "out"},
                 {"--with nowhere: no bench.json, check.json or sweep.json"});
  EXPECT_FALSE(folder.has("out"));
}

// Every hard case passes natively or is refused as its file says, and each file says why it is
// hard.
TEST(CliCheckLong, TheHardCasesHold) {
  const Folder folder;
  const std::string hard = std::string(ROTORUB_MJCF_DIR) + "/hard";
  const json all = folder.json_of({"check", hard, "--json"});
  const json& cases = all.at("cases");
  std::set<std::string> scenes;
  int refused = 0;
  for (const json& c : cases) {
    scenes.insert(c.at("scene"));
    if (!c.at("engine").get<std::string>().starts_with("native")) continue;
    EXPECT_NE(c.at("outcome"), "violates") << c.dump();
    refused += c.at("outcome") == "refused" ? 1 : 0;
    if (c.at("outcome") == "refused") {
      EXPECT_NE(c.at("reason"), "") << c.dump();
    }
  }
  EXPECT_GE(scenes.size(), 25u);
  EXPECT_GT(refused, 0);
  EXPECT_EQ(cases.size(), 6 * scenes.size()) << "every scene on every engine";
  // The whip in MuJoCo's own cone is shown, but does not affect the verdict.
  const auto cone = std::find_if(cases.begin(), cases.end(), [](const json& c) {
    return c["scene"] == "whip" && c["engine"] == "mujoco-cone";
  });
  ASSERT_NE(cone, cases.end());
  EXPECT_EQ(cone->at("outcome"), "violates");
}

// The same start leads to the same attractor for several steps (the committed one is 10 us).
void expect_same_attractors(const std::string& step) {
  const Folder folder;
  folder.done({"check", "--set", "run.step=" + step, shipped("hard/attractor_rub"),
               shipped("hard/attractor_free"), shipped("hard/attractor_whip")});
}
TEST(CliCheckLong, AttractorsDoNotDependOnTheStep) { expect_same_attractors("5e-6"); }
// Daily: CliCheckLong.AttractorsDoNotDependOnTheStep.
TEST(CliCheckNightly, AttractorsDoNotDependOnTheStep) { expect_same_attractors("2e-6"); }

TEST(CliCheck, ARuleThatHoldsGivesZero) {
  const Folder folder;
  write(folder, "drop.toml",
        "[[check]]\nmetric = \"end.rotor_y\"\nmin = -4.906e-4\nmax = -4.904e-4\nwhy = \"w\"\n");
  const Outcome done = folder.done({"check", "drop.toml"});
  EXPECT_TRUE(contains(done.out, "every native case passes"));
  EXPECT_EQ(folder.files(), std::vector<std::string>{"drop.toml"}) << "nothing is written";
}

TEST(CliCheck, AViolatedRuleGivesOneAndSaysByHowMuch) {
  const Folder folder;
  write(folder, "drop.toml", "[[check]]\nmetric = \"end.rotor_vy\"\nmin = -0.09\nwhy = \"w\"\n");
  const Outcome text = folder.run({"check", "drop.toml"});
  EXPECT_EQ(text.code, 1) << text.err;
  EXPECT_TRUE(contains(text.out, "drop, native-event: end.rotor_vy is -0.0981"));
  const Outcome done = folder.run({"check", "drop.toml", "--json"});
  EXPECT_EQ(done.code, 1);
  const json all = json::parse(done.out);
  const json& c = all.at("cases").at(0);
  EXPECT_EQ(c.at("outcome"), "violates");
  EXPECT_EQ(c.at("rule"), "end.rotor_vy >= -0.09");
  EXPECT_NEAR(c.at("value").get<double>(), -0.0981, 1e-9);
  EXPECT_EQ(c.at("limit"), -0.09);
  EXPECT_TRUE(contains(c.at("reason"), "by 0.0081")) << c;
}

TEST(CliCheck, RefusesBadInputWithItsPlace) {
  const Folder folder;
  write(folder, "drop.toml", "[[check]]\nmetric = \"penetration\"\nmax = 1\nwhy = \"w\"\n");
  folder.refuses({"check", "drop.toml"}, {"drop.toml:18: check[0].metric", "max_penetration"});
  write(folder, "drop.toml", "[[check]]\nmetric = \"end.torsion_1\"\nmax = 1\nwhy = \"w\"\n");
  folder.refuses({"check", "drop.toml"}, {"drop.toml:18: check[0].metric", "rotor_x"});
  folder.refuses({"check"});
  folder.refuses({"check", "nowhere.toml"});
  std::filesystem::create_directory(folder.path() / "empty");
  folder.refuses({"check", "empty"});
}

}  // namespace
}  // namespace rotorub::test
