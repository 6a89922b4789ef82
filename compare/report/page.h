// The report: one HTML file with everything in it but the films beside it, for any browser, without
// a network.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/report/beside.h"
#include "compare/run_files/run_directory.h"
#include "compare/study/scene_comparison.h"

namespace rotorub {

struct Film {
  std::string link;  // from the page to the mp4 beside it, as a URL has it
  std::string caption;
};

struct PageScene {
  const SceneComparison* comparison = nullptr;  // a finished one
  std::vector<Film> films;
  std::string no_films;   // why there are none
  std::string setting{};  // to use, or how to find it; a sentence
};

// The whole page; beside: results of other commands, at its end.
std::string report_page(const std::vector<PageScene>& scenes, const Beside& beside = {});

// The page of one run: its plots and its live player, as in the report. shadow: the native model
// that ran alongside, where there was one: the second run of the player.
std::string run_page(const StoredRun& run, const std::optional<StoredRun>& shadow);

}  // namespace rotorub
