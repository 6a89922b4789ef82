// Users' controllers on the command line, and settings that a control engineer needs.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

const std::string kLibraries = ROTORUB_LIBRARIES;

std::vector<std::string> run_with(const std::string& library,
                                  const std::vector<std::string>& more) {
  return with({"run", shipped("paper_sliding"), "--controller", kLibraries + "/" + library, "--set",
               "controller.sample_time=\"50 us\"", "--set", "rotor.modes=2", "--end", "5 ms", "-o",
               "out", "--json"},
              more);
}

TEST(CliController, ALibraryTakesThePlaceOfTheScenes) {
  const Folder folder;
  const Outcome native =
      folder.done(run_with("own_controller.so", {"--set", "controller.config.stiffness=1e5",
                                                 "--set", "controller.on=0"}));
  EXPECT_TRUE(contains(folder.text("out/series.csv"), "control_x")) << "as any controller";
  const Outcome mujoco = folder.run(run_with(
      "own_controller.so", {"--engine", "mujoco", "--set", "controller.config.stiffness=1e5"}));
  ASSERT_EQ(mujoco.code, 0) << mujoco.err << ": a scene that was given may load what it names";
  const Outcome film = folder.run({"render", "out", "--json", "--png", "--size", "320x180"});
  EXPECT_EQ(film.code, 0) << film.err << ": its results are complete where they lie";
}

TEST(CliController, AFailureIsExit3WithNameAndTime) {
  const Folder folder;
  for (const char* engine : {"native", "mujoco"}) {
    const Outcome done =
        folder.run(run_with("faulty_controller.so",
                            {"--engine", engine, "--set", "controller.config.fault=\"nan\"",
                             "--set", "controller.config.at=0.002", "--set", "controller.on=0"}));
    EXPECT_EQ(done.code, 3) << done.err;
    EXPECT_TRUE(contains(done.err, {"controller_failed", "faulty at t = 0.002"}));
    EXPECT_EQ(json::parse(done.out).at("status"), "controller_failed");
  }
}

// A library that calls exit(0) must not make the run look successful.
TEST(CliController, OneThatCallsExitIsExit3) {
  const Folder folder;
  const Outcome done = folder.run(
      run_with("faulty_controller.so", {"--set", "controller.config.fault=exit", "--set",
                                        "controller.config.at=0.002", "--set", "controller.on=0"}));
  EXPECT_EQ(done.code, 3) << done.err;
  EXPECT_TRUE(contains(done.err, "ended the program by calling exit()"));
  EXPECT_FALSE(folder.has("out/summary.json"));
}

// A crash in a library ends the program by its signal, as it always did, but with the law's name.
TEST(CliController, OneThatCrashesIsNamed) {
  const Folder folder;
  const Outcome done = folder.run(
      run_with("faulty_controller.so", {"--set", "controller.config.fault=segmentation", "--set",
                                        "controller.config.at=0.002", "--set", "controller.on=0"}));
  EXPECT_EQ(done.code, 128 + SIGSEGV) << done.err;
  EXPECT_TRUE(contains(done.err, "controller faulty (faulty_controller.so) has caused a fault"));
  EXPECT_FALSE(folder.has("out/summary.json"));
}

// Gains of a user's law are keys like any other.
TEST(CliController, AGainIsVariedInASweepAndAnOptimisation) {
  const Folder folder;
  std::ofstream(folder.path() / "study.toml")
      << "scene = \"" << shipped("paper_sliding") << "\"\n"
      << "[[vary]]\nkey = \"controller.config.stiffness\"\nfrom = 1e4\nto = 2e5\ncount = 2\n"
         "[sample]\nkind = \"grid\"\n[run]\nintegrator = \"verlet\"\n"
         "[optimise]\nminimise = \"control_force\"\nevaluations = 4\n";
  const auto with_law = [](const std::vector<std::string>& call) {
    return with(call, {"--controller", kLibraries + "/own_controller.so", "--set",
                       "controller.sample_time=50us", "--set", "controller.on=0", "--set",
                       "rotor.modes=2", "--set", "run.end=5ms", "-q"});
  };
  folder.done(with_law({"sweep", "study.toml", "-o", "map"}));
  const std::string table = folder.text("map/results.csv");
  EXPECT_TRUE(contains(table, {"\n0,10000,ok", "\n1,200000,ok"}));
  folder.done(with_law({"optimise", "study.toml", "-o", "best"}));
  EXPECT_TRUE(folder.json_in("best/optimum.json")
                  .at("best")
                  .at("values")
                  .contains("controller.config.stiffness"));
}

