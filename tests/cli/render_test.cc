// rotorub render: its files, and what it refuses before anything runs.

#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

using Words = std::vector<std::string>;

// A scene that runs at once.
Words quick_render(const Words& more) {
  return with({"render", shipped("bench_ring"), "--end", "5ms"}, more);
}

// Width and height of a PNG stand in its first chunk, big end first.
std::pair<int, int> png_size(const std::string& png) {
  const auto number = [&png](std::size_t at) {
    int value = 0;
    for (std::size_t k = at; k < at + 4; ++k)
      value = 256 * value + static_cast<unsigned char>(png[k]);
    return value;
  };
  return {number(16), number(20)};
}

TEST(CliRender, SameSceneSameBytesOfAPicture) {
  const Folder folder;
  const json made =
      folder.json_of(quick_render({"--png", "--size", "320x180", "--at", "5 ms", "--json"}));
  EXPECT_EQ(made.at("file"), "bench_ring.png");
  EXPECT_EQ(made.at("t"), 5e-3);
  folder.done(quick_render({"-o", "again.png", "--size", "320x180", "--at", "0.005"}));
  folder.done(quick_render({"-o", "later.png", "--size", "320x180", "--at", "0.0045"}));
  const std::string picture = folder.text("bench_ring.png");
  EXPECT_EQ(png_size(picture), (std::pair{320, 180}));
  EXPECT_EQ(picture, folder.text("again.png"));
  EXPECT_NE(picture, folder.text("later.png"));
  expect_whole_files(folder);
}

TEST(CliRender, FilmIsAsItsFlagsSay) {
  const Folder folder;
  const json made = folder.json_of(
      quick_render({"--gif", "--size", "321x180", "--from", "4 ms", "--to", "0.0045", "--slow",
                    "800", "--fps", "10", "--title", "A bounce", "--json"}));
  EXPECT_EQ(made.at("file"), "bench_ring.gif");
  EXPECT_EQ(made.at("from"), 4e-3);
  EXPECT_EQ(made.at("to"), 4.5e-3);
  EXPECT_EQ(made.at("frames"), 4);  // 0.5 ms * 800 * 10 / s
  EXPECT_EQ(made.at("width"), 321);
  EXPECT_TRUE(contains(folder.text("bench_ring.gif"), "GIF89a"));
}

struct Refused {
  Words flags;
  const char* named;     // the flag
  const char* accepted;  // and what would do
};

TEST(CliRender, RefusesBeforeAnythingRuns) {
  const Refused cases[] = {
      {{"--from", "4ms", "--to", "3ms"}, "--from 4ms --to 3ms", "before"},
      {{"--from", "6ms"}, "--from 0.006 s", "ends at 0.005 s"},
      {{"--to", "1 s"}, "--to 1 s", "ends at 0.005 s"},
      {{"--to", "soon"}, "--to soon", "120 ms"},
      {{"--from=-1ms"}, "--from -1ms", "0 or more"},
      {{"--slow", "0"}, "slow motion = 0", "above 0"},
      {{"--slow", "nan"}, "--slow nan", "above 0"},
      {{"--fps", "1000"}, "1000", "1 to 120"},
      {{"--gif", "--fps", "60"}, "60", "1 to 50"},
      {{"--size", "320"}, "--size 320", "1280x720"},
      {{"--size", "321x180"}, "321x180", "even"},
      {{"--size", "32x18"}, "width = 32", "320 to 3840"},
      {{"--size", "320x180x2"}, "--size 320x180x2", "1280x720"},
      {{"--view", "side"}, "--view side", "rig, axis, close-up or unrolled"},
      {{"--gif", "--png"}, "--gif and --png", "one of them"},
      {{"-o", "film.avi"}, "film.avi", ".mp4, .gif or .png"},
      {{"--gif", "-o", "film.mp4"}, "film.mp4", ".gif"},
      {{"--at", "1ms"}, "--at 1ms", "--png"},
      {{"--png", "--fps", "30"}, "--fps 30", "leave it out with --png"},
  };
  const Folder folder;
  for (const Refused& refused : cases) {
    folder.refuses(quick_render(refused.flags), {refused.named, refused.accepted});
  }
  EXPECT_TRUE(folder.files().empty());
}

