// Impossible requests are refused beforehand: exit code 2, nothing written, and a message that
// names the place in the file.

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

using Arguments = std::vector<std::string>;

void expect_refused(const Folder& folder, const Arguments& arguments,
                    std::initializer_list<std::string_view> parts) {
  folder.refuses(with(arguments, {"-o", "out"}), parts);
  EXPECT_FALSE(folder.has("out"));
}

TEST(CliRefusal, OfMoreStepsThanCanBeDone) {
  const Folder folder;
  const std::string drop = shipped("bench_drop");
  for (const Arguments& engine :
       {Arguments{"--engine", "mujoco"}, Arguments{"--integrator", "verlet"}}) {
    for (const std::string value :
         {"run.end=1e14", "run.end=1e50", "run.step=1e-20", "run.step=1e-308"}) {
      expect_refused(folder, with({"run", drop, "--set", value}, engine),
                     {"run.step: ", " steps of ", "the limit is 1e+10 steps"});
    }
  }
}

// An option without effect is refused.
TEST(CliRefusal, OfTuneOnAMachineOfYourOwn) {
  const Folder folder;
  expect_refused(folder,
                 {"compare", std::string(ROTORUB_MJCF_DIR) + "/examples/own_model.xml", "--tune"},
                 {"own_model.xml: --tune works on scenes (.toml) only", "--step 5us"});
}

TEST(CliRefusal, OfMoreRowsThanMemoryHolds) {
  const Folder folder;
  const std::string ring = shipped("bench_ring");
  expect_refused(folder, {"run", ring, "--set", "run.output_step=1e-12"},
                 {"--set: run.output_step: ", "rows", "at most"});
  // Few enough rows for one mode, too many for a hundred.
  std::ofstream(folder.path() / "long.toml")
      << "[run]\nend = 1\noutput_step = 2e-7\n[rotor]\nspeed = 1\n[rotor.modal]\nmass = [" << [] {
           std::string list = "1";
           for (int k = 1; k < 100; ++k) list += ", 1";
           return list + "]\nstiffness = [" + list + "]\n";
         }();
  for (const std::string engine : {"native", "mujoco"}) {
    expect_refused(folder, {"run", "long.toml", "--engine", engine},
                   {"long.toml:3: run.output_step: ", "5e+06 rows of 417 columns"});
  }
}

TEST(CliRefusal, SaysHowToWriteSet) {
  const Folder folder;
  folder.refuses({"run", shipped("bench_ring"), "--set", "contact.friction", "0.2"},
                 {"write --set contact.friction=0.2"});
}

// The words after a command, and "own.xml" in the place of its input.
const std::map<std::string, Arguments> kGivenAModel{
    {"run", {"own.xml"}},
    {"bench", {"own.xml"}},
    {"modes", {"own.xml"}},
    {"mjcf", {"own.xml"}},
    {"fmu", {"own.xml"}},
    {"render", {"own.xml"}},
    {"sweep", {"own.xml"}},
    {"optimise", {"own.xml"}},
    {"check", {"own.xml"}},
    {"tune", {"own.xml"}},
    {"identify", {"own.xml", "--measured", "own.xml", "--fit", "contact.friction=0.1:0.2"}}};

// A user who gives a model instead of a scene or a library is told what to give.
TEST(CliRefusal, OfAModelSaysWhatToGiveInEveryCommand) {
  const Folder folder;
  std::ofstream(folder.path() / "own.xml") << "<!-- mine -->\n<mujoco/>\n";
  for (const auto& [command, words] : kGivenAModel) {
    folder.refuses(with({command}, words),
                   {"own.xml: this is a MuJoCo model (XML), but a scene or study (.toml) is needed",
                    "rotorub compare"});
  }
  expect_refused(folder, {"plot", "own.xml"}, {"own.xml is not a folder; give the output folder"});
  folder.refuses({"init", "own.xml"}, {"own.xml: give the name of a scene"});
  EXPECT_FALSE(folder.has("own.xml.toml"));
  // A study of a user's model, in both commands that run studies.
  std::ofstream(folder.path() / "study.toml")
      << "scene = \"own.xml\"\n[sample]\nkind = \"grid\"\n[[vary]]\nkey = "
         "\"contact.friction\"\nfrom = 0.1\nto = 0.2\ncount = 2\n[optimise]\nminimise = "
         "\"impacts\"\n";
  for (const std::string command : {"sweep", "optimise"})
    expect_refused(folder, {command, "study.toml"}, {"own.xml: this is a MuJoCo model (XML)"});
  // The list has every command; `compare` accepts the model, and two commands take no file.
  std::string all = folder.run({"nosuch"}).err;
  all.erase(0, all.find("choose from ") + 12);
  for (const std::string other : {"compare", "plot", "init", "schema", "manual"}) {
    ASSERT_TRUE(contains(all, other));
    all.erase(all.find(other), other.size());
  }
  for (const auto& [command, words] : kGivenAModel) {
    ASSERT_TRUE(contains(all, command));
    all.erase(all.find(command), command.size());
  }
  EXPECT_EQ(all.find_first_of("bcdefghijklmpqstuvwxyz"), std::string::npos) << all;
}

