// The plugin in MuJoCo's unmodified windowed programs: they start under Xvfb, step, and give the
// bits of a linked run. Their exit codes have no meaning.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "mjcf/writer.h"
#include "native_model/trajectory/output.h"
#include "plugin/hooks.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/temporary_folder.h"

namespace rotorub::test {
namespace {

namespace fs = std::filesystem;

constexpr int kProgramSteps = 3000;

class Programs : public MujocoTest {
 protected:
  // The line that an mjData of the program leaves after kProgramSteps steps from time 0
  // (step_log.cc).
  std::string logged(const std::string& document, const std::string& program,
                     const std::string& arguments, bool plugin) const {
    const fs::path xml = folder_ / "scene.xml", log = folder_ / "log";
    fs::remove(log);
    write_whole(xml, document);
    const fs::path logger = fs::path(ROTORUB_PLUGIN).parent_path() / "librotorub_step_log.so";
    EXPECT_TRUE(fs::exists(logger)) << logger;
    const std::string libraries =
        (plugin ? std::string(ROTORUB_PLUGIN) + ":" : std::string()) + logger.string();
    const std::string command =
        "cd " + folder_.path().string() + " && TMPDIR=" + folder_.path().string() + " " +
        ROTORUB_SOURCE_DIR + "/tests/support/until_logged " + log.string() +
        " env LD_PRELOAD=" + libraries + " ROTORUB_STEP_LOG_FILE=" + log.string() +
        " ROTORUB_STEP_LOG_AT=" + std::to_string(kProgramSteps) + " " + program + " " +
        xml.string() + " " + arguments + " > out.txt 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    std::ifstream in(log);
    std::string line;
    std::getline(in, line);
    std::ifstream out(folder_ / "out.txt");
    std::stringstream said;
    said << out.rdbuf();
    EXPECT_FALSE(line.empty()) << program << " did not step; it said: " << said.str();
    return line;
  }

  // The same run in this process, with the plugin linked: from mj_makeData, as the programs start.
  static std::string linked(const std::string& document) {
    const plugin::Hooks hooks;
    const ModelPointer m = load(document);
    const DataPointer d(mj_makeData(m.get()));
    for (int k = 0; k < kProgramSteps; ++k) mj_step(m.get(), d.get());
    return "1 " + state_bits(m.get(), d.get());
  }

  // Programs that open a window are not started with a sanitizer, whose run time would come before
  // the graphics driver's.
  static bool sanitized() { return std::string(ROTORUB_SANITIZER_RUNTIME) != ""; }

  const TemporaryFolder folder_;
};

TEST_F(Programs, SimulateStepsWithThePlugin) {
  if (sanitized()) GTEST_SKIP() << "not under sanitizers";
  const std::string document = mjcf(shipped("bench_ring"));
  const std::string with = logged(document, "mujoco-simulate", "", true);
  EXPECT_EQ(with, linked(document));
  const std::string without = logged(document, "mujoco-simulate", "", false);
  EXPECT_EQ(without.substr(0, 2), "0 ");
  EXPECT_NE(without, with);
}

TEST_F(Programs, RecordStepsWithThePlugin) {
  if (sanitized()) GTEST_SKIP() << "not under sanitizers";
  const std::string document = mjcf(shipped("bench_ring"));
  const std::string with = logged(document, "mujoco-record", "0.05 60 frames.rgb", true);
  EXPECT_EQ(with, linked(document));
  EXPECT_GT(fs::file_size(folder_ / "frames.rgb"), 0u);
}

// ---------------------------------------------------------------- preloaded
// The plugin in an unmodified program: LD_PRELOAD with mujoco-testspeed gives the bits of a linked
// run.

class Preload : public MujocoTest, public ::testing::WithParamInterface<const char*> {
 protected:
  // Final states of mujoco-testspeed, as lines of hexadecimal bits; `plugin`: with ours preloaded.
  std::vector<std::string> testspeed(const std::string& document, int steps, int threads,
                                     bool plugin) const {
    const fs::path xml = folder_ / "scene.xml", states = folder_ / "states";
    fs::remove(states);
    write_whole(xml, document);
    const fs::path keeper = fs::path(ROTORUB_PLUGIN).parent_path() / "librotorub_final_state.so";
    EXPECT_TRUE(fs::exists(keeper)) << keeper;
    std::string libraries = ROTORUB_SANITIZER_RUNTIME;
    if (!libraries.empty()) libraries += ":";
    if (plugin) libraries += std::string(ROTORUB_PLUGIN) + ":";
    libraries += keeper.string();
    // Without control noise. Leaks of the foreign program do not count.
    const std::string command =
        "cd " + folder_.path().string() + " && ASAN_OPTIONS=detect_leaks=0 " +
        "ROTORUB_FINAL_STATE_FILE=" + states.string() + " LD_PRELOAD=" + libraries +
        " mujoco-testspeed " + xml.string() + " " + std::to_string(steps) + " " +
        std::to_string(threads) + " 0 > out.txt 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    std::vector<std::string> lines;
    std::ifstream in(states);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    std::ifstream out(folder_ / "out.txt");
    std::stringstream said;
    said << out.rdbuf();
    EXPECT_FALSE(lines.empty()) << said.str();
    return lines;
  }

  // The same run in this process, with the plugin linked.
  static std::string linked(const std::string& document, int steps) {
    const plugin::Hooks hooks;
    const ModelPointer m = load(document);
    const DataPointer d = start(m.get());
    for (int k = 0; k < steps; ++k) {
      // testspeed writes its control noise over ctrl before each step: 0 here.
      mju_zero(d->ctrl, m->nu);
      mj_step(m.get(), d.get());
    }
    return state_bits(m.get(), d.get());
  }

  const TemporaryFolder folder_;
};

// A shipped scene, one with the shadow, or the hand-written example.
std::string document_of(const std::string& name) {
  if (name == "shadow") return mjcf(shipped("bench_ring", {"mujoco.shadow=true"}));
  if (name != "own_model") return mjcf(shipped(name));
  // Without its motor the rotor would not reach the ring, so it is thrown at it.
  std::string document = own_model_example();
  const std::string start = "qvel=\"0 0 300", thrown = "qvel=\"1 0 300";
  for (std::size_t at = document.find(start); at != std::string::npos; at = document.find(start)) {
    document.replace(at, start.size(), thrown);
  }
  return document;
}

// On one thread and on two.
TEST_P(Preload, TestspeedGivesTheBitsOfALinkedRun) {
  constexpr int kSteps = 20000;
  const std::string document = document_of(GetParam()), wanted = linked(document, kSteps);
  EXPECT_EQ(testspeed(document, kSteps, 1, true).back(), wanted);
  EXPECT_NE(testspeed(document, kSteps, 1, false).back(), wanted) << "the plugin did nothing";
  const std::vector<std::string> two = testspeed(document, kSteps, 2, true);
  ASSERT_GE(two.size(), 2u);
  EXPECT_EQ(two[two.size() - 1], wanted);
  EXPECT_EQ(two[two.size() - 2], wanted);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Preload,
                         ::testing::Values("bench_ring", "paper_passive", "paper_sliding",
                                           "paper_magnetic", "own_model", "shadow"));

}  // namespace
}  // namespace rotorub::test
