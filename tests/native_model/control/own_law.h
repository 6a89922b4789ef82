// The scene of the tests of users' laws: a rotor in a ring that a law commands.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "native_model/control/library_file.h"
#include "native_model/scene/reader.h"
#include "tests/support/refusal.h"
#include "tests/support/said.h"

namespace rotorub::test {

inline const std::filesystem::path kLibraries = ROTORUB_LIBRARIES;

// These tests open every law that a scene names; LibraryGate tests what happens otherwise.
class Trusting : public testing::Environment {
 public:
  void SetUp() override { set_scene_libraries(SceneLibraries::kAllowed); }
};
[[maybe_unused]] inline const auto* const trusting =
    testing::AddGlobalTestEnvironment(new Trusting);

inline std::string own_law_text(const std::string& library, const std::string& config = "") {
  return R"([run]
end = 0.01
step = "10 us"
[rotor]
speed = "50 Hz"
[rotor.modal]
mass = [1.0]
stiffness = [2e5]
damping = [20.0]
[contact]
radius = 0.05
clearance = "0.5 mm"
friction = 0.1
restitution = 0.5
[stator]
mass = 1.0
stiffness = 1e5
damping = 50.0
[initial]
x = [1e-4]
[controller]
kind = "library"
library = ")" +
         library + R"("
sample_time = "0.5 ms"
[controller.config]
)" + config;
}

// A scene in the folder of the libraries, as from a file there.
inline scene::Scene own_law_scene(const std::string& library, const std::string& config = "",
                                  const std::vector<std::string>& overrides = {}) {
  scene::Scene s = scene::parse_scene(own_law_text(library, config), "own.toml", overrides);
  s.folder = kLibraries.string();
  return s;
}

// The message that refuses the scene; empty if it is read.
inline std::string own_law_refusal(const scene::Scene& scene) {
  const scene::Diagnostic d = refusal(scene);
  return d.reason.empty() ? "" : to_string(d);
}

inline void expect_said(const std::string& said, const std::vector<std::string>& words) {
  for (const std::string& word : words) EXPECT_TRUE(contains(said, word));
}

}  // namespace rotorub::test
