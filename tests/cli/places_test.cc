// A place that cannot be written to is a user's mistake: exit code 2, reported before the work
// begins.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.h"
#include "tests/support/every_third.h"

namespace rotorub::test {
namespace {

using Arguments = std::vector<std::string>;

const Surroundings kObeysModes{{}, Program::kOut, true};
// Permissions of files restrict root only if the test may give up root's rights.
bool modes_count() { return getuid() != 0 || prctl(PR_CAPBSET_READ, CAP_SETPCAP) == 1; }

const std::string kRing = shipped("bench_ring");

// The studies that the commands below use.
void write_studies(const Folder& folder) {
  const std::string head = "scene = \"" + kRing + "\"\n[run]\nend = 1e3\n";
  const std::string vary = "[[vary]]\nkey = \"contact.friction\"\nfrom = 0.1\nto = 0.2\n";
  folder.write("study.toml", head + "[sample]\nkind = \"grid\"\n" + vary + "count = 2\n");
  folder.write("goal.toml", head + vary + "[optimise]\nminimise = \"impacts\"\nevaluations = 4\n");
}

// Every command that writes, to `place`; those with long computations must refuse before them.
std::vector<Arguments> writers(const std::string& place) {
  return {{"run", kRing, "--end", "1e4", "--integrator", "verlet", "-o", place},
          {"run", kRing, "--engine", "mujoco", "--end", "1e4", "-o", place},
          {"compare", kRing, "--end", "1e3", "-o", place},
          {"bench", kRing, "-o", place},
          {"check", kRing, "--set", "run.end=1e3", "-o", place},
          {"sweep", "study.toml", "-o", place},
          {"optimise", "goal.toml", "-o", place},
          {"modes", kRing, "-o", place},
          {"tune", kRing, "-o", place + "/tuned.toml"},
          {"identify", kRing, "--end", "1e3", "--measured", "kept/series.csv", "--measured-shift",
           "0s", "--fit", "contact.friction=0.05:0.4", "-o", place + "/found.toml"},
          {"render", kRing, "--end", "1e3", "-o", place + "/film.mp4"},
          {"render", "kept", "-o", place + "/film.gif"},
          {"render", "kept", "-o", place + "/film.png"},
          {"plot", "kept", "-o", place + "/plot.html"},
          {"modes", kRing, "-o", place + "/modes.html"},
          {"modes", kRing, "--rub-map", "--speeds", "10Hz:100Hz:1000", "--frictions",
           "0.01:0.5:1000", "-o", place + "/map.html"},
          {"mjcf", kRing, "-o", place + "/ring.xml"},
          {"fmu", kRing, "-o", place + "/ring.fmu"},
          {"init", "--force", "-o", place + "/rotor.toml"},
          {"schema", "-o", place + "/schema.json"},
          {"manual", "-o", place + "/rotorub.1"}};
}

// Expects that nothing is written, and that the message has these parts.
void expect_place_refused(const Folder& folder, const Arguments& arguments,
                          std::initializer_list<std::string_view> parts,
                          const Surroundings& surroundings = {}) {
  SCOPED_TRACE(testing::PrintToString(arguments));
  const auto before = folder.files();
  const auto start = std::chrono::steady_clock::now();
  const Outcome refused = folder.run(arguments, surroundings);
  EXPECT_EQ(refused.code, 2) << refused.err;
  EXPECT_TRUE(contains(refused.err, parts));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  EXPECT_EQ(folder.files(), before);
}

void expect_all_refused(const Folder& folder, const std::string& place,
                        const Surroundings& surroundings = {}) {
  write_studies(folder);
  folder.done({"run", kRing, "--end", "50ms", "-o", "kept", "-q"});
  for (const Arguments& arguments : writers(place))
    expect_place_refused(folder, arguments, {place}, surroundings);
}

TEST(CliPlaces, OfEveryCommandAreTried) {
  const Folder folder;
  std::string all = folder.run({"nosuch"}).err;
  const std::string lead = "choose from ";
  ASSERT_TRUE(contains(all, lead));
  std::istringstream words(all.substr(all.find(lead) + lead.size()));
  std::size_t commands = 0;
  for (std::string word; words >> word;) {
    if (word.ends_with(',')) word.pop_back();
    if (word == "or") continue;
    if (folder.done({word, "--help"}).out.find("--output") == std::string::npos) continue;
    ++commands;
    EXPECT_TRUE(std::ranges::any_of(writers(""), [&](const Arguments& arguments) {
      return arguments.front() == word;
    })) << word;
  }
  EXPECT_EQ(commands, 16u);
}

// Below a file and a device, in a file system that accepts no files, and in a dangling link.
TEST(CliPlaces, WhereNobodyCanMakeAFolder) {
  const Folder folder;
  folder.write("file", "text");
  std::filesystem::create_symlink("nothing", folder.path() / "link");
  for (const char* place : {"file/below", "/dev/full/below", "/proc/rotorub", "link"})
    expect_all_refused(folder, place);
}

TEST(CliPlaces, WithoutTheRight) {
  if (!modes_count()) GTEST_SKIP() << "root here, who may write anywhere";
  const Folder folder;
  std::filesystem::create_directory(folder.path() / "closed");
  std::filesystem::permissions(folder.path() / "closed", std::filesystem::perms::owner_read |
                                                             std::filesystem::perms::owner_exec);
  expect_all_refused(folder, "closed", kObeysModes);
  std::filesystem::permissions(folder.path() / "closed", std::filesystem::perms::owner_all);
}

// ---------------------------------------------------------------- files that are there

void make_folder(const std::filesystem::path& file) { std::filesystem::create_directories(file); }
void make_read_only(const std::filesystem::path& file) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << "old";
  std::filesystem::permissions(file, std::filesystem::perms::owner_read);
}

struct Obstacle {
  std::function<void(const std::filesystem::path&)> make;
  std::string said;
  Surroundings surroundings;
};
std::vector<Obstacle> obstacles() {
  std::vector<Obstacle> all{{make_folder, " is a folder", {}}};
  if (modes_count()) all.push_back({make_read_only, ": Permission denied", kObeysModes});
  return all;
}

TEST(CliPlaces, TakenByAFolderOrAReadOnlyFile) {
  for (const Obstacle& obstacle : obstacles()) {
    const Folder folder;
    folder.done({"run", kRing, "--end", "50ms", "-o", "kept", "-q"});
    for (const Arguments& arguments : writers("there")) {
      const std::string& file = arguments.back();
      if (file == "there") continue;  // a folder
      obstacle.make(folder.path() / file);
      expect_place_refused(folder, arguments, {file + obstacle.said}, obstacle.surroundings);
    }
  }
}

// Every file that a command writes in its folder is checked before the work. So each of them is
// made unwritable in turn for the same command.
void expect_each_file_looked_at(const Arguments& arguments, std::vector<std::string> files) {
  for (const std::string& file : files) {
    for (const Obstacle& obstacle : obstacles()) {
      const Folder folder;
      write_studies(folder);
      obstacle.make(folder.path() / file);
      expect_place_refused(folder, arguments, {file + obstacle.said}, obstacle.surroundings);
    }
  }
}

// The files that the command writes to `out`.
std::vector<std::string> written(const Arguments& arguments) {
  const Folder folder;
  write_studies(folder);
  const Outcome done = folder.run(arguments);
  EXPECT_TRUE(done.code == 0 || done.code == 1) << done.err;
  std::vector<std::string> files = folder.files();
  std::erase_if(files, [](const std::string& file) { return !file.starts_with("out/"); });
  EXPECT_GT(files.size(), 1u);
  return files;
}

void expect_all_files_looked_at(const Arguments& arguments) {
  expect_each_file_looked_at(arguments, written(arguments));
}

TEST(CliPlaces, OfTheFilesOfARun) {
  expect_all_files_looked_at({"run", kRing, "--end", "1ms", "-o", "out"});
  expect_all_files_looked_at({"run", kRing, "--engine", "mujoco", "--set", "mujoco.shadow=true",
                              "--end", "1ms", "-o", "out"});
  expect_each_file_looked_at({"run", kRing, "--lyapunov", "-o", "out"}, {"out/lyapunov.json"});
}

// Each of its runs writes the same files.
const Arguments kComparison{"compare", kRing, "--end",      "1ms",
                            "--twins", "0",   "--no-video", "--no-modes-ladder",
                            "-o",      "out"};
TEST(CliPlaces, OfTheFilesOfAComparison) {
  expect_each_file_looked_at(kComparison, every_third(written(kComparison)));
}
// Daily: CliPlaces.OfTheFilesOfAComparison.
TEST(CliPlacesNightly, OfTheFilesOfAComparison) { expect_all_files_looked_at(kComparison); }

TEST(CliPlaces, OfTheFilesOfASweep) {
  const Arguments sweep{"sweep", "study.toml", "--set", "run.end=1e-3", "-o", "out"};
  expect_all_files_looked_at(sweep);
  expect_all_files_looked_at(with(sweep, {"--point", "1"}));
  expect_all_files_looked_at(with(sweep, {"--bifurcation"}));
  expect_each_file_looked_at(with(sweep, {"--shard", "1/2"}), {"out/results.1-of-2.sqlite"});
  expect_each_file_looked_at(with(sweep, {"--slurm"}), {"out/sweep.sbatch"});
}

TEST(CliPlaces, OfTheFilesOfAnOptimisation) {
  expect_all_files_looked_at({"optimise", "goal.toml", "--set", "run.end=1e-3", "-o", "out"});
}

TEST(CliPlaces, OfTheFilesOfBenchesAndChecks) {
  expect_each_file_looked_at({"bench", kRing, "-o", "out"}, {"out/bench.json", "out/bench.html"});
  expect_each_file_looked_at({"check", kRing, "-o", "out"}, {"out/check.json"});
}

TEST(CliPlaces, OfTheFilesOfAStart) {
  expect_each_file_looked_at({"init", "--form", "controller", "--force", "-o", "out/rotor.toml"},
                             {"out/rotor.toml", "out/rotor_controller/follow.c",
                              "out/rotor_controller/rotorub/controller.h"});
}

// ---------------------------------------------------------------- places that take files

// `ulimit -f` of 4 KiB.
TEST(CliPlaces, WhereFilesMayNotGrow) {
  const Folder folder;
  const std::string command = "cd " + folder.path().string() + " && ulimit -f 4 && " +
                              ROTORUB_BINARY + " run " + kRing + " -o out >said 2>&1";
  const int status = std::system(("bash -c '" + command + "'").c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_TRUE(contains(folder.text("said"), "File too large"));
  EXPECT_EQ(folder.files(), std::vector<std::string>{"said"});
}

// Every command creates a missing folder.
TEST(CliPlaces, InAFolderThatIsMade) {
  const Folder folder;
  folder.done({"run", kRing, "--end", "1ms", "-o", "new/kept", "-q"});
  for (const Arguments& arguments :
       std::vector<Arguments>{{"render", "new/kept", "--png", "--size", "320x180", "-o", "a/b.png"},
                              {"plot", "new/kept", "-o", "b/plot.html"},
                              {"mjcf", kRing, "-o", "c/ring.xml"},
                              {"modes", kRing, "-o", "d/modes.html"},
                              {"schema", "-o", "e/schema.json"},
                              {"check", kRing, "-o", "f"}}) {
    folder.done(arguments);
  }
  for (const char* file :
       {"a/b.png", "b/plot.html", "c/ring.xml", "d/modes.html", "e/schema.json", "f/check.json"}) {
    EXPECT_TRUE(folder.has(file)) << file;
  }
}

}  // namespace
}  // namespace rotorub::test
