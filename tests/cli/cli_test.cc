// The command line of the contract: exit codes, files and their contents.

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>

#include "plugin/model/mujoco_versions.h"
#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

TEST(Cli, WithoutACommandPrintsTheUsage) {
  const Folder folder;
  folder.refuses({});
  folder.refuses({"rnu", shipped("bench_drop")},
                 {"rotorub: rnu: no such command, did you mean run? Choose from init, run"});
  EXPECT_TRUE(folder.files().empty());
}

TEST(Cli, SaysWhatIsWrongWithAnOptionAndWhatToDo) {
  const Folder folder;
  const std::string drop = shipped("bench_drop");
  const auto said = [&](const std::vector<std::string>& words) { return folder.run(words).err; };
  const std::string help = "`rotorub help run` shows the usage\n";
  EXPECT_EQ(said({"run"}), "rotorub run: the argument SCENE is missing. " + help);
  EXPECT_EQ(said({"run", drop, "other.toml"}),
            "rotorub run: other.toml: unexpected argument. " + help);
  EXPECT_EQ(said({"run", drop, "--stpe", "1e-5"}),
            "rotorub run: --stpe: no such option, did you mean --step? " + help);
  EXPECT_EQ(said({"run", drop, "--stpe=1e-5"}),
            "rotorub run: --stpe: no such option, did you mean --step? " + help);
  EXPECT_EQ(said({"run", drop, "--bounce"}), "rotorub run: --bounce: no such option. " + help);
  EXPECT_EQ(said({"run", drop, "--step"}),
            "rotorub run: --step: the value TIME is missing. " + help);
  EXPECT_EQ(said({"run", drop, "--engine", "bullet"}),
            "rotorub run: --engine: bullet: no such value; choose from native, mujoco\n");
  EXPECT_EQ(said({"run", drop, "--integrator", "verlt"}),
            "rotorub run: --integrator: verlt: no such value, did you mean verlet? Choose from "
            "event, verlet, euler\n");
  EXPECT_EQ(said({"run", drop, "--controller", "none.so"}),
            "rotorub run: --controller: none.so: no such file\n");
  EXPECT_EQ(said({"compare", drop, "--twins", "many"}),
            "rotorub compare: --twins many: expected a whole number\n");
  EXPECT_EQ(said({"compare", drop, "--jobs", "0"}),
            "rotorub compare: --jobs: 0: expected a whole number from 1 to 4096\n");
  EXPECT_TRUE(contains(said({"compare", drop, "--no-video", "--all-films"}),
                       "rotorub compare: Give either --"));
  EXPECT_TRUE(contains(said({"--bounce"}), "rotorub: --bounce: no such option. `rotorub help`"));
  EXPECT_TRUE(folder.files().empty());
}

// The help contains none of the parser's notation: types, braces, upper-case words.
TEST(Cli, HelpIsOfWords) {
  const Folder folder;
  const std::string help = folder.done({"help", "compare"}).out;
  EXPECT_TRUE(contains(help, "--mode lockstep|replay|resync"));
  EXPECT_TRUE(contains(help, "(default: lockstep)"));
  EXPECT_TRUE(contains(help, "Not with --no-video."));
  EXPECT_TRUE(contains(folder.done({"help", "modes"}).out, "--speeds FROM:TO:COUNT"));
  for (const std::string raw : {"TEXT", "{", "Excludes", "Needs", "REQUIRED", "INT in"})
    EXPECT_FALSE(contains(help, raw)) << raw << '\n' << help;
}

TEST(Cli, HasItsVersion) {
  const Folder folder;
  const Outcome version = folder.done({"--version"});
  EXPECT_TRUE(contains(version.out, ROTORUB_VERSION));
  // The versions of MuJoCo that the program was built with and that it loads are those of the
  // test's headers and library.
  EXPECT_TRUE(contains(version.out, "MuJoCo: headers " + plugin::version_text(mjVERSION_HEADER) +
                                        ", run time " + mj_versionString() + ")"));
}

