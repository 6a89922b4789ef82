// The report: one HTML file with everything in it, for any browser, without a network.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/study/scene_comparison.h"

namespace rotorub {

struct Film {
  std::filesystem::path file;  // mp4
  std::string caption;
};

struct PageScene {
  const SceneComparison* comparison = nullptr;  // a finished one
  std::vector<Film> films;
  std::string no_films;  // why there are none
};

// The whole page. Throws std::runtime_error where a film cannot be read.
std::string report_page(const std::vector<PageScene>& scenes);

}  // namespace rotorub
