// The inputs that once broke the scene's reader (tests/fuzz).
#include <gtest/gtest.h>

#include <filesystem>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/text.h"
#include "tests/fuzz/said.h"

namespace rotorub::scene {
namespace {

TEST(FoundInputs, AreReadOrRefusedInPrintableWords) {
  int inputs = 0;
  const std::string folder = ROTORUB_SOURCE_DIR "/tests/fuzz/found";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    ++inputs;
    try {
      parse_scene(file_text(entry.path().string()), "scene.toml");
    } catch (const SceneError& error) {
      test::check_said(error.what());
    }
  }
  EXPECT_GT(inputs, 0);
}

}  // namespace
}  // namespace rotorub::scene