constexpr const char* kSeries =
    "t,rotor_x,rotor_y,rotor_vx,rotor_vy,stator_x,stator_y,stator_vx,stator_vy,spin_angle,"
    "spin_speed,gap,gap_rate,slip,normal_force,friction_force,mode,x_1,y_1,vx_1,vy_1,motor_torque";

TEST(CliRun, WritesTheContractsFiles) {
  for (const std::string engine : {"native", "mujoco"}) {
    const Folder folder;
    const Outcome done = folder.done({"run", shipped("bench_ring"), "--engine", engine, "--end",
                                      "0.03", "--set", "run.integrator=verlet", "-o", "out"});
    EXPECT_EQ(done.err, "");
    EXPECT_EQ(folder.files(),
              (std::vector<std::string>{"out/columns.json", "out/events.csv", "out/impacts.csv",
                                        "out/keyphasor.csv", "out/scene.toml", "out/series.csv",
                                        "out/summary.json"}));
    EXPECT_EQ(first_line(folder.text("out/series.csv")), kSeries);
    EXPECT_EQ(first_line(folder.text("out/impacts.csv")),
              "t,normal_impulse,friction_impulse,gap_rate_before,gap_rate_after,slip_before,"
              "slip_after,energy_change");
    EXPECT_EQ(first_line(folder.text("out/events.csv")), "t,event");
    for (const char* file :
         {"out/series.csv", "out/impacts.csv", "out/events.csv", "out/keyphasor.csv"}) {
      const std::string text = folder.text(file);
      EXPECT_FALSE(contains(text, "nan")) << file;
      EXPECT_FALSE(contains(text, ",,")) << file;
      EXPECT_FALSE(contains(text, " ")) << file;
      EXPECT_GT(std::count(text.begin(), text.end(), '\n'), 1) << file;
    }
    const json summary = folder.json_in("out/summary.json");
    EXPECT_EQ(summary.at("engine"), engine);
    EXPECT_EQ(summary.at("status"), "ok");
    EXPECT_EQ(summary.at("step"), 1e-5);
    EXPECT_EQ(summary.at("steps"), 3000);
    EXPECT_EQ(summary.at("scene"), "bench_ring");
  }
}

TEST(CliRun, JsonIsTheSummaryAndNothingElse) {
  const Folder folder;
  const Outcome done =
      folder.done({"run", shipped("bench_drop"), "--json", "--end", "20ms", "-o", "out"});
  EXPECT_EQ(json::parse(done.out), folder.json_in("out/summary.json"));
  EXPECT_EQ(done.err, "");
}

TEST(CliRun, QuietSaysNothing) {
  const Folder folder;
  const Outcome done = folder.done({"run", shipped("bench_drop"), "--quiet", "-o", "out"});
  EXPECT_EQ(done.out + done.err, "");
}

TEST(CliRun, SaysWhereTheDefaultFolderIs) {
  const Folder folder;
  const Outcome done = folder.done({"run", shipped("bench_drop"), "--integrator", "verlet"});
  EXPECT_TRUE(folder.has("runs/bench_drop-native-verlet/summary.json"));
  EXPECT_TRUE(contains(done.out, "runs/bench_drop-native-verlet"));
}

TEST(CliRun, StepAndEndTakeUnits) {
  const Folder folder;
  const json summary = folder.json_of({"run", shipped("bench_drop"), "--step", "20us", "--end",
                                       "10 ms", "--integrator", "verlet", "--json", "-o", "out"});
  EXPECT_DOUBLE_EQ(summary.at("step").get<double>(), 2e-5);
  EXPECT_EQ(summary.at("steps"), 500);
  folder.refuses({"run", shipped("bench_drop"), "--step", "20 kg", "-o", "no"});
  EXPECT_FALSE(folder.has("no"));
}

