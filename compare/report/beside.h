// Results of other commands that the report shows after its comparison, read from their folders:
// bench.json (`bench -o`), check.json (`check -o`), sweep.json (`sweep -o`).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace rotorub {

inline constexpr const char* kBenchFile = "bench.json";
inline constexpr const char* kCheckFile = "check.json";

struct Beside {
  nlohmann::json benches = nlohmann::json::array();  // for page/precision.js: scenes of bench.json
  nlohmann::json maps = nlohmann::json::array();     // for page/maps.js: sweep_plots, with "maps"
  // For page/layout.js, by the ids of their places: "precision", "cases" and "maps".
  nlohmann::json parts = {{"precision", nlohmann::json::array()},
                          {"cases", nlohmann::json::array()},
                          {"maps", nlohmann::json::array()}};
};

// Reads each folder and the folders directly within it, sorted by name. Throws std::runtime_error
// that names a folder without such files, or a file that is not valid.
Beside read_beside(const std::vector<std::string>& folders);

}  // namespace rotorub
