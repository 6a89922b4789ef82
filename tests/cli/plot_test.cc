// rotorub plot: the page of a run's folder, and what it says of a folder that is none.
#include <gtest/gtest.h>

#include <fstream>

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
  EXPECT_TRUE(contains(page, "bench_ring"));
  EXPECT_TRUE(contains(page, "\"label\":\"native\""));
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
  EXPECT_TRUE(contains(page, "\"label\":\"cone\""));
  EXPECT_TRUE(contains(page, "\"label\":\"shadow\""));
}

TEST(CliPlot, RefusesWhatIsNoRun) {
  const Folder folder;
  EXPECT_EQ(folder.run({"plot"}).code, 2);
  const Outcome nowhere = folder.run({"plot", "nowhere"});
  EXPECT_EQ(nowhere.code, 2);
  EXPECT_TRUE(contains(nowhere.err, "nowhere: is no folder")) << nowhere.err;
  std::filesystem::create_directory(folder.path() / "empty");
  const Outcome empty = folder.run({"plot", "empty"});
  EXPECT_EQ(empty.code, 2);
  EXPECT_TRUE(contains(empty.err, "empty/summary.json")) << empty.err;
  folder.done({"run", shipped("bench_ring"), "--end", "0.001", "-o", "out"});
  const Outcome changed = folder.run({"plot", "out", "--set", "run.end=1"});
  EXPECT_EQ(changed.code, 2);
  EXPECT_TRUE(contains(changed.err, "--set")) << changed.err;
}

// A series that somebody has edited is refused by its line, not drawn.
TEST(CliPlot, RefusesASeriesThatIsNone) {
  const Folder folder;
  folder.done({"run", shipped("bench_ring"), "--end", "0.001", "-o", "out"});
  const std::string good = folder.text("out/series.csv");
  const auto refusal = [&](std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    std::ofstream(folder.path() / "out/series.csv") << text;
    const Outcome done = folder.run({"plot", "out"});
    EXPECT_EQ(done.code, 2);
    EXPECT_FALSE(folder.has("out/plot.html"));
    return done.err;
  };
  EXPECT_TRUE(
      contains(refusal(good, "gap_rate", "gap_rape"), "out/series.csv: has no column `gap_rate`"));
  EXPECT_TRUE(contains(refusal(good, "\n0,", "\n5,"), "out/series.csv:3: the times do not ascend"));
  EXPECT_TRUE(contains(refusal(good, "\n0,", "\nnan,"), "out/series.csv:2: t = nan"));
  EXPECT_TRUE(
      contains(refusal(good, "\n0,", "\nzero,"), "out/series.csv:2: `zero` is not a number"));
}

TEST(CliPlot, NamesAColumnOfTheModesThatIsMissing) {
  const Folder folder;
  folder.done(
      {"run", shipped("paper_passive"), "--set", "rotor.modes=2", "--end", "0.001", "-o", "out"});
  std::string text = folder.text("out/series.csv");
  text.replace(text.find(",vx_1"), 5, ",vx_7");
  std::ofstream(folder.path() / "out/series.csv") << text;
  const Outcome done = folder.run({"plot", "out"});
  EXPECT_EQ(done.code, 2);
  EXPECT_TRUE(contains(done.err, "no column `vx_1`")) << done.err;
}

// A device has no end.
TEST(CliPlot, ReadsFilesAlone) {
  const Folder folder;
  folder.done({"run", shipped("bench_ring"), "--end", "0.001", "-o", "out"});
  for (const char* file : {"series.csv", "impacts.csv", "summary.json", "scene.toml"}) {
    const std::filesystem::path there = folder.path() / "out" / file;
    const std::filesystem::path kept = folder.path() / "kept";
    std::filesystem::rename(there, kept);
    std::filesystem::create_symlink("/dev/zero", there);
    const Outcome done = folder.run({"plot", "out"});
    EXPECT_EQ(done.code, 2) << file;
    EXPECT_TRUE(contains(done.err, std::string("out/") + file + ": is a device")) << done.err;
    std::filesystem::rename(kept, there);
  }
  EXPECT_EQ(folder.run({"compare", shipped("bench_ring"), "--measured", "/dev/zero"}).code, 2);
}

}  // namespace
}  // namespace rotorub::test