TEST(CliRun, SetOverridesAnyValue) {
  const Folder folder;
  const auto impulse = [&](const std::vector<std::string>& overrides) {
    std::vector<std::string> arguments{"run", shipped("bench_drop"), "--json", "-o", "out"};
    for (const std::string& override : overrides) arguments = with(arguments, {"--set", override});
    return folder.json_of(arguments).at("impulse_total").get<double>();
  };
  const double plain = impulse({});
  const double bouncy = impulse({"contact.restitution=0.8", "contact.clearance=\"0.4 mm\""});
  EXPECT_NE(plain, bouncy);
  EXPECT_EQ(plain, impulse({"contact.restitution=0.5"}));  // what the scene says already
}

// The message names all errors, not only the first; nothing is written.
TEST(CliRun, ABadSceneIsRefusedWithAllErrors) {
  const Folder folder;
  folder.write(
      "bad.toml",
      "[run]\nend = -1.0\n[rotor]\nspeed = \"50 kg\"\n[rotor.modal]\nmass = [2.0]\n"
      "stiffness = [2e5]\ndamping = [40.0]\ninertia = 1e-3\n[contact]\nclearence = 1e-3\n");
  folder.refuses({"run", "bad.toml", "-o", "out"},
                 {"bad.toml:2", "run.end", "bad.toml:4", "rotor.speed", "clearence"});
  EXPECT_FALSE(folder.has("out"));
  folder.refuses({"run", "missing.toml"});
  folder.refuses({"run", shipped("bench_drop"), "--set", "no_such.key=1"});
}

TEST(CliRun, OptionsOfTheOtherEngineAreRefused) {
  const Folder folder;
  folder.refuses({"run", shipped("bench_drop"), "--contact", "cone"});
  folder.refuses({"run", shipped("bench_drop"), "--engine", "mujoco", "--integrator", "verlet"});
  EXPECT_TRUE(folder.files().empty());
}

// A step beyond the stability of the fastest mode cannot work: the exit code is 3, with a message.
TEST(CliRun, ARunThatCannotBeSolvedIsThree) {
  const Folder folder;
  const Outcome failed = folder.run({"run", shipped("bench_ring"), "--integrator", "verlet",
                                     "--step", "0.1", "--end", "1", "-o", "out"});
  EXPECT_EQ(failed.code, 3);
  EXPECT_NE(failed.err, "");
  EXPECT_NE(folder.json_in("out/summary.json").at("status"), "ok");
}

TEST(CliRun, TheTableSaysEachFigureOnce) {
  const Folder folder;
  const std::string out =
      folder.done({"run", shipped("bench_drop"), "--end", "1ms", "-o", "o"}).out;
  EXPECT_EQ(out.find("least gap"), out.rfind("least gap")) << out;
  EXPECT_TRUE(contains(out, "least gap"));
}

// The summary states the effective mass of the modes that are kept, and warns where the whirl is
// faster than they are.
TEST(CliRun, SummarySaysWhatTheModesAreWorth) {
  const Folder folder;
  const auto summary = [&](const std::string& scene, const std::vector<std::string>& more) {
    return folder.json_of(
        with({"run", shipped(scene), "--end", "5ms", "--json", "-o", "out"}, more));
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

TEST(CliMjcf, WritesToStandardOutputOrAFile) {
  const Folder folder;
  const Outcome printed = folder.done({"mjcf", shipped("bench_ring")});
  EXPECT_TRUE(contains(printed.out, "<mujoco"));
  const Outcome written = folder.done({"mjcf", shipped("bench_ring"), "-o", "ring.xml"});
  EXPECT_EQ(folder.text("ring.xml"), printed.out);
}

TEST(CliModes, PrintsTheContractsJson) {
  const Folder folder;
  const json modes =
      folder.json_of({"modes", shipped("paper_passive"), "--speed", "4000 rpm", "--json"});
  ASSERT_EQ(modes.at("speeds").size(), 1U);
  EXPECT_NEAR(modes.at("speeds")[0].at("speed").get<double>(), 418.879, 1e-3);
  EXPECT_TRUE(modes.contains("critical_speeds"));
  EXPECT_TRUE(modes.contains("stability_threshold"));
  folder.refuses({"modes", shipped("paper_passive"), "--speed", "4 kg"});
}

}  // namespace
}  // namespace rotorub::test