// The number in the last row of a column.
double last_number(const std::string& csv, const std::string& column) {
  std::istringstream rows(csv);
  std::string row, name, number;
  std::getline(rows, row);
  std::istringstream names(row);
  while (std::getline(rows, name)) row = name;
  std::istringstream numbers(row);
  while (std::getline(names, name, ',') && std::getline(numbers, number, ',')) {
    if (name == column) return std::stod(number);
  }
  ADD_FAILURE() << "no column " << column;
  return 0.0;
}

// A law in a Python file.
class CliPythonLaw : public testing::Test {
 protected:
  std::vector<std::string> with_law(const std::vector<std::string>& call) const {
    return with(call, {"--controller", "law.py", "--set", "controller.sample_time=50us", "--set",
                       "controller.on=0", "--set", "rotor.modes=2"});
  }
  void write(const std::string& step) {
    folder_.write("law.py",
                  "def create(setup):\n    return setup['config']\n"
                  "def step(law, now, state):\n    " +
                      step + "\n");
  }

  Folder folder_;
};

TEST_F(CliPythonLaw, RunsInBothEngines) {
  write("return law['gain'] * 0.5, -3.0");
  for (const char* engine : {"native", "mujoco"}) {
    folder_.done(with_law({"run", shipped("paper_sliding"), "--engine", engine, "--end", "5 ms",
                           "--set", "controller.config.gain=4", "-q", "-o", engine}));
    const std::string series = folder_.text(std::string(engine) + "/series.csv");
    EXPECT_NEAR(last_number(series, "control_x"), 2.0, 1e-9) << engine;
    EXPECT_NEAR(last_number(series, "control_y"), -3.0, 1e-9) << engine;
  }
}

TEST_F(CliPythonLaw, IsComparedAndSwept) {
  write("return law['gain'] * (now['rotor'][0] - now['stator'][0]), 0.0");
  const Outcome compared = folder_.run(with_law(
      {"compare", shipped("paper_sliding"), "--end", "5 ms", "--twins", "0", "--no-video",
       "--no-modes-ladder", "-q", "-o", "compared", "--set", "controller.config.gain=1e5"}));
  EXPECT_LE(compared.code, 1) << compared.err;
  folder_.write("study.toml", "scene = \"" + shipped("paper_sliding") +
                                  "\"\n[[vary]]\nkey = \"controller.config.gain\"\nfrom = 1e4\nto "
                                  "= 2e5\ncount = 4\n[sample]\nkind = \"grid\"\n");
  folder_.done(with_law({"sweep", "study.toml", "-o", "map", "--set", "run.end=5ms", "-q"}));
  EXPECT_TRUE(contains(folder_.text("map/results.csv"), {"\n0,10000,ok", "\n3,200000,ok"}));
}

TEST_F(CliPythonLaw, AnExceptionIsExit3WithItsTraceback) {
  write("return (1.0 / (8 - now['sample'])), 0.0");
  for (const char* engine : {"native", "mujoco"}) {
    const Outcome done = folder_.run(with_law({"run", shipped("paper_sliding"), "--engine", engine,
                                               "--end", "5 ms", "--json", "-o", "out"}));
    EXPECT_EQ(done.code, 3) << done.err;
    EXPECT_TRUE(
        contains(done.err, {"controller_failed", "ZeroDivisionError", "in step (", "law.py:4)"}));
    EXPECT_EQ(json::parse(done.out).at("status"), "controller_failed");
  }
}