TEST(CliRender, ScenesAreChangedRunsAreNot) {
  const Folder folder;
  folder.done({"run", shipped("bench_ring"), "--end", "5ms", "--quiet", "-o", "out"});
  folder.refuses({"render", "out", "--step", "1e-5"});
  folder.refuses({"render", "nowhere.toml"});
  EXPECT_FALSE(folder.has("bench_ring.mp4"));
  const Outcome picture = folder.done({"render", "out", "--png", "--size", "320x180", "--quiet"});
  EXPECT_TRUE(folder.has("bench_ring.png"));
}

// The pictures of two similar runs differ where the captions name the key that differs.
TEST(CliRender, NamesTheKeyByWhichTheRunsDiffer) {
  const Folder folder;
  const auto run = [&](const std::string& out, const Words& more) {
    const Outcome done = folder.done(
        with({"run", shipped("bench_ring"), "--end", "5ms", "--quiet", "-o", out}, more));
  };
  run("a", {});
  run("same", {});
  run("other", {"--set", "run.step=2e-5"});  // no part of a run with adaptive steps
  const auto picture = [&](const std::string& beside) {
    folder.done({"render", "a", "--beside", beside, "--png", "--view", "axis", "--size", "640x360",
                 "--at", "0", "--quiet", "-o", beside + ".png"});
    return folder.text(beside + ".png");
  };
  EXPECT_NE(picture("same"), picture("other"));
}

TEST(CliRender, RunsOfOneSceneSideBySide) {
  const Folder folder;
  const auto run = [&](const std::string& scene, const Words& more) {
    const Outcome done =
        folder.done(with({"run", shipped(scene), "--end", "5ms", "--quiet"}, more));
  };
  run("bench_ring", {"-o", "native"});
  run("bench_ring", {"--engine", "mujoco", "--contact", "cone", "-o", "cone"});
  run("bench_drop", {"-o", "other"});
  const Words picture = {"render", "cone", "--png", "--size", "640x360", "--quiet"};
  folder.done(with(picture, {"-o", "alone.png"}));
  const Outcome pair = folder.done(with(picture, {"--beside", "native", "-o", "pair.png"}));
  EXPECT_NE(folder.text("alone.png"), folder.text("pair.png"));
  for (const char* wrong : {"nowhere", "other"}) {
    folder.refuses(with(picture, {"--beside", wrong}), {std::string("--beside ") + wrong});
  }
}

// A broken folder is refused. A run that did not reach its end is filmed up to there, with a
// message.
TEST(CliRender, TellsOfRunsThatAreBrokenOrEndedEarly) {
  const Folder folder;
  folder.done({"run", shipped("bench_ring"), "--end", "5ms", "--quiet", "-o", "out"});
  const Words picture = {"render", "out", "--png", "--size", "320x180", "--quiet", "-o", "one.png"};
  const std::string summary = folder.text("out/summary.json");
  std::string stopped = summary;
  const std::string ok = "\"status\": \"ok\"";
  ASSERT_TRUE(contains(stopped, ok));
  stopped.replace(stopped.find(ok), ok.size(), "\"status\": \"diverged\"");
  folder.write("out/summary.json", stopped);
  const Outcome early = folder.done(picture);
  EXPECT_TRUE(contains(
      early.err, "rotorub render: out: this run ended early, at 0.005 s of 0.005 s: diverged"));
  EXPECT_TRUE(folder.has("one.png"));

  folder.write("out/summary.json", summary);
  EXPECT_TRUE(folder.run(picture).err.empty());
  folder.write("out/series.csv", "t,gap\n0,nan\n");
  folder.refuses(picture, {"out/series.csv"});
}

TEST(CliRenderLong, WritesAFilm) {
  const Folder folder;
  folder.done({"run", shipped("bench_ring"), "--end", "5ms", "--quiet", "-o", "out"});
  const json made = folder.json_of(
      {"render", "out", "--from", "4ms", "--slow", "500", "-o", "film.mp4", "--json"});
  EXPECT_EQ(made.at("file"), "film.mp4");
  EXPECT_EQ(made.at("width"), 1280);
  EXPECT_EQ(made.at("frames"), 30) << "60 a second by default";
  EXPECT_TRUE(contains(folder.text("film.mp4"), "ftyp"));
  expect_whole_files(folder);
}

}  // namespace
}  // namespace rotorub::test