TEST(CliRefusal, OfASourceSaysHowToBuildIt) {
  const Folder folder;
  for (const std::string source : {"mine.c", "mine.cpp"}) {
    std::ofstream(folder.path() / source) << "\n";
    expect_refused(folder, {"run", shipped("paper_sliding"), "--controller", source},
                   {source + " is ", "-shared"});
  }
}

TEST(CliRefusal, OfMoreSamplesThanCanBeTaken) {
  const Folder folder;
  for (const Arguments& engine :
       {Arguments{"--integrator", "event"}, Arguments{"--engine", "mujoco"}}) {
    expect_refused(
        folder,
        with({"run", shipped("paper_sliding_sampled"), "--set", "controller.sample_time=1e-18"},
             engine),
        {"--set: controller.sample_time: ", " samples to run.end", "the limit is 1e+10 samples"});
  }
}

// `event` has no step, so any step is accepted. MuJoCo accepts any step if the run is shorter than
// it.
TEST(CliRefusal, NotOfAStepThatDoesNotMatter) {
  const Folder folder;
  const Arguments run{"run", shipped("bench_ring"), "--quiet", "-o", "short"};
  folder.done(with(run, {"--end", "1ms", "--set", "run.step=1e-308"}));
  folder.done(with(run, {"--end", "1us"}));
  folder.done(with(run, {"--end", "1us", "--engine", "mujoco"}));
}

TEST(CliRefusal, OfErrorsFoundInTheModelNamesTheLine) {
  const Folder folder;
  std::ofstream(folder.path() / "shaft.toml") << R"([run]
end = 0.1
[rotor]
speed = 300.0
length = 0.6
E = 2.1e11
rho = 7850.0
max_frequency = 3000.0
[[rotor.section]]
from = 0.0
to = 0.6
diameter = 0.018
[[rotor.bearing]]
z = 0.0
stiffness = 1e7
[[rotor.bearing]]
z = 0.6
stiffness = 1e7
[initial]
vx = [1e-3, 0.0, 0.0, 0.0, 0.0]
)";
  for (const std::string engine : {"native", "mujoco"}) {
    expect_refused(folder, {"run", "shaft.toml", "--engine", engine},
                   {"shaft.toml:20: initial.vx: expected "});
  }
  // A shaft as thin as a thread: its eigenvalues would not be found after minutes.
  for (const std::string command : {"run", "modes", "mjcf"}) {
    expect_refused(folder, {command, "shaft.toml", "--set", "rotor.section[0].diameter=1e-30"},
                   {"--set: rotor.section[0].diameter: too thin"});
  }
  expect_refused(folder,
                 {"mjcf", "shaft.toml", "--set", "initial=none", "--set", "rotor.max_frequency=1"},
                 {"--set: rotor.max_frequency: keeps no bending mode"});
}

// The refusal names the option that the user gave, or the key that was meant.
TEST(CliRefusal, NamesWhatWasWritten) {
  const Folder folder;
  const std::string drop = shipped("bench_drop");
  expect_refused(folder, {"run", drop, "--end", "-1"}, {"--end: run.end: out of range"});
  expect_refused(folder, {"run", drop, "--step", "0"}, {"--step: run.step: out of range"});
  expect_refused(folder, {"run", drop, "--set", "run.end=-1"}, {"--set: run.end: out of range"});
  for (const std::string path : {"contact.frictoin", "contcat", "frce[0]", "rotor.modal.mas"}) {
    expect_refused(folder, {"run", drop, "--set", path + "=none"}, {"unknown", "did you mean"});
  }
  EXPECT_EQ(
      folder.run({"run", drop, "--end", "1ms", "--set", "gravity=none", "-q", "-o", "o"}).code, 0);
  expect_refused(folder, {"compare", "nofile.xml"},
                 {"nofile.xml: cannot be read: No such file or directory"});
  std::string misspelt = drop;
  misspelt.replace(misspelt.rfind("drop"), 4, "dorp");
  expect_refused(folder, {"run", misspelt}, {"cannot be read", "did you mean bench_drop.toml?"});
  const Outcome friction = folder.run({"init", "--friction", "x"});
  EXPECT_TRUE(contains(friction.err,
                       "expected a pure number, 0 or from 1e-06 to 1e+06, for example \"0.15\""));
}

