// A MuJoCo run with the native model alongside: its own files, and its ghost in the film.
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

const std::vector<std::string> kRun = {
    "run",   shipped("bench_ring"), "--engine", "mujoco", "--end", "20ms",
    "--set", "mujoco.shadow=true",  "-o",       "out"};

TEST(CliShadow, MujocoRunsWriteItsFiles) {
  const Folder folder;
  const Outcome run = folder.done(with(kRun, {"--json"}));
  EXPECT_EQ(json::parse(run.out).at("engine"), "mujoco") << "one summary, and nothing else";
  const json summary = folder.json_in("out/shadow/summary.json");
  EXPECT_EQ(summary.at("engine"), "native");
  EXPECT_EQ(summary.at("integrator"), "verlet");
  EXPECT_EQ(summary.at("step"), json::parse(run.out).at("step"));
  for (const char* file : {"series.csv", "impacts.csv", "events.csv", "keyphasor.csv"}) {
    EXPECT_TRUE(folder.has(std::string("out/shadow/") + file)) << file;
  }
  // Files of a native run.
  folder.done({"run", shipped("bench_ring"), "--integrator", "verlet", "--end", "20ms", "--quiet",
               "-o", "native"});
  EXPECT_EQ(folder.text("out/shadow/series.csv"), folder.text("native/series.csv"));
  EXPECT_EQ(folder.text("out/shadow/impacts.csv"), folder.text("native/impacts.csv"));
}

TEST(CliShadow, NativeRunsHaveNoShadow) {
  const Folder folder;
  auto native = kRun;
  native[3] = "native";
  folder.done(with(native, {"--quiet"}));
  auto off = kRun;
  off[7] = "mujoco.shadow=false";
  folder.done(with(off, {"--quiet"}));
  EXPECT_FALSE(folder.has("out/shadow"));
  EXPECT_EQ(folder.run(with(off, {"--set", "mujoco.shadow=yes"})).code, 2);
}

TEST(CliShadowLong, TheFilmShowsItsGhost) {
  const Folder folder;
  folder.done(with(kRun, {"--quiet"}));
  const Outcome film = folder.done({"render", "out", "--json", "--png", "--size", "320x180"});
  EXPECT_TRUE(json::parse(film.out).at("shadow").get<bool>());
  EXPECT_TRUE(folder.has("bench_ring.png"));
}

}  // namespace
}  // namespace rotorub::test
