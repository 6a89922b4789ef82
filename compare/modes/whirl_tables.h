// Tables of the free rotor's whirl: modes at a speed, critical speeds and mode shapes. Also values
// of the JSON of `rotorub modes`.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/base/json.h"
#include "compare/modes/rotor_analysis.h"
#include "compare/result/result.h"

namespace rotorub {

// The list {"frequency", "damping_ratio"}, for people with the name of each mode. headed: with
// headings on the terminal.
result::Table whirl_table(const std::string& place, const std::vector<WhirlMode>& modes,
                          const std::function<std::string(const WhirlMode&)>& name_of,
                          bool headed = false);

// The critical speeds that unbalance excites; with isotropic planes it cannot drive backward whirl.
std::vector<result::Part> critical_parts(const RotorAnalysis& analysis);

std::vector<result::Part> shapes_parts(const std::optional<ModeShapes>& shapes);

// null if the text is empty.
inline nlohmann::json text_or_null(const std::string& text) {
  return text.empty() ? nlohmann::json(nullptr) : nlohmann::json(text);
}

// The ranges as pairs, with null for an end at infinity.
template <class Ranges>
nlohmann::json ranges_json(const Ranges& ranges) {
  nlohmann::json all = nlohmann::json::array();
  for (const auto& [from, to] : ranges) all.push_back({from, number_or_null(to)});
  return all;
}

}  // namespace rotorub