// The ending of -o determines the format.
TEST(CliRefusal, OfOutputsWithAnotherEnding) {
  const Folder folder;
  const std::string ring = shipped("bench_ring");
  folder.refuses({"mjcf", ring, "-o", "ring.json"}, {"-o ring.json: expected", ".xml"});
  folder.refuses({"fmu", ring, "-o", "ring.zip"}, {"-o ring.zip: expected", ".fmu"});
  folder.refuses({"modes", ring, "-o", "ring.json"},
                 {"-o ring.json: expected", ".html, or a folder"});
  folder.refuses({"tune", ring, "-o", "ring.json"}, {"-o ring.json: expected", ".toml"});
  folder.refuses({"run", ring, "-o", "ring.csv"}, {"-o ring.csv: expected the name of a folder"});
  EXPECT_TRUE(folder.files().empty());
}

// Every line of an error begins with the command.
TEST(CliRefusal, OfASceneNamesTheCommandInEachLine) {
  const Folder folder;
  std::ofstream(folder.path() / "two.toml") << "[rotor.modal]\nmass = [-1]\nstiffness = [\"x\"]\n";
  const std::string err = folder.run({"run", "two.toml"}).err;
  EXPECT_TRUE(contains(err, {"rotorub run: two.toml:2: rotor.modal.mass[0]: ",
                             "\nrotorub run: two.toml:3: rotor.modal.stiffness[0]: "}));
  folder.refuses({"sweep", shipped("bench_ring")}, {"this file is a scene, not a study"});
}

TEST(CliRefusal, OfBareNumbersInInitNamesTheUnit) {
  const Folder folder;
  folder.refuses({"init", "--diameter", "20"}, {"--diameter 20: ", "without a unit is in m"});
  folder.refuses({"init", "--speed", "1e7"}, {"--speed 1e7: ", "without a unit is in rad/s"});
}

// The integrator event has no fixed step.
TEST(CliRefusal, NotesAStepThatHasNoEffect) {
  const Folder folder;
  const Arguments run{"run", shipped("bench_ring"), "--end", "1ms", "--step", "10us", "-o", "o"};
  EXPECT_TRUE(contains(folder.done(run).err, "note: --step 10us has no effect"));
  EXPECT_EQ(folder.done(with(run, {"--integrator", "verlet"})).err, "");
  EXPECT_EQ(folder.done(with(run, {"--quiet"})).err, "");
  const Arguments picture{
      "render", shipped("bench_ring"), "--end", "1ms", "--step", "10us", "--png", "--size",
      "320x180"};
  EXPECT_TRUE(contains(folder.done(picture).err, "note: --step 10us has no effect"));
  EXPECT_EQ(folder.done(with(picture, {"--set", "run.integrator=verlet"})).err, "");
}

TEST(CliRefusal, OfImpossibleNumbers) {
  const Folder folder;
  const std::string ring = shipped("bench_ring");
  expect_refused(folder, {"mjcf", ring, "--set", "contact.clearance=1e308"},
                 {"--set: contact.clearance: too large"});
  expect_refused(folder, {"run", ring, "--set", "rotor.speed=-1e308"},
                 {"--set: rotor.speed: too large"});
}

TEST(CliRefusal, ShowsNoEscapeCodes) {
  const Folder folder;
  const std::string code = "\x1b[31m";
  for (const Arguments& arguments :
       {Arguments{"run", code}, Arguments{"run", code + ".toml"},
        Arguments{"run", shipped("bench_drop"), code},
        Arguments{"run", shipped("bench_drop"), "--" + code},
        Arguments{"run", shipped("bench_drop"), "--engine", code},
        Arguments{"run", shipped("bench_drop"), "--end", code},
        Arguments{"run", shipped("bench_drop"), "--set", code},
        Arguments{"run", shipped("bench_drop"), "--end", "1ms", "-o", "/proc/" + code},
        Arguments{"modes", shipped("bench_ring"), "--speed", code},
        Arguments{"compare", shipped("bench_ring"), "--mode", code}, Arguments{"render", code}}) {
    const Outcome refused = folder.run(arguments);
    EXPECT_EQ(refused.code, 2) << refused.err;
    EXPECT_EQ(refused.err.find('\x1b'), std::string::npos) << refused.err;
    EXPECT_TRUE(contains(refused.err, "\\x1b[31m"));
  }
}

