// The hard scenes: each has its committed .xml, or the writer refuses it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "mjcf/writer.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/rules.h"

namespace rotorub::test {
namespace {

TEST(HardScenes, CommittedFilesAreTheWritersOwn) {
  int written = 0, refused = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(ROTORUB_MJCF_DIR) / "hard")) {
    if (entry.path().extension() != ".toml") continue;
    SCOPED_TRACE(entry.path());
    std::filesystem::path xml = entry.path();
    xml.replace_extension(".xml");
    std::string text;
    try {
      const scene::Scene scene = scene::read_scene(entry.path());
      EXPECT_FALSE(scene::read_rules(scene).empty()) << "a hard case has a rule";
      text = mjcf(scene);
    } catch (const scene::SceneError&) {
      EXPECT_FALSE(std::filesystem::exists(xml));
      ++refused;
      continue;
    }
    std::ifstream in(xml, std::ios::binary);
    std::stringstream committed;
    committed << in.rdbuf();
    EXPECT_EQ(committed.str(), text) << "write it anew: rotorub mjcf";
    ++written;
  }
  EXPECT_GE(written, 25);
  EXPECT_EQ(refused, 1) << "indefinite_mass";
}

}  // namespace
}  // namespace rotorub::test
