// rotorub tune as a user starts it.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

TEST(CliTune, FindsASettingWhoseOwnComparisonPasses) {
  const Folder folder;
  const json all = folder.json_of({"tune", shipped("bench_ring"), "--end", "50ms", "--steps",
                                   "100us,50us,20us,10us", "--tolerance", "5%", "--twins", "4",
                                   "--json", "-o", "tuned.toml"});
  for (const char* key :
       {"trusted", "next_cheaper", "model_error", "contact_error", "step_error"}) {
    EXPECT_TRUE(all.contains(key)) << key;
  }
  const json& trusted = all["trusted"];
  for (const char* key : {"contact", "integrator", "step", "modes", "solref_stiffness", "solver",
                          "us_per_step", "errors"}) {
    EXPECT_TRUE(trusted.contains(key)) << key;
  }
  EXPECT_EQ(trusted["contact"], "rigid");
  EXPECT_TRUE(trusted["errors"].contains("impact_impulse"));
  EXPECT_FALSE(trusted["errors"].contains("control_force")) << "the ring is passive";
  for (const json& s : all["settings"]) {
    if (s["contact"] != "cone") continue;
    EXPECT_NE(s["trusted"], "yes") << s.dump();
  }

  ASSERT_TRUE(folder.has("tuned.toml"));
  EXPECT_TRUE(contains(folder.text("tuned.toml"), "contact = \"rigid\""));
  const Outcome judged = folder.done({"compare", "tuned.toml", "--tolerance", "5%", "--twins", "4",
                                      "--no-video", "--quiet", "-o", "out"});
}

// `tune` and `compare` judge a setting alike.
TEST(CliTune, JudgesAsCompareDoes) {
  const Folder folder;
  const std::vector<std::string> shared{shipped("bench_ring"), "--end", "50ms", "--twins", "0"};
  const json all = json::parse(
      folder.run(with({"tune", "--steps", "50us", "--tolerance", "100%", "--json"}, shared)).out);
  folder.run(with({"compare", "--step", "50us", "--no-video", "--quiet", "-o", "out"}, shared));
  const json sides = folder.json_in("out/compare.json")["scenes"][0]["differences"];
  int seen = 0;
  for (const json& s : all["settings"]) {
    const bool as_it_comes = s["solref_stiffness"].is_null() && s["solref_damping"].is_null() &&
                             s["friction_reference"].is_null();
    if (!as_it_comes || s["integrator"] != "euler" || s["solver"] != "newton") continue;
    const json& figures = sides.at(s["contact"].get<std::string>()).at("figures");
    for (const auto& [key, error] : s["errors"].items()) {
      EXPECT_NEAR(error.get<double>(), figures.at(key).at("deviation").get<double>(), 1e-9)
          << s["contact"] << " " << key;
      ++seen;
    }
  }
  EXPECT_GE(seen, 4 * 7);
}

// The printed next command runs, also with a controller from a library, and a message says if the
// comments of the scene are lost.
TEST(CliTune, ThePrintedNextCommandRuns) {
  const Folder folder;
  const std::string law = std::string(ROTORUB_LIBRARIES) + "/own_controller.so";
  const Outcome tuned =
      folder.run({"tune", shipped("bench_ring"), "--controller", law, "--set",
                  "controller.sample_time=50us", "--end", "5ms", "--steps", "50us,10us",
                  "--tolerance", "100%", "--twins", "0", "-o", "tuned.toml"});
  ASSERT_EQ(tuned.code, 0) << tuned.out << tuned.err;
  EXPECT_TRUE(contains(tuned.out, {"(without the comments of the scene)", "--allow-library"}));
  EXPECT_FALSE(contains(folder.text("tuned.toml"), "# "));
  const Outcome judged = folder.run({"compare", "tuned.toml", "--allow-library", "--twins", "0",
                                     "--no-video", "--no-modes-ladder", "--quiet", "-o", "out"});
  EXPECT_LE(judged.code, 1) << judged.err;
}

// The next command has the file in quotes, and a scene in another folder finds its library.
TEST(CliTune, WritesToAnotherFolderWithABlankInItsName) {
  const Folder folder;
  std::filesystem::copy_file(std::string(ROTORUB_LIBRARIES) + "/own_controller.so",
                             folder.path() / "law.so");
  const std::string ring = read_text(shipped("bench_ring"));
  folder.write("ring.toml", ring +
                                "\n[controller]  # my own\nkind = \"library\"\nlibrary = "
                                "\"law.so\"\nsample_time = 5e-5\n");
  const Outcome tuned =
      folder.done({"tune", "ring.toml", "--allow-library", "--end", "5ms", "--steps", "50us,10us",
                   "--tolerance", "100%", "--twins", "0", "-o", "my rigs/tuned.toml"});
  EXPECT_TRUE(contains(tuned.out, "rotorub compare 'my rigs/tuned.toml' --contact "));
  EXPECT_TRUE(contains(folder.text("my rigs/tuned.toml"),
                       "library = \"" + (folder.path() / "law.so").string() + "\""));
  folder.done({"run", "my rigs/tuned.toml", "--allow-library", "--end", "1ms", "-q", "-o", "out"});
}

// The report recommends `tune` with the options of its comparison.
TEST(CliTune, TheReportNamesItWithTheOptionsOfTheComparison) {
  const Folder folder;
  const std::string law = std::string(ROTORUB_LIBRARIES) + "/own_controller.so";
  std::filesystem::copy_file(shipped("bench_ring"), folder.path() / "ring.toml");
  const Outcome judged = folder.run({"compare", "ring.toml", "--controller", law, "--set",
                                     "controller.sample_time=50us", "--end", "5ms", "--twins", "0",
                                     "--no-video", "--no-modes-ladder", "--quiet", "-o", "out"});
  ASSERT_LE(judged.code, 1) << judged.err;
  EXPECT_TRUE(contains(folder.text("out/report.html"),
                       "rotorub tune ring.toml --controller " + law +
                           " --set controller.sample_time=50us --end 5ms --tolerance 1%"));
}

TEST(CliTune, SaysWhatCannotBeTrusted) {
  const Folder folder;
  const Outcome none = folder.run({"tune", shipped("bench_ring"), "--end", "20ms", "--steps",
                                   "200us", "--tolerance", "0", "--twins", "0", "-o", "no.toml"});
  EXPECT_EQ(none.code, 1) << none.out;
  EXPECT_TRUE(contains(none.out, "none can be trusted"));
  EXPECT_TRUE(contains(none.err, "not written"));
  EXPECT_FALSE(folder.has("no.toml"));
}

TEST(CliTune, RefusesWithWhatIsAccepted) {
  const Folder folder;
  const std::vector<std::string> tune{"tune", shipped("bench_ring")};
  folder.refuses(with(tune, {"--set", "contact=none"}), {"[contact]"});
  folder.refuses(with(tune, {"--steps", "3 kg"}), {"--steps"});
  folder.refuses(with(tune, {"--twins", "-2"}), {"0 to"});
  folder.refuses(with(tune, {"--tolerance", "2"}), {"2%"});
  folder.refuses({"tune", "nowhere.toml"});
}

}  // namespace
}  // namespace rotorub::test
