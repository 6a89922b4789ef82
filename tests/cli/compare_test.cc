// `rotorub compare` by its command line: exit codes, files and their contents.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

TEST(CliCompare, UnknownValuesAreRefused) {
  const Folder folder;
  const std::vector<std::string> ring{"compare", shipped("bench_ring")};
  folder.refuses(with(ring, {"--mode", "guess"}));
  folder.refuses(with(ring, {"--tolerance", "1 mm"}));
  folder.refuses(with(ring, {"--twins", "-1"}));
  // 1 may mean 1 % or 100 %, so it is refused.
  for (const std::string command : {"compare", "tune"}) {
    folder.refuses({command, shipped("bench_ring"), "--tolerance", "1"},
                   {"100 %", "\"1%\"", "0.01"});
  }
  EXPECT_TRUE(folder.files().empty());
}

// The native side replays the commands that MuJoCo used; without commands a message says so.
TEST(CliCompare, ReplaysTheCommands) {
  const Folder folder;
  const std::vector<std::string> base{
      "compare", shipped("bench_ring"), "--mode",  "replay", "--end",
      "0.02",    "--no-video",          "--twins", "2",      "-o",
      "out"};
  const Outcome none = folder.done(base);
  EXPECT_TRUE(contains(none.out, "Replay equals lockstep here: no controller"));

  const Outcome replayed = folder.done(
      with(base, {"--set", "controller.kind=passive", "--set", "controller.stiffness=5e4"}));
  EXPECT_TRUE(contains(replayed.out, "Replay: each MuJoCo run"));
  const json all = folder.json_in("out/compare.json");
  EXPECT_EQ(all.at("mode"), "replay");
  EXPECT_TRUE(all.at("within").get<bool>()) << "as the exit code says";
  EXPECT_EQ(all.at("scenes")[0].at("shadow").at("commands_of"), "rigid");
  EXPECT_TRUE(contains(folder.text("out/report.html"), "\"mode\":\"replay\""));
}

// The exit code follows from the contacts of the model that decides, one by one.
TEST(CliCompare, ResyncJudgesContactByContact) {
  const Folder folder;
  const std::vector<std::string> call{
      "compare", shipped("bench_billiard"), "--mode", "resync", "--end", "0.05", "--no-video", "-o",
      "out"};
  const Outcome rigid = folder.done(call);
  EXPECT_TRUE(contains(rigid.out, "onset"));
  const json all = folder.json_in("out/compare.json");
  EXPECT_EQ(all.at("mode"), "resync");
  const json& rigid_model = all.at("scenes")[0].at("differences").at("rigid");
  EXPECT_LT(rigid_model.at("resync").at("figures").at("impulse").at("worst"), 0.01);
  EXPECT_TRUE(contains(folder.text("out/report.html"), "Contact by contact"));
  EXPECT_EQ(folder.run(with(call, {"--contact", "cone"})).code, 1)
      << "a soft contact takes the peak off";
}

// The user chooses the model whose verdict counts, and the output names it.
TEST(CliCompare, TheConeDecidesWhereAsked) {
  const Folder folder;
  const Outcome differ =
      folder.run({"compare", shipped("bench_ring"), "--end", "0.05", "--no-video", "--tolerance",
                  "10%", "--contact", "cone", "--twins", "4", "-o", "out"});
  EXPECT_EQ(differ.code, 1) << differ.err;
  EXPECT_TRUE(
      contains(differ.out, "The exit code refers to cone (--contact), which is outside 10 %"));
  const json all = folder.json_in("out/compare.json");
  EXPECT_EQ(all.at("contact"), "cone");
  EXPECT_FALSE(all.at("within").get<bool>());
  ASSERT_EQ(all.at("answer").size(), 5U);
  EXPECT_EQ(all["answer"][0].at("contact"), "cone");
  EXPECT_EQ(all["answer"][0].at("trusted"), "no");
  EXPECT_TRUE(all["answer"][0].at("decides_exit_code").get<bool>());
}

TEST(CliCompare, LeavesSeriesJsonAndReport) {
  const Folder folder;
  const Outcome done = folder.run({"compare", shipped("bench_ring"), shipped("bench_drop"), "--end",
                                   "0.05", "--no-video", "-o", "out"});
  ASSERT_LE(done.code, 1) << done.err;
  EXPECT_EQ(done.err, "");
  for (const std::string scene : {"bench_ring", "bench_drop"}) {
    EXPECT_TRUE(contains(done.out, scene));
    for (const std::string side : {"native", "coulomb", "cone"}) {
      for (const std::string file :
           {"series.csv", "impacts.csv", "events.csv", "summary.json", "columns.json"}) {
        EXPECT_TRUE(folder.has("out/" + scene + "/" + side + "/" + file)) << scene << side << file;
      }
    }
  }
  const json compared = folder.json_in("out/compare.json");
  EXPECT_EQ(compared.at("scenes").size(), 2U);
  // The metrics are documented beside their values.
  for (const json& key : folder.json_in("out/columns.json").at("compare.json runs.*.metrics")) {
    json value = compared.at("scenes")[0].at("runs").at("native").at("metrics");
    std::istringstream path(key.at("name").get<std::string>());
    for (std::string part; std::getline(path, part, '.');) value = json(value).at(part);
  }
  // Without a measured record the key is null.
  EXPECT_TRUE(compared.at("scenes")[0].at("measured").is_null());
  const std::string page = folder.text("out/report.html");
  EXPECT_TRUE(contains(page, "bench_drop"));
  EXPECT_FALSE(contains(page, "\"title\":\"The measured run\""));
  expect_whole_files(folder);
}

