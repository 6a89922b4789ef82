// The frame that makes every page independent of other files and of a network.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "compare/result/result.h"

namespace rotorub {

// A page of a kind of page/head.js. names: of its scenes. found: the result, which a browser
// without scripts shows as text. data: what the script lays out and draws; numbers are written with
// seven digits. With "scenes" (plots.h) it is the page of a report or a run, laid out by
// page/report.js. Otherwise page/still.js lays it out from the parts and the JSON of `found`, from
// "texts" of its scenes, and for some kinds from "rotor" and "loops" (modes/page_data.h), "search"
// (optimise/output.h), "rub_map", or "maps" (sweep/page_data.h).
std::string page_of(const std::string& kind, const std::string& names, const result::Section& found,
                    nlohmann::json data);

// The frame with each {{name}} replaced by its value. Throws std::out_of_range for a name without a
// value.
std::string filled(std::string_view frame, const std::map<std::string, std::string>& values);

}  // namespace rotorub
