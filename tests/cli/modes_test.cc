// rotorub modes as a user starts it: the page, and what it refuses.
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

using Files = std::vector<std::string>;

TEST(CliModesPage, IsOneWholeFile) {
  const Folder folder;
  const Outcome done = folder.done({"modes", shipped("paper_passive"), "-o", "deep/whirl.html"});
  EXPECT_EQ(folder.files(), Files{"deep/whirl.html"}) << "nothing left beside it";
  EXPECT_TRUE(contains(done.out, "written to deep/whirl.html")) << done.out;
  EXPECT_TRUE(contains(done.out, "mode shapes at rest")) << done.out;
  const std::string page = folder.text("deep/whirl.html");
  EXPECT_TRUE(page.starts_with("<!doctype html>"));
  EXPECT_TRUE(page.ends_with("</html>\n"));
  EXPECT_TRUE(contains(page, "data-plot=\"shapes\""));
}

// What an impact meets: in the table and in the JSON, and as few modes as a tolerance allows.
TEST(CliModes, SaysWhatAnImpactMeets) {
  const Folder folder;
  const std::string rig = shipped("paper_passive");
  const Outcome table = folder.done({"modes", rig});
  EXPECT_TRUE(contains(table.out, "mass that an impact meets")) << table.out;
  const auto mass = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"modes", rig, "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome done = folder.done(arguments);
    return json::parse(done.out).at("contact_mass");
  };
  const auto own = mass({});
  EXPECT_EQ(own.at("kept_modes"), 8);
  EXPECT_GT(own.at("mesh_modes"), 8);
  EXPECT_GT(own.at("mesh").get<double>(), 0.2) << "the sleeve's at least";
  EXPECT_GT(own.at("kept").get<double>(), own.at("mesh").get<double>());
  const auto fewest = mass({"--set", "rotor.modes=auto", "--set", "rotor.modes_tolerance=0.4"});
  EXPECT_GT(fewest.at("kept_modes"), 8) << "8 modes meet twice the mass";
  EXPECT_LT(fewest.at("kept").get<double>(), fewest.at("mesh").get<double>() * 1.4);
  const Outcome modal = folder.run({"modes", shipped("bench_ring"), "--json"});
  EXPECT_TRUE(json::parse(modal.out).at("contact_mass").is_null());
}

TEST(CliModes, RefusesAutoWhereNoNumberDoes) {
  const Folder folder;
  const Outcome refused = folder.run({"modes", shipped("paper_passive"), "--set",
                                      "rotor.modes=auto", "--set", "rotor.disc[1].mass=1e-4"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(contains(refused.err, "rotor.modes")) << refused.err;
  EXPECT_TRUE(contains(refused.err, "sleeve")) << refused.err;
}

TEST(CliModesPage, GoesIntoAFolder) {
  const Folder folder;
  const Outcome done = folder.done({"modes", shipped("bench_ring"), "-o", "out", "--json"});
  EXPECT_EQ(folder.files(), Files{"out/modes.html"});
  const json modes = json::parse(done.out);
  EXPECT_TRUE(modes.at("mode_shapes").is_null()) << "modal form";
}

TEST(CliModesPage, ReachesUpToTheSpeedAskedFor) {
  const Folder folder;
  folder.done(
      {"modes", shipped("bench_ring"), "-o", "ring.html", "--up-to", "12000 rpm", "--quiet"});
  EXPECT_TRUE(contains(folder.text("ring.html"), "up to 12000 rpm"));
}

TEST(CliModesPage, RefusesWhatMakesNoDiagram) {
  const Folder folder;
  for (const char* range : {"0", "-3000 rpm", "4 kg"}) {
    const Outcome refused = folder.run(
        {"modes", shipped("bench_ring"), "-o", "ring.html", std::string("--up-to=") + range});
    EXPECT_EQ(refused.code, 2) << range;
    EXPECT_TRUE(contains(refused.err, "--up-to")) << refused.err;
  }
  EXPECT_EQ(folder.run({"modes", shipped("bench_ring"), "--up-to", "9000 rpm"}).code, 2)
      << "there is no diagram without a page";
  EXPECT_EQ(folder.run({"modes", shipped("bench_ring"), "-o", "standard_error/page.html"}).code, 2)
      << "a file where a folder should be";
  EXPECT_TRUE(folder.files().empty());
}

TEST(CliModesRubs, MapOnTheTerminalInJsonAndAsAPage) {
  const Folder folder;
  const std::vector<std::string> map{"modes",       shipped("bench_whip"), "--rub-map", "--speeds",
                                     "40Hz:60Hz:3", "--frictions",         "0.1:0.25:4"};
  const Outcome shown = folder.done(map);
  EXPECT_TRUE(contains(shown.out, "      0.2 |VVV")) << shown.out;
  std::vector<std::string> more = map;
  more.insert(more.end(), {"--json", "-o", "out"});
  const Outcome written = folder.done(more);
  EXPECT_EQ(folder.files(), Files{"out/rub_map.html"});
  const json points = json::parse(written.out).at("rub_map").at("points");
  EXPECT_EQ(points.size(), 12U);
}

TEST(CliModesRubs, AreToldWithTheWhirl) {
  const Folder folder;
  const Outcome done = folder.done({"modes", shipped("bench_whip")});
  EXPECT_TRUE(contains(done.out, "-501.9257")) << done.out;
  EXPECT_TRUE(contains(folder.run({"modes", shipped("paper_sliding")}).out, "controller.kind"));
}

TEST(CliModesRubs, RefusesWhatMakesNoMap) {
  const Folder folder;
  for (const char* range : {"10Hz", "10Hz:20Hz", "20Hz:10Hz:3", "10Hz:20Hz:1", "10Hz:20Hz:3:4",
                            "1m:2m:3", "10Hz:20Hz:x", "-10Hz:20Hz:3"}) {
    const Outcome refused =
        folder.run({"modes", shipped("bench_whip"), "--rub-map", std::string("--speeds=") + range});
    EXPECT_EQ(refused.code, 2) << range;
    EXPECT_TRUE(contains(refused.err, "--speeds")) << refused.err;
  }
  EXPECT_EQ(folder.run({"modes", shipped("bench_whip"), "--speeds", "10Hz:20Hz:3"}).code, 2)
      << "there is no map";
  const Outcome refused = folder.run({"modes", shipped("paper_sliding"), "--rub-map"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(contains(refused.err, "paper_sliding.toml")) << refused.err;
  const Outcome several = folder.run({"modes", shipped("two_catchers"), "--rub-map"});
  EXPECT_TRUE(contains(several.err, "one contact alone; accepted: one [[contact]], as with --set"))
      << several.err;
  EXPECT_EQ(
      folder.run({"modes", shipped("bench_whip"), "--rub-map", "--set", "rotor.speed=0"}).code, 2)
      << "no speed about which to draw it";
  EXPECT_TRUE(folder.files().empty());
}

}  // namespace
}  // namespace rotorub::test