// The same for text in files: study, kept run, MJCF, and the name of a library.
TEST(CliRefusal, ShowsNoEscapeCodesOfFiles) {
  const Folder folder;
  const auto write = [&](const std::string& file, const std::string& text) {
    std::ofstream(folder.path() / file) << text;
  };
  const std::string code = "\x1b]0;title\x07", quoted = "\\u001b]0;title\\u0007",
                    drop = shipped("bench_drop");
  folder.done({"run", drop, "--end", "1ms", "-o", "kept"});
  const std::string series = folder.text("kept/series.csv");
  write("kept/series.csv", series + code + std::string(1 << 20, 'x') + "\n");
  std::filesystem::copy(folder.path() / "kept", folder.path() / "broken");
  write("broken/series.csv", series);
  write("broken/summary.json", "{\"scene\": \"a\", " + code + std::string(1 << 20, 'x'));
  write("key.toml", "scene = \"" + drop + "\"\n[sample]\nkind = \"grid\"\n[[vary]]\nkey = \"" +
                        quoted + "\"\nvalues = [1]\n");
  write("scene_name.toml", "scene = \"" + quoted + std::string(1 << 20, 'x') + "\"\n");
  write("kind.toml", "[sample]\nkind = \"" + quoted + "\"\n");
  write("machine.xml", "<mujoco><" + code + "/></mujoco>");
  write("texts.xml", "<mujoco><custom><text name=\"rotorub_contact\" data=\"" +
                         std::string("\xe2\x80\xae") + std::string(1 << 20, 'x') +
                         "\"/></custom></mujoco>");
  for (const Arguments& arguments :
       {Arguments{"plot", "kept"}, Arguments{"render", "kept"}, Arguments{"plot", "broken"},
        Arguments{"render", "broken"}, Arguments{"sweep", "key.toml"},
        Arguments{"sweep", "scene_name.toml"}, Arguments{"sweep", "kind.toml"},
        Arguments{"sweep", "key.toml", "--shard", code},
        Arguments{"compare", "machine.xml", "--no-video"},
        Arguments{"compare", "texts.xml", "--no-video"},
        Arguments{"run", drop, "--controller", code},
        Arguments{"run", shipped("paper_sliding"), "--set", "controller.kind=library", "--set",
                  "controller.library=\"" + quoted + std::string(100000, 'x') + "\"", "--set",
                  "controller.sample_time=1e-4"},
        Arguments{"tune", drop, "--tolerance", code}, Arguments{"bench", drop, "--engines", code},
        Arguments{"bench", drop, "--steps", code}, Arguments{"render", drop, "--size", code},
        Arguments{code + std::string(100000, 'x')}}) {
    SCOPED_TRACE(testing::PrintToString(
        Arguments(arguments.begin(), arguments.begin() + (arguments.size() > 1 ? 2 : 0))));
    const Outcome refused = folder.run(arguments);
    EXPECT_EQ(refused.code, 2) << refused.err.substr(0, 1000);
    EXPECT_EQ(refused.err.find_first_of("\x1b\x07"), std::string::npos)
        << refused.err.substr(0, 1000);
    EXPECT_FALSE(contains(refused.err, "\xe2\x80\xae")) << refused.err.substr(0, 1000);
    EXPECT_NE(refused.err, "");
    EXPECT_LT(refused.err.size(), 4096u) << refused.err.substr(0, 1000);
  }
}

// A file name may contain any bytes; the summary is valid text nevertheless.
TEST(CliRun, AFileWithANameThatIsNoText) {
  const Folder folder;
  std::filesystem::copy_file(shipped("bench_drop"), folder.path() / "\xff.toml");
  const Outcome done = folder.done({"run", "\xff.toml", "--end", "1ms", "--json", "-o", "out"});
  EXPECT_EQ(json::parse(done.out).at("status"), "ok");
}

// An empty value, such as from an unset variable of a script, neither writes elsewhere nor runs for
// minutes.
TEST(CliRefusal, OfValuesThatAreEmpty) {
  const Folder folder;
  const std::string ring = shipped("bench_ring");
  for (const Arguments& arguments :
       {Arguments{"run", ring, "-o", ""}, Arguments{"run", ""},
        Arguments{"bench", ring, "--steps", ""}, Arguments{"mjcf", ring, "--mujoco", ""},
        Arguments{"run", ring, "-o=out"}}) {
    const Outcome refused = folder.run(arguments);
    EXPECT_EQ(refused.code, 2) << testing::PrintToString(arguments) << refused.err;
    EXPECT_FALSE(folder.has("runs"));
    EXPECT_FALSE(folder.has("=out"));
  }
  EXPECT_TRUE(contains(folder.run({"run", ring, "-o", ""}).err, "the value is empty"));
}

}  // namespace
}  // namespace rotorub::test