// The text of a law that fails beside every contact model stands once on the terminal, and once on
// standard error.
TEST_F(CliPythonLaw, AnExceptionIsToldOnceInAComparison) {
  write("raise ValueError('no gain is given')");
  const Outcome done =
      folder_.run(with_law({"compare", shipped("paper_sliding"), "--end", "5 ms", "--twins", "0",
                            "--no-video", "--no-modes-ladder", "-o", "compared"}));
  EXPECT_EQ(done.code, 3) << done.err;
  const auto count = [](const std::string& text) {
    std::size_t found = 0;
    const std::string what = "ValueError: no gain is given";  // its line is quoted too
    for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count(done.err), 1u) << done.err;
  EXPECT_EQ(count(done.out), 1u) << done.out;
  EXPECT_TRUE(contains(done.err, "native, rigid, "));
}

TEST_F(CliPythonLaw, AMistakeInTheFileIsExit2) {
  write("return 1.0 +");
  folder_.refuses(with_law({"run", shipped("paper_sliding")}),
                  {"--controller", "SyntaxError", "law.py:4)"});
}

// The output of a law goes to standard error; standard output is for the results.
TEST_F(CliPythonLaw, PrintsToStandardError) {
  write("print('sample', now['sample']); return 0.0, 0.0");
  const Outcome done = folder_.done(
      with_law({"run", shipped("paper_sliding"), "--end", "1 ms", "--json", "-o", "out"}));
  EXPECT_TRUE(json::accept(done.out)) << done.out;
  EXPECT_TRUE(contains(done.err, "sample 7"));
}

// Several contacts, and a law for magnetic bearings in the place of a ring's.
TEST(CliController, OneForTheWrongPlaceIsRefusedByItsOwnOption) {
  const Folder folder;
  folder.done({"init", "two", "--form", "two-catchers"});
  folder.refuses({"run", "two.toml", "--controller", kLibraries + "/own_controller.so"},
                 {"rotorub run: --controller: this scene has several contacts",
                  "Set [contact.controller] in the file"});
  folder.refuses(run_with("magnetic_pd.so", {}),
                 {"magnetic_pd.so commands magnetic bearings (rotorub_magnetic_controller_get)",
                  "library = \"magnetic_pd.so\""});
  folder.refuses(run_with("librotorub_hdf5.so", {}),
                 {"does not export rotorub_controller_get, so it is not a controller"});
}

// A fixed step that does not divide the sample time is refused, with a step that does.
TEST(CliController, AStepThatDoesNotDivideTheSampleTimeIsRefused) {
  const Folder folder;
  folder.done({"init", "two", "--form", "two-catchers"});
  const std::vector<std::string> sampled{"two.toml",
                                         "--set",
                                         "magnetic_bearing.control.sample_time=55us",
                                         "--set",
                                         "initial.steady=none",
                                         "--end",
                                         "1ms",
                                         "-o",
                                         "out"};
  folder.refuses(with(with({"run"}, sampled), {"--integrator", "verlet", "--step", "10us"}),
                 {"--step 10us", "magnetic_bearing[0] (55 us)", "--step 5.5us"});
  folder.refuses(with(with({"compare"}, sampled), {"--set", "run.step=10us"}), {"run.step"});
  folder.done(with(with({"run"}, sampled), {"--integrator", "verlet", "--step", "5.5us", "-q"}));
  folder.done(with(with({"run"}, sampled), {"--step", "10us", "-q"}));
}

TEST(CliController, WhatCannotBeLoadedIsExit2) {
  const Folder folder;
  folder.refuses({"run", shipped("paper_sliding"), "--controller", "nowhere.so"}, {"nowhere.so"});
  folder.refuses(run_with("other_abi_controller.so", {}), {"rotorub run: --controller: "});
}

