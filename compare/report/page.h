// The pages: each is one HTML file for any browser, without a network. It contains everything
// except the films beside it.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/report/beside.h"
#include "compare/result/result.h"
#include "compare/run_files/run_directory.h"
#include "compare/study/scene_comparison.h"

namespace rotorub {

// A page of a kind of page/head.js. names: of its scenes. found: the result, which a browser
// without scripts shows as text. data: what the script lays out and draws; numbers are written with
// seven digits. With "scenes" (plots.h) it is the page of a report or a run, laid out by
// page/report.js. Otherwise page/still.js lays it out from the parts and the JSON of `found`, from
// "texts" of its scenes, and for some kinds from "rotor" and "loops" (modes/page_data.h), "search"
// (optimise/output.h), "rub_map", or "maps" (sweep/page_data.h).
std::string page_of(const std::string& kind, const std::string& names, const result::Section& found,
                    nlohmann::json data);

// A film beside the page.
struct Film {
  std::string link;  // relative URL of the mp4 file
  std::string caption;
  NLOHMANN_DEFINE_TYPE_INTRUSIVE(Film, link, caption)
};

struct PageScene {
  const SceneComparison* comparison = nullptr;  // must be complete
  std::vector<Film> films;
  std::string no_films;   // why there are no films
  std::string setting{};  // a sentence with the recommended setting, or on how to find it
};

// The page of a comparison; beside: results of other commands, at the end.
std::string report_page(const std::vector<PageScene>& scenes, const Beside& beside = {});

// The page of one run with its plots and live player, as in the report. shadow: the native model
// that ran alongside, if any; the player shows it as the second run.
std::string run_page(const StoredRun& run, const std::optional<StoredRun>& shadow);

// The frame with each {{name}} replaced by its value. Throws std::out_of_range for a name without a
// value.
std::string filled(std::string_view frame, const std::map<std::string, std::string>& values);

}  // namespace rotorub
