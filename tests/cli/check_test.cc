// rotorub check as a user starts it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

const char* const kDrop =
    "[run]\nend = 0.01\nstep = 1e-4\n[rotor]\nspeed = 0.0\n[rotor.modal]\n"
    "mass = [2.0]\nstiffness = [0.0]\n[contact]\nradius = 0.05\n"
    "clearance = \"0.5 mm\"\nfriction = 0.2\nrestitution = 0.5\n[[force]]\nkind = \"constant\"\n"
    "vector = [0.0, -19.62]\n";

void write(const Folder& folder, const std::string& file, const std::string& rules) {
  std::ofstream(folder.path() / file) << kDrop << rules;
}

// What `compare --with` reads is what --json prints.
TEST(CliCheck, KeepsItsCasesForAReport) {
  const Folder folder;
  write(folder, "drop.toml",
        "[[check]]\nmetric = \"mean_force\"\nmax = 1e9\nwhy = \"it is light\"\n");
  const Outcome done = folder.done({"check", "drop.toml", "--json", "-o", "kept"});
  EXPECT_EQ(folder.json_in("kept/check.json"), json::parse(done.out));
  const Outcome nothing = folder.run({"compare", "drop.toml", "--with", "nowhere", "-o", "out"});
  EXPECT_EQ(nothing.code, 2);
  EXPECT_TRUE(contains(nothing.err, "--with nowhere: no bench.json, check.json or sweep.json"))
      << nothing.err;
  EXPECT_FALSE(folder.has("out"));
}

// Every hard case passes natively, or is refused as its file says, and each says why it is hard.
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
  EXPECT_EQ(cases.size(), 7 * scenes.size()) << "every scene on every engine";
  // What MuJoCo's own cone makes of the whip is shown, and decides nothing.
  const auto cone = std::find_if(cases.begin(), cases.end(), [](const json& c) {
    return c["scene"] == "whip" && c["engine"] == "mujoco-cone";
  });
  ASSERT_NE(cone, cases.end());
  EXPECT_EQ(cone->at("outcome"), "violates");
}

// The same start comes to the same attractor over a ladder of steps (the committed one is 10 us).
TEST(CliCheckLong, AttractorsDoNotHangOnTheStep) {
  const Folder folder;
  for (const char* step : {"run.step=5e-6", "run.step=2e-6"}) {
    std::vector<std::string> arguments{"check", "--set", step};
    for (const char* name : {"attractor_rub", "attractor_free", "attractor_whip"}) {
      arguments.push_back(shipped(std::string("hard/") + name));
    }
    const Outcome done = folder.run(arguments);
    EXPECT_EQ(done.code, 0) << step << "\n" << done.out << done.err;
  }
}

TEST(CliCheck, ARuleThatHoldsGivesZeroAndATableOfEightyColumns) {
  const Folder folder;
  write(folder, "drop.toml",
        "[[check]]\nmetric = \"end.rotor_y\"\nmin = -4.906e-4\nmax = -4.904e-4\nwhy = \"w\"\n");
  const Outcome done = folder.done({"check", "drop.toml"});
  EXPECT_TRUE(contains(done.out, "every native case passes")) << done.out;
  std::istringstream lines(done.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
  EXPECT_EQ(folder.files(), std::vector<std::string>{"drop.toml"}) << "nothing is written";
}

TEST(CliCheck, AViolatedRuleGivesOneAndSaysByHowMuch) {
  const Folder folder;
  write(folder, "drop.toml", "[[check]]\nmetric = \"end.rotor_vy\"\nmin = -0.09\nwhy = \"w\"\n");
  const Outcome text = folder.run({"check", "drop.toml"});
  EXPECT_EQ(text.code, 1) << text.err;
  EXPECT_TRUE(contains(text.out, "drop, native-event: end.rotor_vy is -0.0981")) << text.out;
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

TEST(CliCheck, ARefusalThatDoesNotComeIsAViolation) {
  const Folder folder;
  write(folder, "drop.toml",
        "[[check]]\nengine = \"native-verlet\"\nexpect = \"refused\"\nwhy = \"w\"\n");
  EXPECT_EQ(folder.run({"check", "drop.toml"}).code, 1);
  folder.done({"check", "drop.toml", "--set", "check=none"});
}

TEST(CliCheck, RefusesBadInputWithItsPlace) {
  const Folder folder;
  write(folder, "drop.toml", "[[check]]\nmetric = \"penetration\"\nmax = 1\nwhy = \"w\"\n");
  const Outcome metric = folder.run({"check", "drop.toml"});
  EXPECT_EQ(metric.code, 2);
  EXPECT_TRUE(contains(metric.err, "drop.toml:18: check[0].metric")) << metric.err;
  EXPECT_TRUE(contains(metric.err, "max_penetration")) << metric.err;
  write(folder, "drop.toml", "[[check]]\nmetric = \"end.torsion_1\"\nmax = 1\nwhy = \"w\"\n");
  const Outcome column = folder.run({"check", "drop.toml"});
  EXPECT_EQ(column.code, 2);
  EXPECT_TRUE(contains(column.err, "drop.toml:18: check[0].metric")) << column.err;
  EXPECT_TRUE(contains(column.err, "rotor_x")) << column.err;
  EXPECT_EQ(folder.run({"check"}).code, 2);
  EXPECT_EQ(folder.run({"check", "nowhere.toml"}).code, 2);
  std::filesystem::create_directory(folder.path() / "empty");
  EXPECT_EQ(folder.run({"check", "empty"}).code, 2);
}

}  // namespace
}  // namespace rotorub::test
