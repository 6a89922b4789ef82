// A command whose output is lost fails; here all output goes to a full device.
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

const Surroundings kFullDevice{{}, "/dev/full"};

TEST(CliOutput, LostOutputIsAReportedFailure) {
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
    EXPECT_TRUE(contains(lost.err, "standard output")) << arguments[0];
  }
}

// The same for commands that print at the end of their work.
TEST(CliOutput, LostOutputAfterLongWorkIsAFailure) {
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
    EXPECT_TRUE(contains(lost.err, "standard output")) << testing::PrintToString(arguments);
  }
  for (const char* command :
       {"run", "compare", "modes", "mjcf", "render", "bench", "sweep", "check", "tune", "plot"}) {
    EXPECT_EQ(folder.run({command, "--help"}, kFullDevice).code, 3) << command;
  }
}

// Nothing was to be printed, so nothing is lost.
TEST(CliOutput, OfAQuietRunCannotBeLost) {
  const Folder folder;
  const Outcome quiet = folder.done(
      {"run", shipped("bench_drop"), "--end", "1ms", "--quiet", "-o", "out"}, kFullDevice);
  EXPECT_TRUE(folder.has("out/summary.json"));
}

// The first failure determines the exit code.
TEST(CliOutput, BadInputHasPrecedenceOverLostOutput) {
  const Folder folder;
  EXPECT_EQ(folder.run({"run", "missing.toml"}, kFullDevice).code, 2);
}

// The same for a named file. (It is a link: see the tests of the files of a run.)
TEST(CliOutput, ToAFullDeviceByNameFails) {
  const Folder folder;
  std::filesystem::create_symlink("/dev/full", folder.path() / "full");
  const Outcome lost = folder.run({"mjcf", shipped("bench_ring"), "-o", "full"});
  EXPECT_EQ(lost.code, 3);
  EXPECT_TRUE(contains(lost.err, "cannot write full: No space left on device"));
}

}  // namespace
}  // namespace rotorub::test
