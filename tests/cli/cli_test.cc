// The command line of the contract: exit codes, files and what stands in them.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

using nlohmann::json;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// No file that was written aside is left, whatever happened.
void expect_whole_files(const Folder& folder) {
  for (const std::string& file : folder.files()) {
    EXPECT_FALSE(contains(file, ".part")) << file;
  }
}

TEST(Cli, WithoutACommandItIsUsage) {
  const Folder folder;
  EXPECT_EQ(folder.run({}).code, 2);
  EXPECT_EQ(folder.run({"dance"}).code, 2);
  EXPECT_EQ(folder.run({"run"}).code, 2);
  EXPECT_EQ(folder.run({"run", shipped("bench_drop"), "--stpe", "1e-5"}).code, 2);
  EXPECT_EQ(folder.run({"run", shipped("bench_drop"), "--engine", "bullet"}).code, 2);
  EXPECT_TRUE(folder.files().empty());
}

TEST(Cli, HelpAndVersionAreDone) {
  const Folder folder;
  EXPECT_EQ(folder.run({"--help"}).code, 0);
  EXPECT_EQ(folder.run({"run", "--help"}).code, 0);
  const Outcome version = folder.run({"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_TRUE(contains(version.out, ROTORUB_VERSION));
  EXPECT_TRUE(contains(version.out, "MuJoCo 2."));
}

constexpr const char* kSeries =
    "t,rotor_x,rotor_y,rotor_vx,rotor_vy,stator_x,stator_y,stator_vx,stator_vy,spin_angle,"
    "spin_speed,gap,gap_rate,slip,normal_force,friction_force,mode,x_1,y_1,vx_1,vy_1";

TEST(CliRun, WritesTheContractsFiles) {
  for (const std::string engine : {"native", "mujoco"}) {
    const Folder folder;
    const Outcome done = folder.run({"run", shipped("bench_ring"), "--engine", engine, "--end",
                                     "0.02", "--set", "run.integrator=paper", "-o", "out"});
    ASSERT_EQ(done.code, 0) << done.err;
    EXPECT_EQ(done.err, "");
    EXPECT_EQ(folder.files(),
              (std::vector<std::string>{"out/events.csv", "out/impacts.csv", "out/scene.toml",
                                        "out/series.csv", "out/summary.json"}));
    EXPECT_EQ(first_line(folder.text("out/series.csv")), kSeries);
    EXPECT_EQ(first_line(folder.text("out/impacts.csv")),
              "t,normal_impulse,friction_impulse,gap_rate_before,gap_rate_after,slip_before,"
              "slip_after,energy_change");
    EXPECT_EQ(first_line(folder.text("out/events.csv")), "t,event");
    for (const char* file : {"out/series.csv", "out/impacts.csv", "out/events.csv"}) {
      const std::string text = folder.text(file);
      EXPECT_FALSE(contains(text, "nan")) << file;
      EXPECT_FALSE(contains(text, ",,")) << file;
      EXPECT_FALSE(contains(text, " ")) << file;
      EXPECT_GT(std::count(text.begin(), text.end(), '\n'), 1) << file;
    }
    const json summary = json::parse(folder.text("out/summary.json"));
    EXPECT_EQ(summary.at("engine"), engine);
    EXPECT_EQ(summary.at("status"), "ok");
    EXPECT_EQ(summary.at("step"), 1e-5);
    EXPECT_EQ(summary.at("steps"), 2000);
    EXPECT_EQ(summary.at("scene"), "bench_ring");
  }
}

TEST(CliRun, JsonIsTheSummaryAndNothingElse) {
  const Folder folder;
  const Outcome done =
      folder.run({"run", shipped("bench_drop"), "--json", "--end", "20ms", "-o", "out"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(json::parse(done.out), json::parse(folder.text("out/summary.json")));
  EXPECT_EQ(done.err, "");
}

TEST(CliRun, QuietSaysNothing) {
  const Folder folder;
  const Outcome done = folder.run({"run", shipped("bench_drop"), "--quiet", "-o", "out"});
  EXPECT_EQ(done.code, 0);
  EXPECT_EQ(done.out + done.err, "");
}

TEST(CliRun, SaysWhereTheDefaultFolderIs) {
  const Folder folder;
  const Outcome done = folder.run({"run", shipped("bench_drop"), "--integrator", "paper"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(folder.has("runs/bench_drop-native-paper/summary.json"));
  EXPECT_TRUE(contains(done.out, "runs/bench_drop-native-paper"));
}

TEST(CliRun, StepAndEndTakeUnits) {
  const Folder folder;
  const Outcome done = folder.run({"run", shipped("bench_drop"), "--step", "20us", "--end", "10 ms",
                                   "--integrator", "paper", "--json", "-o", "out"});
  ASSERT_EQ(done.code, 0) << done.err;
  const json summary = json::parse(done.out);
  EXPECT_DOUBLE_EQ(summary.at("step").get<double>(), 2e-5);
  EXPECT_EQ(summary.at("steps"), 500);
  EXPECT_EQ(folder.run({"run", shipped("bench_drop"), "--step", "20 kg", "-o", "no"}).code, 2);
  EXPECT_FALSE(folder.has("no"));
}

TEST(CliRun, SetOverridesAnyValue) {
  const Folder folder;
  const auto impulse = [&](const std::vector<std::string>& overrides) {
    std::vector<std::string> arguments{"run", shipped("bench_drop"), "--json", "-o", "out"};
    for (const std::string& override : overrides) {
      arguments.push_back("--set");
      arguments.push_back(override);
    }
    const Outcome done = folder.run(arguments);
    EXPECT_EQ(done.code, 0) << done.err;
    return json::parse(done.out).at("impulse_total").get<double>();
  };
  const double plain = impulse({});
  const double bouncy = impulse({"contact.restitution=0.8", "contact.clearance=\"0.4 mm\""});
  EXPECT_NE(plain, bouncy);
  EXPECT_EQ(plain, impulse({"contact.restitution=0.5"}));  // what the scene says already
}

// Everything that is wrong, not the first alone; nothing is written.
TEST(CliRun, ABadSceneIsRefusedWithAllErrors) {
  const Folder folder;
  std::ofstream(folder.path() / "bad.toml")
      << "[run]\nend = -1.0\n[rotor]\nspeed = \"50 kg\"\n[rotor.modal]\nmass = [2.0]\n"
         "stiffness = [2e5]\ndamping = [40.0]\ninertia = 1e-3\n[contact]\nclearence = 1e-3\n";
  const Outcome refused = folder.run({"run", "bad.toml", "-o", "out"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.out, "");
  for (const char* part : {"bad.toml:2", "run.end", "bad.toml:4", "rotor.speed", "clearence"}) {
    EXPECT_TRUE(contains(refused.err, part)) << part << " in:\n" << refused.err;
  }
  EXPECT_FALSE(folder.has("out"));
  EXPECT_EQ(folder.run({"run", "missing.toml"}).code, 2);
  EXPECT_EQ(folder.run({"run", shipped("bench_drop"), "--set", "no_such.key=1"}).code, 2);
}

TEST(CliRun, OptionsOfTheOtherEngineAreRefused) {
  const Folder folder;
  EXPECT_EQ(folder.run({"run", shipped("bench_drop"), "--contact", "cone"}).code, 2);
  EXPECT_EQ(
      folder.run({"run", shipped("bench_drop"), "--engine", "mujoco", "--integrator", "paper"})
          .code,
      2);
  EXPECT_TRUE(folder.files().empty());
}

TEST(CliRun, AFolderThatCannotBeMadeIsBadInput) {
  const Folder folder;
  std::ofstream(folder.path() / "file") << "in the way";
  EXPECT_EQ(folder.run({"run", shipped("bench_drop"), "-o", "file/out"}).code, 2);
}

// A step beyond the stability of the fastest mode cannot work: exit code 3, said so.
TEST(CliRun, ARunThatCannotBeSolvedIsThree) {
  const Folder folder;
  const Outcome failed = folder.run({"run", shipped("bench_ring"), "--integrator", "paper",
                                     "--step", "0.1", "--end", "1", "-o", "out"});
  EXPECT_EQ(failed.code, 3);
  EXPECT_NE(failed.err, "");
  EXPECT_NE(json::parse(folder.text("out/summary.json")).at("status"), "ok");
}

// Ctrl-C: what there is is kept, whole; exit code 130.
TEST(CliRun, AnInterruptKeepsPartialResults) {
  const Folder folder;
  Program program(folder.path(), {"run", shipped("bench_ring"), "--integrator", "paper", "--end",
                                  "1e5", "--set", "run.output_step=0.1", "-o", "out"});
  std::this_thread::sleep_for(std::chrono::seconds(1));
  program.interrupt();
  const Outcome stopped = program.wait();
  EXPECT_EQ(stopped.code, 130) << stopped.err;
  expect_whole_files(folder);
  const json summary = json::parse(folder.text("out/summary.json"));
  EXPECT_EQ(summary.at("status"), "interrupted");
  EXPECT_GT(summary.at("end").get<double>(), 0.0);
  const std::string series = folder.text("out/series.csv");
  EXPECT_EQ(series.back(), '\n');
  EXPECT_EQ(first_line(series), kSeries);
}

// What a rigid impact is worth on the modes kept, and where the whirl outruns them.
TEST(CliRun, SummarySaysWhatTheModesAreWorth) {
  const Folder folder;
  const auto summary = [&](const std::string& scene, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"run", shipped(scene), "--end", "5ms", "--json", "-o", "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome done = folder.run(arguments);
    EXPECT_EQ(done.code, 0) << done.err;
    return json::parse(done.out);
  };
  const json rig = summary("paper_passive", {"--set", "rotor.modes=2"});
  EXPECT_EQ(rig.at("contact_mass").at("kept_modes"), 2);
  EXPECT_GT(rig.at("contact_mass").at("kept"), rig.at("contact_mass").at("mesh"));
  EXPECT_GT(rig.at("above_modes").at("highest_forward"), 2000.0) << "near 376 Hz";
  EXPECT_EQ(rig.at("above_modes").at("contact_share"), 0.0) << "it has not touched";
  const json ring = summary("bench_ring", {});
  EXPECT_TRUE(ring.at("contact_mass").is_null()) << "modal form";
  EXPECT_TRUE(ring.at("above_modes").is_null());
}

TEST(CliCompare, UnknownModesAndTolerancesAreRefused) {
  const Folder folder;
  EXPECT_EQ(folder.run({"compare", shipped("bench_ring"), "--mode", "guess"}).code, 2);
  EXPECT_EQ(folder.run({"compare", shipped("bench_ring"), "--tolerance", "1 mm"}).code, 2);
  EXPECT_TRUE(folder.files().empty());
}

// The native side under the commands that MuJoCo used; where there are none, that is said.
TEST(CliCompare, ReplaysTheCommands) {
  const Folder folder;
  const std::vector<std::string> base{"compare", shipped("bench_ring"), "--mode", "replay",
                                      "--end",   "0.02",                "--no-video", "--twins",
                                      "2",       "-o",                  "out"};
  const Outcome none = folder.run(base);
  EXPECT_EQ(none.code, 0) << none.out << none.err;
  EXPECT_TRUE(contains(none.out, "Replay equals lockstep here: no controller")) << none.out;

  auto controlled = base;
  for (const char* set : {"controller.kind=passive", "controller.stiffness=5e4"}) {
    controlled.insert(controlled.end(), {"--set", set});
  }
  const Outcome replayed = folder.run(controlled);
  EXPECT_EQ(replayed.code, 0) << replayed.out << replayed.err;
  EXPECT_TRUE(contains(replayed.out, "Replay: each MuJoCo run")) << replayed.out;
  const json all = json::parse(folder.text("out/compare.json"));
  EXPECT_EQ(all.at("mode"), "replay");
  EXPECT_EQ(all.at("scenes")[0].at("shadow").at("commands_of"), "rigid");
  EXPECT_TRUE(contains(folder.text("out/report.html"), "replay comparison"));
}

// The exit code is by the contacts of the model that decides, one by one.
TEST(CliCompare, ResyncJudgesContactByContact) {
  const Folder folder;
  std::vector<std::string> call{"compare", shipped("bench_billiard"), "--mode", "resync",
                                "--end",   "0.05", "--no-video", "-o", "out"};
  const Outcome rigid = folder.run(call);
  EXPECT_EQ(rigid.code, 0) << rigid.out << rigid.err;
  EXPECT_TRUE(contains(rigid.out, "onset")) << rigid.out;
  const json all = json::parse(folder.text("out/compare.json"));
  EXPECT_EQ(all.at("mode"), "resync");
  EXPECT_LT(all.at("scenes")[0]
                .at("differences")
                .at("rigid")
                .at("resync")
                .at("figures")
                .at("impulse")
                .at("worst")
                .get<double>(),
            0.01);
  EXPECT_TRUE(contains(folder.text("out/report.html"), "Contact by contact"));
  call.insert(call.end(), {"--contact", "cone"});
  EXPECT_EQ(folder.run(call).code, 1) << "a soft contact takes the peak off";
}

// bench_ring: coulomb is close, but not to a millionth. The exit code is the verdict.
TEST(CliCompare, ExitCodeSaysWhetherTheyAgree) {
  const Folder folder;
  const std::vector<std::string> base{
      "compare", shipped("bench_ring"), "--end", "0.1", "--no-video", "--json", "-o", "out"};
  auto loose = base;
  loose.insert(loose.end(), {"--tolerance", "10%"});
  const Outcome agree = folder.run(loose);
  EXPECT_EQ(agree.code, 0) << agree.out << agree.err;
  EXPECT_TRUE(json::parse(agree.out).at("within").get<bool>());

  auto strict = base;
  strict.insert(strict.end(), {"--tolerance", "1e-6"});
  const Outcome differ = folder.run(strict);
  EXPECT_EQ(differ.code, 1) << differ.out << differ.err;
  EXPECT_FALSE(json::parse(differ.out).at("within").get<bool>());
}

// Whose verdict counts is the user's choice, and said.
TEST(CliCompare, TheConeDecidesWhereAsked) {
  const Folder folder;
  const Outcome differ =
      folder.run({"compare", shipped("bench_ring"), "--end", "0.05", "--no-video", "--tolerance",
                  "10%", "--contact", "cone", "--twins", "4", "-o", "out"});
  EXPECT_EQ(differ.code, 1) << differ.err;
  EXPECT_TRUE(contains(differ.out, "Exit code: by cone (--contact), which is outside 10 %"))
      << differ.out;
  const json all = json::parse(folder.text("out/compare.json"));
  EXPECT_EQ(all.at("contact"), "cone");
  ASSERT_EQ(all.at("answer").size(), 3U);
  EXPECT_EQ(all["answer"][0].at("contact"), "cone");
  EXPECT_EQ(all["answer"][0].at("trusted"), "no");
  EXPECT_TRUE(all["answer"][0].at("decides_exit_code").get<bool>());
}

// 1 may be meant as 1 % and would be 100 %: neither is guessed.
TEST(CliCompare, ABareToleranceOfOneIsRefused) {
  const Folder folder;
  for (const std::string command : {"compare", "tune"}) {
    const Outcome refused = folder.run({command, shipped("bench_ring"), "--tolerance", "1"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_EQ(refused.out, "");
    for (const char* part : {"100 %", "\"1%\"", "0.01"}) {
      EXPECT_TRUE(contains(refused.err, part)) << part << " in: " << refused.err;
    }
  }
  EXPECT_EQ(folder.run({"compare", shipped("bench_ring"), "--twins", "-1"}).code, 2);
  EXPECT_TRUE(folder.files().empty());
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
      for (const std::string file : {"series.csv", "impacts.csv", "events.csv", "summary.json"}) {
        EXPECT_TRUE(folder.has("out/" + scene + "/" + side + "/" + file)) << scene << side << file;
      }
    }
  }
  EXPECT_EQ(json::parse(folder.text("out/compare.json")).at("scenes").size(), 2U);
  EXPECT_TRUE(contains(folder.text("out/report.html"), "bench_drop"));
  expect_whole_files(folder);
}

// With films: they are files of their own, and inside the page.
TEST(CliCompareLong, TheReportHoldsTheFilms) {
  const Folder folder;
  const Outcome done = folder.run({"compare", shipped("bench_ring"), "--end", "0.02", "-o", "out"});
  ASSERT_LE(done.code, 1) << done.err;
  for (const std::string side : {"native", "coulomb", "cone"}) {
    EXPECT_TRUE(contains(folder.text("out/bench_ring/" + side + ".mp4"), "ftyp"));
  }
  const std::string page = folder.text("out/report.html");
  std::size_t films = 0;
  for (std::size_t at = page.find("src=\"data:video/mp4;base64,"); at != std::string::npos;
       at = page.find("src=\"data:video/mp4;base64,", at + 1)) {
    ++films;
  }
  EXPECT_GE(films, 3U);
  expect_whole_files(folder);
}

TEST(CliCompareLong, AnInterruptIs130) {
  const Folder folder;
  Program program(folder.path(), {"compare", shipped("bench_ring"), "--end", "1000", "-o", "out"});
  std::this_thread::sleep_for(std::chrono::seconds(1));
  program.interrupt();
  EXPECT_EQ(program.wait().code, 130);
  EXPECT_FALSE(folder.has("out/report.html"));
  expect_whole_files(folder);
}

TEST(CliMjcf, WritesToStandardOutputOrAFile) {
  const Folder folder;
  const Outcome printed = folder.run({"mjcf", shipped("bench_ring")});
  ASSERT_EQ(printed.code, 0) << printed.err;
  EXPECT_TRUE(contains(printed.out, "<mujoco"));
  const Outcome written = folder.run({"mjcf", shipped("bench_ring"), "-o", "ring.xml"});
  ASSERT_EQ(written.code, 0);
  EXPECT_EQ(folder.text("ring.xml"), printed.out);
}

TEST(CliModes, PrintsTheContractsJson) {
  const Folder folder;
  const Outcome done =
      folder.run({"modes", shipped("paper_passive"), "--speed", "4000 rpm", "--json"});
  ASSERT_EQ(done.code, 0) << done.err;
  const json modes = json::parse(done.out);
  ASSERT_EQ(modes.at("speeds").size(), 1U);
  EXPECT_NEAR(modes.at("speeds")[0].at("speed").get<double>(), 418.879, 1e-3);
  EXPECT_TRUE(modes.contains("critical_speeds"));
  EXPECT_TRUE(modes.contains("stability_threshold"));
  EXPECT_EQ(folder.run({"modes", shipped("paper_passive"), "--speed", "4 kg"}).code, 2);
}

TEST(CliRender, FilmsAKeptRun) {
  const Folder folder;
  ASSERT_EQ(folder.run({"run", shipped("bench_ring"), "--end", "5ms", "--quiet", "-o", "out"}).code,
            0);
  const Outcome refused = folder.run({"render", "out", "--step", "1e-5"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(folder.run({"render", "nowhere.toml"}).code, 2);
  EXPECT_FALSE(folder.has("film.mp4"));
}

TEST(CliRenderLong, WritesAFilm) {
  const Folder folder;
  ASSERT_EQ(folder.run({"run", shipped("bench_ring"), "--end", "5ms", "--quiet", "-o", "out"}).code,
            0);
  const Outcome done = folder.run({"render", "out", "-o", "film.mp4", "--json"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(json::parse(done.out).at("file"), "film.mp4");
  EXPECT_TRUE(contains(folder.text("film.mp4"), "ftyp"));
  expect_whole_files(folder);
}

}  // namespace
}  // namespace rotorub::test
