// rotorub plot: the page of a run's folder, and the refusal of a folder without a run.
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

TEST(CliPlot, WritesThePageOfARun) {
  const Folder folder;
  folder.done({"run", shipped("bench_ring"), "--end", "0.02", "-o", "out"});
  const json summary = folder.json_of({"plot", "out", "--json"});
  EXPECT_EQ(summary.at("file"), "out/plot.html");
  EXPECT_EQ(summary.at("rows"), 1001);
  EXPECT_EQ(summary.at("shadow"), false);
  const std::string page = folder.text("out/plot.html");
  EXPECT_TRUE(contains(page, {"bench_ring", "\"label\":\"native\""}));
  const Outcome elsewhere = folder.done({"plot", "out", "-o", "pages/one.html"});
  EXPECT_EQ(folder.text("pages/one.html"), page) << "the same run, the same bytes";
  expect_whole_files(folder);
}

TEST(CliPlot, HasTheShadowBesideARunOfMujoco) {
  const Folder folder;
  const Outcome run =
      folder.done({"run", shipped("bench_ring"), "--engine", "mujoco", "--contact", "cone", "--end",
                   "0.02", "--set", "mujoco.shadow=true", "-o", "out"});
  const Outcome done = folder.done({"plot", "out", "--json"});
  EXPECT_EQ(json::parse(done.out).at("shadow"), true);
  const std::string page = folder.text("out/plot.html");
  EXPECT_TRUE(contains(page, {"\"label\":\"cone\"", "\"label\":\"shadow\""}));
}

TEST(CliPlot, ShowsItsProgress) {
  const Folder folder;
  folder.done({"run", shipped("bench_ring"), "--end", "0.001", "-o", "out"});
  EXPECT_TRUE(contains(folder.done({"plot", "out"}, {{{"ROTORUB_PROGRESS", "lines"}}}).err,
                       "0 %  reading the run"));
}

TEST(CliPlot, RefusesWhatIsNoRun) {
  const Folder folder;
  folder.refuses({"plot"});
  folder.refuses({"plot", "nowhere"}, {"nowhere is not a folder"});
  std::filesystem::create_directory(folder.path() / "empty");
  folder.refuses({"plot", "empty"}, {"empty/summary.json"});
  folder.done({"run", shipped("bench_ring"), "--end", "0.001", "-o", "out"});
  folder.refuses({"plot", "out", "--set", "run.end=1"}, {"--set"});
}

// A series that somebody has edited is refused with its line.
TEST(CliPlot, RefusesASeriesThatIsNone) {
  const Folder folder;
  folder.done({"run", shipped("bench_ring"), "--end", "0.001", "-o", "out"});
  const std::string good = folder.text("out/series.csv");
  const auto expect_refused = [&](const std::string& from, const std::string& to,
                                  const std::string& said) {
    std::string text = good;
    folder.write("out/series.csv", text.replace(text.find(from), from.size(), to));
    folder.refuses({"plot", "out"}, {"out/series.csv:" + said});
    EXPECT_FALSE(folder.has("out/plot.html"));
  };
  expect_refused("gap_rate", "gap_rape", " has no column `gap_rate`");
  expect_refused("\n0,", "\n5,", "3: the times do not ascend");
  expect_refused("\n0,", "\nnan,", "2: t = nan");
  expect_refused("\n0,", "\nzero,", "2: `zero` is not a number");
}

TEST(CliPlot, NamesAColumnOfTheModesThatIsMissing) {
  const Folder folder;
  folder.done(
      {"run", shipped("paper_passive"), "--set", "rotor.modes=2", "--end", "0.001", "-o", "out"});
  std::string text = folder.text("out/series.csv");
  text.replace(text.find(",vx_1"), 5, ",vx_7");
  folder.write("out/series.csv", text);
  folder.refuses({"plot", "out"}, {"no column `vx_1`"});
}

// Reading a device would never end.
TEST(CliPlot, ReadsFilesAlone) {
  const Folder folder;
  folder.done({"run", shipped("bench_ring"), "--end", "0.001", "-o", "out"});
  for (const char* file : {"series.csv", "impacts.csv", "summary.json", "scene.toml"}) {
    const std::filesystem::path there = folder.path() / "out" / file;
    const std::filesystem::path kept = folder.path() / "kept";
    std::filesystem::rename(there, kept);
    std::filesystem::create_symlink("/dev/zero", there);
    folder.refuses({"plot", "out"}, {std::string("out/") + file + ": is a device"});
    std::filesystem::rename(kept, there);
  }
  folder.refuses({"compare", shipped("bench_ring"), "--measured", "/dev/zero"});
}

}  // namespace
}  // namespace rotorub::test
