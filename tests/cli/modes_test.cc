// rotorub modes as a user starts it: the page and the refusals.
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

using Files = std::vector<std::string>;

TEST(CliModesPage, IsOneWholeFile) {
  const Folder folder;
  const Outcome done = folder.done({"modes", shipped("paper_passive"), "-o", "deep/whirl.html"});
  EXPECT_EQ(folder.files(), Files{"deep/whirl.html"}) << "nothing left beside it";
  EXPECT_TRUE(contains(done.out, {"written to deep/whirl.html", "mode shapes at rest"}));
  const std::string page = folder.text("deep/whirl.html");
  EXPECT_TRUE(page.starts_with("<!doctype html>"));
  EXPECT_TRUE(page.ends_with("</html>\n"));
  EXPECT_TRUE(contains(page, "\"mode_shapes\":{"));
}

// The effective mass at the contact is in the table and in the JSON, with as few modes as a
// tolerance allows.
TEST(CliModes, PrintsTheEffectiveMassAtTheContact) {
  const Folder folder;
  const std::string rig = shipped("paper_passive");
  const Outcome table = folder.done({"modes", rig});
  EXPECT_TRUE(contains(table.out, {"effective mass at the contact", "lasting rubs at"}));
  const auto mass = [&](const std::vector<std::string>& more) {
    return folder.json_of(with({"modes", rig, "--json"}, more)).at("contact_mass");
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

TEST(CliModes, FindsPeriodicRubsIfAskedFor) {
  const Folder folder;
  const std::string ring = shipped("compliant_ring");
  EXPECT_TRUE(contains(folder.done({"modes", ring}).out, {"needs a rigid contact", "--periodic"}));
  EXPECT_TRUE(contains(folder.done({"modes", ring, "--periodic"}).out,
                       {"periodic motions to which runs settle", "synchronous rub"}));
  folder.refuses({"modes", ring, "--periodic", "--speed", "50 Hz"}, {"--speed", "--periodic"});
}

TEST(CliModesPage, ShowsBranchesOfPeriodicRubs) {
  const Folder folder;
  const std::string whip = shipped("bench_whip"), frictions = "contact.friction=0.15:0.2:2";
  EXPECT_TRUE(contains(
      folder.done({"modes", whip, "--periodic", "--across", frictions, "-o", "branches"}).out,
      {"branch 1", "fold", "unstable", "rub_branches.html"}));
  EXPECT_EQ(folder.files(), (Files{"branches/rub_branches.csv", "branches/rub_branches.html"}));
  folder.refuses({"modes", whip, "--across", frictions}, {"--across", "--periodic"});
  folder.refuses({"modes", whip, "--periodic", "--up", frictions}, {"--up", "--across"});
  folder.refuses({"modes", whip, "--periodic", "--across", frictions, "--up", frictions},
                 {"two different keys"});
}

TEST(CliModes, RefusesAutoWhereNoNumberDoes) {
  const Folder folder;
  folder.refuses({"modes", shipped("paper_passive"), "--set", "rotor.modes=auto", "--set",
                  "rotor.disc[1].mass=1e-4"},
                 {"rotor.modes", "sleeve"});
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
  EXPECT_TRUE(contains(folder.text("ring.html"), "\"top\":1256.637"));
}

TEST(CliModesPage, RefusesWhatMakesNoDiagram) {
  const Folder folder;
  for (const char* range : {"0", "-3000 rpm", "4 kg"}) {
    folder.refuses(
        {"modes", shipped("bench_ring"), "-o", "ring.html", std::string("--up-to=") + range},
        {"--up-to"});
  }
  folder.refuses({"modes", shipped("bench_ring"), "--up-to", "9000 rpm"});  // without a page
  EXPECT_TRUE(folder.files().empty());
}

TEST(CliModesRubs, MapOnTheTerminalInJsonAndAsAPage) {
  const Folder folder;
  const std::vector<std::string> map{"modes",       shipped("bench_whip"), "--rub-map", "--speeds",
                                     "40Hz:60Hz:3", "--frictions",         "0.1:0.25:4"};
  const Outcome shown = folder.done(map);
  EXPECT_TRUE(contains(shown.out, "      0.2 |VVV"));
  const json written = folder.json_of(with(map, {"--json", "-o", "out"}));
  EXPECT_EQ(folder.files(), Files{"out/rub_map.html"});
  EXPECT_EQ(written.at("rub_map").at("points").size(), 12U);
}

TEST(CliModesRubs, RefusesWhatMakesNoMap) {
  const Folder folder;
  for (const char* range : {"10Hz", "10Hz:20Hz", "20Hz:10Hz:3", "10Hz:20Hz:1", "10Hz:20Hz:3:4",
                            "1m:2m:3", "10Hz:20Hz:x", "-10Hz:20Hz:3"}) {
    folder.refuses({"modes", shipped("bench_whip"), "--rub-map", std::string("--speeds=") + range},
                   {"--speeds"});
  }
  folder.refuses({"modes", shipped("bench_whip"), "--speeds", "10Hz:20Hz:3"});  // there is no map
  folder.refuses({"modes", shipped("paper_sliding"), "--rub-map"}, {"paper_sliding.toml"});
  folder.refuses({"modes", shipped("two_catchers"), "--rub-map"},
                 {"single contact; remove the others, for example with --set"});
  // There is no speed about which to draw the diagram.
  folder.refuses({"modes", shipped("bench_whip"), "--rub-map", "--set", "rotor.speed=0"});
  EXPECT_TRUE(folder.files().empty());
}

}  // namespace
}  // namespace rotorub::test
