// Lost output is no success: whatever is printed goes to a full device here.
#include <gtest/gtest.h>
#include <sys/mount.h>

#include <chrono>
#include <fstream>
#include <string>
#include <vector>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

const Surroundings kFullDevice{{}, "/dev/full"};

TEST(CliOutput, LostIsAFailureThatIsSaid) {
  const std::string ring = shipped("bench_ring"), drop = shipped("bench_drop");
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"mjcf", ring},
                                             {"mjcf", ring, "--json"},
                                             {"mjcf", ring, "-o", "ring.xml"},
                                             {"modes", ring},
                                             {"modes", ring, "--json"},
                                             {"run", drop, "--end", "1ms", "-o", "out"},
                                             {"run", drop, "--end", "1ms", "-o", "out", "--json"},
                                             {"--help"},
                                             {"run", "--help"},
                                             {"--version"}}) {
    const Folder folder;
    const Outcome lost = folder.run(arguments, kFullDevice);
    EXPECT_EQ(lost.code, 3) << arguments[0];
    EXPECT_NE(lost.err.find("standard output"), std::string::npos) << arguments[0] << lost.err;
  }
}

// The same of the commands that print at the end of their work.
TEST(CliOutput, LostOfLongerWorkToo) {
  const Folder folder;
  const std::string ring = shipped("bench_ring"), drop = shipped("bench_drop");
  folder.done({"run", drop, "--end", "1ms", "-o", "kept", "-q"});
  std::ofstream(folder.path() / "study.toml")
      << "scene = \"" << drop
      << "\"\n[sample]\nkind = \"grid\"\n[[vary]]\nkey = \"contact.friction\"\nvalues = [0.1]\n"
      << "[run]\nend = 1e-3\n";
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"check", drop, "--set", "run.end=1e-3"},
           {"check", drop, "--set", "run.end=1e-3", "--json"},
           {"sweep", "study.toml", "-o", "one"},
           {"sweep", "study.toml", "-o", "two", "--json"},
           {"plot", "kept"},
           {"plot", "kept", "--json"},
           {"render", "kept", "--png", "--size", "320x180", "-o", "a.png"},
           {"compare", drop, "--end", "1ms", "--no-video", "--twins", "0"},
           {"tune", drop, "--end", "1ms", "--steps", "100us", "--twins", "0"},
           {"bench", drop, "--set", "run.end=1e-3", "--engines", "native-event", "--steps", "100us",
            "--repeats", "1"}}) {
    const Outcome lost = folder.run(arguments, kFullDevice);
    EXPECT_EQ(lost.code, 3) << testing::PrintToString(arguments) << lost.err;
    EXPECT_NE(lost.err.find("standard output"), std::string::npos)
        << testing::PrintToString(arguments) << lost.err;
  }
  for (const char* command :
       {"run", "compare", "modes", "mjcf", "render", "bench", "sweep", "check", "tune", "plot"}) {
    EXPECT_EQ(folder.run({command, "--help"}, kFullDevice).code, 3) << command;
  }
}

// Nothing was to be printed, and nothing is lost.
TEST(CliOutput, OfAQuietRunCannotBeLost) {
  const Folder folder;
  const Outcome quiet = folder.done(
      {"run", shipped("bench_drop"), "--end", "1ms", "--quiet", "-o", "out"}, kFullDevice);
  EXPECT_TRUE(folder.has("out/summary.json"));
}

// The first failure is the one that counts.
TEST(CliOutput, LostBesideBadInputIsBadInput) {
  const Folder folder;
  EXPECT_EQ(folder.run({"run", "missing.toml"}, kFullDevice).code, 2);
}

// The same for a file that is named. (By a link: see the tests of the files of a run.)
TEST(CliOutput, ToAFullDeviceByNameFails) {
  const Folder folder;
  std::filesystem::create_symlink("/dev/full", folder.path() / "full");
  const Outcome lost = folder.run({"mjcf", shipped("bench_ring"), "-o", "full"});
  EXPECT_EQ(lost.code, 3);
  EXPECT_NE(lost.err.find("cannot write full: No space left on device"), std::string::npos)
      << lost.err;
}

// ----------------------------------------------------------------
// Where nothing can be written is a mistake of who named the place: exit code 2, said before the
// work begins.

using Arguments = std::vector<std::string>;