// Files beside the page, which links to them; the page contains none of them. One film: MuJoCo
// alone beside the native run; `every`: all of them.
void expect_films(bool every) {
  const Folder folder;
  std::vector<std::string> arguments{"compare", shipped("bench_ring"), "--end", "0.02", "-o",
                                     "out"};
  if (every) arguments.push_back("--all-films");
  const Outcome done = folder.run(arguments);
  ASSERT_LE(done.code, 1) << done.err;
  const std::string page = folder.text("out/report.html");
  for (const std::string side : {"native", "rigid", "coulomb", "cone", "cone-coulomb"}) {
    const std::string film = "bench_ring/" + side + ".mp4";
    const bool made = every || side == "cone";
    EXPECT_EQ(folder.has("out/" + film), made) << film;
    EXPECT_EQ(contains(page, "\"link\":\"" + film + "\""), made) << film;
    EXPECT_TRUE(!made || contains(folder.text("out/" + film), "ftyp"));
  }
  EXPECT_FALSE(contains(page, "data:video"));
  expect_whole_files(folder);
}
TEST(CliCompareLong, TheReportLinksTheFilm) { expect_films(false); }
TEST(CliCompareNightly, TheReportLinksEveryFilm) { expect_films(true); }

// The setting stands beside the verdicts; without --tune the page says how to find it.
TEST(CliCompareLong, TheSettingToUseStandsBesideTheVerdicts) {
  const Folder folder;
  const std::vector<std::string> arguments{
      "compare", shipped("bench_ring"), "--end", "0.02", "--no-video", "--twins", "0", "-o", "out"};
  ASSERT_LE(folder.run(arguments).code, 1);
  EXPECT_TRUE(contains(folder.text("out/report.html"), "rotorub tune "));
  const Outcome done = folder.run(with(arguments, {"--tune"}));
  ASSERT_LE(done.code, 1) << done.err;
  const std::size_t at = done.out.find("setting to use: ");
  ASSERT_NE(at, std::string::npos) << done.out;
  const std::string setting = first_line(done.out.substr(at + 16));
  EXPECT_TRUE(contains(setting, " µs a step"));
  EXPECT_TRUE(contains(folder.text("out/report.html"), setting));
  const Outcome alone =
      folder.run({"tune", shipped("bench_ring"), "--end", "0.02", "--twins", "0", "--json"});
  const json trusted = json::parse(alone.out).at("trusted");
  EXPECT_TRUE(setting.starts_with(trusted.at("contact").get<std::string>()))
      << "as tune itself says: " << setting;
}

// A JSON without the times of computation.
json without_times(const json& all) {
  if (!all.is_structured()) return all;
  json kept = all;
  if (kept.is_object()) {
    for (const char* key : {"timing", "wall_s", "us_per_step", "real_time_factor"}) kept.erase(key);
  }
  for (auto& value : kept) value = without_times(value);
  return kept;
}

// The scene is chaotic, so there are many twins and runs at smaller steps; one thread and two give
// the same result.
TEST(CliCompareLong, NoResultDependsOnTheNumberOfJobs) {
  const Folder folder;
  for (const char* jobs : {"1", "2"}) {
    const Outcome outcome =
        folder.run({"compare", shipped("bench_billiard"), "--end", "0.3", "--set", "run.step=5e-5",
                    "--no-video", "--jobs", jobs, "-o", std::string("out") + jobs});
    ASSERT_LE(outcome.code, 1) << outcome.err;
  }
  EXPECT_EQ(without_times(folder.json_in("out1/compare.json")),
            without_times(folder.json_in("out2/compare.json")));
  std::size_t compared = 0;
  for (const std::string& file : folder.files()) {
    if (!file.starts_with("out1/") || !file.ends_with(".csv")) continue;
    EXPECT_EQ(folder.text(file), folder.text("out2" + file.substr(4))) << file;
    ++compared;
  }
  EXPECT_GE(compared, 6U);
}

TEST(CliCompare, WritesItsProgressInLinesWhereAsked) {
  const Folder folder;
  const std::vector<std::string> words{
      "compare", shipped("bench_ring"), "--end", "0.01", "--no-video", "--twins", "1", "-o", "out"};
  EXPECT_EQ(folder.run(words).err, "");
  const Outcome lines = folder.run(words, {{{"ROTORUB_PROGRESS", "lines"}}});
  EXPECT_TRUE(lines.err.starts_with("  0 %  bench_ring: ")) << lines.err;
}

}  // namespace
}  // namespace rotorub::test
