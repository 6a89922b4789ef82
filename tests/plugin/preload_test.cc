// The plugin in a program that nobody here wrote: LD_PRELOAD with mujoco-testspeed gives the bits
// of a linked run.
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
    // No control noise. Leaks of the foreign program are not ours to judge.
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

  // The same run here, with the plugin linked.
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

// A shipped scene's, one with the native model alongside, or the example that is written by hand.
std::string document_of(const std::string& name) {
  if (name == "shadow") return mjcf(shipped("bench_ring", {"mujoco.shadow=true"}));
  if (name != "own_model") return mjcf(shipped(name));
  // Without its motor the rotor would not reach the ring: it is thrown at it.
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
