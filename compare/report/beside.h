// Results of other commands that the report shows beside its comparison, from the folders in which
// these left them: bench.json (`bench -o`), check.json (`check -o`), sweep.json (`sweep -o`).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace rotorub {

inline constexpr const char* kBenchFile = "bench.json";
inline constexpr const char* kCheckFile = "check.json";

struct Beside {
  nlohmann::json benches = nlohmann::json::array();  // for page/precision.js: precision_plots
  nlohmann::json maps = nlohmann::json::array();     // for page/maps.js: sweep_plots
  // For report.html: "benches", "map_sets", "has_cases", "case_engines", "cases", "violations".
  nlohmann::json values = {{"benches", nlohmann::json::array()},
                           {"map_sets", nlohmann::json::array()},
                           {"has_cases", false},
                           {"case_engines", nlohmann::json::array()},
                           {"cases", nlohmann::json::array()},
                           {"violations", nlohmann::json::array()}};
};

// Of each folder what lies in it and in the folders directly in it, in order of name. Throws
// std::runtime_error that names the folder with nothing in it, or the file that is none of these.
Beside read_beside(const std::vector<std::string>& folders);

}  // namespace rotorub
