// After the program was stopped there are only complete files, at once or after the next run.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

using namespace std::chrono_literals;

const std::vector<std::string> kLongRun{
    "run",   shipped("bench_ring"), "--integrator", "verlet", "--end", "1e5",
    "--set", "run.output_step=0.1", "-o",           "out"};

// The exit code of a shell: 128 plus the signal.
TEST(CliStop, ASignalKeepsPartialResults) {
  for (const auto& [signal, code] : {std::pair{SIGTERM, 143}, {SIGHUP, 129}, {SIGINT, 130}}) {
    const Folder folder;
    Program program(folder.path(), kLongRun);
    std::this_thread::sleep_for(1s);
    program.interrupt(signal);
    const Outcome stopped = program.wait();
    EXPECT_EQ(stopped.code, code) << stopped.err;
    expect_whole_files(folder);
    const json summary = folder.json_in("out/summary.json");
    EXPECT_EQ(summary.at("status"), "interrupted");
    EXPECT_GT(summary.at("end").get<double>(), 0.0);
    EXPECT_EQ(folder.text("out/series.csv").back(), '\n');
  }
}

TEST(CliStop, AComparisonSaysThatItWasInterrupted) {
  const Folder folder;
  Program program(folder.path(), {"compare", shipped("bench_ring"), "--end", "1e3", "-o", "out"});
  std::this_thread::sleep_for(1s);
  program.interrupt(SIGINT);
  const Outcome stopped = program.wait();
  EXPECT_EQ(stopped.code, 130);
  EXPECT_FALSE(folder.has("out/report.html"));
  expect_whole_files(folder);
  EXPECT_TRUE(contains(stopped.err, "rotorub compare: interrupted"));
}

TEST(CliStop, AFilmIsNotLeftHalfMade) {
  const Folder folder;
  Program program(folder.path(),
                  {"render", shipped("bench_ring"), "--end", "0.1", "-o", "film.mp4"});
  for (int tries = 0; tries < 300 && folder.files().empty(); ++tries)
    std::this_thread::sleep_for(20ms);
  EXPECT_EQ(folder.files().size(), 1u) << "it is being made";
  program.interrupt(SIGTERM);
  EXPECT_EQ(program.wait().code, 143);
  EXPECT_EQ(folder.files(), std::vector<std::string>());
}

// A process number that is no longer in use, as after a kill.
pid_t ended_process(const Folder& folder) {
  const Program program(folder.path(), {"--version"});
  program.wait();
  return program.process();
}

TEST(CliStop, TheNextRunRemovesWhatAKilledOneLeft) {
  const Folder folder;
  const std::string ended = std::to_string(ended_process(folder)),
                    running = std::to_string(getpid());
  std::filesystem::create_directory(folder.path() / "out");
  const std::vector<std::string> stale{"out/series.csv.part-" + ended,
                                       "out/summary.json.part-" + ended, "drop.xml.part-" + ended,
                                       "film.png.part-" + ended};
  const std::vector<std::string> others{"out/series.csv.part-" + running, "out/notes.part-" + ended,
                                        "out/series.csv.part-x"};
  for (const auto& files : {stale, others}) {
    for (const std::string& file : files) std::ofstream(folder.path() / file) << "half";
  }
  const std::string drop = shipped("bench_drop");
  folder.done({"run", drop, "--end", "1ms", "-o", "out"});
  folder.done({"mjcf", drop, "-o", "drop.xml"});
  folder.done({"render", "out", "--png", "--size", "320x180", "-o", "film.png"});
  for (const std::string& file : stale) EXPECT_FALSE(folder.has(file)) << file;
  for (const std::string& file : others)
    EXPECT_TRUE(folder.has(file)) << file << " is somebody else's";
}

// Wherever a run is killed, the next run leaves only complete files.
TEST(CliStop, AKilledFilmLeavesNothingAfterTheNext) {
  const Folder folder;
  const std::vector<std::string> render{
      "render",  shipped("bench_ring"), "--end", "20ms", "--size", "320x180", "--slow", "50", "-o",
      "film.mp4"};
  Program program(folder.path(), render);
  for (int tries = 0; tries < 300 && folder.files().empty(); ++tries)
    std::this_thread::sleep_for(20ms);
  EXPECT_EQ(program.kill_and_wait().code, 128 + SIGKILL);
  folder.done(render);
  EXPECT_EQ(folder.files(), std::vector<std::string>{"film.mp4"});
}

// Replaces ffmpeg by a script that runs `does`, and expects the error message `said`.
void expect_failure_of_encoder(const std::string& does, const std::string& said) {
  const Folder folder;
  std::filesystem::permissions(folder.write("bin/ffmpeg", "#!/bin/sh\n" + does + "\n"),
                               std::filesystem::perms::owner_all);
  const std::string path = (folder.path() / "bin").string() + ":" + std::getenv("PATH");
  const Outcome failed = folder.run(
      {"render", shipped("bench_ring"), "--end", "20ms", "--slow", "50", "-o", "film.mp4"},
      {{{"PATH", path}}});
  EXPECT_EQ(failed.code, 3);
  EXPECT_TRUE(contains(failed.err, "film.mp4: " + said));
  EXPECT_EQ(folder.files(), std::vector<std::string>{"bin/ffmpeg"});
}
TEST(CliStop, AFailingEncoderIsAReportedFailure) {
  expect_failure_of_encoder("cat >/dev/null; echo 'disc full' >&2; exit 3",
                            "ffmpeg failed (3): disc full");
}
// The encoder never takes a frame, and is ended after 20 s. Daily: Video.EncoderThatHangsIsEnded.
TEST(CliStopNightly, AnEncoderThatHangsIsAFailureThatIsSaid) {
  expect_failure_of_encoder("exec sleep 1000", "ffmpeg did nothing");
}

}  // namespace
}  // namespace rotorub::test
