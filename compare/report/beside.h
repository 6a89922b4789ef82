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
  // Scenes of bench.json, each with "machine": where it was measured.
  nlohmann::json benches = nlohmann::json::array();
  nlohmann::json cases = nlohmann::json::array();   // parts for page/layout.js
  nlohmann::json sweeps = nlohmann::json::array();  // sweep/page_data.h
};

// Reads each folder and the folders directly within it, sorted by name. Throws std::runtime_error
// that names a folder without such files, or a file that is not valid.
Beside read_beside(const std::vector<std::string>& folders);

}  // namespace rotorub
