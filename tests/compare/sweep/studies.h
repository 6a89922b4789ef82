// Studies in a folder of their own, for tests.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "compare/sweep/study_file.h"

namespace rotorub::test {

class StudyFolder {
 public:
  StudyFolder() {
    std::string name = testing::TempDir() + "/rotorub_study_XXXXXX";
    path_ = mkdtemp(name.data());
  }
  ~StudyFolder() { std::filesystem::remove_all(path_); }
  StudyFolder(const StudyFolder&) = delete;
  StudyFolder& operator=(const StudyFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }
  sweep::Study study(const std::string& text) const {
    return sweep::read_study(write("study.toml", text));
  }
  // What refuses a study; empty: nothing.
  std::string refusal(const std::string& text) const {
    try {
      study(text);
    } catch (const std::exception& error) {
      return error.what();
    }
    return {};
  }

 private:
  std::filesystem::path path_;
};

// The first line of a study of bench_ring.
inline std::string of_ring() {
  return "scene = \"" + std::string(ROTORUB_MJCF_DIR) + "/bench_ring.toml\"\n";
}

}  // namespace rotorub::test
