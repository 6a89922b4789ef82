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
// page/report.js, otherwise from "page", a list of parts for page/layout.js, by page/still.js. The
// plots are drawn from "rotor" (modes_page.h), "loops" (loop_page.h), "benches"
// ("scenes" of bench.json) and "maps" (sweep_page.h).
std::string page_of(const PageHead& head, const result::Section& found, const nlohmann::json& data,
                    const std::string& footer);

// The same with "page" in the data.
std::string laid_out_page(const PageHead& head, const result::Section& found,
                          const nlohmann::json& parts, nlohmann::json data,
                          const std::string& footer);

// A short answer at the top of the page (page/layout.js). tone: "", "good", "bad".
nlohmann::json card(std::string_view title, std::string_view tone, std::string_view headline,
                    std::string_view text);

// The frame with each {{name}} replaced by its value. Throws std::out_of_range for a name without a
// value.
std::string filled(std::string_view frame, const std::map<std::string, std::string>& values);

}  // namespace rotorub