// Every command that writes, to `place`; those that compute long are to refuse before it.
std::vector<Arguments> writers(const std::string& place) {
  const std::string ring = shipped("bench_ring");
  return {{"run", ring, "--end", "1e4", "--integrator", "verlet", "-o", place},
          {"run", ring, "--engine", "mujoco", "--end", "1e4", "-o", place},
          {"compare", ring, "--end", "1e3", "-o", place},
          {"bench", ring, "-o", place},
          {"check", ring, "--set", "run.end=1e3", "-o", place},
          {"tune", ring, "-o", place + "/tuned.toml"},
          {"sweep", "study.toml", "-o", place},
          {"render", ring, "-o", place + "/film.mp4"},
          {"render", "kept", "-o", place + "/film.gif"},
          {"render", "kept", "-o", place + "/film.png"},
          {"plot", "kept", "-o", place + "/plot.html"},
          {"modes", ring, "-o", place},
          {"modes", ring, "-o", place + "/modes.html"},
          {"modes", ring, "--rub-map", "--speeds", "10Hz:100Hz:1000", "--frictions",
           "0.01:0.5:1000", "-o", place + "/map.html"},
          {"mjcf", ring, "-o", place + "/ring.xml"}};
}

void expect_all_refused(const Folder& folder, const std::string& place) {
  folder.done({"run", shipped("bench_ring"), "--end", "1ms", "-o", "kept", "-q"});
  std::ofstream(folder.path() / "study.toml")
      << "scene = \"" << shipped("bench_ring")
      << "\"\n[sample]\nkind = \"grid\"\n[[vary]]\nkey = \"contact.friction\"\nfrom = 0.1\nto = "
         "0.2\ncount = 1000\n";
  const auto before = folder.files();
  for (const Arguments& arguments : writers(place)) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    const auto start = std::chrono::steady_clock::now();
    const Outcome refused = folder.run(arguments);
    EXPECT_EQ(refused.code, 2) << refused.err;
    EXPECT_NE(refused.err.find(place), std::string::npos) << refused.err;
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
    EXPECT_EQ(folder.files(), before);
  }
}

// `ulimit -f` of 4 KiB.
TEST(CliPlaces, WhereFilesMayNotGrow) {
  const Folder folder;
  const std::string command = "cd " + folder.path().string() + " && ulimit -f 4 && " +
                              ROTORUB_BINARY + " run " + shipped("bench_ring") +
                              " -o out >said 2>&1";
  const int status = std::system(("bash -c '" + command + "'").c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_TRUE(contains(folder.text("said"), "File too large")) << folder.text("said");
  EXPECT_EQ(folder.files(), std::vector<std::string>{"said"});
}

// A folder that is not there is made, by every command alike.
TEST(CliPlaces, InAFolderThatIsMade) {
  const Folder folder;
  const std::string ring = shipped("bench_ring");
  folder.done({"run", ring, "--end", "1ms", "-o", "new/kept", "-q"});
  for (const Arguments& arguments :
       std::vector<Arguments>{{"render", "new/kept", "--png", "--size", "320x180", "-o", "a/b.png"},
                              {"plot", "new/kept", "-o", "b/plot.html"},
                              {"mjcf", ring, "-o", "c/ring.xml"},
                              {"modes", ring, "-o", "d/modes.html"},
                              {"schema", "-o", "e/schema.json"},
                              {"check", ring, "-o", "f"}}) {
    folder.done(arguments);
  }
  for (const char* file :
       {"a/b.png", "b/plot.html", "c/ring.xml", "d/modes.html", "e/schema.json", "f/check.json"}) {
    EXPECT_TRUE(folder.has(file)) << file;
  }
  const Outcome refused = folder.run({"mjcf", ring, "-o", "c"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(contains(refused.err, "c: is a folder")) << refused.err;
}

TEST(CliPlaces, BelowAFile) {
  const Folder folder;
  std::ofstream(folder.path() / "file") << "text";
  expect_all_refused(folder, "file/below");
}

// A folder without the right to write. To root every folder is open, but not a file system mounted
// read-only.
TEST(CliPlaces, WithoutTheRight) {
  const Folder folder;
  const auto closed = folder.path() / "closed";
  std::filesystem::create_directory(closed);
  const bool mounted = getuid() == 0;
  if (!mounted) {
    std::filesystem::permissions(
        closed, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  } else if (mount("none", closed.c_str(), "tmpfs", MS_RDONLY, nullptr) != 0) {
    GTEST_SKIP() << "root here, who may write anywhere, and nothing can be mounted";
  }
  expect_all_refused(folder, "closed");
  if (mounted) umount(closed.c_str());
  std::filesystem::permissions(closed, std::filesystem::perms::owner_all);
}

}  // namespace
}  // namespace rotorub::test
