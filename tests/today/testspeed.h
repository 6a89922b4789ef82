// MuJoCo's own testspeed, of 2.2.2 or of a recent version, with the plugin preloaded.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "native_model/trajectory/output.h"
#include "tests/support/temporary_folder.h"

namespace rotorub::test {

struct Testspeed {
  bool today = true;  // else the system's, 2.2.2
  bool plugin = true;
  int threads = 1;               // rollouts side by side
  int engine_threads = 0;        // today's: MuJoCo's own pool of a rollout
  std::string plugin_file = {};  // another one than of this MuJoCo
};

class TestspeedTest : public ::testing::Test {
 protected:
  // Final states of the rollouts, a vector (time, qpos, qvel) each.
  std::vector<std::vector<double>> run(const std::string& document, int steps,
                                       const Testspeed& how = {}) {
    namespace fs = std::filesystem;
    const fs::path xml = folder_ / "scene.xml", states = folder_ / "states";
    const fs::path libraries =
        how.today ? fs::path(ROTORUB_PLUGIN).parent_path() : fs::path(ROTORUB_SYSTEM_LIBS);
    fs::remove(states);
    write_whole(xml, document);
    std::string preload = (libraries / "librotorub_final_state.so").string();
    const std::string file =
        how.plugin_file.empty() ? (libraries / "librotorub_mujoco.so").string() : how.plugin_file;
    if (how.plugin) preload = file + ":" + preload;
    const std::string n = std::to_string(steps), t = std::to_string(how.threads);
    const std::string program =
        how.today
            ? std::string(ROTORUB_TODAY) + "/bin/testspeed --noisestd=0 --nstep=" + n +
                  " --nthread=" + t + " --nenginethread=" + std::to_string(how.engine_threads) +
                  " " + xml.string()
            : "mujoco-testspeed " + xml.string() + " " + n + " " + t + " 0";
    const std::string command =
        "cd " + folder_.path().string() + " && ROTORUB_FINAL_STATE_FILE=" + states.string() +
        " LD_PRELOAD=" + preload + " " + program + " > out.txt 2>&1 < /dev/null";
    status_ = std::system(command.c_str());
    std::vector<std::vector<double>> all;
    std::ifstream in(states);
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      all.emplace_back();
      for (std::string word; words >> word;) {
        all.back().push_back(
            std::bit_cast<double>(static_cast<std::uint64_t>(std::stoull(word, nullptr, 16))));
      }
    }
    std::stringstream text;
    text << std::ifstream(folder_ / "out.txt").rdbuf();
    said_ = text.str();
    return all;
  }
  std::vector<double> last(const std::string& document, int steps, const Testspeed& how = {}) {
    const auto all = run(document, steps, how);
    EXPECT_FALSE(all.empty()) << said_;
    return all.empty() ? std::vector<double>{} : all.back();
  }

  const TemporaryFolder folder_;
  std::string said_;
  int status_ = 0;
};

}  // namespace rotorub::test
