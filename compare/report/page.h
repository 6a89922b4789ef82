// The report: one HTML file for any browser, without a network. It contains everything except the
// films beside it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/report/beside.h"
#include "compare/run_files/run_directory.h"
#include "compare/study/scene_comparison.h"

namespace rotorub {

struct Film {
  std::string link;  // relative URL of the mp4 file beside the page
  std::string caption;
};

struct PageScene {
  const SceneComparison* comparison = nullptr;  // must be complete
  std::vector<Film> films;
  std::string no_films;   // why there are no films
  std::string setting{};  // a sentence with the recommended setting, or on how to find it
};

// The whole page; beside: results of other commands, at the end.
std::string report_page(const std::vector<PageScene>& scenes, const Beside& beside = {});

// The page of one run with its plots and live player, as in the report. shadow: the native model
// that ran alongside, if any; the player shows it as the second run.
std::string run_page(const StoredRun& run, const std::optional<StoredRun>& shadow);

}  // namespace rotorub
