// A MuJoCo run with the native model alongside: its own files, and its ghost in the film.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

using nlohmann::json;

const std::vector<std::string> kRun = {
    "run",   shipped("bench_ring"), "--engine", "mujoco", "--end", "20ms",
    "--set", "mujoco.shadow=true",  "-o",       "out"};

TEST(CliShadow, MujocoRunsWriteItsFiles) {
  const Folder folder;
  const Outcome run = folder.run(with(kRun, {"--json"}));
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(json::parse(run.out).at("engine"), "mujoco") << "one summary, and nothing else";
  const json summary = json::parse(folder.text("out/shadow/summary.json"));
  EXPECT_EQ(summary.at("engine"), "native");
  EXPECT_EQ(summary.at("integrator"), "midpoint");
  EXPECT_EQ(summary.at("step"), json::parse(run.out).at("step"));
  for (const char* file : {"series.csv", "impacts.csv", "events.csv"}) {
    EXPECT_TRUE(folder.has(std::string("out/shadow/") + file)) << file;
  }
  // What a native run writes.
  ASSERT_EQ(folder
                .run({"run", shipped("bench_ring"), "--integrator", "midpoint", "--end", "20ms",
                      "--quiet", "-o", "native"})
                .code,
            0);
  EXPECT_EQ(folder.text("out/shadow/series.csv"), folder.text("native/series.csv"));
  EXPECT_EQ(folder.text("out/shadow/impacts.csv"), folder.text("native/impacts.csv"));
}

TEST(CliShadow, OthersHaveNone) {
  const Folder folder;
  auto native = kRun;
  native[3] = "native";
  ASSERT_EQ(folder.run(with(native, {"--quiet"})).code, 0);
  auto off = kRun;
  off[7] = "mujoco.shadow=false";
  ASSERT_EQ(folder.run(with(off, {"--quiet"})).code, 0);
  EXPECT_FALSE(folder.has("out/shadow"));
  EXPECT_EQ(folder.run(with(off, {"--set", "mujoco.shadow=yes"})).code, 2);
}

TEST(CliShadowLong, TheFilmShowsItsGhost) {
  const Folder folder;
  ASSERT_EQ(folder.run(with(kRun, {"--quiet"})).code, 0);
  const Outcome film = folder.run({"render", "out", "--json", "--png", "--size", "320x180"});
  ASSERT_EQ(film.code, 0) << film.err;
  EXPECT_TRUE(json::parse(film.out).at("shadow").get<bool>());
  EXPECT_TRUE(folder.has("bench_ring.png"));
}

}  // namespace
}  // namespace rotorub::test