// A user's machine with a user's law.
TEST(CliController, CommandsTheRingOfAMachineOfTheUsersOwn) {
  const Folder folder;
  const std::vector<std::string> call{
      "compare",      std::string(ROTORUB_MJCF_DIR) + "/examples/own_model.xml",
      "--controller", kLibraries + "/own_controller.so",
      "--set",        "controller.sample_time=50us",
      "--set",        "controller.config.stiffness=2e5",
      "--end",        "10 ms",
      "--twins",      "0",
      "--no-video",   "-o",
      "out",          "--json"};
  const Outcome done = folder.run(call);
  ASSERT_LE(done.code, 1) << done.err;
  const json said = json::parse(done.out).at("scenes")[0];
  EXPECT_TRUE(contains(said.at("own_model").at("left_out").dump(), "|F_x| + |F_y|"));
  for (const char* side : {"native", "rigid", "cone"}) {
    const std::string series = folder.text(std::string("out/own_model/") + side + "/series.csv");
    EXPECT_TRUE(contains(first_line(series), ",control_x,control_y")) << side;
  }
  folder.refuses(with(call, {"--set", "contact.friction=0.2"}),
                 {"--set contact.friction=0.2: this key belongs to scenes"});
  folder.refuses(with(call, {"--set", "controller.config.gain=1"}),
                 {"--controller: controller.config: own_controller refuses: gain"});
}

// ------------------------------------------------------------------ a scene, or results, from
// elsewhere
class CliForeignLibrary : public testing::Test {
 protected:
  CliForeignLibrary() {
    std::filesystem::copy_file(kLibraries + "/marking_controller.so", folder_.path() / "evil.so");
    std::filesystem::copy_file(shipped("bench_ring"), folder_.path() / "scene.toml");
    std::ofstream(folder_.path() / "scene.toml", std::ios::app)
        << "[controller]\nkind = \"library\"\nlibrary = \"evil.so\"\nsample_time = \"50 us\"\n";
  }
  bool opened() const { return std::filesystem::exists(folder_.path() / "opened"); }

  Folder folder_;
};

TEST_F(CliForeignLibrary, IsNotOpenedWithoutPermission) {
  const std::vector<std::vector<std::string>> commands{
      {"run", "scene.toml"},     {"run", "scene.toml", "--engine", "mujoco"},
      {"compare", "scene.toml"}, {"bench", "scene.toml"},
      {"check", "scene.toml"},   {"tune", "scene.toml", "--tolerance", "1%"},
      {"render", "scene.toml"}};
  for (const auto& command : commands) {
    folder_.refuses(command, {"evil.so", "--allow-library"});
    EXPECT_FALSE(opened()) << command.front();
  }
  folder_.write("study.toml",
                "scene = \"scene.toml\"\n[sample]\nkind = \"grid\"\n[[vary]]\nkey = "
                "\"contact.friction\"\nvalues = [0.1, 0.2]\n");
  folder_.refuses({"sweep", "study.toml", "-o", "out"}, {"evil.so"});
  EXPECT_FALSE(opened());
}

TEST_F(CliForeignLibrary, IsOpenedWhereTheUserSaysSo) {
  const Outcome done = folder_.run({"run", "scene.toml", "--allow-library"});
  EXPECT_TRUE(opened());
  EXPECT_EQ(done.code, 2) << "it is no controller";
}

TEST_F(CliForeignLibrary, IsNotNeededToShowResults) {
  ASSERT_EQ(folder_.run({"run", shipped("bench_ring"), "--end", "10 ms", "-o", "results"}).code, 0);
  // Results whose scene names a foreign library.
  std::filesystem::copy_file(folder_.path() / "scene.toml", folder_.path() / "results/scene.toml",
                             std::filesystem::copy_options::overwrite_existing);
  std::filesystem::copy_file(folder_.path() / "evil.so", folder_.path() / "results/evil.so");
  for (const auto& command :
       std::vector<std::vector<std::string>>{{"modes", "scene.toml"},
                                             {"mjcf", "scene.toml", "-o", "scene.xml"},
                                             {"plot", "results"},
                                             {"render", "results", "--png", "--size", "320x180"}}) {
    const Outcome done = folder_.run(command);
    EXPECT_EQ(done.code, 0) << command.front() << ": " << done.err;
    EXPECT_FALSE(opened()) << command.front();
  }
}

