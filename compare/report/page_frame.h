// The frame that makes every page independent of other files and of a network.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "compare/result/result.h"

namespace rotorub {

struct PageHead {
  std::string names;    // of the scenes
  std::string topic;    // a few words, in the title and above the heading
  std::string heading;  // the question that the page answers
};

// A page, which its script lays out. found: the result, which a browser without scripts shows as
// text. data: what the script lays out and draws. With "scenes" (plots.h) it is laid out by
// page/report.js, otherwise by page/still.js. The plots are drawn from "rotor" and "loops"
// (rotor_data.h), "benches" ("scenes" of bench.json), "maps" (sweep_page.h), "rub_map",
// "feedback_map" and "branches" (JSON of `rotorub modes`) and "search" (command_pages.cc). Numbers
// are written with seven digits.
std::string page_of(const PageHead& head, const result::Section& found, const nlohmann::json& data,
                    const std::string& footer);

// The page of one command, laid out by page/still_parts.js from the parts of `found` and the data,
// as its kind asks: "bench", "branches", "feedback_map", "modes", "optimise", "rub_map", "sweep".
std::string laid_out_page(const PageHead& head, const result::Section& found,
                          const std::string& kind, nlohmann::json data, const std::string& footer);

// The frame with each {{name}} replaced by its value. Throws std::out_of_range for a name without a
// value.
std::string filled(std::string_view frame, const std::map<std::string, std::string>& values);

}  // namespace rotorub