TEST(CliModes, GivesThePlantOfAController) {
  const Folder folder;
  const json plant = folder.json_of(
      {"modes", shipped("paper_sliding"), "--state-space", "--set", "rotor.modes=2"});
  EXPECT_EQ(plant.at("A").size(), 12u);
  EXPECT_EQ(plant.at("A")[0].size(), 12u);
  EXPECT_EQ(plant.at("B").size(), 12u);
  EXPECT_EQ(plant.at("C").size(), 4u);
  EXPECT_EQ(plant.at("states")[4], "stator_x");
  EXPECT_EQ(plant.at("A")[10][4], -2e5 / 1.5) << "the ring's spring";
  EXPECT_EQ(plant.at("B")[10][0], 1.0 / 1.5);
}

// Without a ring that moves, the controls of magnetic bearings are designed with the plant.
TEST(CliModes, GivesThePlantOfMagneticBearings) {
  const Folder folder;
  const std::string rotor =
      "[rotor]\nspeed = \"1000 rpm\"\n[rotor.modal]\nmass = [2.0]\nstiffness = [0.0]\n";
  folder.write("magnets.toml", rotor +
                                   "[magnetic_bearing]\nnegative_stiffness = 1e5\n"
                                   "[magnetic_bearing.control]\nforce_per_current = 80\n"
                                   "proportional = 4000\nderivative = 2\n");
  const json plant = folder.json_of({"modes", "magnets.toml", "--state-space"});
  EXPECT_EQ(plant.at("inputs"), json({"bearing_current_x", "bearing_current_y"}));
  EXPECT_EQ(plant.at("outputs"), json({"bearing_sensor_x", "bearing_sensor_y"}));
  EXPECT_EQ(plant.at("states"), json({"x_1", "y_1", "vx_1", "vy_1"}));
  EXPECT_EQ(plant.at("A")[2][0], 1e5 / 2.0) << "the magnets pull";
  EXPECT_EQ(plant.at("B")[3][1], 80.0 / 2.0);
  folder.write("nothing.toml", rotor);
  folder.refuses({"modes", "nothing.toml", "--state-space"}, {"a ring that moves", "magnetic"});
}

// A further ring that cannot move changes nothing, at any place in the list.
TEST(CliModes, GivesThePlantOfTheRingThatMoves) {
  const Folder folder;
  const std::string rotor =
      "[rotor]\nspeed = \"1000 rpm\"\n[rotor.modal]\nmass = [2.0]\nstiffness = [2e5]\n"
      "damping = [40.0]\n";
  const std::string fixed =
      "[[contact]]\nradius = 0.05\nclearance = \"0.5 mm\"\nfriction = 0.1\nrestitution = 0.5\n";
  const std::string moving =
      fixed + "[contact.stator]\nmass = 1.5\nstiffness = 3e5\ndamping = 200.0\n";
  std::ofstream(folder.path() / "fixed_first.toml") << rotor + fixed + moving;
  std::ofstream(folder.path() / "moving_first.toml") << rotor + moving + fixed;
  const json plant = folder.json_of({"modes", "fixed_first.toml", "--state-space"});
  EXPECT_EQ(plant, folder.json_of({"modes", "moving_first.toml", "--state-space"}));
  EXPECT_EQ(plant.at("A").size(), 8u);
}

TEST(CliModes, MapsTheFeedbackThatCalmsARub) {
  const Folder folder;
  const std::string scene = shipped("paper_cross_coupled");
  const std::vector<std::string> asked{"modes",       scene,           "--feedback-map",
                                       "--set",       "rotor.modes=2", "--speeds",
                                       "40Hz:60Hz:3", "--feedbacks",   "0:4000:9"};
  const Outcome table = folder.done(asked);
  EXPECT_TRUE(contains(table.out, {"N s/m", "feedback_speed = [\"40 Hz\""}));
  const json map = folder.json_of(with(asked, {"--json"})).at("feedback_map");
  EXPECT_EQ(map.at("growth").size(), 3u);
  EXPECT_EQ(map.at("growth")[0].size(), 9u);
  EXPECT_EQ(map.at("rule").size(), 3u);
  folder.refuses({"modes", shipped("paper_sliding"), "--feedback-map"}, {"controller.kind"});
}

}  // namespace
}  // namespace rotorub::test
